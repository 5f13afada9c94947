"""Rigid blocks in pages and pictures, and displacements relative to a block. Run by view_test.py, with its pages."""
import math
import subprocess

from browser import Picture
from legibility import DRAWN
from pages import Pages, PageTest


class BlocksTest(PageTest):
    def test_rigid_blocks_are_no_supports(self):
        self.open("rigid")
        self.assertEqual(self.evaluate("data.blocks.filter(block => block.fixed).map(block => block.name)"),
                         ["support.1", "support.2"])
        self.assertEqual(self.evaluate("data.blocks.filter(block => !block.fixed && block.order === 0).length"), 9)
        # The range is that of the voussoirs: what sinks by micrometres, not 0 to 1 m of no values.
        low, high = self.evaluate("rangeOf(fields.displacement, currentFrame())")
        largest = self.evaluate("data.summary.largest_displacement.value")
        self.assertLess(largest, 0.01)
        self.assertAlmostEqual(high / largest, 1, delta=1e-3)
        self.assertGreaterEqual(low, 0)

    def test_a_click_says_rigid(self):
        self.open("rigid", "#from=front&contacts=none")
        for index, name, order in ((6, "arch.5", "0 (rigid)"), (0, "support.1", "fixed")):
            self.browser.click(*self.on_screen(f"centreOf({index})"))
            shown = self.picked()
            self.assertEqual((shown["block"], shown["order"]), (name, order))
        self.change("field", "order")
        names = self.evaluate("legendParts(currentFrame(), 10).kinds.map(kind => kind.name)")
        self.assertEqual(names, ["fixed", "order 0 (rigid)"])

    def test_rigid_blocks_have_a_line_of_thrust(self):
        self.open("rigid", "#thrust=yes&color=stone&contacts=none")
        # A line through each of nine voussoirs, from joint to joint.
        self.assertEqual(self.evaluate("thrustLines(visibleLinks(currentFrame())).length / 6"), 9)
        self.assertNotIn("no line of thrust", self.text("force-note"))
        self.open("falling", "#thrust=yes&frame=0")
        self.assertIn("no line of thrust", self.text("force-note"))

    def test_rigid_blocks_in_pictures(self):
        path = Pages.folder / "rigid.png"
        done = subprocess.run([Pages.program, "picture", Pages.folder / "rigid", "-o", path, "--size", "480x320", "--from",
                               "front", "--color", "stone", "--thrust-line", "--contacts", "none"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        pixels = Picture(path.read_bytes()).pixels(0, 0, 480, 320)
        self.assertGreater(pixels.count((0xc0, 0x00, 0x18)), 100)  # the line
        # Stone is warm, supports are cold: there is more of the arch than of the supports.
        warm = sum(r > b + 10 for r, _, b in pixels)
        cold = sum(b > r + 4 for r, _, b in pixels)
        self.assertGreater(warm, 2000)
        self.assertGreater(cold, 500)

    def test_displacements_are_relative_to_the_base_that_moves(self):
        self.open("moved", "#frame=4")
        self.assertEqual(self.evaluate("data.blocks[current.relative].name"), "base")
        shown = self.evaluate("""pointsOfBlocks().map(points => points.map(p =>
            [0, 1, 2].map(k => shownDisplacement(currentFrame())[3 * p + k])))""")
        for place in shown[0]:
            for component in place:
                self.assertAlmostEqual(component, 0, delta=1e-6)
        for place in shown[1]:
            for component, expected in zip(place, (-0.2, 0, 0)):
                self.assertAlmostEqual(component, expected, delta=1e-6)
        title = self.evaluate("scaleTitle(mainField(), rangeOf(mainField(), currentFrame()))")
        self.assertEqual(title, "displacement relative to base (mm)")
        self.assertIn("largest displacement relative to base", self.text("answers"))
        self.assertIn("largest displacement, absolute", self.text("answers"))
        # Enlarged displacements leave the base where it is and take the stone on: at 2.5 to 3.5 m, less 0.2 m once more.
        self.change("scale", "2")
        x = self.evaluate("[0, 1].map(block => centreOf(block).x)")
        self.assertAlmostEqual(x[0], 0.2, delta=1e-5)
        self.assertAlmostEqual(x[1], 3 - 0.2, delta=1e-5)

    def test_displacements_as_they_are(self):
        self.open("moved", "#frame=4&relative=none")
        self.assertIsNone(self.evaluate("current.relative"))
        self.assertAlmostEqual(self.evaluate("shownDisplacement(currentFrame())[0]"), 0.2, delta=1e-6)
        title = self.evaluate("scaleTitle(mainField(), rangeOf(mainField(), currentFrame()))")
        self.assertEqual(title, "displacement (mm)")
        self.change("relative", "0")
        self.assertEqual(self.evaluate("data.blocks[current.relative].name"), "base")
        self.assertEqual(self.evaluate("addressOf()"), "frame=4")

    def test_the_motion_of_a_block_includes_its_rotation(self):
        self.open("moved", "#frame=4&relative=turning")
        angle = math.radians(self.evaluate("data.history.values['turning.rz'].slice(-1)[0]"))
        self.assertAlmostEqual(angle, 0.8, delta=0.01)
        for place in self.evaluate("""pointsOfBlocks()[2].map(p =>
                lengthAt(shownDisplacement(currentFrame()), p))"""):
            self.assertAlmostEqual(place, 0, delta=1e-4)
        # A point that stands still seems to have turned the other way about the axis: by Y - R Y.
        rows = self.evaluate("""pointsOfBlocks()[1].map(p => [0, 1, 2].map(k => data.reference[3 * p + k])
            .concat([0, 1, 2].map(k => shownDisplacement(currentFrame())[3 * p + k])))""")
        self.assertEqual(len(rows), 8)
        for x, y, _, ux, uy, uz in rows:
            self.assertAlmostEqual(ux, x - (math.cos(angle) * x - math.sin(angle) * y), delta=2e-4)
            self.assertAlmostEqual(uy, y - (math.sin(angle) * x + math.cos(angle) * y), delta=2e-4)
            self.assertAlmostEqual(uz, 0, delta=2e-4)

    def test_the_orthogonal_factor_of_a_matrix(self):
        self.open("moved")
        # R S with S = diag(1, 2, 1e-3) and R a quarter turn about z.
        factor = self.evaluate("orthogonalFactor(new THREE.Matrix3().set(0, -2, 0, 1, 0, 0, 0, 0, 1e-3)).toArray()")
        for value, expected in zip(factor, (0, 1, 0, -1, 0, 0, 0, 0, 1)):  # column by column
            self.assertAlmostEqual(value, expected, delta=1e-12)

    def test_relative_pictures(self):
        colours = {}
        for more in ((), ("--relative-to", "none"), ("--relative-to", "base"), ("--relative-to", "still")):
            path = Pages.folder / "relative.png"
            done = subprocess.run([Pages.program, "picture", Pages.folder / "moved", "-o", path, "--size", "320x200", *more],
                                  capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""), more)
            colours[more] = path.read_bytes()
        self.assertEqual(colours[()], colours["--relative-to", "base"])
        self.assertEqual(len(set(colours.values())), 3)
