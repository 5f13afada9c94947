"""Pages of `ashlar view` for all tests, with actions and views of a user."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

from browser import Browser, find_chromium

HERE = pathlib.Path(__file__).parent
WIDTH, HEIGHT = 900, 520


class Pages:
    """The scenes, each simulated and viewed when a test first asks for it, and the browser that all tests share."""
    browser = None
    _written = set()

    @classmethod
    def shared_browser(cls):
        """Started by the first test that opens a page: `ashlar picture` starts one of its own."""
        if cls.browser is None:
            cls.browser = Browser(find_chromium(), WIDTH, HEIGHT)
        return cls.browser

    @classmethod
    def folder_of(cls, name):
        """The result folder of one of the scenes below, with its page."""
        folder = cls.folder / name
        if name not in cls._written:
            scene, more = cls._scenes()[name]
            subprocess.run([cls.program, "run", scene, "--out", folder, "--quiet", "--view", *more], check=True)
            if name == "slope":
                cls._add_key_blocks(scene, folder)
            cls._written.add(name)
        return folder

    @classmethod
    def address_of(cls, name):
        return (cls.folder_of(name) / "view.html").as_uri()

    @classmethod
    def _scenes(cls):
        demo = cls.scenes
        stress = ["--set", 'output.fields=["displacement", "velocity", "stress"]']
        return {"falling": (demo / "falling_block.toml", ["--set", "analysis.end_time=0.56"]),
                "curved": (demo / "falling_block.toml",
                           ["--set", "analysis.end_time=0.01", "--set", "output.curved=true"]),
                "slope": (HERE / "slope.toml", []), "column": (HERE / "column.toml", []),
                "moved": (HERE / "moved_base.toml", []), "rigid": (HERE / "rigid_arch.toml", []),
                "acted": (HERE / "acted_on.toml", []),
                "arch": (demo / "arch_stands.toml", stress),
                "wall": (demo / "wall.toml", ["--set", "analysis.end_time=0.02", *stress])}

    @classmethod
    def _add_key_blocks(cls, scene, folder):
        subprocess.run([cls.program, "blocks", scene, "--out", folder, "--removable", "0,0,-1"], check=True,
                       capture_output=True)
        subprocess.run([cls.program, "view", folder], check=True, capture_output=True)


def main():
    """Runs the tests of the calling file: FILE ASHLAR SCENES, the program and the folder of the demo scenes; skipped (77)
    where there is no Chromium."""
    if find_chromium() is None:
        print("\n*** NOT TESTED: no chromium found, the pages of `ashlar view` were not opened in a browser ***\n",
              file=sys.stderr)
        sys.exit(77)
    Pages.program, Pages.scenes = map(pathlib.Path, (sys.argv.pop(1), sys.argv.pop(1)))
    with tempfile.TemporaryDirectory() as folder:
        Pages.folder = pathlib.Path(folder)
        try:
            result = unittest.main(verbosity=2, exit=False).result
        finally:
            if Pages.browser is not None:
                Pages.browser.close()
    sys.exit(0 if result.wasSuccessful() else 1)


class PageTest(unittest.TestCase):
    """A test that opens pages: none may complain."""
    def setUp(self):
        self.browser = Pages.shared_browser()
        self.browser.complaints.clear()

    def tearDown(self):
        self.assertEqual(self.browser.complaints, [])

    def open(self, name, wishes=""):
        # A change of the part behind # alone does not load a page.
        self.browser.open("about:blank")
        self.browser.open(Pages.address_of(name) + wishes)
        self.evaluate("started.then(() => 0)")
        self.wait_for_painting()

    def wait_for_painting(self):
        """No user acts before there is something to see; plots find their size when they are painted first."""
        self.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done())))")

    def evaluate(self, expression):
        return self.browser.evaluate(expression)

    def change(self, control, value):
        """Sets a control as the user would and lets the page know."""
        member = "checked" if isinstance(value, bool) else "value"
        literal = str(value).lower() if isinstance(value, bool) else repr(value)
        self.evaluate(f"element('{control}').{member} = {literal};"
                      f"element('{control}').dispatchEvent(new Event('change'))")

    def text(self, element_id):
        return self.evaluate(f"element('{element_id}').innerText")

    def middle_of(self, element_id, share=0.5):
        x, y, width, height = self.evaluate(
            f"(r => [r.x, r.y, r.width, r.height])(element('{element_id}').getBoundingClientRect())")
        return x + share * width, y + 0.5 * height

    def on_screen(self, vector):
        """Pixel at which the page shows a THREE.Vector3, given as an expression."""
        return self.evaluate(f"""(() => {{ const p = {vector}.clone().project(camera), c = element('canvas');
            return [(p.x + 1) / 2 * c.clientWidth, (1 - p.y) / 2 * c.clientHeight]; }})()""")

    def picked(self):
        return dict(line.split("\t") for line in self.text("picked").splitlines())
