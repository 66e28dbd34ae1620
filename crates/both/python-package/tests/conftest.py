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

        # A process that a script started in the background ignores the signal, and Python then has no handler for it.
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        thread = threading.Thread(target=interrupt)
        thread.start()
        try:
            with pytest.raises(KeyboardInterrupt):
                try:
                    yield
                finally:
                    ended.set()
            thread.join()
        finally:
            signal.signal(signal.SIGINT, before)

    return interrupted
