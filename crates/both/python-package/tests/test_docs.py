"""The examples of the pages run as they stand."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("xarray")
matplotlib = pytest.importorskip("matplotlib")
ROOT = Path(__file__).resolve().parents[4]


def blocks(page):
    return re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(), re.S)


def test_the_lines_of_the_readme_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    matplotlib.use("Agg")
    (block,) = blocks("README.md")
    assert len(block.splitlines()) == 6
    exec(block, {})
    assert sorted(file.name for file in tmp_path.iterdir()) == ["hopper.gif"]


@pytest.mark.parametrize(
    "page, number",
    [
        ("docs/python.md", 0),
        ("docs/python.md", 1),
        ("docs/python.md", 2),
        ("docs/any-model.md", 0),
        ("crates/both/python-package/README.md", 0),
    ],
)
def test_the_examples_of_the_pages_run(page, number, tmp_path):
    found = blocks(page)
    assert len(found) == {"docs/python.md": 3, "docs/any-model.md": 2, "crates/both/python-package/README.md": 1}[page]
    if "store=" in found[number]:
        pytest.importorskip("zarr", reason="stores need zarr")
    if "distributed" in found[number]:
        pytest.importorskip("distributed", reason="SKIPPED clusters: dask.distributed is not installed")
    # Each is a program of its own: a cluster starts only in a main program.
    program = tmp_path / "example.py"
    program.write_text(found[number])
    ended = subprocess.run([sys.executable, str(program)], cwd=tmp_path, capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
