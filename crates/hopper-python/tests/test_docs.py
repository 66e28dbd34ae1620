"""The examples of the pages run as they stand."""

import re
from pathlib import Path

import pytest

pytest.importorskip("xarray")
matplotlib = pytest.importorskip("matplotlib")
ROOT = Path(__file__).resolve().parents[3]


def blocks(page):
    return re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(), re.S)


def test_the_lines_of_the_readme_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    matplotlib.use("Agg")
    (block,) = blocks("README.md")
    assert len(block.splitlines()) == 5
    exec(block, {})
    assert sorted(file.name for file in tmp_path.iterdir()) == ["basins.png", "hopper.gif"]


@pytest.mark.parametrize("number", range(3))
def test_the_examples_of_the_page_run(number, tmp_path, monkeypatch, capsys):
    found = blocks("docs/python.md")
    assert len(found) == 3
    if "store=" in found[number]:
        pytest.importorskip("zarr", reason="stores need zarr")
    monkeypatch.chdir(tmp_path)
    # A cluster starts only in a main program: that example is compiled here, and its calls are those of test_stores.py.
    exec(compile(found[number], "docs/python.md", "exec"), {"__name__": "example"})
