"""Rigid blocks in pages and pictures, and displacements relative to a block: blocks_test.py ASHLAR SCENES."""
import math
import subprocess

from browser import Picture
from legibility import DRAWN
from pages import Pages, PageTest, main


class BlocksTest(PageTest):
    def test_rigid_blocks_are_no_supports(self):
        self.open("rigid")
        self.assertEqual(self.evaluate("data.blocks.filter(block => block.fixed).map(block => block.name)"),
                         ["support.1", "support.2"])
        self.assertEqual(self.evaluate("data.blocks.filter(block => !block.fixed && block.order === 0).length"), 9)
        # The range is that of the voussoirs, micrometres, not 0 to 1 m for missing values.
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

    def test_key_blocks_are_a_table_that_picks(self):
        self.open("slope")
        head, stone = (line.split("\t") for line in self.text("key-block-table").splitlines())
        self.assertEqual(head[:2], ["block", "factor"])
        self.assertEqual(stone[0], "stone")
        self.assertAlmostEqual(float(stone[1]), math.tan(math.radians(20)) / math.tan(math.radians(30)), delta=1e-4)
        self.browser.click(*self.evaluate("""(r => [r.x + 5, r.y + 5])(
            (row => (row.scrollIntoView(), row.getBoundingClientRect()))(document.querySelector('tr.pickable')))"""))
        self.assertEqual(self.picked()["block"], "stone")
        self.open("column")
        self.assertTrue(self.evaluate("element('key-blocks').hidden"))

    def test_rigid_blocks_have_a_line_of_thrust(self):
        self.open("rigid", "#thrust=yes&color=stone&contacts=none")
        # A line through each of nine voussoirs, from joint to joint.
        self.assertEqual(self.evaluate("thrustLines(visibleLinks(currentFrame())).length / 6"), 9)
        self.assertNotIn("no line of thrust", self.text("force-note"))
        self.open("falling", "#thrust=yes&frame=0")
        self.assertIn("no line of thrust", self.text("force-note"))

    def test_rigid_blocks_in_pictures(self):
        path = Pages.folder / "rigid.png"
        done = subprocess.run([Pages.program, "picture", Pages.folder_of("rigid"), "-o", path, "--size", "480x320", "--from",
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
        # Enlarged displacements keep the base in place and move the stone further: 2.5 to 3.5 m, less 0.2 m once more.
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
        self.assertEqual(self.evaluate("addressOf()"), "", "a page opens at the last frame")

    def test_the_motion_of_a_block_includes_its_rotation(self):
        self.open("moved", "#frame=4&relative=turning")
        angle = math.radians(self.evaluate("data.history.values['turning.rz'].slice(-1)[0]"))
        self.assertAlmostEqual(angle, 0.8, delta=0.01)
        for place in self.evaluate("""pointsOfBlocks()[2].map(p =>
                lengthAt(shownDisplacement(currentFrame()), p))"""):
            self.assertAlmostEqual(place, 0, delta=1e-4)
        # A point at rest appears to have rotated in the opposite direction about the axis: by Y - R Y.
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
            done = subprocess.run([Pages.program, "picture", Pages.folder_of("moved"), "-o", path, "--size", "320x200", *more],
                                  capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""), more)
            colours[more] = path.read_bytes()
        self.assertEqual(colours[()], colours["--relative-to", "base"])
        self.assertEqual(len(set(colours.values())), 3)

    def test_front_side_and_top_are_parallel(self):
        self.open("rigid")
        ends = [f"new THREE.Vector3(-1, {y}, 0.5)" for y in (-3, 3)]
        for view, parallel in (("front", True), ("start", False)):
            self.evaluate(f"lookAtView('{view}')")
            near, far = map(self.on_screen, ends)
            self.assertEqual(math.dist(near, far) < 0.1, parallel, view)
        # The scale bar is right for every depth: as long as these points are apart in pixels.
        self.evaluate("lookAtView('front')")
        left, right = (self.on_screen(f"new THREE.Vector3({x}, -3, 0.5)") for x in (0, 1))
        self.assertAlmostEqual((right[0] - left[0]) * self.evaluate("lengthOfPixel()"), 1, delta=1e-6)
        self.evaluate("noteView()")
        self.assertAlmostEqual(self.evaluate("current.zoom"), 1, delta=1e-6)
        # Turned and nearer it is a parallel view still, also for those who get its address.
        self.browser.call("Input.dispatchMouseEvent", type="mouseWheel", x=250, y=250, deltaX=0, deltaY=-100)
        self.browser.drag(250, 250, 300, 270)
        self.wait_for_painting()
        zoom, place = self.evaluate("current.zoom"), self.on_screen("centreOf(4)")
        self.assertGreater(zoom, 1)
        self.open("rigid", "#" + self.evaluate("addressOf()"))
        self.assertTrue(self.evaluate("camera.isOrthographicCamera"))
        self.assertAlmostEqual(self.evaluate("current.zoom"), zoom, delta=1e-3)
        self.assertLess(math.dist(self.on_screen("centreOf(4)"), place), 0.5)

    def test_edges_of_faces_that_hardly_bend_are_not_drawn(self):
        self.open("rigid")
        # A prism of 24 sides, 15 degrees each: its side edges are not features, its upper and lower rims are.
        kinds = self.evaluate("""(() => {
            const kept = data.reference, count = 24, points = [];
            for (const z of [0, 1]) for (let k = 0; k < count; ++k)
              points.push(Math.cos(2 * Math.PI * k / count), Math.sin(2 * Math.PI * k / count), z);
            const ring = [...Array(count).keys()], cells = ring.map((k) => ({block: 0, order: 1, face: k,
              corners: [k, (k + 1) % count, count + (k + 1) % count, count + k]}));
            cells.push({block: 0, order: 1, face: count, corners: ring.map((k) => count + k)},
              {block: 0, order: 1, face: count + 1, corners: [...ring].reverse()});
            data.reference = new Float32Array(points);
            const made = buildSurface(cells);
            data.reference = kept;
            return [made.edges.length, made.smoothEdges.length, made.innerEdges.length]; })()""")
        self.assertEqual(kinds, [48, 24, 0])

    def test_openings_are_coloured_from_zero(self):
        self.open("arch", "#joints=opening")
        low, high = self.evaluate("rangeOf(mainField(), currentFrame())")
        self.assertEqual(low, 0)
        self.assertGreater(high, 0)
        self.assertEqual(self.evaluate("stopsOf(mainField()) === SEQUENTIAL"), True)

    def test_legends_say_how_long_a_force_is(self):
        self.open("rigid", "#chain=yes&contacts=none&from=front")
        [kind] = self.evaluate("forceKinds(currentFrame()).filter(kind => kind.bar)")
        number, unit = kind["name"].removeprefix("joint force ").split()
        newton = float(number) * {"N": 1, "kN": 1e3}[unit]
        link = self.evaluate("currentFrame().links[0].force.toArray()")
        metres = self.evaluate("forceLength(new THREE.Vector3(...currentFrame().links[0].force.toArray()), usualForce('links') / chainFactor())")
        self.assertAlmostEqual(kind["bar"] * self.evaluate("lengthOfPixel()") / newton, metres / math.hypot(*link), delta=1e-9)

    def test_the_answer_of_a_search_comes_first(self):
        self.open("rigid")
        summary = """{status: "completed", message: "load factor between 1.9 and 2; block a: [1e-17, 0, 1]",
            load_factor: {lower: 1.915, upper: 2, moving: ["a", "b", "c"]}}"""
        self.assertEqual(self.evaluate(f"answerText({summary})"), "load factor between 1.915 and 2: 3 of 9 blocks move: a, b, c")
        self.assertEqual(self.evaluate(f"answerRows({summary})"), [])
        failed = "{status: 'failed', message: 'it went too deep'}"
        self.assertEqual(self.evaluate(f"answerText({failed})"), "failed")
        self.assertEqual(self.evaluate(f"answerRows({failed})"), [["message", "it went too deep"]])

    def test_the_whole_is_seen_after_the_window_has_changed(self):
        size = lambda width, height: self.browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                                                       deviceScaleFactor=1, mobile=False)
        before = self.evaluate("[innerWidth, innerHeight]")
        self.addCleanup(size, *before)
        size(1400, 500)
        self.open("rigid")
        size(1000, 900)
        self.wait_for_painting()
        self.wait_for_painting()
        middle, sides = self.evaluate(DRAWN)
        self.assertGreater(middle, 0.01)
        self.assertEqual(sides, 0, "the scene is cut off")


if __name__ == "__main__":
    main()
