"""Draws every picture of the gallery, and writes its pages: python draw_all.py [FOLDER].

Pictures go into FOLDER, by default docs/figures/python of the repository. The pages, docs/gallery, are written with the default alone; python draw_all.py --pages
writes these without drawing.
"""

import ast
import os
import runpy
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
DOCS = HERE.parents[3] / "docs"
#: The scripts with their titles: of systems other than the hopper, and of the hopper, in the order of the index.
SCRIPTS = {
    "Any system": {
        "bouncing_ball": "A bouncing ball",
        "thermostat": "A thermostat",
        "impact_oscillator": "An impact oscillator",
        "spring_leg": "A runner on a spring leg",
        "buck_converter": "A buck converter",
        "magnetic_pendulum": "A magnetic pendulum",
        "double_well": "A double well",
        "henon": "Hénon's map",
        "newton": "Newton's method",
        "valve": "A valve",
    },
    "The hopper": {
        "basins": "The basins of the hopper",
        "cobweb": "The map and an orbit",
        "animated_hopper": "The hopper in motion",
        "basin_fractions": "Fractions of basins",
        "tipping": "Tipping",
        "zoom": "A zoom",
    },
}


def draw(folder):
    """Runs all scripts in a folder, where they leave their pictures."""
    folder.mkdir(parents=True, exist_ok=True)
    os.environ.setdefault("MPLBACKEND", "Agg")
    os.chdir(folder)
    for script in sorted(HERE.glob("*.py")):
        if script.name != Path(__file__).name:
            print(script.name, flush=True)
            runpy.run_path(str(script), run_name="__main__")


def about(name):
    """The sentences with which a script begins."""
    return ast.get_docstring(ast.parse((HERE / f"{name}.py").read_text())).replace("α*", "α\\*")


def picture(name):
    return next((DOCS / "figures/python").glob(f"{name}.*")).name


def pages():
    """The pages of the gallery by the names of their files: one for each script, and an index."""
    found = {}
    for name, title in (script for scripts in SCRIPTS.values() for script in scripts.items()):
        source = (HERE / f"{name}.py").read_text()
        body = source.split('"""', 2)[2].lstrip("\n")
        found[f"{name}.md"] = "\n".join(
            [
                f"# {title}\n",
                f"{about(name)}\n",
                f"![{name.replace('_', ' ')}](../figures/python/{picture(name)})\n",
                f"[{name}.py](../../crates/both/python-package/gallery/{name}.py), as it stands:\n",
                f"```python\n{body}```\n",
                "[All pictures](README.md) · [Use Python](../python.md)\n",
            ]
        )
    index = [
        "# Pictures in Python\n",
        "Each picture links to its page with the script that made it, of at most 30 lines. `python crates/both/python-package/gallery/draw_all.py` draws all of them again.",
    ]
    for heading, scripts in SCRIPTS.items():
        index += [f"\n## {heading}\n", "| | |", "|---|---|"]
        cells = [f"[![{name.replace('_', ' ')}](../figures/python/{picture(name)})]({name}.md) {about(name)}" for name in scripts]
        index += [f"| {' | '.join(cells[k : k + 2])} |" for k in range(0, len(cells), 2)]
    found["README.md"] = "\n".join(index) + "\n"
    return found


def write_pages():
    (DOCS / "gallery").mkdir(exist_ok=True)
    for name, text in pages().items():
        (DOCS / "gallery" / name).write_text(text)


if __name__ == "__main__":
    if sys.argv[1:] != ["--pages"]:
        draw(Path(sys.argv[1]) if len(sys.argv) > 1 else DOCS / "figures/python")
    if len(sys.argv) == 1 or sys.argv[1] == "--pages":
        write_pages()
