"""Datasets follow the CF conventions: the rules that a checker tests, one by one."""

import re

import nonsmooth as ns
import numpy as np
import passive_hopper as hopper
import pytest
from nonsmooth import labelling

xarray = pytest.importorskip("xarray")

WORD = re.compile(r"[A-Za-z0-9_.+@-]+")


def in_a_store(tmp_path):
    pytest.importorskip("zarr")
    return hopper.basins(M=(0.2, 1.0), shape=(8, 8), store=tmp_path / "basins.zarr")


BALL = ns.System(
    ["speed", "-1"], states="height speed", guards=[ns.Guard("floor", "height", "falling", reset=["height", "-0.8*speed"])]
)
WELL = ns.System(["v", "x - x^3 - 0.3*v"], states="x v")


def along_a_parameter(path):
    at = lambda c: ns.map_steps([f"x + 0.4*x*(1 - x^2) + {c}"], states="x")
    return ns.attractors_along(at, (0.0, 0.1), {"x": (-1.7, 1.7)}, steps=2, difference=0.5, points=50).to_xarray("c")


DATASETS = {
    "run": lambda path: BALL.run([1, 0], time=4).to_xarray(),
    "run at times": lambda path: BALL.run([1, 0], time=4, t=[0, 1, 2, 4]).to_xarray(),
    "basins of a system": lambda path: ns.basins_of(WELL, {"x": (-2, 2), "v": (-2, 2)}, (4, 4), step=1.0, starts=5, locate=50, tests=5),
    "along a parameter": along_a_parameter,
    "basins": lambda path: hopper.basins(M=(0.2, 1.0), shape=(8, 8)),
    "store": in_a_store,
    "motion": lambda path: hopper.motion(7.0, hops=3),
    "basins_of": lambda path: labelling.basins_of(
        lambda x, y: x > y, {"x": (0, 1), "y": (0, 1)}, shape=(4, 4), names={1: "above α; (é)"}
    ),
}


@pytest.mark.parametrize("name", DATASETS)
def test_attributes_follow_the_conventions(name, tmp_path):
    found = DATASETS[name](tmp_path)
    assert found.attrs["Conventions"] == "CF-1.11" and all(found.attrs[name] for name in ("title", "source", "history"))
    for own in found.variables.values():
        assert own.attrs.get("long_name")
        # A unit that UDUNITS knows: all numbers of the model are dimensionless.
        assert own.attrs.get("units", "1") == "1"
        if "flag_values" in own.attrs:
            values, words = own.attrs["flag_values"], own.attrs["flag_meanings"].split(" ")
            assert np.asarray(values).dtype == own.dtype and len(values) == len(words) == len(set(words))
            assert all(WORD.fullmatch(word) for word in words), words
    for name, own in found.coords.items():
        assert not np.isnan(own.values).any() and own.encoding["_FillValue"] is None
        # A variable with the name of its dimension rises strictly.
        if own.dims == (name,):
            assert (np.diff(own.values) > 0).all()


@pytest.mark.parametrize("name", DATASETS)
def test_a_file_has_the_same_types(name, tmp_path):
    pytest.importorskip("netCDF4")
    found = DATASETS[name](tmp_path)
    found.to_netcdf(tmp_path / "found.nc")
    with xarray.open_dataset(tmp_path / "found.nc") as back:
        assert back.load().identical(found.load())
        for own in back.variables.values():
            assert "flag_values" not in own.attrs or np.asarray(own.attrs["flag_values"]).dtype == own.dtype
