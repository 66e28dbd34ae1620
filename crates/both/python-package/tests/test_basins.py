"""Fates, traps and basins."""

import threading
import time

import numpy as np
import passive_hopper as hopper
import pytest


def test_fates_of_scalars_and_arrays_agree():
    m = hopper.LiftOffMap(0.2)
    speeds = np.linspace(4.5, 20, 500)
    assert [m.fate(float(speed)).label for speed in speeds] == m.fates(speeds).tolist()
    assert m.fates(speeds.reshape(5, 100)).shape == (5, 100)
    fate = m.fate(4.55)
    assert (fate.label, fate.name) == (1, hopper.label_name(1))


def test_traps_and_crises():
    trap = hopper.trap(1, 0.2)
    assert trap.left == hopper.alpha_star(1) and trap.left < trap.right
    assert trap.left in trap and trap.right + 1e-9 not in trap
    assert hopper.crisis(1).mass_ratio == pytest.approx(0.10345775533613707, abs=1e-15)
    assert hopper.grounding(1).mass_ratio > 0.3
    assert np.array_equal(hopper.alpha_star(range(1, 4)), [hopper.alpha_star(n) for n in (1, 2, 3)])
    with pytest.raises(ValueError):
        hopper.crisis(0)
    for call in (hopper.alpha_star, hopper.crisis, hopper.grounding, hopper.label_name, lambda n: hopper.trap(n, 0.2)):
        for n in (-1, 2**64):
            with pytest.raises(ValueError, match=f"needed, not {n}"):
                call(n)
        with pytest.raises(TypeError, match="'float'"):
            call(1.5)


def test_intervals_agree_with_fates():
    basins = hopper.interval_basins(0.2, last=3)
    left, right, labels = basins.arrays()
    assert len(left) == len(basins) and (left <= right).all() and (left[1:] >= right[:-1]).all()
    m = hopper.LiftOffMap(0.2)
    wide = right - left > 1e-9
    assert np.array_equal(m.fates((0.5 * (left + right))[wide]), labels[wide])
    assert basins.ground == "branches" and basins.probes[1] == 0
    total = sum(basins.fraction(int(label)).lower for label in np.unique(labels))
    assert total == pytest.approx(1 - basins.undecided / (basins.window[1] - basins.window[0]), abs=1e-9)
    assert basins.label(4.55) == 1
    assert hopper.interval_basins(2.0, last=2).ground == "enclosures"


def test_the_papers_fraction():
    fractions = hopper.fractions(0.2)
    incessant = sum(share for name, share in fractions.items() if name.startswith("to "))
    assert incessant == pytest.approx(0.037, abs=5e-4)
    assert sum(fractions.values()) == pytest.approx(1)


def test_rasters_have_the_fates_of_their_pixels():
    calls = []
    ratios, speeds, labels = hopper.basin_labels(
        M=(0.15, 0.9), alpha=(4.5, 12.0), shape=(100, 80), progress=lambda done, all: calls.append((done, all))
    )
    assert labels.shape == (100, 80) and labels.dtype == np.uint16
    assert calls[-1] == (100, 100) and calls == sorted(calls)
    for column in (0, 37, 99):
        assert np.array_equal(hopper.LiftOffMap(ratios[column]).fates(speeds), labels[column])


def test_windows_are_lists_or_arrays_as_well():
    tuples = hopper.basin_labels(M=(0.1, 1.0), alpha=(4.5, 9.0), shape=(6, 4))
    lists = hopper.basin_labels(M=[0.1, 1.0], alpha=np.array([4.5, 9.0]), shape=[6, 4])
    assert all(np.array_equal(one, other) for one, other in zip(tuples, lists))


def test_datasets_name_their_flags():
    xarray = pytest.importorskip("xarray")
    found = hopper.basins(shape=(20, 30))
    assert isinstance(found, xarray.Dataset) and found["label"].dims == ("M", "alpha")
    label = found["label"]
    assert len(label.attrs["flag_meanings"].split()) == len(label.attrs["flag_values"])


@pytest.mark.parametrize(
    "arguments, part",
    [
        ({"M": (1.0, 0.1)}, "0.1"),
        ({"M": (0.1, float("nan"))}, "NaN"),
        ({"alpha": (-1.0, 5.0)}, "-1"),
        ({"shape": (0, 10)}, "0"),
        ({"shape": (-4, 10)}, "-4"),
        ({"shape": (4, 10, 2)}, "3"),
        ({"shape": (2**40, 2**40)}, "1099511627776"),
    ],
)
def test_wrong_windows_are_value_errors_with_the_numbers(arguments, part):
    with pytest.raises(ValueError) as caught:
        hopper.basin_labels(**({"shape": (4, 4)} | arguments))
    assert part in str(caught.value)


def test_an_error_in_progress_ends_the_computation():
    def progress(done, all):
        raise RuntimeError("stop")

    with pytest.raises(RuntimeError, match="stop"):
        hopper.basin_labels(shape=(512, 512), progress=progress)


def test_ctrl_c_ends_a_long_raster(ctrl_c):
    with ctrl_c():
        hopper.basin_labels(shape=(20000, 20000))


def test_other_threads_run_meanwhile():
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    hopper.basin_labels(shape=(512, 512))
    done.set()
    thread.join()
    assert len(ticks) > 5


def test_pictures_are_drawn(tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    hopper.cobweb(0.2, 7.0).figure.savefig(tmp_path / "cobweb.png")
    hopper.plot_basins(shape=(64, 64)).figure.savefig(tmp_path / "basins.png")
    image = hopper.plot_basins(M=[0.2, 0.3], alpha=(5, 6), shape=(1, 1)).images[0]
    assert image.get_extent() == [0.2, 0.3, 5, 6]
    assert (tmp_path / "basins.png").stat().st_size > 1000


def test_every_layer_is_an_array_and_a_dataset(tmp_path):
    """What the table of layers has, Python has: as arrays, in memory, and in a store."""
    pytest.importorskip("xarray")
    wanted = dict(M=(0.1, 0.3), alpha=(8.0, 10.0), shape=(9, 7))
    _, _, labels = hopper.basin_labels(**wanted)
    numbered = [layer for layer in hopper.layers() if layer["dtype"] is not None]
    assert {"label", "hops", "proof"} <= {layer["key"] for layer in numbered}
    for layer in numbered:
        key = layer["key"]
        _, _, numbers = hopper.basin_labels(**wanted, layer=key)
        assert (numbers.dtype, numbers.shape) == (layer["dtype"], (9, 7))
        if layer["fates"]:
            assert (numbers.astype(int) % 65536 == labels).all()
        found = hopper.basins(**wanted, layer=key)
        # Pixels without a number are NaN.
        assert np.array_equal(found[key].values, numbers, equal_nan=True) and found[key].attrs["long_name"]
        if layer["fates"]:
            assert set(np.unique(numbers)) == set(found[key].attrs["flag_values"])
        pytest.importorskip("zarr")
        for _ in range(2):
            stored = hopper.basins(**wanted, layer=key, store=tmp_path / f"{key}.zarr")
            assert stored[key].dtype == layer["dtype"]
            assert np.array_equal(stored[key].values, numbers, equal_nan=True)
            assert stored.attrs["sha256"] == found.attrs["sha256"]
    for key in ("coverage", "none"):
        with pytest.raises(ValueError, match="there are 'label', 'hops', 'proof'"):
            hopper.basins(**wanted, layer=key)
        with pytest.raises(ValueError, match="there are 'label', 'hops', 'proof'"):
            hopper.basin_labels(**wanted, layer=key)
