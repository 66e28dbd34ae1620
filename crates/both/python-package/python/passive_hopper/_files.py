"""Files that appear under their names complete, or not at all."""

import os
import tempfile


def write_whole(path, content):
    """Writes bytes to a file of this name. A write that fails leaves the file that was there."""
    path = os.path.abspath(os.fspath(path))
    folder, name = os.path.split(path)
    handle, beside = tempfile.mkstemp(prefix=f".{name}.", suffix=".tmp", dir=folder)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        # A file of mkstemp is its owner's alone; others get what the user's mask allows.
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(beside, 0o666 & ~mask)
        os.replace(beside, path)
    except BaseException:
        os.unlink(beside)
        raise
