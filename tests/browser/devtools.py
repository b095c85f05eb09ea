# SPDX-License-Identifier: GPL-3.0-or-later
"""A headless Chromium driven through the Chrome DevTools Protocol, with Python's standard library only.

Browser starts the process and always kills it; Page is one tab. Every wait is limited, and raises Failure at its limit.
"""

import base64
import ctypes
import json
import os
import pathlib
import shutil
import signal
import socket
import struct
import subprocess
import tempfile
import time
from types import TracebackType
from typing import Any

TIMEOUT_S = 10.0  # of one answer: a loaded machine takes seconds to start a renderer
WIDTH, HEIGHT = 1100, 800

KEYS = {"Tab": 9, "Enter": 13, "Escape": 27, " ": 32, "End": 35, "Home": 36,
        "ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40}  # Windows' codes, which are the protocol's
TEXTS = {"Enter": "\r", " ": " "}  # a button is pressed by the character, not by the key


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


def find_chromium() -> str | None:
    names = [os.environ.get("CHROMIUM", ""), "chromium", "chromium-browser", "google-chrome"]
    return next((path for path in map(shutil.which, filter(None, names)) if path), None)


def _die_with_parent() -> None:
    """In the child: when this test itself is killed (by ctest's time limit), no browser is left behind."""
    PR_SET_PDEATHSIG = 1
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


class Browser:
    """with Browser(path) as browser: page = browser.new_page()"""

    def __init__(self, chromium: str) -> None:
        self._directory = tempfile.TemporaryDirectory(prefix="earthtop-browser-", ignore_cleanup_errors=True)
        home = pathlib.Path(self._directory.name)
        self._log = home / "log"
        self._socket: WebSocket | None = None
        self._ids = 0
        self._answers: dict[int, dict[str, Any]] = {}
        self._pages: dict[str, "Page"] = {}
        self._process = subprocess.Popen(
            [chromium, "--headless=new", "--no-sandbox", "--disable-gpu", "--remote-debugging-port=0",
             f"--user-data-dir={home / 'profile'}", f"--window-size={WIDTH},{HEIGHT}", "--force-device-scale-factor=1",
             "--no-first-run", "--disable-extensions", "--disable-sync", "--disable-background-networking",
             "--disable-component-update", "--mute-audio",
             "--disable-background-timer-throttling", "--disable-renderer-backgrounding",
             "--disable-backgrounding-occluded-windows", "--lang=en-US", "about:blank"],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=self._log.open("wb"), start_new_session=True,
            preexec_fn=_die_with_parent, env={**os.environ, "HOME": str(home), "TMPDIR": str(home)})
        try:
            port, path = self._address(home / "profile" / "DevToolsActivePort")
            self._socket = WebSocket("127.0.0.1", port, path)
            self.version: str = self.call("Browser.getVersion")["product"]
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> "Browser":
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
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

    def new_page(self) -> "Page":
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        page = Page(self, target, session)
        self._pages[session] = page
        page.enable()
        return page

    def forget(self, session: str) -> None:
        self._pages.pop(session, None)

    def call(self, method: str, session: str | None = None, timeout_s: float = TIMEOUT_S, **params: Any) -> Any:
        sent = self.post(method, session, **params)
        end = time.monotonic() + timeout_s
        while sent not in self._answers:
            try:
                self._take(end)
            except TimeoutError:
                raise Failure(f"{method}: no answer within {timeout_s:g} s") from None
        answer = self._answers.pop(sent)
        if "error" in answer:
            raise Failure(f"{method}: {answer['error'].get('message')}")
        return answer["result"]

    def post(self, method: str, session: str | None = None, **params: Any) -> int:
        """Sends without waiting for the answer, because a reaction to an event happens within the wait of another call."""
        assert self._socket
        self._ids += 1
        message = {"id": self._ids, "method": method, "params": params}
        self._socket.send(json.dumps(message if session is None else {**message, "sessionId": session}))
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
        if "id" in message:
            self._answers[message["id"]] = message
        elif message.get("sessionId") in self._pages:
            self._pages[message["sessionId"]].on_event(message["method"], message["params"])

    def _address(self, file: pathlib.Path) -> tuple[int, str]:
        end = time.monotonic() + TIMEOUT_S
        while time.monotonic() < end and self._process.poll() is None:
            lines = file.read_text().splitlines() if file.exists() else []
            if len(lines) == 2:  # the file is there before it is written
                return int(lines[0]), lines[1]
            time.sleep(0.02)
        tail = "\n".join(self._log.read_text(errors="replace").splitlines()[-5:])
        raise Failure(f"the browser does not start (status {self._process.poll()}):\n{tail}")


class Page:
    """One tab, and a record of what happened in it since open()."""

    def __init__(self, browser: Browser, target: str, session: str) -> None:
        self._browser = browser
        self._target = target
        self._session = session
        self.width = WIDTH
        self._clear()

    def _clear(self) -> None:
        self.complaints: list[str] = []  # console errors and warnings, exceptions, what the browser logs or reports
        self.requests: list[str] = []  # addresses
        self.dialogs: list[str] = []
        self._loaded = False

    def enable(self) -> None:
        for domain in ("Page", "Runtime", "Log", "Network", "Audits", "Accessibility"):
            self.call(f"{domain}.enable")
        self.call("Emulation.setFocusEmulationEnabled", enabled=True)  # :focus needs a focused window
        self.emulate()

    def close(self) -> None:
        self._browser.call("Target.closeTarget", targetId=self._target)
        self._browser.forget(self._session)

    def call(self, method: str, timeout_s: float = TIMEOUT_S, **params: Any) -> Any:
        return self._browser.call(method, self._session, timeout_s, **params)

    def on_event(self, method: str, params: dict[str, Any]) -> None:
        if method == "Runtime.consoleAPICalled" and params["type"] in ("error", "warning", "assert"):
            words = [str(part.get("value", part.get("description", ""))) for part in params["args"]]
            self.complaints.append(f"console.{params['type']}: {' '.join(words)}")
        elif method == "Runtime.exceptionThrown":
            details = params["exceptionDetails"]
            self.complaints.append(f"exception: {details.get('exception', {}).get('description', details['text'])}")
        elif method == "Log.entryAdded" and params["entry"]["level"] in ("error", "warning"):
            self.complaints.append(f"{params['entry']['source']}: {params['entry']['text']}")
        elif method == "Audits.issueAdded" and params["issue"]["code"] == "ContentSecurityPolicyIssue":
            details = params["issue"]["details"].get("contentSecurityPolicyIssueDetails", {})
            self.complaints.append(f"CSP: {details.get('violatedDirective')} {details.get('blockedURL', 'inline')}")
        elif method == "Network.requestWillBeSent":
            self.requests.append(params["request"]["url"])
        elif method == "Page.javascriptDialogOpening":
            self.dialogs.append(f"{params['type']}: {params['message']}")
            self._browser.post("Page.handleJavaScriptDialog", self._session, accept=False)  # else all scripts wait
        elif method == "Page.loadEventFired":
            self._loaded = True
        elif method == "Inspector.targetCrashed":
            raise Failure("the page's process crashed")

    def open(self, url: str) -> None:
        """Loads a page and waits until it has been painted."""
        self._clear()
        result = self.call("Page.navigate", url=url)
        if "errorText" in result:
            raise Failure(f"{url}: {result['errorText']}")
        end = time.monotonic() + TIMEOUT_S
        while not self._loaded:
            if time.monotonic() > end:
                raise Failure(f"{url}: not loaded within {TIMEOUT_S:g} s")
            self._browser.listen(0.02)
        self.frames(2)

    def evaluate(self, script: str, timeout_s: float = TIMEOUT_S) -> Any:
        """The value of an expression, awaited if it is a promise, as JSON."""
        result = self.call("Runtime.evaluate", timeout_s, expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            details = result["exceptionDetails"]
            raise Failure(f"{script[:80]}: {details.get('exception', {}).get('description', details['text'])}")
        return result["result"].get("value")

    def frames(self, count: int) -> None:
        """Waits for a number of frames, so that what an event changed has been drawn."""
        self.evaluate(f"new Promise(done => {{ let n = {count}; const next = () => n-- ? requestAnimationFrame(next)"
                      " : done(); next(); })")

    def wait(self, seconds: float) -> None:
        self._browser.listen(seconds)

    def key(self, name: str) -> None:
        code = {" ": "Space"}.get(name, name)
        common = {"key": name, "code": code, "windowsVirtualKeyCode": KEYS[name]}
        text = {"text": TEXTS[name]} if name in TEXTS else {}
        self.call("Input.dispatchKeyEvent", type="keyDown" if text else "rawKeyDown", **common, **text)
        self.call("Input.dispatchKeyEvent", type="keyUp", **common)

    def move(self, x: float, y: float) -> None:
        self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)

    def click(self, x: float, y: float) -> None:
        self.drag(x, y, x, y, steps=0)

    def drag(self, x: float, y: float, to_x: float, to_y: float, steps: int = 8) -> None:
        self.move(x, y)
        held = {"button": "left", "buttons": 1}
        self.call("Input.dispatchMouseEvent", type="mousePressed", x=x, y=y, clickCount=1, **held)
        for step in range(1, steps + 1):
            part = step / steps
            self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x + part * (to_x - x), y=y + part * (to_y - y),
                      **held)
        self.call("Input.dispatchMouseEvent", type="mouseReleased", x=to_x, y=to_y, button="left", clickCount=1)

    def middle(self, element: str) -> tuple[float, float]:
        """Scrolls the element of the expression into view. Returns its centre in the window."""
        box = self.evaluate(f"(e => {{ e.scrollIntoView({{block: 'center', behavior: 'instant'}});"
                            " const r = e.getBoundingClientRect();"
                            f" return [r.x + r.width / 2, r.y + r.height / 2]; }})({element})")
        return box[0], box[1]

    def emulate(self, dark: bool = False, reduced_motion: bool = False) -> None:
        self.call("Emulation.setEmulatedMedia", features=[
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"},
            {"name": "prefers-reduced-motion", "value": "reduce" if reduced_motion else "no-preference"}])

    def resize(self, width: int, height: int = HEIGHT) -> None:
        """Gives the window another size (CSS pixels); a narrow one is that of a phone, which is touched."""
        phone = width < 600
        self.width = width
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=phone)
        self.call("Emulation.setTouchEmulationEnabled", enabled=phone)
        self.frames(2)

    def tap(self, x: float, y: float) -> None:
        self.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x, "y": y}])
        self.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])

    def pdf(self) -> bytes:
        """The page on A4."""
        return base64.b64decode(self.call("Page.printToPDF", timeout_s=60, printBackground=True, paperWidth=8.27,
                                          paperHeight=11.69)["data"])

    def screenshot(self, path: pathlib.Path) -> None:
        """A picture of the whole page, as far as one picture can hold it."""
        height = min(16000, self.evaluate("document.documentElement.scrollHeight"))
        clip = {"x": 0, "y": 0, "width": self.width, "height": height, "scale": 1}
        path.write_bytes(base64.b64decode(
            self.call("Page.captureScreenshot", captureBeyondViewport=True, clip=clip)["data"]))

    def accessible_nodes(self) -> list[tuple[str, str]]:
        """Role and name of each element, as reported to assistive software; hidden elements are left out."""
        nodes = self.call("Accessibility.getFullAXTree")["nodes"]
        return [(node.get("role", {}).get("value", ""), node.get("name", {}).get("value", ""))
                for node in nodes if not node["ignored"]]
