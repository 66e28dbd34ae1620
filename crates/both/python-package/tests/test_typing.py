"""Users who check types have no complaint: the gallery and the lines of the pages under mypy --strict and pyright, and the stub of the native module."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("mypy", reason="SKIPPED types: mypy is not installed")
pytest.importorskip("pyright", reason="SKIPPED types: pyright is not installed")
pytest.importorskip("distributed", reason="SKIPPED types: dask.distributed, which the pages import, is not installed")
ROOT = Path(__file__).resolve().parents[4]
GALLERY = ROOT / "crates/both/python-package/gallery"


def started(*arguments, folder):
    return subprocess.Popen([sys.executable, "-m", *arguments], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def test_gallery_pages_and_the_stub_of_the_native_module(tmp_path):
    files = [str(script) for script in GALLERY.glob("*.py") if script.name != "draw_all.py"]
    for page in ("README.md", "docs/python.md", "crates/both/python-package/README.md"):
        for number, block in enumerate(re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(), re.S)):
            own = tmp_path / f"{re.sub('[^a-z]', '_', page)}_{number}.py"
            own.write_text(block)
            files.append(str(own))
    # A disjoint base is no word of older checkers.
    allowed = tmp_path / "allowed"
    allowed.write_text("nonsmooth._native.__all__\n")
    # Side by side: each takes some ten seconds. Dask has no types.
    both = [
        started("mypy", "--strict", "--allow-untyped-calls", "--ignore-missing-imports", "--cache-dir", str(tmp_path / "cache"), *files, folder=tmp_path),
        started("pyright", "--pythonpath", sys.executable, *files, folder=tmp_path),
        started("mypy.stubtest", "nonsmooth._native", "--ignore-disjoint-bases", "--allowlist", str(allowed), folder=tmp_path),
    ]
    for own in both:
        said, _ = own.communicate()
        assert own.returncode == 0, said
