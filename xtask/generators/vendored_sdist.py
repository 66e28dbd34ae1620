"""Puts the sources of all crates into a source archive, so that it builds without a network: `python vendored_sdist.py ARCHIVE.tar.gz`."""

import gzip
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

#: Where the crates lie in the archive, and what tells Cargo so.
FOLDER = "vendor"
CONFIG = f"""[source.crates-io]
replace-with = "vendored"

[source.vendored]
directory = "{FOLDER}"
"""


def add_crates(archive):
    """The same archive with the crates of its lock file."""
    with tempfile.TemporaryDirectory() as place:
        with tarfile.open(archive) as packed:
            packed.extractall(place, filter="data")
        (root,) = Path(place).iterdir()
        (manifest,) = root.glob("**/python-package/Cargo.toml")
        cargo = os.environ.get("CARGO", "cargo")
        subprocess.run([cargo, "vendor", "--quiet", "--locked", "--versioned-dirs", "--manifest-path", manifest, root / FOLDER], check=True, stdout=subprocess.DEVNULL)
        (root / ".cargo").mkdir(exist_ok=True)
        (root / ".cargo/config.toml").write_text(CONFIG)
        beside = archive.with_suffix(".new")
        # Without names, times and owners: the same sources give the same archive.
        with open(beside, "wb") as file, gzip.GzipFile(filename="", mode="wb", fileobj=file, mtime=0) as packed:
            with tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as new:
                for path in sorted(path for path in root.rglob("*") if not path.is_dir()):
                    new.add(path, arcname=path.relative_to(place), filter=plain)
        shutil.move(beside, archive)


def plain(entry):
    entry.uid = entry.gid = entry.mtime = 0
    entry.uname = entry.gname = ""
    return entry


if __name__ == "__main__":
    add_crates(Path(sys.argv[1]).resolve())
