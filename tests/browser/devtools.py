# SPDX-License-Identifier: GPL-3.0-or-later
"""A headless Chromium driven through the Chrome DevTools Protocol. Browser is the process, Page one tab."""

import base64
import os
import pathlib
import shutil
import time
from typing import Any

from browser_process import TIMEOUT_S, BrowserProcess, Failure, Tab

WIDTH, HEIGHT = 1100, 800

KEYS = {"Tab": 9, "Enter": 13, "Escape": 27, " ": 32, "End": 35, "Home": 36,
        "ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40}  # Windows' codes, which are the protocol's
TEXTS = {"Enter": "\r", " ": " "}  # a button is pressed by the character, not by the key


def find_chromium() -> str | None:
    names = [os.environ.get("CHROMIUM", ""), "chromium", "chromium-browser", "google-chrome"]
    return next((path for path in map(shutil.which, filter(None, names)) if path), None)


class Browser(BrowserProcess):
    """with Browser(path) as browser: page = browser.new_page()"""

    def __init__(self, chromium: str) -> None:
        self._pages: dict[str, "Page"] = {}
        super().__init__(
            [chromium, "--headless=new", "--no-sandbox", "--disable-gpu", "--remote-debugging-port=0",
             "--user-data-dir={home}/profile", f"--window-size={WIDTH},{HEIGHT}", "--force-device-scale-factor=1",
             "--no-first-run", "--disable-extensions", "--disable-sync", "--disable-background-networking",
             "--disable-component-update", "--mute-audio",
             "--disable-background-timer-throttling", "--disable-renderer-backgrounding",
             "--disable-backgrounding-occluded-windows", "--lang=en-US", "about:blank"])

    def address(self) -> tuple[int, str] | None:
        file = self.home / "profile/DevToolsActivePort"
        lines = file.read_text().splitlines() if file.exists() else []
        return (int(lines[0]), lines[1]) if len(lines) == 2 else None  # the file is there before it is written

    def greet(self) -> None:
        self.version: str = self.call("Browser.getVersion")["product"]

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
        return self.ask(_message(method, session, params), timeout_s)

    def call_later(self, method: str, session: str, **params: Any) -> None:
        self.post(_message(method, session, params))

    def on_event(self, message: dict[str, Any]) -> None:
        if message.get("sessionId") in self._pages:
            self._pages[message["sessionId"]].on_event(message["method"], message["params"])


def _message(method: str, session: str | None, params: dict[str, Any]) -> dict[str, Any]:
    message = {"method": method, "params": params}
    return message if session is None else {**message, "sessionId": session}


class Page(Tab):
    def __init__(self, browser: Browser, target: str, session: str) -> None:
        super().__init__()
        self._browser = browser
        self._target = target
        self._session = session
        self.width = WIDTH
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
            self._browser.call_later("Page.handleJavaScriptDialog", self._session, accept=False)  # else all scripts wait
        elif method == "Page.loadEventFired":
            self._loaded = True
        elif method == "Inspector.targetCrashed":
            raise Failure("the page's process crashed")

    def open(self, url: str) -> None:
        """Loads a page and waits until it has been painted."""
        self.clear()
        self._loaded = False
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
        result = self.call("Runtime.evaluate", timeout_s, expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            details = result["exceptionDetails"]
            raise Failure(f"{script[:80]}: {details.get('exception', {}).get('description', details['text'])}")
        return result["result"].get("value")

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
