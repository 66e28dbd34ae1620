"""The licences of all crates that are linked into the Python package: crates/both/python-package/NOTICE.

python notice.py writes it; python notice.py --check compares.
"""

import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "crates/both/python-package"
FONT = ROOT / "crates/both/journal-figures/assets/STIX-OFL.txt"
#: Of several licences the first one of these is taken.
WANTED = ("MIT", "BSD-3-CLAUSE", "BSD-2-CLAUSE", "BSD", "ZLIB", "APACHE", "")


def linked():
    """The crates that are linked, with their metadata, in the order of their names."""
    command = ["cargo", "metadata", "--format-version", "1", "--locked", "--filter-platform", "x86_64-unknown-linux-gnu"]
    found = json.loads(subprocess.check_output([*command, "--manifest-path", PACKAGE / "Cargo.toml"]))
    packages = {package["id"]: package for package in found["packages"]}
    nodes = {node["id"]: node for node in found["resolve"]["nodes"]}
    seen, waiting = set(), [found["resolve"]["root"]]
    while waiting:
        own = waiting.pop()
        if own in seen:
            continue
        seen.add(own)
        waiting += [dep["pkg"] for dep in nodes[own]["deps"] if any(kind["kind"] is None for kind in dep["dep_kinds"])]
    outside = [packages[own] for own in seen if packages[own]["source"]]
    return sorted(outside, key=lambda package: (package["name"], package["version"]))


def licence_text(package):
    """The text of one of the licences of a crate."""
    folder = Path(package["manifest_path"]).parent
    texts = [file for file in sorted(folder.iterdir()) if file.is_file() and file.name.upper().startswith(("LICEN", "COPYING", "UNLICENSE"))]
    for wanted in WANTED:
        for file in texts:
            if wanted in file.name.upper():
                return file.read_text(encoding="utf-8", errors="replace").strip()
    return f"{package['name']} has no file with its licence; it is {package['license']}."


def notice():
    crates = linked()
    lines = ["The native module of this package contains these crates, and the font STIX. Their licences follow.", ""]
    lines += [f"{crate['name']} {crate['version']}: {crate['license']}" for crate in crates]
    owners = {}
    for crate in crates:
        owners.setdefault(licence_text(crate), []).append(f"{crate['name']} {crate['version']}")
    owners[FONT.read_text(encoding="utf-8").strip()] = ["the font STIX"]
    for text, names in owners.items():
        lines += ["", "=" * 80, ", ".join(names), "=" * 80, text]
    return "\n".join(line.rstrip() for line in "\n".join(lines).splitlines()) + "\n"


if __name__ == "__main__":
    file, text = PACKAGE / "NOTICE", notice()
    if "--check" not in sys.argv:
        file.write_text(text, encoding="utf-8")
    elif file.read_text(encoding="utf-8") != text:
        sys.exit("NOTICE has other crates than the package: python xtask/generators/notice.py writes it again")
