"""Chromium without a window, for tests of pages. Only the standard library: it is spoken to over a pipe."""

import json
import os
import pathlib
import select
import shutil
import subprocess
import sys
import tempfile
import time

# FACETMILL_BROWSER=none: without one, though there may be one.
NAMES = () if os.environ.get("FACETMILL_BROWSER") == "none" else ("chromium", "chromium-browser", "google-chrome")
CHROMIUM = next(filter(None, map(shutil.which, NAMES)), None)
PATIENCE = 60  # seconds
# CI sets it where it could install a browser: nothing that needs one may be skipped then.
STRICT = os.environ.get("FACETMILL_REQUIRE_BROWSER") == "1"


def miss(case, what):
    """Says that something is not there, or fails where it has to be."""
    if STRICT:
        case.fail(what)
    print(f"notice: {what}: {case.id()}", file=sys.stderr)


def require(case):
    """Skips a test without a browser."""
    if not CHROMIUM:
        miss(case, "Chromium is missing (tools/deps.sh --browser installs it)")
        case.skipTest("Chromium is missing")


class Browser:
    """A page of a browser. problems: what its console said; requests: what it asked for beside itself."""

    def __init__(self, *switches):
        self.folder = tempfile.mkdtemp(prefix="facetmill-browser-")
        to_browser, self.to = os.pipe()
        self.back, from_browser = os.pipe()
        command = [CHROMIUM, "--headless=new", "--no-sandbox", "--remote-debugging-pipe", f"--user-data-dir={self.folder}",
                   "--disable-extensions", "--no-first-run", "--disable-dev-shm-usage", "--use-gl=angle", "--use-angle=swiftshader",
                   "--enable-unsafe-swiftshader", "--hide-scrollbars", *switches, "about:blank"]
        # The pipe is at the descriptors 3 and 4.
        self.process = subprocess.Popen(["sh", "-c", f'exec "$@" 3<&{to_browser} 4>&{from_browser}', "sh", *command],
                                        pass_fds=(to_browser, from_browser), stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.number, self.buffer, self.session = 0, b"", None
        self.problems, self.requests, self.loaded = [], [], False
        target = next(t for t in self.ask("Target.getTargets")["targetInfos"] if t["type"] == "page")["targetId"]
        self.session = self.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.ask(f"{domain}.enable")

    def close(self):
        self.process.terminate()
        self.process.wait(PATIENCE)
        os.close(self.to)
        os.close(self.back)
        shutil.rmtree(self.folder, ignore_errors=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def message(self):
        """The next message of the browser."""
        end = time.monotonic() + PATIENCE
        while b"\0" not in self.buffer:
            if not select.select([self.back], [], [], max(0, end - time.monotonic()))[0]:
                raise TimeoutError("the browser says nothing")
            more = os.read(self.back, 1 << 20)
            if not more:
                raise ConnectionError("the browser ended")
            self.buffer += more
        text, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(text)

    def note(self, message):
        method, what = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            self.problems.append(what["exceptionDetails"].get("exception", {}).get("description", "an exception"))
        elif method == "Runtime.consoleAPICalled" and what["type"] in ("error", "warning"):
            self.problems.append(str(what["args"]))
        elif method == "Log.entryAdded" and what["entry"]["level"] in ("error", "warning"):
            self.problems.append(what["entry"]["text"])
        elif method == "Network.requestWillBeSent" and not what["request"]["url"].startswith(("data:", "about:")):
            self.requests.append(what["request"]["url"])
        elif method == "Page.loadEventFired":
            self.loaded = True

    def ask(self, method, **params):
        self.number += 1
        request = {"id": self.number, "method": method, "params": params}
        if self.session:
            request["sessionId"] = self.session
        os.write(self.to, json.dumps(request).encode() + b"\0")
        while True:
            message = self.message()
            if message.get("id") == self.number:
                if "error" in message:
                    raise RuntimeError(message["error"]["message"])
                return message["result"]
            self.note(message)

    def open(self, path):
        """Opens a file. requests holds what it asks for beside itself."""
        self.go(pathlib.Path(path).resolve().as_uri())

    def go(self, url):
        self.loaded = False
        self.problems.clear()
        self.requests.clear()
        self.ask("Page.navigate", url=url)
        while not self.loaded:
            self.note(self.message())
        self.requests.remove(url)

    def do(self, script):
        """The value of an expression; of a promise, what it comes to."""
        answer = self.ask("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(answer["exceptionDetails"].get("exception", {}).get("description", script))
        return answer["result"].get("value")

    def wait(self, condition):
        """Until an expression holds."""
        end = time.monotonic() + PATIENCE
        while not self.do(condition):
            if time.monotonic() > end:
                raise TimeoutError(condition)
            time.sleep(0.05)

    def comes_to(self, condition, seconds=1):
        """Whether an expression holds, at once or after a while."""
        end = time.monotonic() + seconds
        while not self.do(condition):
            if time.monotonic() > end:
                return False
            time.sleep(0.05)
        return True

    def press(self, key, shift=False):
        for kind in ("keyDown", "keyUp"):
            self.ask("Input.dispatchKeyEvent", type=kind, key=key, modifiers=8 if shift else 0,
                     **({"text": key} if len(key) == 1 and kind == "keyDown" else {}))

    def size(self, width, height, scale=1):
        self.ask("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=False)
