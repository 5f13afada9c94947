"""Every mode of a page, wide and narrow: modes_test.py ASHLAR SCENES."""
import os
import pathlib

from legibility import DRAWN, TOO_FAINT, TOO_WIDE
from pages import HEIGHT, WIDTH, PageTest, main


class ModesTest(PageTest):
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


if __name__ == "__main__":
    main()
