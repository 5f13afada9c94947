"""Answers, loads, supports, bolts and water of a page: actions_test.py ASHLAR SCENES."""
from browser import Picture
from pages import PageTest, main

LOAD, HELD, ROLLER = (0x7a, 0x2f, 0xb5), (0x3d, 0x46, 0x54), (0x0b, 0x72, 0x85)


class ActionsTest(PageTest):
    def colours(self):
        picture = Picture(self.browser.screenshot())
        return picture.pixels(130, 60, int(self.evaluate("element('stage').clientWidth")) - 130, picture.height - 130)

    def test_a_load_is_an_arrow_with_its_size(self):
        self.open("acted")
        self.assertEqual(self.evaluate("currentFrame().loads.map(load => [data.blocks[load.block].name, Math.round(load.force.z)])"),
                         [["upper", -30000]])
        self.assertEqual(self.evaluate("actions.labels.map(({size}) => quantity(size, 'N'))"), ["30 kN"])
        self.assertGreater(self.colours().count(LOAD), 20)
        self.change("loads", False)
        self.assertEqual(self.colours().count(LOAD), 0)

    def test_supports_differ_by_what_they_hold(self):
        self.open("acted", "#chain=no&from=front")
        self.assertEqual(sorted(self.evaluate("currentFrame().supports.map(({held}) => held)")), [4, 4, 7, 7])
        self.assertEqual(self.evaluate("supportKinds().map(({name}) => name)"), ["supports", "supports held in z"])
        drawn = self.colours()
        self.assertGreater(min(drawn.count(HELD), drawn.count(ROLLER)), 5)
        self.change("supports", False)
        self.assertEqual((self.colours().count(HELD), self.colours().count(ROLLER)), (0, 0))

    def test_bolts_have_the_colour_of_their_force(self):
        self.open("acted")
        [force] = set(self.evaluate("currentFrame().bolts.map(({axial}) => Math.round(axial / 100))"))
        # The load presses the blocks by micrometres: the tie keeps its pretension but for a part.
        self.assertTrue(150 < force <= 200, force)
        self.assertEqual(self.evaluate("boltRange()[0]"), 0)
        with_bolts = self.browser.screenshot()
        self.change("bolts", False)
        self.assertNotEqual(self.browser.screenshot(), with_bolts)

    def test_water_is_a_plane_and_a_pressure_in_joints(self):
        self.open("acted", "#joints=water")
        self.assertEqual(self.evaluate("waterLevels(currentFrame()).map(({point}) => point[2])"), [1.5])
        # 1.5 m below the level, and 0.5 m below it.
        pressures = sorted(set(self.evaluate("Array.from(currentFrame().joints.water, p => Math.round(p / 10) * 10)")))
        self.assertEqual(pressures, [4900, 14720] if 14720 in pressures else [4900, 14710])
        shown = self.browser.screenshot()
        self.change("water", False)
        self.assertNotEqual(self.browser.screenshot(), shown)

    def test_axes_and_scale_bar_are_beside_the_model(self):
        size = lambda width, height=800: self.browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                                                           deviceScaleFactor=1, mobile=False)
        self.addCleanup(size, *self.evaluate("[innerWidth, innerHeight]"))
        for name, width in (("acted", 1400), ("arch", 1400), ("wall", 1200), ("rigid", 420), ("acted", 900)):
            with self.subTest(name, width=width):
                size(width)
                self.open(name, "#contacts=none&chain=no&loads=no&supports=no&bolts=no&water=no")
                # The model itself, without legend and marks, which are on another canvas.
                self.assertEqual(self.evaluate("""(() => { const copy = document.createElement("canvas"), from = element("canvas");
                    Object.assign(copy, {width: from.width, height: from.height}); const context = copy.getContext("2d");
                    context.drawImage(from, 0, 0); const {x, y, width, height} = frameSize.marks;
                    return new Set(context.getImageData(x, y, width - 8, height).data).size; })()"""), 1)

    def test_bars_stay_within_their_blocks(self):
        self.open("arch", "#chain=yes")
        shares = self.evaluate("""currentFrame().links.map(({a, b, force, place}) => {
            const half = 0.5 * forceLength(force, usualForce("links") / chainFactor()), along = force.clone().normalize();
            const reach = (d) => Math.max(reachOf(a, currentFrame(), place, d), reachOf(b, currentFrame(), place, d));
            return half / Math.min(reach(along), reach(along.clone().negate())); }).sort((x, y) => x - y)""")
        self.assertLessEqual(shares[int(0.85 * len(shares))], 1.001)

    def test_the_answer_comes_first(self):
        self.open("arch")
        self.assertEqual(self.evaluate("document.querySelector('aside fieldset').innerText.split('\\n').slice(0, 2)")[-1].strip() or
                         self.text("answer"), "stands: static equilibrium")
        answers = [
            ("{status: 'completed', load_factor: {lower: 1.9151, upper: 2, mode: 'topples', moving: ['wall.1']}}",
             "load factor between 1.915 and 2: block wall.1 topples"),
            ("{status: 'completed', factor_of_safety: {lower: null, upper: 0.5, moving: []}}",
             "factor of safety below 0.5, where blocks move"),
            ("{status: 'completed', factor_of_safety: {lower: 1.4065, upper: 1.4178, proven: false, released: 0.569, "
             "associated: 4.159, mode: 'slides', moving: ['rock.1']}}",
             "factor of safety at least 1.407 (at 1.418 neither rest nor motion was found): block rock.1 slides; 0.569 if joints "
             "do not wedge; 4.159 if joints dilate"),
            ("{status: 'moving', moving: [{block: 'arch.1'}, {block: 'arch.2'}]}",
             "does not stand: 2 of 27 blocks move: arch.1, arch.2"),
        ]
        count = self.evaluate("data.blocks.filter(({fixed}) => !fixed).length")
        for summary, words in answers:
            self.assertEqual(self.evaluate(f"answerText({summary})"), words.replace("of 27", f"of {count}"))


if __name__ == "__main__":
    main()
