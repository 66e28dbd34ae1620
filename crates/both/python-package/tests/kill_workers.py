"""Rasters by a Dask cluster of three worker processes, of which two are killed at random moments.

python kill_workers.py TRIALS prints a line for each trial. The tests make three.
"""

import os
import random
import signal
import sys
import tempfile
import threading
import time
from pathlib import Path

import passive_hopper as hopper

#: 24 regions, some seconds of work.
JOB = {"M": (0.1, 0.4), "shape": (1536, 1500)}


def cluster():
    from distributed import LocalCluster

    return LocalCluster(n_workers=3, threads_per_worker=1, processes=True, dashboard_address=None)


def one_trial(folder, seed):
    """The digest of a raster during which two workers are killed, the number of killed ones, and the times of the kills
    in seconds."""
    from distributed import Client

    moments = random.Random(seed)
    begun = threading.Event()
    kills = []

    def kill():
        begun.wait()
        start = time.monotonic()
        for pid in moments.sample(pids, 2):
            time.sleep(moments.uniform(0, 0.6))
            os.kill(pid, signal.SIGKILL)
            kills.append(round(time.monotonic() - start, 2))

    # A cluster of its own for each trial: one that has lost workers may not get all of them back.
    with cluster() as workers, Client(workers) as client:
        client.wait_for_workers(3, timeout=60)
        pids = sorted(client.run(os.getpid).values())
        killer = threading.Thread(target=kill)
        killer.start()
        found = hopper.basins(
            **JOB, store=Path(folder) / f"trial_{seed}.zarr", client=client, progress=lambda *_: begun.set()
        )
        begun.set()
        killer.join()
    return found.attrs["sha256"], len(kills), kills


def main():
    alone = hopper.basins(**JOB).attrs["sha256"]
    print(f"one process: {alone}", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(int(sys.argv[1])):
            found, killed, kills = one_trial(folder, seed)
            same = "same" if found == alone else "DIFFERENT"
            print(f"trial {seed}: {killed} workers killed, {kills} s after the first region: {same}", flush=True)


if __name__ == "__main__":
    main()
