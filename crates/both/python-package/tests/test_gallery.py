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


def test_the_pages_are_those_of_the_scripts():
    drawing = runpy.run_path(str(GALLERY / "draw_all.py"))
    folder = GALLERY.parents[3] / "docs/gallery"
    wanted = drawing["pages"]()
    assert {script.stem for script in SCRIPTS} == {name for names in drawing["SCRIPTS"].values() for name in names}
    assert {page.name: page.read_text() for page in folder.iterdir()} == wanted, "python draw_all.py --pages writes them"
