"""Every script of the gallery runs as it stands, and leaves its picture."""

import runpy
from pathlib import Path

import pytest

matplotlib = pytest.importorskip("matplotlib")
pytest.importorskip("xarray")

GALLERY = Path(__file__).resolve().parents[1] / "gallery"
SCRIPTS = sorted(script for script in GALLERY.glob("*.py") if script.name != "draw_all.py")


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_a_script_runs_and_leaves_its_picture(script, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    matplotlib.use("Agg")
    runpy.run_path(str(script), run_name="__main__")
    matplotlib.pyplot.close("all")
    (picture,) = tmp_path.iterdir()
    assert picture.stem == script.stem and picture.stat().st_size > 1000
    assert len(script.read_text().splitlines()) <= 30


def test_every_picture_is_in_the_docs():
    docs = GALLERY.parents[3] / "docs"
    page = (docs / "python.md").read_text()
    for script in SCRIPTS:
        assert f"figures/python/{script.stem}." in page and f"gallery/{script.name}" in page
        assert list((docs / "figures/python").glob(f"{script.stem}.*"))
