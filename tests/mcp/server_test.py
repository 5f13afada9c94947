"""`ashlar mcp` by standard input and output: the protocol, its faults, the folder that it stays in, and jobs with numbers by hand.

Use: server_test.py ASHLAR
"""
import base64
import json
import pathlib
import shutil
import struct
import sys
import unittest

import jsonschema

from client import ASHLAR, LONG, WAIT, McpTest, Server

REVISIONS = ("2024-11-05", "2025-03-26", "2025-06-18")
TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"


class Protocol(McpTest):
    def test_revisions_are_agreed_on(self):
        for revision in (*REVISIONS, "2099-01-01"):
            server = self.serve(revision=revision)
            self.assertEqual(server.welcome["protocolVersion"], revision if revision in REVISIONS else REVISIONS[-1])
            self.assertEqual(server.welcome["serverInfo"]["name"], "ashlar")
            self.assertEqual(set(server.welcome["capabilities"]), {"tools", "resources"})
            self.assertEqual(server.ask("ping"), {})
            keys = server.call("scene_keys", query="analysis.end_time")
            self.assertEqual("structuredContent" in keys, server.welcome["protocolVersion"] == REVISIONS[-1])
            self.assertEqual(server.close(), 0)
            self.assertEqual(server.process.stderr.read(), b"")

    def test_initialize_comes_first_and_once(self):
        server = self.serve(revision=None)
        self.assertEqual(server.ask("ping"), {})
        self.assertEqual(server.ask("tools/list")["code"], -32600)
        self.assertEqual(server.ask("initialize")["code"], -32602)
        self.assertEqual(server.ask("initialize", protocolVersion="2025-06-18")["protocolVersion"], "2025-06-18")
        self.assertEqual(server.ask("initialize", protocolVersion="2025-06-18")["code"], -32600)

    def test_messages_that_are_none(self):
        server = self.serve()

        def code_of(line, identifier=None):
            server.write(line + b"\n")
            answer = server.next()
            self.assertEqual(answer["id"], identifier, line)
            return answer["error"]["code"]

        for line in (b"{", b"nonsense", b'{"jsonrpc": "2.0", "id": 1, "method": "ping"', b'"\xff\xfe"', b"[" * 100000,
                     b'{"a":' * 200 + b"1" + b"}" * 200, b"\x00"):
            self.assertEqual(code_of(line), -32700, line[:40])
        for line in (b"1", b'"ping"', b"null", b"{}", b'{"jsonrpc": "2.0"}', b'{"jsonrpc": "2.0", "method": 5}',
                     b'{"method": "ping"}', b'{"jsonrpc": "2.0", "id": null, "method": "ping"}', b"[]",
                     b'{"jsonrpc": "2.0", "id": 1.5, "method": "ping"}', b'{"jsonrpc": "2.0", "id": [1], "method": "ping"}',
                     b'{"jsonrpc": "2.0", "id": 1' + b"0" * 400 + b', "method": "ping"}',
                     b'[{"jsonrpc": "2.0", "id": 1, "method": "ping"}]'):
            self.assertIn(code_of(line), (-32600, -32700), line[:60])
        self.assertEqual(code_of(b'{"jsonrpc": "1.0", "id": 8, "method": "ping"}', 8), -32600)
        self.assertEqual(code_of(b'{"jsonrpc": "2.0", "id": 9, "method": "ping", "params": [1]}', 9), -32602)
        self.assertEqual(code_of(b'{"jsonrpc": "2.0", "id": 10, "method": "tools/destroy"}', 10), -32601)
        # Blank lines, answers to nothing and unknown notifications have no answer; line ends of Windows are blanks.
        server.write(b'\n  \r\n{"jsonrpc": "2.0", "id": 5, "result": {}}\r\n{"jsonrpc": "2.0", "method": "notifications/x"}\n')
        self.assertEqual(server.ask("ping"), {})
        self.assertEqual(server.others, [])

    def test_identifiers_come_back_as_they_are(self):
        server = self.serve()
        for identifier in (0, -1, 2**63 - 1, 2**64 - 1, "", "a", "\u00fc\u0000\U0001f600", "x" * 1_000_000):
            server.send({"jsonrpc": "2.0", "id": identifier, "method": "ping"})
            self.assertEqual(server.next(), {"jsonrpc": "2.0", "id": identifier, "result": {}})

    def test_a_line_that_is_too_long_is_skipped(self):
        server = self.serve()
        part = b'{"jsonrpc": "2.0", "id": 1, "method": "ping", "params": {"text": "' + b"a" * 1_000_000
        server.write(part)
        for _ in range(20):
            server.write(b"a" * 1_000_000)
        server.write(b'"}}\n')
        self.assertEqual(server.next()["error"]["code"], -32600)
        self.assertEqual(server.ask("ping"), {})

    def test_lists_of_messages_of_the_revision_that_has_them(self):
        server = self.serve(revision="2025-03-26")
        server.send([{"jsonrpc": "2.0", "id": "a", "method": "ping"}, {"jsonrpc": "2.0", "method": "notifications/x"},
                     {"jsonrpc": "2.0", "id": "b", "method": "tools/call", "params": {"name": "verify"}}, 7,
                     {"jsonrpc": "2.0", "id": "c", "method": "initialize", "params": {"protocolVersion": "2025-03-26"}}])
        answers = server.next()
        self.assertEqual({answer["id"] for answer in answers}, {"a", "b", "c", None})
        self.assertTrue(all(("error" in answer) == (answer["id"] in ("c", None)) for answer in answers), answers)
        server.send([{"jsonrpc": "2.0", "method": "notifications/x"}])
        self.assertEqual(server.ask("ping"), {})

    def test_tools_and_their_arguments(self):
        server = self.serve()
        tools = server.ask("tools/list")["tools"]
        self.assertEqual(len({tool["name"] for tool in tools}), len(tools))
        for tool in tools:
            self.assertEqual(tool["inputSchema"]["type"], "object")
            jsonschema.Draft202012Validator.check_schema(tool["inputSchema"])
            self.assertTrue(tool["description"].endswith("."), tool)
        self.assertEqual(server.ask("tools/list", cursor="2")["code"], -32602)
        self.assertEqual(server.ask("tools/call")["code"], -32602)
        self.assertEqual(server.ask("tools/call", name="checks")["code"], -32602)
        self.assertIn("did you mean check?", server.ask("tools/call", name="checks")["message"])
        self.assertEqual(server.ask("tools/call", name="check", arguments=[1])["code"], -32602)
        for arguments, words in (({}, "scene is missing"), ({"scene": 5}, "scene is 5, a text"),
                                 ({"scene": "a.toml", "sett": {}}, "did you mean set?"),
                                 ({"scene": "a.toml", "set": {"a": [1]}}, "an object is needed"),
                                 ({"scene": "x" * 2000}, "at most 1000 bytes")):
            self.assertIn(words, server.refusal("check", **arguments))
        for rows in (0, 2.5, "5", 10**9, None, True):
            self.assertIn("a whole number from 1 to 2000 is needed", server.refusal("history", folder="a", rows=rows))
        self.assertIn("one of", server.refusal("new_scene", kind="castle"))

    def test_an_identifier_in_use_is_refused(self):
        server = self.serve()
        self.write("long.toml", LONG)
        number = server.request("tools/call", name="run_start", arguments={"scene": "long.toml", "wait_seconds": 300})
        server.send({"jsonrpc": "2.0", "id": number, "method": "ping"})
        self.assertEqual(server.next()["error"]["code"], -32600)
        server.notify("notifications/cancelled", requestId=number)
        server.notify("notifications/cancelled", requestId="nobody's")
        server.notify("notifications/cancelled")
        server.send({"jsonrpc": "2.0", "id": number, "method": "ping"})
        self.assertEqual(server.next()["result"], {})

    def test_pages_are_resources(self):
        server = self.serve()
        listed = server.ask("resources/list")["resources"]
        names = {entry["name"] for entry in listed}
        self.assertLessEqual({"howto/rock.md", "reference/scene.md", "scenes/slope.toml", "scene.schema.json"}, names)
        docs = pathlib.Path(__file__).resolve().parents[2]
        for entry in listed:
            (read,) = server.ask("resources/read", uri=entry["uri"])["contents"]
            self.assertEqual(read["uri"], entry["uri"])
            if entry["name"].endswith(".md"):
                self.assertEqual(read["text"], (docs / "apps" / "docs" / entry["name"]).read_text(), entry)
        self.assertEqual(server.ask("resources/read", uri="file:///etc/passwd")["code"], -32002)
        self.assertEqual(server.ask("resources/read", uri="ashlar://book/../CMakeLists.txt")["code"], -32002)
        self.assertEqual(server.ask("resources/read")["code"], -32602)
        self.assertEqual(server.ask("resources/templates/list"), {"resourceTemplates": []})

    def test_the_book_answers(self):
        server = self.serve()
        found = server.data("search_book", query="spectrum of a record", count=3)["passages"]
        self.assertEqual(len(found), 3)
        self.assertIn("record", json.dumps(found).lower())
        page = server.call("read_page", page=found[0]["page"])["content"][0]["text"]
        self.assertIn(found[0]["excerpt"].split("\n")[0][:40], page)
        (key,) = server.data("scene_keys", query="analysis.time_step")["keys"]
        self.assertEqual((key["table"], key["key"]), ("[analysis]", "time_step"))
        self.assertTrue(all(key["table"] == "[[block.fix]]" for key in server.data("scene_keys", query="block.fix")["keys"]))
        self.assertIn("scene_keys", {tool["name"] for tool in server.ask("tools/list")["tools"]})
        server.refusal("search_book", query="xyzzyplugh")
        server.refusal("read_page", page="../../CMakeLists.txt")


class Folder(McpTest):
    def test_nothing_outside_is_reached(self):
        (self.outside / "secret.toml").write_text("secret_word = 1\n" + LONG)
        (self.outside / "empty").mkdir()
        (self.folder / "out_link").symlink_to(self.outside)
        (self.folder / "link.toml").symlink_to(self.outside / "secret.toml")
        (self.folder / "gone.toml").symlink_to(self.outside / "new.toml")
        self.write("good.toml", LONG)
        server = self.serve()
        self.addCleanup(lambda: self.assertEqual(sorted(p.name for p in self.outside.iterdir()),
                                                 ["empty", "models", "secret.toml"]))
        strange = ("../secret.toml", str(self.outside / "secret.toml"), "a/../../secret.toml", "./../secret.toml",
                   "out_link/secret.toml", "link.toml", "", ".hidden.toml", "-x.toml", "a\nb.toml", "x" * 300 + ".toml")
        for path in strange:
            for tool, arguments in (("read_file", {"file": path}), ("check", {"scene": path}), ("blocks", {"scene": path}),
                                    ("run_start", {"scene": path}), ("list_files", {"folder": path}),
                                    ("new_scene", {"kind": "slope", "file": path}), ("summary", {"folder": path}),
                                    ("write_file", {"file": path, "text": "x = 1", "replace": True}),
                                    ("run_start", {"scene": "good.toml", "out": path}), ("history", {"folder": path}),
                                    ("picture", {"folder": path}), ("contacts", {"a": path, "b": "good.toml"}),
                                    ("explain_contacts", {"scene": path, "a": "floor", "b": "stone"})):
                said = server.refusal(tool, **arguments)
                self.assertNotIn("secret_word", said)
                self.assertRegex(said, r"; (give|list_files|run_start)", (tool, path))
        server.refusal("write_file", file="gone.toml", text="x = 1", replace=True)
        self.assertEqual(server.close(), 0)

    def test_a_scene_names_no_file_outside(self):
        (self.outside / "secret.toml").write_text("secret_word = 1\n")
        (self.outside / "secret.off").write_text(TETRAHEDRON)
        (self.outside / "secret.csv").write_text("secret_word,a\n0,0\n1,0\n")
        (self.folder / "link.csv").symlink_to(self.outside / "secret.csv")
        block = '[[block]]\nname = "m"\nmaterial = "m"\nmesh = {{ file = "{}" }}\n'
        history = 'displacement_history = {{ file = "{}", time = "secret_word", values = ["a", "a", "a"] }}\n'
        fix = '[[block]]\nname = "m"\nmaterial = "m"\nbox = {{ min = [3, 3, 3], max = [4, 4, 4] }}\n' \
              "[[block.fix]]\nplane = {{ point = [3, 3, 3], normal = [0, 0, -1] }}\n" + history
        body = LONG.split("block = ")[0] + '[[block]]\nname = "f"\nfixed = true\nbox = { min = [-2, -2, -1], max = [2, 2, 0] }\n'
        server = self.serve()
        for place in ("../", f"{self.outside}/", "x/../../"):
            for text in (f'include = ["{place}secret.toml"]\n' + body, body + block.format(place + "secret.off"),
                         body + fix.format(place + "secret.csv")):
                server.call("write_file", file="scene.toml", text=text, replace=True)
                report = server.data("check", scene="scene.toml")
                self.assertFalse(report["good"])
                self.assertIn("outside of the folder", json.dumps(report))
                self.assertNotIn("unknown key secret_word", json.dumps(report))
                self.assertNotIn("secret_word (", json.dumps(report))
                self.assertIn("outside of the folder", server.refusal("run_start", scene="scene.toml", wait_seconds=300))
        server.call("write_file", file="scene.toml", text=body + fix.format("link.csv"), replace=True)
        self.assertIn("outside of the folder", json.dumps(server.data("check", scene="scene.toml")))
        # The same files inside.
        shutil.copy(self.outside / "secret.off", self.folder / "inside.off")
        server.call("write_file", file="scene.toml", text=body + block.format("inside.off"), replace=True)
        self.assertTrue(server.data("check", scene="scene.toml")["good"])
        told = server.data("check", scene="scene.toml", set={"block.m.mesh.file": "../secret.off"})
        self.assertIn("outside of the folder", json.dumps(told))

    def test_files_are_written_and_read(self):
        server = self.serve()
        self.assertIn("check", server.call("write_file", file="a/b/wall.toml", text="x = 1\ny = 2\n")["content"][0]["text"])
        self.assertIn("replace: true", server.refusal("write_file", file="a/b/wall.toml", text="x = 2\n"))
        self.assertEqual((self.folder / "a/b/wall.toml").read_text(), "x = 1\ny = 2\n")
        for name in ("wall.sh", "wall", "wall.toml/x.toml", ".bashrc", "view.html"):
            server.refusal("write_file", file="a/b/" + name, text="x", replace=True)
        self.assertEqual(server.call("read_file", file="a/b/wall.toml", first_line=2)["content"][0]["text"],
                         "y = 2\n(2 lines in all)\n")
        entries = server.data("list_files", folder="a/b")["entries"]
        self.assertEqual(entries, [{"name": "wall.toml", "kind": "file", "bytes": 12}])
        server.refusal("list_files", folder="a/c")
        (self.folder / "bytes.toml").write_bytes(b"a\0b")
        server.refusal("read_file", file="bytes.toml")
        self.assertIn("written", server.call("write_file", file="big.csv", text="1,2\n" * 900_000)["content"][0]["text"])
        self.assertIn("at most 4000000 bytes", server.refusal("write_file", file="big.csv", text="1,2\n" * 1_100_000))

    def test_a_folder_that_is_none(self):
        with Server(ASHLAR, self.folder / "none", revision=None) as server:
            self.assertEqual(server.process.wait(WAIT), 2)
            self.assertIn(b"cannot be used", server.process.stderr.read())


class Jobs(McpTest):
    def test_a_stone_slides_as_by_hand(self):
        server = self.serve()
        server.call("new_scene", kind="example:slope", file="slope.toml")
        report = server.data("check", scene="slope.toml")
        self.assertTrue(report["good"], report)
        self.assertEqual(report["blocks"], 2)
        blocks = server.data("blocks", scene="slope.toml", names="st*")
        self.assertEqual([block["name"] for block in blocks["blocks"]], ["stone"])
        self.assertEqual((blocks["count"], blocks["matching"]), (2, 1))
        run = server.call("run_start", scene="slope.toml")["structuredContent"]["run"]
        end = server.end_of(run)
        self.assertEqual((end["status"], end["exit_status"], end["folder"]), ("completed", 0, "slope.out"))
        # g (sin 30 - cos 30 tan 20) / 2 down the slope after one second, half of it in height.
        down = 9.81 * (0.5 - 0.75**0.5 * 0.36397023426620234) / 2
        (height,) = server.data("history", folder="slope.out", columns=["sole.uz"])["columns"]
        self.assertAlmostEqual(height["last"], -down / 2, delta=0.01 * down)
        self.assertEqual(height["first"], 0)
        rows = server.data("history", folder="slope.out", columns=["time", "sole.uz"], rows=11)["rows"]
        self.assertLessEqual(len(rows), 11)
        self.assertEqual(rows[-1], [1.0, height["last"]])
        self.assertIn("sole.uz", [column["column"] for column in server.data("history", folder="slope.out")["columns"]])
        self.assertIn("did you mean sole.uz?", server.refusal("history", folder="slope.out", columns=["soul.uz"]))
        summary = server.data("summary", folder="slope.out")
        self.assertEqual(summary["status"], "completed")
        self.assertIn("scene", summary["left_out"])
        self.assertEqual(server.data("summary", folder="slope.out", keys=["scene.title"])["scene.title"],
                         "A stone on a slope")
        server.refusal("summary", folder="slope.out", keys=["statu"])
        self.assertIn("view.html", server.call("view_page", folder="slope.out")["content"][0]["text"])
        self.assertTrue((self.folder / "slope.out" / "view.html").is_file())
        server.refusal("write_file", file="slope.out/summary.json", text="{}", replace=True)

    @unittest.skipUnless(any(map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), "no Chromium")
    def test_a_picture_comes_back(self):
        server = self.serve()
        server.call("new_scene", kind="slope")
        run = server.call("run_start", scene="slope.toml", set={"analysis.end_time": 0.1})["structuredContent"]["run"]
        server.end_of(run)
        answer = server.call("picture", folder="slope.out", size="320x200", color="velocity")
        image = next(part for part in answer["content"] if part["type"] == "image")
        self.assertEqual(image["mimeType"], "image/png")
        png = base64.b64decode(image["data"], validate=True)
        self.assertTrue(png.startswith(b"\x89PNG\r\n\x1a\n"))
        self.assertEqual(struct.unpack(">II", png[16:24]), (320, 200))
        self.assertIn("malformed size", server.refusal("picture", folder="slope.out", size="big"))
        server.refusal("picture", folder="slope.out", frame=1000)

    def test_without_a_browser_the_reason_is_told(self):
        server = self.serve(environment={"PATH": "/nowhere", "HOME": str(self.outside)})
        server.call("new_scene", kind="example:slope")
        run = server.call("run_start", scene="slope.toml", set={"analysis.end_time": 0.01})["structuredContent"]["run"]
        server.end_of(run)
        self.assertIn("chromium", server.refusal("picture", folder="slope.out"))

    def test_faults_are_data_with_their_places(self):
        server = self.serve()
        self.write("bad.toml", LONG.replace("end_time", "end_tme").replace("30", "-5"))
        report = server.data("check", scene="bad.toml")
        self.assertFalse(report["good"])
        self.assertIn(("bad.toml", 2), {(fault["file"], fault["line"]) for fault in report["faults"]})
        self.assertTrue(all(fault["column"] > 0 and fault["message"] for fault in report["faults"]))
        told = server.call("run_start", scene="bad.toml", wait_seconds=300)
        self.assertTrue(told["isError"])
        self.assertEqual(told["structuredContent"]["exit_status"], 2)
        self.assertIn("bad.toml:2:", told["structuredContent"]["messages"])
        self.assertFalse((self.folder / "bad.out").exists())

    def test_contacts_are_explained(self):
        server = self.serve()
        self.write("a.off", TETRAHEDRON)
        self.write("b.off", TETRAHEDRON.replace("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1",
                                                "OFF\n4 4 0\n2 0 0\n3 0 0\n2 1 0\n2 0 1"))
        report = server.data("contacts", a="a.off", b="b.off", distance=0.5)
        self.assertEqual((report["relation"], report["squared_distance"]), ("apart", 1.0))
        self.write("long.toml", LONG)
        told = server.call("explain_contacts", scene="long.toml", a="stone", b="floor", set={"analysis.end_time": 0.01})
        self.assertFalse(told["isError"], told)
        self.assertIn("stone", told["content"][0]["text"])
        server.refusal("explain_contacts", scene="long.toml", a="stone", b="roof", set={"analysis.end_time": 0.01})
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["a.off", "b.off", "long.toml"])

    def test_cases_are_listed_and_run(self):
        server = self.serve()
        cases = server.data("verify")["cases"]
        self.assertGreater(len(cases), 50)
        told = server.data("verify", cases=["free-fall"])
        self.assertTrue(told["passed"], told)
        self.assertIn("did you mean", server.refusal("verify", cases=[cases[0]["name"] + "x"]))
        server.refusal("verify", cases=["--list"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
