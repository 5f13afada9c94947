"""Runs of `ashlar mcp`: started, polled, stopped, given up and gone on with; one in a folder; limits; clients and servers that end.

Use: runs_test.py ASHLAR
"""
import json
import shutil
import signal
import sys
import time
import unittest

from client import LONG, WAIT, McpTest


class Runs(McpTest):
    def setUp(self):
        super().setUp()
        self.write("long.toml", LONG)

    def start(self, server, **more):
        told = server.call("run_start", scene="long.toml", wait_seconds=0, **more)
        self.assertFalse(told["isError"], told)
        return told["structuredContent"]["run"]

    def wait_for_steps(self, folder="long.out"):
        end = time.monotonic() + WAIT
        history = self.folder / folder / "history.csv"
        while time.monotonic() < end and not (history.exists() and history.read_bytes().count(b"\n") > 20):
            time.sleep(0.05)
        self.assertTrue(history.exists())

    def status_in(self, folder="long.out"):
        return json.loads((self.folder / folder / "summary.json").read_text())["status"]

    def test_a_run_is_stopped_and_goes_on(self):
        server = self.serve()
        run = self.start(server)
        self.wait_for_steps()
        told = server.data("run_status", run=run)
        self.assertEqual(told["state"], "working")
        end = server.data("run_stop", run=run)
        self.assertEqual((end["state"], end["status"], end["exit_status"]), ("ended", "interrupted", 130))
        self.assertIn("resume", end["next"])
        steps = json.loads((self.folder / "long.out" / "summary.json").read_text())["steps"]
        self.assertGreater(steps, 0)
        self.assertIn("resume: true", server.refusal("run_start", scene="long.toml"))
        # The same state goes on, to an earlier end than that of the scene.
        again = server.call("run_start", scene="long.toml", resume=True, wait_seconds=0)["structuredContent"]
        self.assertEqual(server.data("run_stop", run=again["run"])["exit_status"], 130)
        self.assertGreaterEqual(json.loads((self.folder / "long.out" / "summary.json").read_text())["steps"], steps)
        self.assertEqual([told["state"] for told in server.data("run_status")["runs"]], ["ended", "ended"])
        server.refusal("run_stop", run="run-7")
        server.refusal("run_start", scene="long.toml", resume=True, replace=True)
        server.refusal("run_start", scene="long.toml", out="new.out", resume=True)

    def test_one_run_in_a_folder_and_some_at_a_time(self):
        server = self.serve("--runs", "2")
        first = self.start(server, out="one.out")
        self.assertIn(f"{first} writes", server.refusal("run_start", scene="long.toml", out="one.out"))
        self.assertIn(f"{first} writes", server.refusal("run_start", scene="long.toml", out="one.out", replace=True))
        self.wait_for_steps("one.out")
        (self.folder / "same").symlink_to("one.out")
        self.assertIn(f"{first} writes", server.refusal("run_start", scene="long.toml", out="same"))
        second = self.start(server, out="two.out")
        self.assertIn("2 run(s) at a time", server.refusal("run_start", scene="long.toml", out="three.out"))
        for run in (first, second):
            server.data("run_stop", run=run)
        self.start(server, out="three.out")

    def test_a_run_of_another_program_has_its_folder(self):
        one, other = self.serve(), self.serve()
        self.start(one)
        self.wait_for_steps()
        told = other.call("run_start", scene="long.toml", replace=True, wait_seconds=300)
        self.assertTrue(told["isError"], told)
        self.assertIn("long.out", told["structuredContent"]["messages"])

    def test_scenes_above_the_limits_are_refused(self):
        server = self.serve("--blocks", "1")
        self.assertIn("at most 1 blocks", json.dumps(server.data("check", scene="long.toml")["limits_exceeded"]))
        self.assertIn("at most 1 are allowed", server.refusal("run_start", scene="long.toml", wait_seconds=300))
        self.assertIn("at most 1 are allowed",
                      server.refusal("explain_contacts", scene="long.toml", a="stone", b="floor"))
        server = self.serve("--memory", "1e-6")
        self.assertIn("GB", server.refusal("run_start", scene="long.toml", wait_seconds=300))
        self.assertFalse((self.folder / "long.out").exists())

    def test_times_are_limited(self):
        server = self.serve("--hours", "1e-3", "--seconds", "0.3")
        run = self.start(server)
        end = server.end_of(run)
        self.assertIn("limit of hours", end["next"])
        self.assertEqual(self.status_in(), "interrupted")
        self.assertIn("the server's limit", server.refusal("explain_contacts", scene="long.toml", a="stone", b="floor"))

    def test_a_cancelled_start_stops_its_run(self):
        server = self.serve()
        number = server.request("tools/call", name="run_start", arguments={"scene": "long.toml", "wait_seconds": 300})
        self.wait_for_steps()
        server.notify("notifications/cancelled", requestId=number, reason="not needed")
        self.assertEqual(server.end_of("run-1")["exit_status"], 130)
        self.assertNotIn(number, [message.get("id") for message in server.others])
        # A cancelled wait leaves the run alone.
        self.start(server, resume=True)
        number = server.request("tools/call", name="run_status", arguments={"run": "run-2", "wait_seconds": 300})
        server.notify("notifications/cancelled", requestId=number)
        self.assertEqual(server.data("run_status", run="run-2")["state"], "working")

    def test_progress_is_told_to_those_who_ask(self):
        server = self.serve()
        run = self.start(server)
        number = server.request("tools/call", name="run_status", arguments={"run": run, "wait_seconds": 4},
                                _meta={"progressToken": "p"})
        server.answer_to(number)
        told = [message["params"] for message in server.others if message.get("method") == "notifications/progress"]
        self.assertGreaterEqual(len(told), 2)
        self.assertTrue(all(message["progressToken"] == "p" for message in told))
        self.assertEqual(sorted(message["progress"] for message in told), [message["progress"] for message in told])

    def test_the_server_answers_while_it_works(self):
        server = self.serve()
        number = server.request("tools/call", name="explain_contacts",
                                arguments={"scene": "long.toml", "a": "stone", "b": "floor"})
        self.assertEqual(server.ask("ping"), {})
        self.assertTrue(server.data("check", scene="long.toml")["good"])
        server.notify("notifications/cancelled", requestId=number)
        self.assertEqual(server.ask("ping"), {})
        self.assertEqual([message for message in server.others if message.get("id") == number], [])

    def test_a_client_that_leaves_stops_its_runs(self):
        server = self.serve()
        self.start(server)
        self.wait_for_steps()
        server.request("tools/call", name="run_status", arguments={"run": "run-1", "wait_seconds": 300})
        self.assertEqual(server.close(), 0)
        self.assertEqual(self.status_in(), "interrupted")
        self.assertTrue((self.folder / "long.out" / "checkpoint").is_file())

    def test_signals_stop_server_and_runs(self):
        for ending, status in ((signal.SIGTERM, 130), (signal.SIGKILL, -signal.SIGKILL)):
            shutil.rmtree(self.folder / "long.out", ignore_errors=True)
            server = self.serve()
            self.start(server)
            self.wait_for_steps()
            server.process.send_signal(ending)
            self.assertEqual(server.process.wait(WAIT), status)
            end = time.monotonic() + WAIT
            while time.monotonic() < end and not (self.folder / "long.out" / "summary.json").exists():
                time.sleep(0.05)
            self.assertEqual(self.status_in(), "interrupted")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
