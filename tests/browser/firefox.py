# SPDX-License-Identifier: GPL-3.0-or-later
"""A headless Firefox driven through WebDriver BiDi (https://w3c.github.io/webdriver-bidi). Firefox is the process, Page its tab."""

import base64
import json
import os
import pathlib
import shutil
import time
from typing import Any

from browser_process import TIMEOUT_S, BrowserProcess, Failure, Tab

HEIGHT = 800
A4_CM = {"width": 21.0, "height": 29.7}
KEYS = {"Tab": "\ue004", "Enter": "\ue007", " ": " ", "End": "\ue010", "Home": "\ue011",
        "ArrowLeft": "\ue012", "ArrowUp": "\ue013", "ArrowRight": "\ue014", "ArrowDown": "\ue015"}  # WebDriver, 17.4.2

# Nothing of the browser's own reaches for the network, and no window asks a question.
PREFERENCES = {"app.normandy.enabled": False, "app.update.enabled": False, "browser.shell.checkDefaultBrowser": False,
               "browser.aboutwelcome.enabled": False, "datareporting.policy.dataSubmissionEnabled": False,
               "toolkit.telemetry.enabled": False, "network.captive-portal-service.enabled": False,
               "network.connectivity-service.enabled": False, "remote.prefs.recommended": True}

# A violation of the page's content policy is told to the page and not to the console that can be listened to.
POLICY_LISTENER = """() => addEventListener('securitypolicyviolation',
    event => console.error('CSP: ' + event.violatedDirective + ' ' + event.blockedURI))"""


def find_firefox() -> str | None:
    names = [os.environ.get("FIREFOX", ""), "firefox-esr", "firefox"]
    return next((path for path in map(shutil.which, filter(None, names)) if path), None)


class Firefox(BrowserProcess):
    """with Firefox(path) as browser: browser.page.open(url)"""

    def __init__(self, firefox: str) -> None:
        self._page: Page | None = None
        super().__init__([firefox, "--headless", "--no-remote", "--profile", "{home}/profile", "--remote-debugging-port=0"])

    @property
    def page(self) -> "Page":
        assert self._page
        return self._page

    def prepare(self) -> None:
        profile = self.home / "profile"
        profile.mkdir()
        (profile / "user.js").write_text("".join(
            f"user_pref({json.dumps(name)}, {json.dumps(value)});\n" for name, value in PREFERENCES.items()))

    def address(self) -> tuple[int, str] | None:
        file = self.home / "profile/WebDriverBiDiServer.json"
        try:
            return json.loads(file.read_text())["ws_port"], "/session"
        except (OSError, ValueError, KeyError):
            return None  # not written yet, or not to its end

    def greet(self) -> None:
        session = self.call("session.new", timeout_s=3 * TIMEOUT_S,
                            capabilities={"alwaysMatch": {"unhandledPromptBehavior": {"default": "dismiss"}}})
        self.version: str = f"Firefox/{session['capabilities']['browserVersion']}"
        self.call("session.subscribe", events=["log.entryAdded", "network.beforeRequestSent", "browsingContext.userPromptOpened"])
        self.call("script.addPreloadScript", functionDeclaration=POLICY_LISTENER)
        self._page = Page(self, self.call("browsingContext.getTree")["contexts"][0]["context"])

    def call(self, method: str, timeout_s: float = TIMEOUT_S, **params: Any) -> Any:
        return self.ask({"method": method, "params": params}, timeout_s)

    def on_event(self, message: dict[str, Any]) -> None:
        if self._page:
            self._page.on_event(message["method"], message["params"])


class Page(Tab):
    def __init__(self, browser: Firefox, context: str) -> None:
        super().__init__()
        self._browser = browser
        self._context = context

    def call(self, method: str, timeout_s: float = TIMEOUT_S, **params: Any) -> Any:
        return self._browser.call(method, timeout_s, context=self._context, **params)

    def on_event(self, method: str, params: dict[str, Any]) -> None:
        if method == "log.entryAdded" and params["level"] in ("error", "warn"):
            self.complaints.append(f"{params['type']} {params['level']}: {params['text']}")
        elif method == "network.beforeRequestSent":
            self.requests.append(params["request"]["url"])
        elif method == "browsingContext.userPromptOpened":
            self.dialogs.append(f"{params['type']}: {params['message']}")

    def open(self, url: str) -> None:
        """Loads a page and waits until it has been painted."""
        self.clear()
        self.call("browsingContext.navigate", timeout_s=3 * TIMEOUT_S, url=url, wait="complete")
        self.frames(2)

    def evaluate(self, script: str, timeout_s: float = TIMEOUT_S) -> Any:
        answer = self._browser.call("script.evaluate", timeout_s, awaitPromise=True, target={"context": self._context},
                                    expression=f"(async () => JSON.stringify(await ({script})))()")
        if answer["type"] == "exception":
            raise Failure(f"{script[:80]}: {answer['exceptionDetails']['text']}")
        return json.loads(answer["result"]["value"]) if answer["result"]["type"] == "string" else None

    def wait(self, seconds: float) -> None:
        self._browser.listen(seconds)

    def key(self, name: str) -> None:
        self._act("key", {}, [{"type": "keyDown", "value": KEYS[name]}, {"type": "keyUp", "value": KEYS[name]}])

    def click(self, x: float, y: float) -> None:
        self._act("pointer", {"parameters": {"pointerType": "mouse"}}, [
            {"type": "pointerMove", "x": round(x), "y": round(y)},
            {"type": "pointerDown", "button": 0}, {"type": "pointerUp", "button": 0}])

    def drag(self, x: float, y: float, to_x: float, to_y: float) -> None:
        self._act("pointer", {"parameters": {"pointerType": "mouse"}}, [
            {"type": "pointerMove", "x": round(x), "y": round(y)}, {"type": "pointerDown", "button": 0},
            {"type": "pointerMove", "x": round(to_x), "y": round(to_y), "duration": 100}, {"type": "pointerUp", "button": 0}])

    def _act(self, kind: str, more: dict[str, Any], actions: list[dict[str, Any]]) -> None:
        self.call("input.performActions", actions=[{"type": kind, "id": kind, **more, "actions": actions}])

    def resize(self, width: int, height: int = HEIGHT) -> None:
        self.call("browsingContext.setViewport", viewport={"width": width, "height": height})
        end = time.monotonic() + TIMEOUT_S
        while self.evaluate("innerWidth") != width:
            if time.monotonic() > end:
                raise Failure(f"the window does not become {width} px wide")
            self.wait(0.02)
        self.frames(2)

    def pdf(self) -> bytes:
        """The page on A4."""
        return base64.b64decode(self.call("browsingContext.print", timeout_s=60, background=True, page=A4_CM)["data"])

    def screenshot(self, path: pathlib.Path) -> None:
        """A picture of the whole page."""
        path.write_bytes(base64.b64decode(self.call("browsingContext.captureScreenshot", timeout_s=60, origin="document")["data"]))
