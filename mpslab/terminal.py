"""What the commands share: bad input is told in one line, and output that nobody reads any more, as
after ``... | head -1``, does not stop the work.
"""

import argparse
import os
import sys
from contextlib import ExitStack, contextmanager, redirect_stderr, redirect_stdout, suppress


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one line, as a ValueError."""

    def error(self, message):
        raise ValueError(f"{message} (see --help)")


@contextmanager
def unbroken():
    """Print what the block prints for as long as that is possible, and nothing from then on."""
    with ExitStack() as stack:
        for stream, redirect in ((sys.stdout, redirect_stdout), (sys.stderr, redirect_stderr)):
            if stream is not None:
                patient = stack.enter_context(redirect(Patient(stream)))
                stack.callback(patient.flush)
        yield


class Patient:
    """A stream that goes silent when it cannot be written."""

    def __init__(self, stream):
        self._stream = stream

    def __getattr__(self, name):
        return getattr(self._stream, name)

    def write(self, text):
        """Write a text; returns its length."""
        self._try(lambda: self._stream.write(text))
        return len(text)

    def flush(self):
        """Hand over what was written."""
        self._try(self._stream.flush)

    def _try(self, act):
        try:
            act()
        except OSError:
            self._silence()

    def _silence(self):
        """Throw away what waits to be written, and all that follows."""
        with suppress(OSError, ValueError):
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, self._stream.fileno())
            os.close(nowhere)
