#!/usr/bin/env python3
"""The page that runs the program, opened from disk in Chromium: run_page_test.py PAGE; skipped (77) where there is no Chromium."""
import pathlib
import sys
import time
import unittest

from browser import Browser, find_chromium

SKIPPED = 77
# s from opening to the verdict of the tunnel roof
LONGEST_FIRST_VERDICT = 60


class RunPageTest(unittest.TestCase):
    page = None
    chromium = None

    def setUp(self):
        self.browser = Browser(self.chromium, 1400, 900)
        self.addCleanup(self.browser.close)

    def tearDown(self):
        self.assertEqual(self.browser.complaints, [])

    def open(self, wishes=""):
        self.opened = time.monotonic()
        self.browser.open(self.page.as_uri() + wishes)

    def text(self, name):
        return self.browser.evaluate(f"document.getElementById('{name}').textContent")

    def wait_for(self, condition, limit=120):
        """Until an expression of the page is true."""
        end = time.monotonic() + limit
        while not self.browser.evaluate(f"Boolean({condition})"):
            self.assertLess(time.monotonic(), end, f"{condition}: {self.text('state')}\n{self.text('log')}")
            time.sleep(0.2)

    def in_view(self, expression):
        """The value of an expression in the frame of results, which the page itself may not look into."""
        targets = self.browser.call("Target.getTargets")["targetInfos"]
        frames = [each["targetId"] for each in targets if each["type"] == "iframe"]
        return self.browser.evaluate_in(frames[0], expression) if frames else None

    def write(self, text):
        self.browser.evaluate(f"setText({text!r})")

    def test_first_verdict(self):
        self.open("#scene=tunnel_roof.toml&run")
        self.wait_for("page.results")
        seconds = time.monotonic() - self.opened
        self.assertIn("1 of 24 blocks move, block rock.13 fastest", self.text("log"))
        print(f"verdict after {seconds:.1f} s", flush=True)
        self.assertLess(seconds, LONGEST_FIRST_VERDICT)
        end = time.monotonic() + 60
        while "rock.13" not in (self.in_view("document.getElementById('answer')?.textContent") or ""):
            self.assertLess(time.monotonic(), end, "the frame shows no answer")
            time.sleep(0.2)
        names = self.browser.evaluate("Object.keys(page.results)")
        self.assertIn("tunnel_roof.out/summary.json", names)
        self.assertGreater(self.browser.evaluate("zipOf(page.results).then(archive => archive.size)"), 10000)

    def test_faults_at_their_lines(self):
        self.open()
        self.wait_for("program.module")
        self.write('title = "x"\nanalysis = { type = "statik" }\n')
        self.wait_for("document.querySelectorAll('#faults .error').length > 0")
        self.assertEqual(self.browser.evaluate("[...document.querySelectorAll('#lines .error')].map(each => each.textContent)"),
                         ["1", "2"])
        self.browser.evaluate("document.querySelector('#faults li:last-child').click()")
        self.assertGreater(self.browser.evaluate("element('text').selectionStart"), 11)

    def test_keys_and_values_from_the_schema(self):
        self.open()
        self.wait_for("editor.schema")
        for before, expected in (("[contact]\nfriction_a", "friction_angle"), ('analysis = { type = "', '"static"'), ("[[mas", "[[masonry]]")):
            with self.subTest(before):
                self.write(before)
                self.browser.evaluate("element('text').focus(), element('text').setSelectionRange(999, 999), offerCompletions(true)")
                self.assertIn(expected, self.browser.evaluate("editor.list.map(each => each.text)"))
        self.browser.evaluate("complete(0)")
        self.assertEqual(self.browser.evaluate("element('text').value"), "[[masonry]]")

    def test_stop_keeps_frames(self):
        self.open("#scene=tunnel_roof.toml")
        self.wait_for("program.module")
        self.browser.evaluate("setText(element('text').value.replace('end_time = 0.6', 'end_time = 60')), void run()")
        self.wait_for("/ 60 s/.test(element('log').textContent)")
        time.sleep(4)
        self.browser.evaluate("element('stop').click()")
        self.wait_for("element('state').textContent.startsWith('stopped')")
        self.wait_for("page.results && page.viewAddress")
        self.assertIn("tunnel_roof.out/view.html", self.browser.evaluate("Object.keys(page.results)"))


def main():
    RunPageTest.page = pathlib.Path(sys.argv.pop(1)).resolve()
    RunPageTest.chromium = find_chromium()
    if RunPageTest.chromium is None:
        print("there is no Chromium")
        return SKIPPED
    return 0 if unittest.main(verbosity=2, exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
