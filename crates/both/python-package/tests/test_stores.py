"""Rasters in Zarr stores: the same Dataset, whatever is killed."""

import hashlib
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import passive_hopper as hopper
import pytest

xarray = pytest.importorskip("xarray")
zarr = pytest.importorskip("zarr", reason="stores need zarr")
from passive_hopper import stores  # noqa: E402

JOB = {"M": (0.15, 0.9), "alpha": (4.5, 12.0), "shape": (150, 80)}


def files(store):
    return {str(file.relative_to(store)): file.read_bytes() for file in sorted(store.rglob("*")) if file.is_file()}


def test_a_store_gives_the_same_dataset(tmp_path):
    memory = hopper.basins(**JOB)
    calls = []
    stored = hopper.basins(**JOB, store=tmp_path / "basins.zarr", progress=lambda *done: calls.append(done))
    assert calls == [(64, 150), (128, 150), (150, 150)]
    xarray.testing.assert_identical(memory, stored.load())
    xarray.testing.assert_identical(memory, xarray.open_zarr(tmp_path / "basins.zarr").load())
    assert memory.attrs["sha256"] == hashlib.sha256(memory.label.values).hexdigest()
    assert (
        memory.alpha.attrs["units"] == "1"
        and "m2 g omega/k" in memory.alpha.attrs["long_name"]
        and "basins(M=(0.15, 0.9)" in memory.attrs["command"]
    )
    # A finished store is not computed again.
    before = files(tmp_path / "basins.zarr")
    hopper.basins(**JOB, store=tmp_path / "basins.zarr", progress=lambda *done: pytest.fail("computed again"))
    assert files(tmp_path / "basins.zarr") == before
    # Zarr 3, sharded and compressed: one file a region.
    assert sum(name.startswith("label/c/") for name in before) == 3


def test_a_finished_store_is_read_and_verified_from_anywhere(tmp_path):
    fsspec = pytest.importorskip("fsspec", reason="SKIPPED URLs: fsspec is not installed")
    store = tmp_path / "basins.zarr"
    stored = hopper.basins(**JOB, store=store)
    xarray.testing.assert_identical(hopper.open_basins(store).load(), stored.load())
    place = "memory://somewhere/basins.zarr"
    fsspec.filesystem("memory").put(str(store), "somewhere/basins.zarr", recursive=True)
    found = hopper.open_basins(place)
    xarray.testing.assert_identical(found.load(), stored.load())
    assert found.label.attrs["flag_values"].dtype == stored.label.dtype
    # A label that was changed, in a chunk that can be decoded.
    zarr.open_group(str(store), mode="r+")["label"][70, 3] = 7
    with pytest.raises(ValueError, match="not those that were computed"):
        hopper.open_basins(store)
    with pytest.raises(FileNotFoundError):
        hopper.open_basins(tmp_path / "nothing.zarr")


def test_a_store_that_is_not_finished_is_refused(tmp_path):
    store = tmp_path / "basins.zarr"
    hopper.basins(**JOB, store=store)
    del zarr.open_group(str(store), mode="r+").attrs["sha256"]
    with pytest.raises(ValueError, match="no finished store"):
        hopper.open_basins(store)


def test_writing_to_a_url_is_refused_and_makes_no_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ValueError, match="is written to a folder"):
        hopper.basins(**JOB, store="memory://basins.zarr")
    assert list(tmp_path.iterdir()) == []


def test_the_labels_are_those_of_the_arrays(tmp_path):
    stored = hopper.basins(**JOB, store=tmp_path / "basins.zarr")
    ratios, speeds, labels = hopper.basin_labels(**JOB)
    assert np.array_equal(stored.label, labels) and stored.label.dtype == labels.dtype
    assert np.array_equal(stored.M, ratios) and np.array_equal(stored.alpha, speeds)


@pytest.mark.parametrize("change", [{"shape": (150, 81)}, {"M": (0.15, 0.91)}, {"alpha": (4.5, 12.5)}])
def test_another_job_is_refused_and_nothing_changes(tmp_path, change):
    store = tmp_path / "basins.zarr"
    hopper.basins(**JOB, store=store)
    before = files(store)
    with pytest.raises(ValueError, match="another job"):
        hopper.basins(**(JOB | change), store=store)
    assert files(store) == before


def test_a_folder_that_is_no_store_is_refused(tmp_path):
    (tmp_path / "basins.zarr").mkdir()
    (tmp_path / "basins.zarr" / "mine.txt").write_text("mine")
    with pytest.raises(FileExistsError, match="no Zarr store"):
        hopper.basins(**JOB, store=tmp_path / "basins.zarr")
    assert list(files(tmp_path)) == ["basins.zarr/mine.txt"]
    with pytest.raises(OSError):
        hopper.basins(**JOB, store=tmp_path / "no folder" / "basins.zarr")


def test_a_damaged_region_is_computed_again(tmp_path):
    store = tmp_path / "basins.zarr"
    whole = hopper.basins(**JOB, store=store).load()
    file = store / "label" / "c" / "1" / "0"
    content = file.read_bytes()
    for damage in (content[: len(content) // 2], b"", content[:100] + bytes([content[100] ^ 1]) + content[101:]):
        file.write_bytes(damage)
        calls = []
        again = hopper.basins(**JOB, store=store, progress=lambda *done: calls.append(done))
        assert len(calls) == 1
        xarray.testing.assert_identical(whole, again.load())
        assert file.read_bytes() == content


def test_a_store_that_is_not_finished_says_so(tmp_path):
    store = tmp_path / "basins.zarr"

    def stop(done, all):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        hopper.basins(**JOB, store=store, progress=stop)
    there = xarray.open_zarr(store, consolidated=False)
    assert "sha256" not in there.attrs
    xarray.testing.assert_identical(hopper.basins(**JOB), hopper.basins(**JOB, store=store).load())


@pytest.mark.skipif(os.name != "posix", reason="sends a signal")
def test_a_process_that_is_killed_loses_nothing(tmp_path):
    store = tmp_path / "basins.zarr"
    job = {"M": (0.1, 0.4), "shape": (640, 1500)}
    call = f"import passive_hopper; passive_hopper.basins(**{job!r}, store={str(store)!r}, progress=print)"
    kills = 0
    for delay in (0.0, 0.1, 0.3):
        process = subprocess.Popen([sys.executable, "-u", "-c", call], stdout=subprocess.PIPE)
        # After the first region of this call, or at its end.
        process.stdout.readline()
        time.sleep(delay)
        process.send_signal(signal.SIGKILL)
        kills += process.wait() == -signal.SIGKILL
    assert kills > 0
    assert hopper.basins(**job, store=store).attrs["sha256"] == hopper.basins(**job).attrs["sha256"]
    # What killed processes were writing may belong to a running one. After a day it is removed.
    for left in store.rglob("*.partial"):
        os.utime(left, (0, 0))
    (store / "alpha" / "c" / "0").unlink()
    hopper.basins(**job, store=store)
    (store / "label" / "digests" / "0").write_text("changed")
    hopper.basins(**job, store=store)


def labels_of(store):
    return zarr.open_group(store, mode="r+", use_consolidated=False)["label"]


def test_changed_labels_are_computed_again(tmp_path):
    store = tmp_path / "basins.zarr"
    whole = hopper.basins(**JOB, store=store).load()
    before = files(store)
    # By the library that wrote them, and by a file of another region.
    labels_of(store)[70:72] = 7
    xarray.testing.assert_identical(whole, hopper.basins(**JOB, store=store).load())
    folder = store / "label" / "c"
    (folder / "1" / "0").write_bytes((folder / "0" / "0").read_bytes())
    xarray.testing.assert_identical(whole, hopper.basins(**JOB, store=store).load())
    (folder / "2" / "0").unlink()
    xarray.testing.assert_identical(whole, hopper.basins(**JOB, store=store).load())
    assert files(store) == before


def test_coordinates_are_checked(tmp_path):
    store = tmp_path / "basins.zarr"
    whole = hopper.basins(**JOB, store=store).load()
    group = zarr.open_group(store, mode="r+", use_consolidated=False)

    def remove():
        (store / "alpha" / "c" / "0").unlink()

    def overwrite():
        group["M"][:] = group["M"][:] + 1

    def unit():
        group["alpha"].attrs["units"] = "m s-1"

    def folder():
        shutil.rmtree(store / "M")

    for change in (remove, overwrite, unit, folder):
        change()
        xarray.testing.assert_identical(whole, hopper.basins(**JOB, store=store).load())


def test_two_writers_leave_each_other_alone(tmp_path):
    store = tmp_path / "basins.zarr"
    hopper.basins(**JOB, store=store)
    held = store / "label" / "c" / "0" / "0.0123456789abcdef.partial"
    held.write_bytes(b"half")
    (store / "label" / "c" / "1" / "0").unlink()
    hopper.basins(**JOB, store=store)
    assert held.exists()


def test_a_finished_store_is_not_written_to(tmp_path):
    store = tmp_path / "basins.zarr"
    hopper.basins(**JOB, store=store)
    times = {path: path.stat().st_mtime_ns for path in store.rglob("*")}
    hopper.basins(**JOB, store=store)
    assert {path: path.stat().st_mtime_ns for path in store.rglob("*")} == times


def test_a_read_error_removes_nothing(tmp_path, monkeypatch):
    store = tmp_path / "basins.zarr"
    hopper.basins(**JOB, store=store)
    before = files(store)

    def fails(path, job, mode):
        raise OSError(24, "too many open files")

    monkeypatch.setattr(stores, "_array", fails)
    with pytest.raises(OSError, match="too many"):
        hopper.basins(**JOB, store=store)
    assert files(store) == before


def test_a_process_holds_one_region_at_a_time(tmp_path, monkeypatch):
    native, asked = stores._native.basin_region, []

    def region(M, alpha, shape, columns, **more):
        asked.append(columns)
        return native(M, alpha, shape, columns, **more)

    monkeypatch.setattr(stores._native, "basin_region", region)
    hopper.basins(**JOB, store=tmp_path / "basins.zarr")
    assert asked == [(0, 64), (64, 128), (128, 150)]


def test_a_client_needs_a_store():
    with pytest.raises(ValueError, match="store="):
        hopper.basins(**JOB, client=object())


def test_what_is_no_client_leaves_no_store(tmp_path):
    with pytest.raises(TypeError, match="dask.distributed.Client, not 3"):
        hopper.basins(**JOB, store=tmp_path / "basins.zarr", client=3)
    assert not list(tmp_path.iterdir())


@pytest.fixture(scope="module")
def client():
    pytest.importorskip("distributed", reason="SKIPPED clusters: dask.distributed is not installed")
    from distributed import Client
    from kill_workers import cluster

    with cluster() as workers, Client(workers) as client:
        yield client


@pytest.mark.skipif(os.name != "posix", reason="sends a signal")
def test_workers_that_are_killed_lose_nothing(tmp_path):
    pytest.importorskip("distributed", reason="SKIPPED clusters: dask.distributed is not installed")
    from kill_workers import JOB as LONG
    from kill_workers import one_trial

    alone = hopper.basins(**LONG).attrs["sha256"]
    for seed in range(3):
        found, killed, _ = one_trial(tmp_path, seed)
        assert killed == 2 and found == alone
        labels = xarray.open_zarr(tmp_path / f"trial_{seed}.zarr", chunks=None).label.values
        assert hashlib.sha256(labels).hexdigest() == alone


def test_the_dataset_of_a_cluster_is_lazy(client, tmp_path):
    found = hopper.basins(**JOB, store=tmp_path / "basins.zarr", client=client)
    assert found.label.chunks is not None
    xarray.testing.assert_identical(found.compute(), hopper.basins(**JOB))


def test_a_worker_of_another_version_is_told(client, tmp_path):
    job = ((0.15, 0.9), (4.5, 12.0), (150, 80))
    with pytest.raises(RuntimeError, match="same version"):
        stores._task(str(tmp_path / "basins.zarr"), job, 0, ("0.0.0", 1))


def test_an_error_of_a_worker_passes_through(client, tmp_path, monkeypatch):
    store = tmp_path / "basins.zarr"
    hopper.basins(**JOB, store=store)
    # A folder in the place of a shard: no worker can write it.
    file = store / "label" / "c" / "1" / "0"
    file.unlink()
    file.mkdir()
    with pytest.raises(OSError):
        hopper.basins(**JOB, store=store, client=client)
    file.rmdir()
    assert hopper.basins(**JOB, store=store, client=client).attrs["sha256"] == hopper.basins(**JOB).attrs["sha256"]


def test_a_scheduler_that_dies_is_an_error_and_nothing_is_lost(tmp_path):
    pytest.importorskip("distributed", reason="SKIPPED clusters: dask.distributed is not installed")
    from distributed import Client
    from kill_workers import cluster

    store = tmp_path / "basins.zarr"
    job = {"M": (0.1, 0.4), "shape": (1280, 1500)}
    with cluster() as workers, Client(workers) as client:

        def end(done, all):
            workers.close()

        with pytest.raises(RuntimeError, match="scheduler of the cluster is gone"):
            hopper.basins(**job, store=store, client=client, progress=end)
    assert "sha256" not in xarray.open_zarr(store, consolidated=False).attrs
    assert hopper.basins(**job, store=store).attrs["sha256"] == hopper.basins(**job).attrs["sha256"]


def test_a_full_disk_leaves_nothing_that_reads_as_finished(tmp_path):
    disk = tmp_path / "disk"
    disk.mkdir()
    # 160 KiB hold the description of the store and some regions, and not all ten.
    mount = ["mount", "-t", "tmpfs", "-o", "size=160k", "tmpfs", str(disk)]
    if (
        not sys.platform.startswith("linux")
        or os.geteuid() != 0
        or subprocess.run(mount, capture_output=True).returncode != 0
    ):
        pytest.skip("SKIPPED the full disk: a small tmpfs needs Linux and root")
    store = disk / "basins.zarr"
    job = {"M": (0.1, 0.4), "shape": (640, 4000)}
    calls = []
    try:
        with pytest.raises(OSError, match="No space left"):
            hopper.basins(**job, store=store, progress=lambda *done: calls.append(done))
        assert 0 < len(calls) < 10
        assert "sha256" not in xarray.open_zarr(store, consolidated=False).attrs
        # Every region that is there is whole: the others are computed, and these are not.
        subprocess.run([*mount[:4], "remount,size=16m", *mount[5:]], check=True)
        again = []
        stored = hopper.basins(**job, store=store, progress=lambda *done: again.append(done))
        assert len(again) == 10 - len(calls)
        assert stored.attrs["sha256"] == hopper.basins(**job).attrs["sha256"]
    finally:
        subprocess.run(["umount", "-l", str(disk)], check=True)


def test_a_store_on_a_read_only_disk_opens_if_it_is_finished(tmp_path):
    disk = tmp_path / "disk"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=4m", "tmpfs", str(disk)]
    if (
        not sys.platform.startswith("linux")
        or os.geteuid() != 0
        or subprocess.run(mount, capture_output=True).returncode != 0
    ):
        pytest.skip("SKIPPED the read-only disk: a tmpfs needs Linux and root")
    store = disk / "basins.zarr"
    remounted = lambda how: subprocess.run([*mount[:4], f"remount,{how}", *mount[5:]], check=True)
    try:
        finished = hopper.basins(**JOB, store=store)
        remounted("ro")
        xarray.testing.assert_identical(hopper.basins(**JOB, store=store).load(), finished.load())
        # What is not there has to be written.
        for lost in (store / "label" / "c" / "1" / "0", store / "alpha" / "c" / "0"):
            remounted("rw")
            kept = lost.read_bytes()
            lost.unlink()
            remounted("ro")
            with pytest.raises(OSError, match="Read-only file system"):
                hopper.basins(**JOB, store=store)
            remounted("rw")
            lost.write_bytes(kept)
    finally:
        subprocess.run(["umount", "-l", str(disk)], check=True)


def hopper_program():
    """The program `hopper` of the repository: HOPPER_PROGRAM, or one that cargo has built in the folder target."""
    target = Path(__file__).parents[4] / "target"
    places = [os.environ.get("HOPPER_PROGRAM"), target / "release" / "hopper", target / "debug" / "hopper"]
    return next((str(place) for place in places if place and os.path.isfile(place)), None)


def test_the_arrays_of_the_program_have_the_same_labels(tmp_path):
    program = hopper_program()
    if program is None:
        pytest.skip(
            "SKIPPED the arrays of the program: build it with `cargo build -p hopper`, or name it with HOPPER_PROGRAM"
        )
    window = ["--mass-ratio", "0.15", "0.9", "--speed", "4.5", "12", "--pixels", "150", "80"]
    subprocess.run([program, "basins", *window, "--out", str(tmp_path / "basins"), "--quiet"], check=True)
    labels = np.load(tmp_path / "basins" / "basin.npy")
    # The program's arrays have a row for each speed. Both files have the labels M by M.
    stored = hopper.basins(**JOB, store=tmp_path / "basins.zarr").label.values
    assert labels.flags.f_contiguous and labels.dtype == stored.dtype
    assert labels.T.tobytes() == stored.tobytes()


def test_metadata_on_disk_are_not_believed(tmp_path):
    import json

    store, call = tmp_path / "s", dict(M=(0.1, 1), shape=(64, 64))
    true = hopper.basins(store=store, **call)
    labels, meanings = true["label"].values, true["label"].attrs["flag_meanings"]

    def changed(name, change):
        own = json.loads((store / name / "zarr.json").read_text())
        change(own)
        (store / name / "zarr.json").write_text(json.dumps(own))

    def consolidated(own):
        return own["consolidated_metadata"]["metadata"]["label"]

    changes = [
        ("label", lambda own: own.update(dimension_names=["alpha", "M"])),
        ("label", lambda own: own.update(dimension_names=["x", "y"])),
        ("label", lambda own: own["attributes"].update(flag_meanings="a b c")),
        ("", lambda own: own["attributes"].update(source="evil 9.9")),
        ("", lambda own: own["attributes"].update(extra="1")),
        ("", lambda own: consolidated(own).update(dimension_names=["alpha", "M"])),
        ("", lambda own: consolidated(own)["attributes"].update(flag_meanings="a b c")),
    ]
    for name, change in changes:
        changed(name, change)
        again = hopper.basins(store=store, **call)
        assert again.identical(true)
        import xarray

        by_reader = xarray.open_zarr(store)["label"]
        assert by_reader.dims == ("M", "alpha") and by_reader.attrs["flag_meanings"] == meanings
        assert (by_reader.values == labels).all()
    # Broken ones are written again.
    for path in ("label/zarr.json", "M/zarr.json", "label/digests/0"):
        (store / path).write_bytes(b"\xff\xfe{")
        assert hopper.basins(store=store, **call).identical(true)
    (store / "label/digests/0").unlink()
    (store / "label/digests/0").mkdir()
    assert hopper.basins(store=store, **call).identical(true)
    shutil.copytree(store / "label", store / "label2")
    assert set(hopper.basins(store=store, **call).data_vars) == {"label"}
