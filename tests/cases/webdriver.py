"""A few calls of the WebDriver protocol (W3C) to Debian's ChromeDriver, by the standard library."""

import base64
import json
import shutil
import socket
import subprocess
import time
import urllib.error
import urllib.request

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")
CHROMEDRIVER = shutil.which("chromedriver")
AVAILABLE = bool(CHROMIUM and CHROMEDRIVER)
ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # key of an element's reference in the protocol
FLAGS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--allow-file-access-from-files",
    "--window-size=1400,1000",
]


class Browser:
    """Headless Chromium with an empty profile; use as a context manager."""

    def __init__(self, profile):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.base = f"http://127.0.0.1:{port}"
        self.driver = subprocess.Popen(
            [CHROMEDRIVER, f"--port={port}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        options = {"binary": CHROMIUM, "args": [*FLAGS, f"--user-data-dir={profile}"]}
        wanted = {"goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}}
        try:
            self.wait(lambda: self._call("GET", "/status")["ready"], "ChromeDriver")
            session = self._call("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})
        except BaseException:
            self.driver.kill()
            self.driver.wait()
            raise
        self.session = f"/session/{session['sessionId']}"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self._call("DELETE", self.session)
        finally:
            self.driver.terminate()
            self.driver.wait()

    def _call(self, method, path, body=None):
        data = None if method != "POST" else json.dumps(body or {}).encode()
        request = urllib.request.Request(self.base + path, data, method=method)
        opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        with opener.open(request, timeout=120) as answer:
            return json.loads(answer.read())["value"]

    def wait(self, condition, what, limit_s=60.0):
        """Poll until `condition()` is true."""
        end = time.monotonic() + limit_s
        while True:
            try:
                found = condition()
            except (urllib.error.URLError, ConnectionError):
                found = None
            if found:
                return found
            assert time.monotonic() < end, f"waited {limit_s:g} s for {what}"
            time.sleep(0.1)

    def open(self, url):
        self._call("POST", f"{self.session}/url", {"url": url})

    def script(self, code, *args):
        """Run JavaScript; elements come back as references for `click`."""
        return self._call("POST", f"{self.session}/execute/sync", {"script": code, "args": args})

    def elements(self, xpath):
        body = {"using": "xpath", "value": xpath}
        return self._call("POST", f"{self.session}/elements", body)

    def click(self, xpath, nth=0):
        """Click what `xpath` finds, as a user's pointer would."""
        found = self.wait(lambda: self.elements(xpath)[nth:], xpath)
        self._call("POST", f"{self.session}/element/{found[0][ELEMENT]}/click")

    def enter(self, xpath):
        """Make a frame the place where elements and text are looked for; `leave` goes back."""
        found = self.wait(lambda: self.elements(xpath), xpath)
        self._call("POST", f"{self.session}/frame", {"id": found[0]})

    def leave(self):
        self._call("POST", f"{self.session}/frame", {"id": None})

    def text(self):
        return self.script("return document.body.innerText")

    def log(self):
        """Messages of the console so far, as text."""
        entries = self._call("POST", f"{self.session}/se/log", {"type": "browser"})
        return [f"{entry['level']}: {entry['message']}" for entry in entries]

    def call_cdp(self, command, params):
        """A command of Chromium's own protocol, as its emulation of other screens."""
        body = {"cmd": command, "params": params}
        return self._call("POST", f"{self.session}/goog/cdp/execute", body)

    def screenshot(self, path):
        picture = self._call("GET", f"{self.session}/screenshot")
        with open(path, "wb") as handle:
            handle.write(base64.b64decode(picture))
