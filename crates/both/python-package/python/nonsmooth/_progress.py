"""How far a computation is: by a function of the caller, or by a bar of tqdm."""


from __future__ import annotations

from collections.abc import Callable
from typing import Any


class _Bar:
    """A bar of tqdm as a function of the finished and of all parts. It is closed when all are finished."""

    def __init__(self) -> None:
        try:
            from tqdm.auto import tqdm
        except ImportError as error:
            raise ImportError(
                "progress=True needs tqdm: pip install 'passive-hopper[progress]', or give a function progress(done,"
                " all)"
            ) from error
        self._tqdm = tqdm
        self._bar = None

    def __call__(self, done: int, all: int) -> None:
        if self._bar is None:
            self._bar = self._tqdm(total=all)
        self._bar.update(done - self._bar.n)
        if done >= all:
            self._bar.close()


def function_of(progress: Any) -> Callable[[int, int], Any] | None:
    """The function progress(done, all) of an argument ``progress``: None or False for none, True for a bar of tqdm, or
    a function."""
    if progress is None or progress is False:
        return None
    if progress is True:
        return _Bar()
    if not callable(progress):
        raise TypeError(f"progress is a function of (done, all), True for a bar of tqdm, or None, not {progress!r}")

    def told(done: int, all: int) -> Any:
        try:
            return progress(done, all)
        except StopIteration as error:
            # It would end a loop of the caller as if all were done.
            raise RuntimeError("progress raised StopIteration") from error

    return told
