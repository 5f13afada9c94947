"""A headless Chromium driven over its debugging pipe (DevTools protocol), with Python's own modules only."""
import base64
import json
import os
import select
import shutil
import struct
import subprocess
import tempfile
import time
import zlib


def find_chromium():
    """Path of a Chromium, or None."""
    names = ("chromium", "chromium-browser", "google-chrome")
    return next((path for path in map(shutil.which, names) if path), None)


class Browser:
    """One page. complaints collects warnings and errors of the console, and exceptions of the
    page."""

    def __init__(self, chromium, width=1200, height=800):
        self._folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_browser, self._write = os.pipe()
        self._read, from_browser = os.pipe()
        self._process = subprocess.Popen(
            ["/bin/sh", "-c", f'exec "$@" 3<&{to_browser} 4>&{from_browser}', "sh", chromium, "--headless",
             "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-dev-shm-usage",
             "--no-first-run", "--disable-background-networking", f"--user-data-dir={self._folder.name}",
             "--remote-debugging-pipe", "about:blank"],
            pass_fds=(to_browser, from_browser), stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self._buffer = b""
        self._last_id = 0
        self._session = None
        self._events = []
        self.complaints = []
        target = next(info for info in self.call("Target.getTargets")["targetInfos"] if info["type"] == "page")
        attached = self.call("Target.attachToTarget", targetId=target["targetId"], flatten=True)
        self._session = attached["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def close(self):
        os.close(self._write)
        self._process.terminate()
        self._process.wait(30)
        os.close(self._read)
        self._folder.cleanup()

    def call(self, method, **parameters):
        self._last_id += 1
        message = {"id": self._last_id, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        self._send(json.dumps(message).encode() + b"\0")
        while True:
            answer = self._receive()
            if answer.get("id") == self._last_id:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                return answer["result"]

    def open(self, url):
        self._events.clear()
        self.call("Page.navigate", url=url)
        while "Page.loadEventFired" not in self._events:
            self._receive()

    def evaluate(self, expression):
        """The value of an expression of the page; promises are awaited."""
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{expression}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def evaluate_in(self, target, expression):
        """The same in another target, as a frame that has a process of its own."""
        page, self._session = self._session, self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        try:
            return self.evaluate(expression)
        finally:
            frame, self._session = self._session, page
            self.call("Target.detachFromTarget", sessionId=frame)

    def click(self, x, y):
        for kind in ("mouseMoved", "mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def drag(self, x, y, to_x, to_y):
        self.call("Input.dispatchMouseEvent", type="mousePressed", x=x, y=y, button="left", clickCount=1)
        self.call("Input.dispatchMouseEvent", type="mouseMoved", x=to_x, y=to_y, button="left", buttons=1)
        self.call("Input.dispatchMouseEvent", type="mouseReleased", x=to_x, y=to_y, button="left", clickCount=1)

    def screenshot(self):
        """The PNG of what the user sees."""
        return base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])

    def _send(self, data):
        while data:
            data = data[os.write(self._write, data):]

    def _receive(self):
        limit = time.monotonic() + 120
        while b"\0" not in self._buffer:
            ready, _, _ = select.select([self._read], [], [], max(0, limit - time.monotonic()))
            piece = os.read(self._read, 1 << 20) if ready else b""
            if not piece:
                raise RuntimeError("the browser does not answer")
            self._buffer += piece
        text, self._buffer = self._buffer.split(b"\0", 1)
        message = json.loads(text)
        self._note(message.get("method"), message.get("params"))
        return message

    def _note(self, method, parameters):
        self._events.append(method)
        if method == "Runtime.exceptionThrown":
            self.complaints.append(str(parameters["exceptionDetails"]))
        elif method == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "warning", "assert"):
            self.complaints.append(str(parameters["args"]))
        elif method == "Log.entryAdded" and parameters["entry"]["level"] == "error":
            self.complaints.append(parameters["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            url = parameters["request"]["url"]
            if not url.startswith(("file:", "data:", "blob:")):
                self.complaints.append(f"the page asks for {url}")


class Picture:
    """The pixels of a PNG of 8-bit RGB or RGBA, not interlaced."""

    def __init__(self, png):
        self.width, self.height, depth, kind = struct.unpack(">IIBB", png[16:26])
        assert png[:8] == b"\x89PNG\r\n\x1a\n" and depth == 8 and kind in (2, 6) and png[28] == 0
        self._bytes = 4 if kind == 6 else 3
        packed, at = b"", 8
        while at < len(png):
            size, = struct.unpack(">I", png[at:at + 4])
            if png[at + 4:at + 8] == b"IDAT":
                packed += png[at + 8:at + 8 + size]
            at += size + 12
        self._rows = self._unfiltered(zlib.decompress(packed))

    def _unfiltered(self, data):
        stride = self.width * self._bytes
        above, rows = bytearray(stride), []
        for start in range(0, len(data), stride + 1):
            row = bytearray(data[start + 1:start + 1 + stride])
            self._undo(data[start], row, above)
            rows.append(row)
            above = row
        return rows

    def _undo(self, kind, row, above):
        step = self._bytes
        for i in range(len(row) if kind else 0):
            left = row[i - step] if i >= step else 0
            corner = above[i - step] if i >= step else 0
            guess = (0, left, above[i], (left + above[i]) // 2, self._nearest(left, above[i], corner))[kind]
            row[i] = (row[i] + guess) & 255

    @staticmethod
    def _nearest(left, above, corner):
        guess = left + above - corner
        return min((left, above, corner), key=lambda value: abs(guess - value))

    def pixel(self, x, y):
        return tuple(self._rows[y][x * self._bytes:x * self._bytes + 3])

    def pixels(self, left, top, right, bottom):
        return [self.pixel(x, y) for y in range(top, bottom) for x in range(left, right)]
