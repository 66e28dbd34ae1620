"""How far a computation is: a function, or a bar of tqdm."""

import sys

import passive_hopper as hopper
import pytest
from nonsmooth.labelling import basins_of


def raster(progress, folder):
    hopper.basin_labels(shape=(24, 8), progress=progress)


def dataset(progress, folder):
    pytest.importorskip("xarray")
    hopper.basins(shape=(24, 8), progress=progress)


def store(progress, folder):
    pytest.importorskip("zarr", reason="stores need zarr")
    hopper.basins(shape=(24, 8), store=folder / "basins.zarr", progress=progress)


def labelling(progress, folder):
    pytest.importorskip("xarray")
    basins_of(lambda x, y: x > y, {"x": (0, 1), "y": (0, 1)}, shape=(24, 8), progress=progress)


def animation(progress, folder):
    pytest.importorskip("xarray")
    hopper.animate(hopper.motion(7.0, hops=1), folder / "hopper.gif", progress=progress)


CALLS = [raster, dataset, store, labelling, animation]


@pytest.mark.parametrize("call", CALLS)
def test_true_shows_a_bar_up_to_its_end(call, tmp_path, capsys):
    pytest.importorskip("tqdm", reason="SKIPPED bars: tqdm is not installed")
    counts = []
    counted = tmp_path / "counted"
    counted.mkdir()
    call(lambda *done: counts.append(done), counted)
    done, all = counts[-1]
    assert done == all
    call(True, tmp_path)
    bar = capsys.readouterr().err
    assert "100%" in bar and f"{all}/{all}" in bar


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("none", [None, False])
def test_none_and_false_show_nothing(call, none, tmp_path, capsys):
    call(none, tmp_path)
    found = capsys.readouterr()
    assert found.out == found.err == ""


@pytest.mark.parametrize("call", CALLS)
def test_without_tqdm_true_says_what_to_install(call, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    with pytest.raises(ImportError, match=r"passive-hopper\[progress\]"):
        call(True, tmp_path)
    assert not [file for file in tmp_path.iterdir() if file.name == "hopper.gif"]


@pytest.mark.parametrize("call", CALLS)
def test_what_is_no_function_is_told(call, tmp_path):
    with pytest.raises(TypeError, match="not 3"):
        call(3, tmp_path)
