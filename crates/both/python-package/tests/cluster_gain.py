"""What K worker processes gain on this computer: python cluster_gain.py SIDE ROUNDS prints a table for K = 1, 2 and 4.

The clusters take turns, and the least time of all rounds counts: other processes disturb some of them. A time is that
of the call, with its look for finished regions and the digest at the end, which one process makes. The cluster is there
before it.
"""

import sys
import tempfile
import time
from pathlib import Path

import passive_hopper as hopper

WORKERS = (1, 2, 4)


def one_round(side, workers):
    """Seconds of one call, the CPU seconds of its workers, and the digest."""
    from distributed import Client, LocalCluster

    cluster = LocalCluster(n_workers=workers, threads_per_worker=1, processes=True, dashboard_address=None)
    with cluster, Client(cluster) as client, tempfile.TemporaryDirectory() as folder:
        client.wait_for_workers(workers, timeout=60)

        def used():
            return sum(client.run(time.process_time).values())

        # Python reads its modules, and the library makes its tables, once in each worker.
        client.run(hopper.basin_labels, shape=(16, 16))
        before, begin = used(), time.perf_counter()
        found = hopper.basins(M=(0.1, 1), shape=(side, side), store=Path(folder) / "basins.zarr", client=client)
        seconds = time.perf_counter() - begin
        return seconds, used() - before, found.attrs["sha256"]


def main():
    side, rounds = int(sys.argv[1]), int(sys.argv[2])
    least = {}
    digests = set()
    for _ in range(rounds):
        for workers in WORKERS:
            seconds, used, digest = one_round(side, workers)
            digests.add(digest)
            least[workers] = min(least.get(workers, (seconds, used)), (seconds, used))
    if len(digests) != 1:
        sys.exit(f"the digests differ: {digests}")
    print(
        f"{side}² pixels, the least of {rounds}:\n\n| workers | time | gain | CPU time of the workers"
        " |\n|---:|---:|---:|---:|"
    )
    for workers, (seconds, used) in least.items():
        print(f"| {workers} | {seconds:.1f} s | {least[1][0] / seconds:.2f} | {used:.1f} s |")


if __name__ == "__main__":
    main()
