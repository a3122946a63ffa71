"""Firefox without a screen by WebDriver BiDi, which it speaks itself: no driver is needed."""

import json
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

from helpers import package, skip

LISTENING = re.compile(r"WebDriver BiDi listening on (ws://\S+)")
TIMEOUT = 120
"""Seconds for an answer on a busy machine."""


class Firefox:
    """A started Firefox with one page."""

    def __init__(self, profile: Path):
        program = shutil.which("firefox") or shutil.which("firefox-esr")
        if program is None:
            skip("there is no Firefox", "apt-get install firefox-esr")
        websocket = package("websocket", "-r tests/browser/requirements.txt")
        self._process = subprocess.Popen(
            [program, "--headless", "--remote-debugging-port=0", "--profile", str(profile)],
            stderr=subprocess.PIPE,
            text=True,
        )
        lines = iter(self._process.stderr.readline, "")
        address = next(filter(None, map(LISTENING.search, lines)))[1]
        self._socket = websocket.create_connection(
            f"{address}/session", timeout=TIMEOUT, suppress_origin=True
        )
        self._sent = 0
        self.command("session.new", capabilities={})
        self._context = self.command("browsingContext.getTree")["contexts"][0]["context"]

    def command(self, method: str, **params: Any) -> dict[str, Any]:
        """Send a command of WebDriver BiDi, and return its result."""
        self._sent += 1
        self._socket.send(json.dumps({"id": self._sent, "method": method, "params": params}))
        while (answer := json.loads(self._socket.recv())).get("id") != self._sent:
            pass  # an event
        assert answer["type"] == "success", answer
        return answer["result"]

    def open(self, address: str) -> None:
        """Open a page, and wait until it is loaded."""
        self.command(
            "browsingContext.navigate", context=self._context, url=address, wait="complete"
        )

    def run(self, expression: str) -> Any:
        """Return the value of an expression, or of its promise, which is a text or a number."""
        answer = self.command(
            "script.evaluate",
            expression=expression,
            target={"context": self._context},
            awaitPromise=True,
        )
        assert answer["type"] == "success", answer
        return answer["result"].get("value")

    def press(self, *keys: str) -> None:
        """Press and release keys, one after the other."""
        actions = [{"type": kind, "value": key} for key in keys for kind in ("keyDown", "keyUp")]
        source = {"type": "key", "id": "keyboard", "actions": actions}
        self.command("input.performActions", context=self._context, actions=[source])

    def point_at(self, x: float, y: float) -> None:
        """Move the mouse to a place in the window."""
        move = {"type": "pointerMove", "x": round(x), "y": round(y)}
        source = {"type": "pointer", "id": "mouse", "actions": [move]}
        self.command("input.performActions", context=self._context, actions=[source])

    def quit(self) -> None:
        """End the browser."""
        self._socket.close()
        self._process.terminate()
        self._process.wait(TIMEOUT)
