"""Opens the pages of `ashlar view` in Chromium and acts like a user: view_test.py ASHLAR SCENES."""
from browser import Picture
from pages import HEIGHT, PageTest, main


class ViewTest(PageTest):
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

    def test_axis_has_times_where_the_slider_has_them(self):
        self.open("falling")
        ticks = self.evaluate("""[...document.querySelectorAll('#time-axis span')].map(
            tick => [parseFloat(tick.textContent), parseFloat(tick.style.left)])""")
        self.assertGreaterEqual(len(ticks), 4)
        for time, place in ticks:
            self.evaluate(f"showFrame(Math.round({place} / 100 * (data.frames.length - 1)))")
            # A frame is 0.01 s.
            self.assertAlmostEqual(float(self.text("clock").split()[2]), time, delta=0.0051)
        self.evaluate("document.querySelector('#time-axis .event').click()")
        self.assertIn(self.text("clock").split(" s")[0],
                      self.evaluate("document.querySelector('#time-axis .event').title"))

    def test_slider_moves_picture_clock_and_cursor(self):
        self.open("falling", "#frame=0")
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
        self.open("falling", "#frame=0")
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
        self.open("falling", "#frame=0")
        self.change("field", "displacement")
        # At the start block A has not moved and is pale green, #bfe6a8 in its shade: neither unlit stone nor a support.
        red, green, blue = self.colours_of_blocks()[0]
        self.assertTrue(green > 1.1 * red and green > 1.2 * blue, (red, green, blue))

    def test_switches_change_the_picture(self):
        self.open("falling", "#frame=55")
        for control, value in (("edges", False), ("sub-faces", True), ("see-through", True), ("scale", "1.5"), ("scale", "1"),
                               ("contact-colour", "state"), ("open-contacts", True), ("contact-colour", "type"), ("arrows", True), ("chain", False),
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
        self.open("falling", "#frame=0")
        self.browser.click(*self.on_screen("centreOf(0)"))
        self.assertEqual([float(x) for x in self.picked()["centre (m)"].split(", ")], [7.25, 0, 2.25])

    def test_curved_frames_look_like_divided_ones(self):
        pixels = []
        for name in ("falling", "curved"):
            self.open(name, "#color=order&frame=0")
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
        self.assertIn("completed", self.text("answer"))
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
        self.assertEqual(self.text("clock"), "static equilibrium")
        self.assertEqual(self.evaluate("plots[0].options.scales.x.title.text"), "iteration")
        self.assertEqual(self.text("answer"), "stands: static equilibrium")
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


if __name__ == "__main__":
    main()
