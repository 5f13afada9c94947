"""Opens the pages of `ashlar view` in Chromium and does what a user does; skipped (77) where it is missing.

Use: view_test.py ASHLAR SCENES, the program and the folder of the demo scenes.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from browser import Browser, Picture, find_chromium

WIDTH, HEIGHT = 900, 520
HERE = pathlib.Path(__file__).parent

# Shares of the scene's canvas that are not background: in its middle half, and along its two sides.
DRAWN = """(() => {
    const from = element("canvas"), copy = document.createElement("canvas");
    const [width, height] = [copy.width, copy.height] = [from.width, from.height];
    const context = copy.getContext("2d");
    context.drawImage(from, 0, 0);
    const [r, g, b] = new THREE.Color(theme().background).toArray().map((c) => Math.round(255 * c));
    const drawn = (x, y, w, h) => {
      const {data} = context.getImageData(x, y, w, h);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) if (data[i] !== r || data[i + 1] !== g || data[i + 2] !== b) ++count;
      return count / (w * h);
    };
    return [drawn(width >> 2, height >> 2, width >> 1, height >> 1), drawn(0, 0, 2, height) + drawn(width - 2, 0, 2, height)];
  })()"""

# Elements that go beyond the window, or whose text goes beyond them.
TOO_WIDE = """[...document.querySelectorAll("body *")].filter((item) => {
    const box = item.getBoundingClientRect();
    return box.width > 0 && (box.right > innerWidth + 1 || box.left < -1
      || (item.matches("button, legend, label, td, h1") && item.scrollWidth > item.clientWidth + 1));
  }).map((item) => item.tagName + "#" + item.id + " " + item.textContent.slice(0, 20))"""

# Texts whose contrast with what is behind them (WCAG 2) is less than 4.5, and the colours that texts on the picture have.
TOO_FAINT = """(() => {
    const numbers = (colour) => colour.match(/[\\d.]+/g).map(Number);
    const light = (rgb) => rgb.slice(0, 3).map((c) => c / 255)
      .map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))
      .reduce((sum, c, k) => sum + [0.2126, 0.7152, 0.0722][k] * c, 0);
    const contrast = (a, b) => { const [low, high] = [light(a), light(b)].sort((x, y) => x - y);
      return (high + 0.05) / (low + 0.05); };
    const behind = (item) => {
      for (; item; item = item.parentElement) {
        const colour = numbers(getComputedStyle(item).backgroundColor);
        if (colour.length < 4 || colour[3] > 0) return colour;
      }
      return [255, 255, 255];
    };
    const faint = [...document.querySelectorAll("body *")].filter((item) => item.getClientRects().length > 0
      && !item.matches("script, option, optgroup, :disabled")
      && [...item.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim())
      && contrast(numbers(getComputedStyle(item).color), behind(item)) < 4.5)
      .map((item) => item.tagName + "#" + item.id + " " + item.textContent.slice(0, 20));
    const rgb = (colour) => new THREE.Color(colour).toArray().map((c) => 255 * c);
    if (contrast(rgb(theme().text), rgb(theme().background)) < 4.5) faint.push("text on the picture");
    return faint;
  })()"""


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
                                  ("arch", scenes / "arch_stands.toml", stress),
                                  ("wall", scenes / "wall.toml", ["--set", "analysis.end_time=0.02", *stress])):
            out = folder / name
            subprocess.run([program, "run", scene, "--out", out, "--quiet", "--view", *more], check=True)
            cls.files[name] = (out / "view.html").as_uri()


class ViewTest(unittest.TestCase):
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

    def colours_of_blocks(self):
        """Colours seen at the centres of the blocks."""
        picture = Picture(self.browser.screenshot())
        count = self.evaluate("data.blocks.length")
        centres = [self.on_screen(f"centreOf({block})") for block in range(count)]
        return [picture.pixel(round(x), round(y)) for x, y in centres]

    def test_every_page_shows_blocks(self):
        for name, fewest in (("falling", 0.04), ("slope", 0.04), ("column", 0.04)):
            with self.subTest(name):
                self.open(name)
                self.assertTrue(self.evaluate("element('message').hidden"), "no WebGL")
                width = int(self.evaluate("element('stage').clientWidth"))
                pixels = Picture(self.browser.screenshot()).pixels(10, 60, width - 10, HEIGHT - 80)
                drawn = sum(pixel != (255, 255, 255) for pixel in pixels) / len(pixels)
                self.assertGreater(drawn, fewest)
                self.assertGreater(len(set(pixels)), 20)

    def test_slider_moves_picture_clock_and_cursor(self):
        self.open("falling")
        self.assertIn("t = 0 s", self.text("clock"))
        before = self.browser.screenshot()
        height = self.on_screen("centreOf(0)")[1]
        plot = self.evaluate("element('plot-1').toDataURL()")
        self.browser.click(*self.middle_of("slider", 0.9))
        self.assertNotIn("t = 0 s", self.text("clock"))
        self.assertNotEqual(self.browser.screenshot(), before)
        self.assertGreater(self.on_screen("centreOf(0)")[1], height + 20, "the falling block did not go down")
        self.assertNotEqual(self.evaluate("element('plot-1').toDataURL()"), plot)

    def test_play_goes_on_and_stops(self):
        self.open("falling")
        self.browser.click(*self.middle_of("play"))
        self.evaluate("new Promise(done => setInterval(() => current.frame >= 2 && done(), 5))")
        self.browser.click(*self.middle_of("play"))
        stopped = self.evaluate("current.frame")
        self.assertGreaterEqual(stopped, 2)
        self.browser.screenshot()
        self.assertEqual(self.evaluate("current.frame"), stopped)

    def test_colours_tell_fields_and_blocks_apart(self):
        self.open("falling")
        seen = set()
        for field in self.evaluate("Object.keys(fields)"):
            self.change("field", field)
            seen.add(self.browser.screenshot())
        # displacement and its parts, velocity, von Mises, pressure, 2 principal and 6 stresses, block, order, stone
        self.assertEqual(len(seen), 18)
        self.change("contact-colour", "none")
        for field in ("block", "order"):
            self.change("field", field)
            first, second = self.colours_of_blocks()
            self.assertGreater(sum(abs(a - b) for a, b in zip(first, second)), 60, field)

    def test_the_least_value_has_the_first_colour(self):
        self.open("falling")
        self.change("field", "displacement")
        # At the start block A has not moved and is pale green, #bfe6a8 in its shade: neither unlit stone nor a support.
        red, green, blue = self.colours_of_blocks()[0]
        self.assertTrue(green > 1.1 * red and green > 1.2 * blue, (red, green, blue))

    def test_switches_change_the_picture(self):
        self.open("falling", "#frame=55")
        for control, value in (("edges", False), ("sub-faces", True), ("see-through", True), ("scale", "1.5"), ("scale", "1"),
                               ("open-contacts", True), ("contact-colour", "type"), ("arrows", True), ("chain", False),
                               ("vectors", "velocity"), ("crosses", True), ("units", "si"),
                               ("range", "percentile"), ("marks-shown", False), ("section", "y"), ("joints", "normal"),
                               ("joints", "state"), ("theme", "dark")):
            before = self.browser.screenshot()
            self.change(control, value)
            self.assertNotEqual(self.browser.screenshot(), before, control)

    def test_a_click_shows_the_block(self):
        for name, blocks in (("falling", [("A", "rock", "1"), ("B", "rock", "3")]),
                             ("slope", [("slope", "-", "fixed"), ("stone", "granite", "1")]),
                             ("column", [("lower", "granite", "2"), ("upper", "granite", "1")])):
            self.open(name)
            self.change("contact-colour", "none")
            for index, (block, material, order) in enumerate(blocks):
                with self.subTest(block):
                    self.browser.click(*self.on_screen(f"centreOf({index})"))
                    shown = self.picked()
                    self.assertEqual((shown["block"], shown["material"], shown["order"]), (block, material, order))

    def test_the_centre_of_a_cube_is_its_middle(self):
        self.open("falling")
        self.browser.click(*self.on_screen("centreOf(0)"))
        self.assertEqual([float(x) for x in self.picked()["centre (m)"].split(", ")], [7.25, 0, 2.25])

    def test_curved_frames_look_like_divided_ones(self):
        pixels = []
        for name in ("falling", "curved"):
            self.open(name, "#color=order")
            # The scene's size, which sets the view, is that of all frames.
            self.evaluate("Object.assign(current, {at: new THREE.Vector3(4, 0, 0), from: new THREE.Vector3(0, -1, 0)}),"
                          "sceneBox.set(new THREE.Vector3(0, -2, -2), new THREE.Vector3(8, 2, 4)),"
                          "outline = cornersOf(sceneBox), lookFrom(current.from), render()")
            pixels.append(Picture(self.browser.screenshot()).pixels(150, 60, 500, 400))
        differing = sum(a != b for a, b in zip(*pixels))
        self.assertLess(differing, 0.01 * len(pixels[0]))
        self.assertGreater(sum(pixel != (255, 255, 255) for pixel in pixels[0]), 0.1 * len(pixels[0]))

    def test_contacts_in_words(self):
        self.open("slope")
        self.browser.click(*self.middle_of("slider", 0.97))
        self.assertRegex(self.text("force-note"), r"\d+ contact points; largest joint force [\d.]+ kN")
        self.change("arrows", True)
        self.assertRegex(self.text("force-note"), r"\d+ contact points, largest force [\d.]+ kN")
        self.change("units", "si")
        self.assertRegex(self.text("force-note"), r"largest joint force \d+ N")

    def test_a_click_on_nothing_clears(self):
        self.open("falling")
        self.browser.click(*self.on_screen("centreOf(0)"))
        self.browser.click(5, 200)
        self.assertEqual(self.picked(), {})

    def test_a_click_shows_the_contact(self):
        self.open("slope")
        self.browser.click(*self.middle_of("slider", 0.97))
        self.browser.click(*self.on_screen("visibleContacts(currentFrame())[0].place"))
        shown = self.picked()
        self.assertEqual((shown["type"], shown["state"]), ("face-face", "sliding"))
        self.assertEqual(set(shown["contact"].split(" on ")), {"slope", "stone"})
        normal, shear = map(float, shown["normal, shear (N)"].split(", "))
        self.assertGreater(normal, 0)
        self.assertAlmostEqual(shear / normal, 0.36397, places=3)  # tan 20 degrees

    def test_drag_turns_the_scene(self):
        self.open("column")
        before = self.browser.screenshot()
        self.browser.drag(200, 300, 320, 300)
        turned = self.browser.screenshot()
        self.assertNotEqual(turned, before)
        self.assertEqual(self.picked(), {}, "a drag is no click")
        self.browser.click(*self.middle_of("home"))
        self.assertNotEqual(self.browser.screenshot(), turned)

    def test_history_and_summary(self):
        self.open("falling")
        groups = self.evaluate("[...element('plot-1-group').options].map(option => option.value)")
        for group in ("tip: displacement", "corner: velocity", "energies", "contacts", "step size", "tip.uz"):
            self.assertIn(group, groups)
            self.change("plot-1-group", group)
            self.assertGreater(self.evaluate("plots[0].data.datasets[0].data.length"), 500, group)
        self.assertIn("completed", self.text("answers"))
        self.assertEqual(self.evaluate("document.title"), "Block falling on a cantilever - Ashlar")

    def test_a_click_in_a_plot_shows_that_time(self):
        self.open("falling")
        self.evaluate("element('plot-1').scrollIntoView({block: 'center'})")
        self.wait_for_painting()
        left, right = self.evaluate("[plots[0].chartArea.left, plots[0].chartArea.right]")
        x, y = self.evaluate("(r => [r.x, r.y + r.height / 2])(element('plot-1').getBoundingClientRect())")
        self.browser.click(x + left + 0.5 * (right - left), y)
        self.wait_for_painting()  # Chart.js answers to events with the next one
        self.assertAlmostEqual(self.evaluate("currentFrame().time"), 0.28, delta=0.011)

    def test_energies_are_differences_from_the_start(self):
        self.open("falling")
        self.change("plot-1-group", "energies")
        self.assertEqual(self.evaluate("plots[0].data.datasets.map(set => set.data[0].y)"),
                         [0] * self.evaluate("plots[0].data.datasets.length"))
        self.assertIn("change", self.evaluate("plots[0].options.scales.y.title.text"))

    def test_any_column_against_any_as_a_table(self):
        self.open("falling")
        self.change("plot-1-group", "tip.uz")
        self.change("plot-1-x", "tip.z")
        head, first, *_ = self.evaluate("plotTable(plots[0])").splitlines()
        self.assertEqual(head, '"tip.z (mm)","tip.uz (mm)"')
        self.assertEqual([float(x) for x in first.split(",")], self.evaluate(
            "[data.history.values['tip.z'][0] * 1000, data.history.values['tip.uz'][0] * 1000]"))
        self.assertTrue(self.evaluate("plotPicture(plots[0])").startswith("data:image/png;base64,"))

    def test_statics_open_at_their_end(self):
        self.open("arch")
        self.assertEqual(self.evaluate("current.frame"), self.evaluate("data.frames.length - 1"))
        self.assertIn("iteration", self.text("clock"))
        self.assertEqual(self.evaluate("plots[0].options.scales.x.title.text"), "iteration")
        self.assertIn("equilibrium", self.text("answers"))
        self.assertRegex(self.text("answers"), r"largest compression\s+[\d.]+ kPa in arch\.\d+ at")

    def test_ticks_are_round(self):
        self.open("slope")
        ticks = self.evaluate("scaleOf({label: '', unit: 'm'}, [0, 0.9064], 5).ticks.map(tick => tick.text)")
        self.assertEqual(ticks, ["0", "200", "400", "600", "800"])
        self.assertEqual(self.evaluate("scaleOf({unit: 'm'}, [0, 0.9064], 5).unit"), "mm")
        self.assertEqual(self.evaluate("roundTicks(-0.3, 0.31, 6).map(Number)"), [-0.3, -0.2, -0.1, 0, 0.1, 0.2, 0.3])
        self.assertEqual(self.evaluate("quantity(9.1e6, 'Pa')"), "9.1 MPa")
        texts = self.evaluate("scaleOf({unit: 's'}, [0.036261, 0.036263], 4).ticks.map(tick => tick.text)")
        self.assertEqual(len(set(texts)), len(texts))
        self.assertIn("0.0362615", texts)

    def test_blocks_are_found_hidden_and_isolated(self):
        self.open("arch", "#color=block&contacts=none")
        self.evaluate("element('search').value = 'arch.1', element('search').dispatchEvent(new Event('input'))")
        self.assertIn("11 found", self.text("block-count"))  # arch.1, arch.10 to arch.19
        before = self.browser.screenshot()
        self.evaluate("element('isolate').click()")
        self.assertIn("11 of 29 shown", self.text("block-count"))
        self.assertNotEqual(self.browser.screenshot(), before)
        self.evaluate("element('show-all').click()")
        self.evaluate("element('hide').click()")
        self.assertIn("18 of 29 shown", self.text("block-count"))

    def test_principal_stresses(self):
        self.open("arch")
        # Turned by 45 degrees about z: sigma_xx = sigma_yy = 1, sigma_xy = 2 has the principal values 3 and -1.
        self.assertEqual([round(x, 9) for x in self.evaluate("principal([1, 1, 0.5, 2, 0, 0], 0)")], [3, 0.5, -1])
        axes = self.evaluate("principalAxes([1, 1, 0.5, 2, 0, 0]).map(a => [a.value, ...a.axis.toArray()])")
        value, x, y, z = max(axes)
        self.assertAlmostEqual(value, 3)
        self.assertAlmostEqual(abs(x + y), 2 ** 0.5)
        self.assertAlmostEqual(z, 0)

    def test_a_section_is_filled(self):
        self.open("column", "#color=block&contacts=none&from=front")
        self.change("section", "-y")
        # The cut faces of both blocks together are the front of the column: as wide as it is high in metres.
        area = self.evaluate("""(() => { const p = section.caps.geometry.attributes.position; let sum = 0;
            for (let k = 0; k < p.count; k += 3) { const [a, b, c] = [0, 1, 2].map(i =>
                new THREE.Vector3().fromBufferAttribute(p, k + i));
                sum += b.sub(a).cross(c.sub(a)).length() / 2; } return sum; })()""")
        box = self.evaluate("(b => (b.max.x - b.min.x) * (b.max.z - b.min.z))(new THREE.Box3().setFromBufferAttribute("
                            "meshes.mesh.geometry.attributes.position))")
        self.assertAlmostEqual(area / box, 1, delta=0.01)

    def test_a_click_shows_the_joint(self):
        self.open("slope", "#joints=state&contacts=none")
        self.browser.click(*self.middle_of("slider", 0.97))
        self.browser.click(*self.on_screen("new THREE.Vector3().fromArray(currentFrame().joints.places)"
                                           ".lerp(new THREE.Vector3().fromArray(currentFrame().joints.places, 6), 0.5)"))
        shown = self.picked()
        self.assertEqual(set(shown["joint"].split(" on ")), {"slope", "stone"})
        self.assertEqual(shown["state"], "sliding")
        normal, shear = [float(text.split()[0]) for text in (shown["normal stress"], shown["shear stress"])]
        self.assertAlmostEqual(shear / normal, 0.36397, places=2)  # tan 20 degrees

    def test_the_chain_has_the_forces_of_the_joints(self):
        self.open("slope")
        self.browser.click(*self.middle_of("slider", 0.97))
        [link] = self.evaluate("currentFrame().links.map(link => link.force.toArray())")
        points = self.evaluate("currentFrame().contacts.map(contact => contact.force.toArray())")
        for got, parts in zip(link, zip(*points)):
            self.assertAlmostEqual(got, sum(parts), delta=2e-3 * max(map(abs, link)))

    def test_the_address_says_what_is_shown(self):
        self.open("slope")
        for control, value in (("joints", "shear"), ("scale", "2"), ("thrust", True), ("section", "x"), ("theme", "dark")):
            self.change(control, value)
        self.browser.click(*self.middle_of("slider", 0.5))
        self.browser.drag(200, 250, 260, 250)
        self.evaluate("new Promise(done => setTimeout(done, 700))")
        before, address = self.browser.screenshot(), self.evaluate("location.hash")
        for part in ("joints=shear", "scale=2", "thrust=yes", "section=x", "theme=dark", "frame=", "zoom="):
            self.assertIn(part, address)
        self.open("slope", address)
        self.assertEqual(self.evaluate("addressOf()"), address[1:])
        after = self.browser.screenshot()
        a, b = (Picture(png).pixels(0, 60, 500, 450) for png in (before, after))
        self.assertLess(sum(x != y for x, y in zip(a, b)), 0.02 * len(a))

    def test_every_mode_is_drawn_fits_and_is_legible(self):
        modes = {"usual": "", "thrust": "#thrust=yes&color=stone&contacts=none", "opening": "#joints=opening&frame=LAST",
                 "shear": "#joints=shear&frame=LAST", "state": "#joints=state&frame=LAST", "section": "#section=x,0.1",
                 "vectors": "#vectors=displacement&frame=LAST", "stress": "#color=sigma_3&crosses=yes&frame=LAST",
                 "si": "#units=si&range=percentile&frame=LAST", "dark": "#theme=dark&frame=LAST", "top": "#from=top"}
        keep = os.environ.get("ASHLAR_SCREENSHOTS")
        for width, height in ((1400, 900), (420, 800)):
            self.browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                              mobile=False)
            self.addCleanup(self.browser.call, "Emulation.setDeviceMetricsOverride", width=WIDTH, height=HEIGHT,
                            deviceScaleFactor=1, mobile=False)
            for name in ("slope", "arch", "wall"):
                self.open(name)
                last = self.evaluate("data.frames[data.frames.length - 1].index")
                for mode, wishes in modes.items():
                    with self.subTest(f"{name} {mode} {width}"):
                        self.open(name, wishes.replace("LAST", str(last)))
                        png = self.browser.screenshot()
                        if keep:
                            (pathlib.Path(keep) / f"{name}_{mode}_{width}.png").write_bytes(png)
                        middle, sides = self.evaluate(DRAWN)
                        self.assertGreater(middle, 0.01, "next to nothing is drawn")
                        self.assertEqual(sides, 0, "the scene is cut off")
                        self.assertEqual(self.evaluate(TOO_WIDE), [])
                        self.assertEqual(self.evaluate(TOO_FAINT), [])

    def picture(self, name, *options):
        path = Pages.folder / "picture.png"
        path.unlink(missing_ok=True)
        command = [Pages.program, "picture", Pages.folder / name, "-o", path, *options]
        done = subprocess.run(command, capture_output=True, text=True)
        return done, Picture(path.read_bytes()) if path.exists() else None

    def test_picture_command(self):
        done, picture = self.picture("falling", "--size", "320x200", "--frame", "0", "--color", "block", "--from=0,-1,0")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("frame 0 of 0 to 56", done.stdout)
        self.assertEqual((picture.width, picture.height), (320, 200))
        # Seen from the front the cube is a column of pixels above the beam's free end, and the beam fills the width.
        pixels = [[picture.pixel(x, y) for x in range(60, 320)] for y in range(30, 200)]
        widths = [sum(pixel != (255, 255, 255) for pixel in row) for row in pixels]
        upper, lower = widths[:60], widths[60:]
        self.assertGreater(max(upper), 10)
        self.assertGreater(max(lower), 2 * max(upper))

    def test_picture_from_nearer(self):
        view = ("falling", "--size", "320x200", "--frame", "0", "--color", "block", "--from=0,-1,0")
        drawn = []
        # All; the beam's middle; a point beside the blocks.
        for more in ((), ("--at=4,0,-0.2", "--zoom", "3"), ("--at=4,0,40", "--zoom", "3")):
            done, picture = self.picture(*view, *more)
            self.assertEqual(done.returncode, 0, done.stderr)
            drawn.append(sum(pixel != (255, 255, 255) for pixel in picture.pixels(60, 62, 230, 105)))  # without legend, axes
        self.assertGreater(drawn[1], 2 * drawn[0])
        self.assertEqual(drawn[2], 0)

    def test_picture_with_and_without_contacts(self):
        arrow = (0xc0, 0x00, 0x18)
        counts = []
        for more in ((), ("--no-arrows",), ("--contacts", "none"), ("--scale", "2")):
            done, picture = self.picture("slope", "--size", "320x200", *more)
            self.assertEqual(done.returncode, 0, done.stderr)
            pixels = picture.pixels(0, 0, 320, 200)
            counts.append((pixels.count(arrow), pixels.count((0xe8, 0x59, 0x0c))))
        self.assertGreater(min(counts[0]), 20)
        self.assertEqual(counts[1][0], 0)
        self.assertGreater(counts[1][1], 20)  # what slides
        self.assertEqual(counts[2], (0, 0))
        self.assertGreater(min(counts[3]), 20)  # contacts go with enlarged displacements

    def test_picture_of_joints_and_thrust(self):
        for more in (("--joints", "opening"), ("--thrust-line", "--color", "stone"), ("--section", "y,0"), ("--crosses",),
                     ("--dark",), ("--from", "front"), ("--range", "0,1e-4"), ("--si",), ("--vectors", "displacement")):
            done, picture = self.picture("arch", "--size", "320x200", *more)
            self.assertEqual((done.returncode, done.stderr), (0, ""), more)
            pixels = picture.pixels(0, 0, 320, 200)
            self.assertGreater(len(set(pixels)), 20, more)
            if more[0] == "--thrust-line":
                self.assertGreater(pixels.count((0xc0, 0x00, 0x18)), 100)

    def test_picture_of_a_study(self):
        out = Pages.folder / "study"
        done = subprocess.run([Pages.program, "study", "subfaces", "--out", out], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"picture: {out / 'subfaces.png'}", done.stdout)
        picture = Picture((out / "subfaces.png").read_bytes())
        self.assertEqual((picture.width, picture.height), (1000, 600))
        self.assertEqual(picture.pixel(5, 5), (255, 255, 255))
        # The curves of n = 2 and n = 3.
        for colour in ((0x00, 0x72, 0xb2), (0xd5, 0x5e, 0x00)):
            self.assertGreater(picture.pixels(90, 50, 640, 530).count(colour), 100)

    def test_picture_of_a_field_that_was_not_written(self):
        done, picture = self.picture("column", "--color", "velocity")
        self.assertEqual((done.returncode, picture), (2, None))
        self.assertIn("no velocity", done.stderr)


if __name__ == "__main__":
    chromium = find_chromium()
    if chromium is None:
        print("\n*** NOT TESTED: no chromium found, the pages of `ashlar view` were not opened in a browser ***\n",
              file=sys.stderr)
        sys.exit(77)
    program, scenes = map(pathlib.Path, (sys.argv.pop(1), sys.argv.pop(1)))
    with tempfile.TemporaryDirectory() as folder:
        Pages.write(program, scenes, pathlib.Path(folder))
        Pages.browser = Browser(chromium, WIDTH, HEIGHT)
        try:
            result = unittest.main(verbosity=2, exit=False).result
        finally:
            Pages.browser.close()
    sys.exit(0 if result.wasSuccessful() else 1)
