"""A browser without a window, driven over the pipe of its DevTools protocol."""

import fcntl
import json
import os
import subprocess
import tempfile
from contextlib import contextmanager

from validation import browser


class Tab:
    """One page of the browser.

    Attributes
    ----------
    events : list of dict
        All that the browser reported since the start: requests, console messages, errors.
    """

    def __init__(self, reader, writer):
        self._reader, self._writer = reader, writer
        self._session, self._count, self.events = None, 0, []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        attached = self.call("Target.attachToTarget", targetId=target, flatten=True)
        self._session = attached["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    def call(self, method, **parameters):
        """The answer to a command."""
        self._count += 1
        message = {"id": self._count, "method": method, "params": parameters}
        message |= {"sessionId": self._session} if self._session else {}
        self._writer.write(json.dumps(message).encode() + b"\0")
        self._writer.flush()
        answer = self._receive(lambda message: message.get("id") == self._count)
        assert "error" not in answer, answer
        return answer["result"]

    def _receive(self, wanted):
        """The first message that is wanted; events before it are kept."""
        while True:
            text = bytearray()
            while (byte := self._reader.read(1)) != b"\0":
                assert byte, "the browser has gone"
                text += byte
            message = json.loads(text)
            if "method" in message:
                self.events.append(message)
            if wanted(message):
                return message

    def load(self, url, width, height=900):
        """Load a page, with a window so many pixels wide."""
        self.call(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=width < 600,
        )
        self.call("Page.navigate", url=url)
        self._receive(lambda message: message.get("method") == "Page.loadEventFired")

    def evaluate(self, script):
        """The value of a piece of JavaScript."""
        answer = self.call("Runtime.evaluate", expression=script, returnByValue=True)
        assert "exceptionDetails" not in answer, answer
        return answer["result"].get("value")

    def press(self, key):
        """Press and let go of a key."""
        code = {"Enter": 13, "Tab": 9}[key]
        text = "\r" if key == "Enter" else ""
        for kind in ("keyDown", "keyUp"):
            self.call(
                "Input.dispatchKeyEvent",
                type=kind,
                key=key,
                text=text if kind == "keyDown" else "",
                windowsVirtualKeyCode=code,
            )


@contextmanager
def open_tab():
    """A `Tab` of a browser of its own."""
    commands, to_browser = _pipe()
    from_browser, answers = _pipe()

    def connect():
        """Give the browser the descriptors at which it reads and answers."""
        os.dup2(commands, 3)
        os.dup2(answers, 4)

    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        process = subprocess.Popen(
            [*browser.command(browser.find(), profile), "--remote-debugging-pipe"],
            preexec_fn=connect,
            close_fds=False,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(commands)
        os.close(answers)
        with open(from_browser, "rb") as reader, open(to_browser, "wb") as writer:
            try:
                yield Tab(reader, writer)
            finally:
                process.terminate()
                process.wait()


def _pipe():
    """Ends of a pipe to read from and to write to, out of the way of descriptors 3 and 4."""
    ends = os.pipe()
    moved = [fcntl.fcntl(end, fcntl.F_DUPFD_CLOEXEC, 10) for end in ends]
    for end in ends:
        os.close(end)
    return moved
