"""Draws every picture of the gallery: python draw_all.py FOLDER. Without a folder, into docs/figures/python of the
repository."""

import os
import runpy
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
folder = Path(sys.argv[1] if len(sys.argv) > 1 else here.parents[3] / "docs/figures/python")
folder.mkdir(parents=True, exist_ok=True)
os.environ.setdefault("MPLBACKEND", "Agg")
os.chdir(folder)
for script in sorted(here.glob("*.py")):
    if script.name != Path(__file__).name:
        print(script.name, flush=True)
        runpy.run_path(str(script), run_name="__main__")
