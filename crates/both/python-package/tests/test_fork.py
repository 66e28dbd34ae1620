"""A child of fork has none of the threads of its parent: every call works there, too."""

import multiprocessing
import multiprocessing.connection
import os
import sys
import warnings

import numpy as np
import passive_hopper as hopper
import pytest
from nonsmooth import labelling

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")

CALLS = {
    "basin_labels": lambda: hopper.basin_labels(M=(0.1, 1), shape=(64, 64))[2].sum(),
    "interval_basins": lambda: repr(hopper.interval_basins(0.95)),
    "fractions": lambda: repr(hopper.fractions(0.2)),
    "fates": lambda: hopper.LiftOffMap(0.2).fates(np.linspace(4.5, 9, 1000)).sum(),
    "region_fractions": lambda: repr(labelling.region_fractions(lambda x, y: x < y, [(0, 1), (0, 1)], count=1000)),
    "attractors": lambda: repr(labelling.Attractors(lambda x: x / 2, region=[(-1, 1)], starts=[[0.5]], tests=5)),
}


def in_child(call, depth=1):
    """The text of the result in a child of a child of …, within half a minute."""
    read, write = os.pipe()
    with warnings.catch_warnings():
        # Python warns of threads: that is what this test is about.
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if child == 0:
        try:
            text = in_child(call, depth - 1) if depth > 1 else str(call())
        except BaseException as error:
            text = repr(error)
        os.write(write, text.encode())
        os._exit(0)
    os.close(write)
    context = multiprocessing.connection.wait([read], timeout=30)
    if not context:
        os.kill(child, 9)
    os.waitpid(child, 0)
    with os.fdopen(read, "rb") as pipe:
        return pipe.read().decode() if context else "no answer within 30 s"


@pytest.mark.parametrize("name", CALLS)
def test_a_call_works_after_a_fork(name):
    call = CALLS[name]
    # The parent has used its threads.
    expected = str(call())
    assert in_child(call) == expected
    assert in_child(call, depth=2) == expected
    assert str(call()) == expected


def test_a_pool_of_forked_processes_works():
    hopper.basin_labels(M=(0.1, 1), shape=(16, 16))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        with multiprocessing.get_context("fork").Pool(2) as pool:
            found = pool.map_async(_size, [8, 16]).get(timeout=60)
    assert found == [64, 256]


def _size(side):
    return hopper.basin_labels(M=(0.1, 1), shape=(side, side))[2].size


if sys.version_info >= (3, 12):
    pytestmark = [pytestmark, pytest.mark.filterwarnings("ignore::DeprecationWarning")]
