# SPDX-License-Identifier: GPL-3.0-or-later
"""A browser's process without a window, and the messages to and from it: JSON over a WebSocket, with Python's standard
library only. Both protocols, Chromium's and Firefox's, number their messages and answer by the number.

Every wait is limited, and raises Failure at its limit.
"""

import abc
import base64
import ctypes
import json
import os
import pathlib
import signal
import socket
import struct
import subprocess
import tempfile
import time
from types import TracebackType
from typing import Any, Self

TIMEOUT_S = 10.0  # of one answer: a loaded machine takes seconds to start a renderer


class Failure(Exception):
    """The browser did not answer, refused, or a script of ours threw."""


class WebSocket:
    """A client of RFC 6455: text messages only, without TLS and extensions."""

    CONTINUATION, TEXT, CLOSE, PING, PONG = 0x0, 0x1, 0x8, 0x9, 0xA

    def __init__(self, host: str, port: int, path: str) -> None:
        self._socket = socket.create_connection((host, port), timeout=TIMEOUT_S)
        self._buffer = bytearray()
        self._parts: list[bytes] = []  # of a message that is not complete yet
        key = base64.b64encode(os.urandom(16)).decode()
        self._socket.sendall((f"GET {path} HTTP/1.1\r\nHost: {host}:{port}\r\nUpgrade: websocket\r\n"
                              f"Connection: Upgrade\r\nSec-WebSocket-Key: {key}\r\n"
                              "Sec-WebSocket-Version: 13\r\n\r\n").encode())
        end = time.monotonic() + TIMEOUT_S
        while b"\r\n\r\n" not in self._buffer:
            self._fill(end)
        head, _, rest = bytes(self._buffer).partition(b"\r\n\r\n")
        if b" 101 " not in head.split(b"\r\n")[0]:
            raise Failure(f"no WebSocket: {head.splitlines()[0]!r}")
        self._buffer = bytearray(rest)

    def send(self, text: str) -> None:
        self._send_frame(self.TEXT, text.encode())

    def receive(self, end: float) -> str:
        """The next whole message; `end` is the time limit, by time.monotonic()."""
        while True:
            final, opcode, payload = self._frame(end)
            if opcode == self.PING:
                self._send_frame(self.PONG, payload)
            elif opcode == self.CLOSE:
                raise Failure("the browser closed the connection")
            elif opcode in (self.TEXT, self.CONTINUATION):  # control frames may come between a message's fragments
                self._parts.append(payload)
                if final:
                    message = b"".join(self._parts).decode()
                    self._parts = []
                    return message

    def close(self) -> None:
        self._socket.close()

    def _send_frame(self, opcode: int, payload: bytes) -> None:
        length = len(payload)
        if length < 126:
            head = struct.pack("!BB", 0x80 | opcode, 0x80 | length)
        elif length < 1 << 16:
            head = struct.pack("!BBH", 0x80 | opcode, 0x80 | 126, length)
        else:
            head = struct.pack("!BBQ", 0x80 | opcode, 0x80 | 127, length)
        mask = os.urandom(4)  # a client has to mask what it sends
        repeated = (mask * (length // 4 + 1))[:length]
        masked = (int.from_bytes(payload, "big") ^ int.from_bytes(repeated, "big")).to_bytes(length, "big")
        self._socket.settimeout(TIMEOUT_S)
        self._socket.sendall(head + mask + masked)

    def _frame(self, end: float) -> tuple[bool, int, bytes]:
        """Nothing is taken from the buffer before the frame is whole: a timeout between two bytes loses none."""
        while True:
            at, length = 2, 0
            if len(self._buffer) >= 2:
                length = self._buffer[1] & 0x7F  # a server does not mask
                at += {126: 2, 127: 8}.get(length, 0)
            if at > 2 and len(self._buffer) >= at:
                length = int.from_bytes(self._buffer[2:at], "big")
            if len(self._buffer) >= at + length:
                first = self._buffer[0]
                payload = bytes(self._buffer[at:at + length])
                del self._buffer[:at + length]
                return bool(first & 0x80), first & 0x0F, payload
            self._fill(end)

    def _fill(self, end: float) -> None:
        left = end - time.monotonic()
        if left <= 0:
            raise TimeoutError
        self._socket.settimeout(left)
        received = self._socket.recv(1 << 20)
        if not received:
            raise Failure("the browser hung up")
        self._buffer += received


def _die_with_parent() -> None:
    """In the child: when this test itself is killed (by ctest's time limit), no browser is left behind."""
    PR_SET_PDEATHSIG = 1
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


class BrowserProcess(abc.ABC):
    """Starts a browser in a directory of its own, and always kills it: with a subclass's object as browser: ..."""

    def __init__(self, command: list[str]) -> None:
        """`command` may contain {home}, the directory of the process."""
        self._directory = tempfile.TemporaryDirectory(prefix="earthtop-browser-", ignore_cleanup_errors=True)
        self.home = pathlib.Path(self._directory.name)
        self._log = self.home / "log"
        self._socket: WebSocket | None = None
        self._ids = 0
        self._answers: dict[int, dict[str, Any]] = {}
        self.prepare()
        self._process = subprocess.Popen(
            [word.replace("{home}", str(self.home)) for word in command], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=self._log.open("wb"), start_new_session=True, preexec_fn=_die_with_parent,
            env={**os.environ, "HOME": str(self.home), "TMPDIR": str(self.home)})
        try:
            self._socket = WebSocket("127.0.0.1", *self._address())
            self.greet()
        except BaseException:
            self.close()
            raise

    def prepare(self) -> None:
        """What is to be done before the process starts."""

    @abc.abstractmethod
    def address(self) -> tuple[int, str] | None:
        """Port and path of the WebSocket; None as long as the process has not said them."""

    @abc.abstractmethod
    def greet(self) -> None:
        """The first messages."""

    @abc.abstractmethod
    def on_event(self, message: dict[str, Any]) -> None:
        """Takes a message that is no answer."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    def close(self) -> None:
        if self._socket:
            self._socket.close()
        try:
            os.killpg(self._process.pid, signal.SIGKILL)  # the children are in its session's group
        except ProcessLookupError:
            pass
        self._process.wait()
        self._directory.cleanup()

    def ask(self, message: dict[str, Any], timeout_s: float = TIMEOUT_S) -> Any:
        """Sends a message and waits for its answer's result."""
        sent = self.post(message)
        end = time.monotonic() + timeout_s
        while sent not in self._answers:
            try:
                self._take(end)
            except TimeoutError:
                raise Failure(f"{message['method']}: no answer within {timeout_s:g} s") from None
        answer = self._answers.pop(sent)
        if "error" in answer:  # Chromium has a record there, Firefox a word and its message beside it
            error = answer["error"]
            raise Failure(f"{message['method']}: {error['message'] if isinstance(error, dict) else answer['message']}")
        return answer["result"]

    def post(self, message: dict[str, Any]) -> int:
        """Sends without waiting for the answer, because a reaction to an event happens within the wait of another call."""
        assert self._socket
        self._ids += 1
        self._socket.send(json.dumps({"id": self._ids, **message}))
        return self._ids

    def listen(self, seconds: float) -> None:
        """Handles events for the given time."""
        end = time.monotonic() + seconds
        try:
            while True:
                self._take(end)
        except TimeoutError:
            pass

    def _take(self, end: float) -> None:
        assert self._socket
        message = json.loads(self._socket.receive(end))
        if message.get("id") is not None:
            self._answers[message["id"]] = message
        else:
            self.on_event(message)

    def _address(self) -> tuple[int, str]:
        end = time.monotonic() + 3 * TIMEOUT_S
        while time.monotonic() < end and self._process.poll() is None:
            if address := self.address():
                return address
            time.sleep(0.02)
        tail = "\n".join(self._log.read_text(errors="replace").splitlines()[-5:])
        raise Failure(f"the browser does not start (status {self._process.poll()}):\n{tail}")


class Tab(abc.ABC):
    """One tab, and a record of what happened in it since it was opened."""

    def __init__(self) -> None:
        self.clear()

    def clear(self) -> None:
        self.complaints: list[str] = []  # console errors and warnings, exceptions, what the browser logs or reports
        self.requests: list[str] = []  # addresses
        self.dialogs: list[str] = []

    @abc.abstractmethod
    def evaluate(self, script: str, timeout_s: float = TIMEOUT_S) -> Any:
        """The value of an expression, awaited if it is a promise, as JSON."""

    @abc.abstractmethod
    def wait(self, seconds: float) -> None:
        """Handles events for the given time."""

    def frames(self, count: int) -> None:
        """Waits for a number of frames, so that what an event changed has been drawn."""
        self.evaluate(f"new Promise(done => {{ let n = {count}; const next = () => n-- ? requestAnimationFrame(next)"
                      " : done(); next(); })")

    def middle(self, element: str) -> tuple[float, float]:
        """Scrolls the element of the expression into view. Returns its centre in the window."""
        box = self.evaluate(f"(e => {{ e.scrollIntoView({{block: 'center', behavior: 'instant'}});"
                            " const r = e.getBoundingClientRect();"
                            f" return [r.x + r.width / 2, r.y + r.height / 2]; }})({element})")
        return box[0], box[1]
