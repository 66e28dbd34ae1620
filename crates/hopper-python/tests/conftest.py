"""What several files of tests need."""

import contextlib
import os
import signal
import threading

import pytest


@pytest.fixture
def ctrl_c():
    """A context in which Ctrl-C comes after 0.3 s, and has to end the computation."""
    if os.name != "posix":
        pytest.skip("SKIPPED Ctrl-C: this system cannot send a signal to one process")

    @contextlib.contextmanager
    def interrupted():
        ended = threading.Event()

        def interrupt():
            # A computation that has ended already fails the test, and the signal would hit the next one.
            if not ended.wait(0.3):
                os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        thread.start()
        with pytest.raises(KeyboardInterrupt):
            try:
                yield
            finally:
                ended.set()
        thread.join()

    return interrupted
