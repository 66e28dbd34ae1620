"""Files that appear under their names complete, or not at all."""

import errno
import os
import stat
import tempfile


def write_whole(path, content):
    """Writes bytes to a file of this name. A write that fails leaves the file that was there. A link is written
    through; a named pipe or a device is refused, as it cannot be replaced."""
    target = os.path.realpath(os.fspath(path))
    if os.path.exists(target) and not stat.S_ISREG(os.stat(target).st_mode):
        if os.path.isdir(target):
            raise IsADirectoryError(errno.EISDIR, "this is a folder; give the name of a file", os.fspath(path))
        raise OSError(
            errno.EINVAL,
            "this is a named pipe or a device, and a file is written whole or not at all; give a file",
            os.fspath(path),
        )
    folder, name = os.path.split(target)
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
        os.replace(beside, target)
    except BaseException:
        os.unlink(beside)
        raise
