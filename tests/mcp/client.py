"""A client of `ashlar mcp` with Python's own modules: it starts the server, sends messages and collects those that come."""
import itertools
import json
import os
import pathlib
import queue
import subprocess
import sys
import tempfile
import threading
import unittest

ASHLAR = os.path.abspath(sys.argv[1])
# A block at rest that is computed in every step: as many steps as a test needs.
LONG = """
analysis = { end_time = 1000, time_step = 1e-3, sleeping = false }
contact = { friction_angle = 30 }
material = [{ name = "m", density = 2000, young_modulus = 1e9, poisson_ratio = 0.2 }]
block = [{ name = "floor", fixed = true, box = { min = [-2, -2, -1], max = [2, 2, 0] } },
         { name = "stone", material = "m", box = { min = [-0.5, -0.5, 0], max = [0.5, 0.5, 1] } }]
measure = [{ name = "top", block = "stone", point = [0, 0, 1] }]
output = { interval = 100 }
"""

WAIT = 300  # s, for an answer on a busy machine


class Server:
    """A server and its messages. Each line of its output must be a message of JSON-RPC."""

    def __init__(self, program, folder, *options, revision="2025-06-18", environment=None):
        self.process = subprocess.Popen([program, "mcp", "--folder", str(folder), *options], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment)
        self.messages = queue.Queue()
        self.others = []  # notifications and answers to other requests
        self.numbers = itertools.count(1)
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()
        if revision:
            self.welcome = self.ask("initialize", protocolVersion=revision, capabilities={},
                                    clientInfo={"name": "test", "version": "1"})
            self.notify("notifications/initialized")

    def _read(self):
        for line in self.process.stdout:
            self.messages.put(json.loads(line))
        self.messages.put(None)

    def write(self, data):
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def send(self, message):
        self.write(json.dumps(message).encode() + b"\n")

    def next(self, seconds=WAIT):
        """The next message; None: the server has closed its output."""
        return self.messages.get(timeout=seconds)

    def notify(self, method, **parameters):
        self.send({"jsonrpc": "2.0", "method": method, "params": parameters})

    def request(self, method, **parameters):
        """Its id."""
        number = next(self.numbers)
        self.send({"jsonrpc": "2.0", "id": number, "method": method, "params": parameters})
        return number

    def answer_to(self, number, seconds=WAIT):
        for message in self.others:
            if message.get("id") == number:
                self.others.remove(message)
                return message
        while True:
            message = self.next(seconds)
            if message is None:
                raise AssertionError(f"the server ended: {self.process.stderr.read().decode()}")
            if isinstance(message, dict) and message.get("id") == number:
                return message
            self.others.append(message)

    def ask(self, method, **parameters):
        """The result of a request, or its error as {"code", "message"}."""
        answer = self.answer_to(self.request(method, **parameters))
        assert answer["jsonrpc"] == "2.0" and ("result" in answer) != ("error" in answer), answer
        return answer.get("result", answer.get("error"))

    def call(self, tool, **arguments):
        """The result of a tool."""
        return self.ask("tools/call", name=tool, arguments=arguments)

    def data(self, tool, **arguments):
        """The object that a tool returns, which must be the same as its text."""
        result = self.call(tool, **arguments)
        assert not result.get("isError"), result
        assert json.loads(result["content"][0]["text"]) == result["structuredContent"], result
        return result["structuredContent"]

    def refusal(self, tool, **arguments):
        """The text of a call that must be refused."""
        result = self.call(tool, **arguments)
        assert result.get("isError") is True, result
        return result["content"][0]["text"]

    def end_of(self, run):
        """State of a run when it has ended."""
        while True:
            told = self.call("run_status", run=run, wait_seconds=60)["structuredContent"]
            if told["state"] == "ended":
                return told

    def close(self):
        """Closes its input, as a client does that leaves. The exit status."""
        self.process.stdin.close()
        return self.process.wait(WAIT)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            if self.process.poll() is None:
                self.close()
            else:
                self.process.stdin.close()
        except (OSError, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        self.reader.join()
        self.process.stdout.close()
        self.process.stderr.close()


class McpTest(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)  # a run may still write
        self.addCleanup(kept.cleanup)
        self.outside = pathlib.Path(kept.name)
        self.folder = self.outside / "models"
        self.folder.mkdir()

    def serve(self, *options, **more):
        server = Server(ASHLAR, self.folder, *options, **more)
        self.addCleanup(server.__exit__)
        return server

    def write(self, name, text):
        (self.folder / name).write_text(text)
