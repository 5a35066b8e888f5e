# SPDX-License-Identifier: BSD-3-Clause
"""Drives a headless Chromium over a pair of pipes (the DevTools protocol), with the network off.

It records the page's console output, its exceptions, and every address that it requests.
"""
import base64
import fcntl
import io
import json
import os
import shutil
import subprocess
import tempfile
import time

import numpy as np
from matplotlib import image as pyplot_image

PROGRAM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
PATIENCE = 90.0


class Browser:
    def __init__(self, width=1280, height=900):
        self.complaints, self.requests = [], []
        self._profile = tempfile.TemporaryDirectory(prefix="cairn_chromium.", ignore_cleanup_errors=True)
        commands, self._out = os.pipe()
        self._in, answers = os.pipe()
        command = [PROGRAM, "--headless=new", "--no-sandbox", "--remote-debugging-pipe", "--use-angle=swiftshader",
                   "--enable-unsafe-swiftshader", "--disable-dev-shm-usage", "--no-first-run", "--hide-scrollbars",
                   "--disable-background-networking", "--disable-component-update", "--disable-sync", "--mute-audio",
                   "--host-resolver-rules=MAP * ~NOTFOUND", "--force-device-scale-factor=1",
                   f"--user-data-dir={self._profile.name}", f"--window-size={width},{height}", "about:blank"]

        # The browser reads commands from descriptor 3 and writes answers to 4. A shell redirects the pipes to these.
        lent = [fcntl.fcntl(end, fcntl.F_DUPFD, 10) for end in (commands, answers)]
        self._log = open(os.path.join(self._profile.name, "log"), "w+")
        self._process = subprocess.Popen(["bash", "-c", f'exec 3<&{lent[0]} 4>&{lent[1]} "$@"', "bash", *command],
                                         pass_fds=lent, stdin=subprocess.DEVNULL, stdout=self._log, stderr=self._log)
        for end in (commands, answers, *lent):
            os.close(end)
        self._rest, self._number, self._session = b"", 0, None
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")
        self.call("Network.emulateNetworkConditions", offline=True, latency=0, downloadThroughput=0, uploadThroughput=0)
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._process.terminate()
        try:
            self._process.wait(20)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        os.close(self._out)
        os.close(self._in)
        self._log.close()
        self._profile.cleanup()

    def _message(self):
        while b"\0" not in self._rest:
            chunk = os.read(self._in, 1 << 20)
            if not chunk:
                self._log.seek(0)
                raise RuntimeError("the browser ended: " + self._log.read()[-2000:])
            self._rest += chunk
        message, self._rest = self._rest.split(b"\0", 1)
        return json.loads(message)

    def call(self, method, **parameters):
        self._number += 1
        request = {"id": self._number, "method": method, "params": parameters}
        if self._session:
            request["sessionId"] = self._session
        os.write(self._out, json.dumps(request).encode() + b"\0")
        while True:
            message = self._message()
            if message.get("id") == self._number:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']}")
                return message["result"]
            self._note(message)

    def _note(self, message):
        method, told = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            details = told["exceptionDetails"]
            self.complaints.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Runtime.consoleAPICalled" and told["type"] in ("error", "assert"):
            self.complaints.append(" ".join(str(part.get("value", part.get("description"))) for part in told["args"]))
        elif method == "Log.entryAdded" and told["entry"]["level"] == "error":
            self.complaints.append(told["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            self.requests.append(told["request"]["url"])

    def open(self, path):
        self.call("Page.navigate", url="file://" + os.path.abspath(path))
        self.wait("document.body && document.body.dataset.ready === 'true'")

    def evaluate(self, expression):
        told = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in told:
            raise RuntimeError(f"{expression}: {told['exceptionDetails']}")
        return told["result"].get("value")

    def wait(self, condition):
        until = time.monotonic() + PATIENCE
        while not self.evaluate(f"!!({condition})"):
            if time.monotonic() > until:
                raise RuntimeError(f"this did not come true: {condition}; complaints: {self.complaints}")
            time.sleep(0.05)

    def screenshot(self, path=None, whole_page=False):
        """A screenshot of the page as an array of height x width x 3. It is also written to a PNG file."""
        told = self.call("Page.captureScreenshot", format="png", captureBeyondViewport=whole_page)
        content = base64.b64decode(told["data"])
        if path:
            with open(path, "wb") as file:
                file.write(content)
        return pixels(content)


def pixels(png):
    """A PNG file as an array of height x width x 3 with values 0 to 255."""
    return (pyplot_image.imread(io.BytesIO(png), format="png")[:, :, :3] * 255).round().astype(np.uint8)
