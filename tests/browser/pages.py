"""Pages of `ashlar view` for all tests, with actions and views of a user."""
import pathlib
import subprocess
import unittest

HERE = pathlib.Path(__file__).parent


class Pages:
    """The scenes simulated and viewed once, and the browser that all tests share."""
    browser = None
    files = {}

    @classmethod
    def write(cls, program, scenes, folder):
        cls.program, cls.folder = program, folder
        falling = scenes / "falling_block.toml"
        curved = ["--set", "analysis.end_time=0.01", "--set", "output.curved=true"]
        stress = ["--set", 'output.fields=["displacement", "velocity", "stress"]']
        for name, scene, more in (("falling", falling, ["--set", "analysis.end_time=0.56"]),
                                  ("curved", falling, curved),
                                  ("slope", HERE / "slope.toml", []), ("column", HERE / "column.toml", []),
                                  ("moved", HERE / "moved_base.toml", []), ("rigid", HERE / "rigid_arch.toml", []),
                                  ("acted", HERE / "acted_on.toml", []),
                                  ("arch", scenes / "arch_stands.toml", stress),
                                  ("wall", scenes / "wall.toml", ["--set", "analysis.end_time=0.02", *stress])):
            out = folder / name
            subprocess.run([program, "run", scene, "--out", out, "--quiet", "--view", *more], check=True)
            if name == "slope":
                cls.add_key_blocks(program, scene, out)
            cls.files[name] = (out / "view.html").as_uri()


    @staticmethod
    def add_key_blocks(program, scene, folder):
        subprocess.run([program, "blocks", scene, "--out", folder, "--removable", "0,0,-1"], check=True,
                       capture_output=True)
        subprocess.run([program, "view", folder], check=True, capture_output=True)


class PageTest(unittest.TestCase):
    """A test that opens pages: none may complain."""
    def setUp(self):
        self.browser = Pages.browser
        self.browser.complaints.clear()

    def tearDown(self):
        self.assertEqual(self.browser.complaints, [])

    def open(self, name, wishes=""):
        # A change of the part behind # alone does not load a page.
        self.browser.open("about:blank")
        self.browser.open(Pages.files[name] + wishes)
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
