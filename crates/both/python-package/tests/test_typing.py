"""Users who check types have no complaint: the gallery and the lines of the pages under mypy --strict, and the stub of the native module."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("mypy", reason="SKIPPED types: mypy is not installed")
ROOT = Path(__file__).resolve().parents[4]
GALLERY = ROOT / "crates/both/python-package/gallery"


def checked(*arguments, folder):
    ended = subprocess.run([sys.executable, "-m", *arguments], cwd=folder, capture_output=True, text=True)
    assert ended.returncode == 0, ended.stdout + ended.stderr


def test_the_gallery_and_the_lines_of_the_pages_are_strict(tmp_path):
    files = [str(script) for script in GALLERY.glob("*.py") if script.name != "draw_all.py"]
    for page in ("README.md", "docs/python.md", "crates/both/python-package/README.md"):
        for number, block in enumerate(re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(), re.S)):
            own = tmp_path / f"{re.sub('[^a-z]', '_', page)}_{number}.py"
            own.write_text(block)
            files.append(str(own))
    # Dask has no types.
    checked("mypy", "--strict", "--allow-untyped-calls", "--ignore-missing-imports", "--cache-dir", str(tmp_path / "cache"), *files, folder=tmp_path)


def test_the_stub_of_the_native_module_is_right(tmp_path):
    # A disjoint base is no word of older checkers.
    allowed = tmp_path / "allowed"
    allowed.write_text("nonsmooth._native.__all__\n")
    checked("mypy.stubtest", "nonsmooth._native", "--ignore-disjoint-bases", "--allowlist", str(allowed), folder=tmp_path)
