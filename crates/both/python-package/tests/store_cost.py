"""CPU time, memory and bytes of rasters in Zarr stores: python store_cost.py SIDE …, each in a process of its own. For
Linux."""

import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import passive_hopper as hopper


def row(side):
    """One line of the table: a raster of side² pixels."""
    with tempfile.TemporaryDirectory() as folder:
        store = Path(folder) / "basins.zarr"
        hopper.basins(M=(0.1, 1), shape=(side, side), store=store)
        used = resource.getrusage(resource.RUSAGE_SELF)
        size = sum(file.stat().st_size for file in store.rglob("*") if file.is_file())
    seconds = used.ru_utime + used.ru_stime
    # Linux gives the peak in KiB.
    return f"| {side} | {seconds:.1f} s | {used.ru_maxrss / 1024:.0f} MiB | {size} bytes | {size / side**2:.3f} |"


if __name__ == "__main__":
    if sys.argv[1] == "--row":
        print(row(int(sys.argv[2])))
    else:
        print("| N | CPU time | peak of memory | store | bytes per pixel |\n|---:|---:|---:|---:|---:|", flush=True)
        for side in sys.argv[1:]:
            subprocess.run([sys.executable, __file__, "--row", side], check=True)
