"""Rasters of basins in Zarr stores, region by region, by this process or by the workers of a Dask cluster.

A region is a strip of columns, and one shard: one file, which appears under its name complete or not at all. A region
whose file is there and can be decoded is finished; each part of it has a checksum. The same region has the same bytes,
whoever computes it and however often. So processes and workers may be killed at any instant, and a region may be
computed twice.

What is on disk is never believed. Beside the array, the folder ``digests`` has a note for each region: the SHA-256 of
its numbers as they were computed. A region counts as finished if its labels have this digest; one that was changed,
copied from another region, or damaged is computed again. So are coordinates, and the metadata of the group and of its
arrays: they are compared with those of a new store of the same job. The digest of the whole store is that of the notes'
labels, read back.
"""

import errno
import hashlib
import json
import os
import shutil
import tempfile
import time
import warnings
from pathlib import Path

from nonsmooth.errors import InputError
from nonsmooth import _native
from ._files import write_whole
from nonsmooth._progress import function_of
from nonsmooth._conventions import complete
from .datasets import coordinates, import_xarray, job_attributes, layer_of, number_attributes

#: Columns of a region. More make larger files and later progress; fewer make many small files. 64 columns of 16384
#: pixels are 2 MB.
REGION = 64
#: Pixels of a chunk along the speeds: a reader of a small window decodes chunks of 128 KB.
CHUNK = 1024
#: Seconds after which a half-written file belongs to a process that was killed. A region takes minutes at most.
ABANDONED = 86_400
#: How often a region is given to the cluster again after its worker was lost. One that kills every worker is an error
#: in the end.
TRIALS = 20


def write_basins(store, job, client=None, progress=None):
    """The raster of a job (M, α, shape, layer) in a store, as a lazy Dataset. What is finished there is kept."""
    xarray = import_xarray("basins", "basin_labels gives the same as arrays.")
    _import_zarr()
    progress = function_of(progress)
    if is_url(store):
        raise InputError(
            f"a store is written to a folder, whose files are renamed when they are whole, not to {store}: give a folder, copy it there when it is"
            " finished, as by fsspec's put(folder, url, recursive=True), and read it by open_basins(url)"
        )
    path = Path(os.path.abspath(os.fspath(store)))
    _open_or_make(path, job)
    columns = job[2][0]
    regions = range(-(-columns // REGION))
    missing = [region for region in regions if _verified(path, job, region) is None]
    found = len(regions) - len(missing)

    def count():
        nonlocal found
        found += 1
        if progress is not None:
            progress(min(columns, found * REGION), columns)

    if client is None:
        for region in missing:
            _write_region(str(path), job, region, None)
            count()
    else:
        _by_cluster(client, path, job, missing, count)
    _finish(path, job, regions)
    return _opened(xarray.open_zarr(path, chunks=None if client is None else {}, consolidated=False), job[3])


def is_url(store):
    """Whether this names a place by the protocol of fsspec, such as s3://bucket/basins.zarr."""
    return isinstance(store, str) and "://" in store


def open_basins(store, storage_options=None):
    """The Dataset of a finished store, whose labels are read once and compared with its digest.

    ``store`` is a folder, or a URL of fsspec such as ``"s3://bucket/basins.zarr"`` or ``"memory://basins.zarr"``, with ``storage_options`` for its file system. A store that is
    not finished, or whose labels are not those that were computed, raises InputError. The labels are loaded lazily afterwards.
    """
    xarray = import_xarray("open_basins", "basin_labels gives the same as arrays.")
    _import_zarr()
    place = store if is_url(store) else os.fspath(store)
    if not is_url(store) and not os.path.isdir(place):
        raise FileNotFoundError(errno.ENOENT, "there is no store of this name", place)
    found = xarray.open_zarr(place, chunks=None, consolidated=False, storage_options=storage_options)
    layer = next((name for name in found.data_vars if found[name].dims == ("M", "alpha")), None)
    digest = found.attrs.get("sha256")
    if layer is None or digest is None:
        raise InputError(f"{place} is no finished store of basins: it has no digest; basins(…, store=…) of its job finishes it")
    own = hashlib.sha256()
    for begin in range(0, found.sizes["M"], REGION):
        own.update(found[layer][begin : begin + REGION].values.tobytes())
    if own.hexdigest() != digest:
        raise InputError(
            f"the labels of {place} are not those that were computed: their SHA-256 is {own.hexdigest()}, not {digest}; basins(…, store=…) of its job"
            " computes what is damaged again"
        )
    return _opened(found, layer)


def _stored(attributes):
    """Attributes as JSON has them."""
    return {name: value.tolist() if hasattr(value, "tolist") else value for name, value in attributes.items()}


def _opened(found, layer):
    """A store as a dataset. JSON forgets the type of its flags."""
    import numpy

    # Arrays that someone has put beside ours are none of ours.
    found = found[[layer]]
    flags = found[layer].attrs
    if "flag_values" in flags:
        flags["flag_values"] = numpy.array(flags["flag_values"], dtype=layer_of(layer)["dtype"])
    return complete(found)


def _import_zarr():
    try:
        import zarr
    except ImportError as error:
        raise ImportError("a store needs zarr: pip install 'passive-hopper[zarr]' (Python 3.11 or newer)") from error
    return zarr


def _open_or_make(path, job):
    """Makes the store of a job, complete or not at all; refuses a folder that is something else."""
    zarr = _import_zarr()
    wanted = job_attributes(*job)
    if path.exists():
        found = _metadata(path)
        if found is None or found.get("node_type") != "group":
            raise FileExistsError(f"{path} is no Zarr store; give the name of a new folder")
        attributes = found.get("attributes", {})
        for name in ("command", "computation"):
            if attributes.get(name) != wanted[name]:
                raise InputError(
                    f"{path} has another job: its {name} is {attributes.get(name)!r}, not {wanted[name]!r}; "
                    "give the name of a new folder, or remove this one"
                )
        _mend(path, job)
        return
    beside = Path(tempfile.mkdtemp(prefix=f".{path.name}.", suffix=".tmp", dir=path.parent))
    try:
        _make(beside, job)
        os.chmod(beside, 0o777 & ~_mask())
        os.rename(beside, path)
    except BaseException:
        shutil.rmtree(beside, ignore_errors=True)
        if path.exists():
            # Another process has made the same store meanwhile, or something else: the next look tells.
            return _open_or_make(path, job)
        raise


def _make(folder, job):
    """Writes the store of a job into an empty folder: coordinates and metadata, and no labels."""
    zarr = _import_zarr()
    shape = job[2]
    group = zarr.create_group(folder, zarr_format=3, attributes=job_attributes(*job))
    for name, (numbers, attributes) in coordinates(*job).items():
        _make_coordinate(group, name, numbers, attributes)
    chunks = (min(REGION, shape[0]), min(CHUNK, shape[1]))
    rows = -(-shape[1] // chunks[1]) * chunks[1]
    group.create_array(
        job[3],
        shape=shape,
        dtype=layer_of(job[3])["dtype"],
        chunks=chunks,
        shards=(chunks[0], rows),
        compressors=[zarr.codecs.ZstdCodec(level=5, checksum=True)],
        fill_value=_native.label_codes()["OUTSIDE"],
        dimension_names=("M", "alpha"),
        attributes=number_attributes(job[3], []),
    )


def _mask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


def _array(path, job, mode):
    return _import_zarr().open_group(path, mode=mode, use_consolidated=False)[job[3]]


def _file(path, job, region):
    """The file of a region, which is one shard."""
    return Path(path) / job[3] / "c" / str(region) / "0"


def _columns(job, region):
    return region * REGION, min((region + 1) * REGION, job[2][0])


def _make_coordinate(group, name, numbers, attributes):
    group.create_array(name, data=numbers, dimension_names=(name,), attributes=attributes)


def _metadata(folder):
    """The metadata of a group or an array; None if they cannot be read."""
    try:
        found = json.loads((folder / "zarr.json").read_text())
    except PermissionError:
        raise
    except (OSError, ValueError):
        return None
    return found if isinstance(found, dict) else None


def _mend_metadata(path, job):
    """Writes the metadata of the group and of the labels again if they differ from those of a new store. What is added
    when a store is finished is compared then."""
    with tempfile.TemporaryDirectory() as folder:
        _make(Path(folder), job)
        new = {name: _metadata(Path(folder) / name) for name in ("", job[3])}
    for name, wanted in new.items():
        own = _metadata(path / name) or {}
        # The labels' own are compared when the store is finished.
        of_job = lambda attributes: {key: value for key, value in attributes.items() if name == "" and key != "sha256"}
        alike = {**own, "attributes": of_job(own.get("attributes") or {})}
        alike.pop("consolidated_metadata", None)
        plain = {**wanted, "attributes": of_job(wanted["attributes"])}
        plain.pop("consolidated_metadata", None)
        if alike != plain:
            (path / name).mkdir(exist_ok=True)
            write_whole(path / name / "zarr.json", json.dumps(wanted, indent=2).encode())


def _mend(path, job):
    """Writes the metadata and the coordinates again that are missing or differ from those of the job."""
    import numpy

    zarr = _import_zarr()
    _mend_metadata(path, job)
    group = zarr.open_group(path, mode="r", use_consolidated=False)
    for name, (numbers, attributes) in coordinates(*job).items():
        try:
            own = group[name]
            # A missing chunk would be read as zeros.
            right = (
                own.dtype == numbers.dtype
                and own.shape == numbers.shape
                and own[:].tobytes() == numpy.ascontiguousarray(numbers).tobytes()
            )
            right = right and dict(own.attrs) == attributes and tuple(own.metadata.dimension_names or ()) == (name,)
        except PermissionError:
            raise
        except (KeyError, TypeError, ValueError, RuntimeError, OSError):
            right = False
        if not right:
            mended = zarr.open_group(path, mode="r+", use_consolidated=False)
            shutil.rmtree(path / name, ignore_errors=True)
            (path / name).unlink(missing_ok=True)
            _make_coordinate(mended, name, numbers, attributes)


def _note(path, job, region):
    """The file that has the digest of a region."""
    return Path(path) / job[3] / "digests" / str(region)


def _digest(job, region, labels):
    """The digest of the labels of a region, which belongs to this job and region."""
    wanted = job_attributes(*job)
    identity = json.dumps([wanted["command"], wanted["computation"], region])
    return hashlib.sha256(identity.encode() + labels.tobytes()).hexdigest()


def _read(path, job, region):
    """The labels of a region as they are on disk; None if they cannot be decoded."""
    if not _file(path, job, region).is_file():
        return None
    begin, end = _columns(job, region)
    try:
        return _array(path, job, "r")[begin:end]
    except (ValueError, RuntimeError):
        return None


def _verified(path, job, region):
    """The labels of a region, if they are those that were computed; None if not."""
    labels = _read(path, job, region)
    try:
        note = _note(path, job, region).read_text()
    except PermissionError:
        raise
    except (OSError, ValueError):
        return None
    return None if labels is None or note != _digest(job, region, labels) else labels


def _write_region(path, job, region, threads):
    """Computes and writes one region. It returns nothing, so that nothing travels between machines."""
    zarr = _import_zarr()
    begin, end = _columns(job, region)
    M, alpha, shape, layer = job
    labels = _native.basin_region(M, alpha, shape, (begin, end), threads=threads, layer=layer)
    # The last region fills only a part of its file. zarr then reads the rest first, and a damaged file cannot be read.
    _file(path, job, region).unlink(missing_ok=True)
    with zarr.config.set({"array.write_empty_chunks": True}):
        _array(path, job, "r+")[begin:end] = labels
    note = _note(path, job, region)
    note.parent.mkdir(exist_ok=True)
    if note.is_dir():
        shutil.rmtree(note)
    # After the labels: a process that is killed in between leaves a region that is computed again.
    write_whole(note, _digest(job, region, labels).encode())


def _finish(path, job, regions):
    """Reads all labels back, compares them with what was computed, and writes the attributes that a finished store
    has."""
    import numpy

    zarr = _import_zarr()
    digest, codes = hashlib.sha256(), set()
    for region in regions:
        labels = _verified(path, job, region)
        if labels is None:
            # Another process, or a person, has changed it since: once more.
            _write_region(str(path), job, region, None)
            labels = _verified(path, job, region)
            if labels is None:
                raise RuntimeError(
                    f"region {region} of {path} changes while it is read ({_file(path, job, region)}); is the disk"
                    " damaged?"
                )
        digest.update(labels)
        codes |= set(numpy.unique(labels).tolist())
    group = zarr.open_group(path, mode="r", use_consolidated=False)
    attributes = _stored(number_attributes(job[3], sorted(codes)))
    if (
        group.attrs.get("sha256") == digest.hexdigest()
        and dict(group[job[3]].attrs) == attributes
        and _is_consolidated(path, job)
    ):
        return
    _array(path, job, "r+").attrs.put(attributes)
    for left in (path / job[3] / "c").glob("*/*.partial"):
        # A killed process leaves the file that it was writing; that of a running one is young.
        try:
            if time.time() - left.stat().st_mtime > ABANDONED:
                left.unlink()
        except FileNotFoundError:
            pass
    zarr.open_group(path, mode="r+", use_consolidated=False).attrs["sha256"] = digest.hexdigest()
    with warnings.catch_warnings():
        # xarray asks for consolidated metadata, and zarr warns that its form may change. Both can read the store
        # without.
        warnings.simplefilter("ignore")
        zarr.consolidate_metadata(path, zarr_format=3)


def _is_consolidated(path, job):
    """Whether the metadata that readers find in one place are those of the arrays."""
    of_all = ((_metadata(path) or {}).get("consolidated_metadata") or {}).get("metadata") or {}
    arrays = {"M", "alpha", job[3]}
    return arrays <= set(of_all) and all(own == _metadata(path / name) for name, own in of_all.items())


def _task(path, job, region, version):
    """The work of one task on a worker, by one thread."""
    own = (_native.__version__, int(_native.RASTER_VERSION))
    if own != version:
        raise RuntimeError(
            f"a worker has passive_hopper {own}, and this process has {version}: install the same version on all"
        )
    _write_region(path, job, region, 1)


def _by_cluster(client, path, job, missing, count):
    """Gives the missing regions to the workers, and again those whose worker is lost."""
    from distributed import KilledWorker, as_completed
    from distributed.client import FutureCancelledError

    version = (_native.__version__, int(_native.RASTER_VERSION))
    trials = {}

    def submit(region):
        trials[region] = trials.get(region, 0) + 1
        return client.submit(
            _task, str(path), job, region, version, pure=False, key=f"basins-{path.name}-{region}-{os.urandom(8).hex()}"
        )

    submitted = {submit(region): region for region in missing}
    futures = as_completed(list(submitted))
    try:
        for future in futures:
            region = submitted.pop(future)
            try:
                future.result()
                count()
            except KilledWorker as error:
                if trials[region] >= TRIALS:
                    raise RuntimeError(
                        f"region {region} has lost its worker {TRIALS} times; the others are kept in {path}"
                    ) from error
                again = submit(region)
                submitted[again] = region
                futures.add(again)
            except FutureCancelledError as error:
                raise RuntimeError(
                    f"the scheduler of the cluster is gone, or has dropped region {region}; what is finished is kept in"
                    f" {path}, and the same call goes on"
                ) from error
    finally:
        if submitted:
            try:
                client.cancel(list(submitted))
            except Exception:  # the scheduler is gone: nothing is left to cancel
                pass
