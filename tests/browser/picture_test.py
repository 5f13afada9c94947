"""Contents of `ashlar picture` and of the picture of a study: picture_test.py ASHLAR SCENES."""
import subprocess
import unittest

from browser import Picture
from pages import Pages, main


class PictureTest(unittest.TestCase):
    def picture(self, name, *options):
        path = Pages.folder / "picture.png"
        path.unlink(missing_ok=True)
        command = [Pages.program, "picture", Pages.folder_of(name), "-o", path, *options]
        done = subprocess.run(command, capture_output=True, text=True)
        return done, Picture(path.read_bytes()) if path.exists() else None

    def test_picture_command(self):
        done, picture = self.picture("falling", "--size", "320x200", "--frame", "0", "--color", "block", "--from=0,-1,0",
                                     "--without", "supports,marks")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("frame 0 of 0 to 56", done.stdout)
        self.assertEqual((picture.width, picture.height), (320, 200))
        # Seen from the front the cube is a column of pixels above the beam's free end, and the beam fills the width.
        pixels = [[picture.pixel(x, y) for x in range(60, 320)] for y in range(30, 200)]
        widths = [sum(pixel != (255, 255, 255) for pixel in row) for row in pixels]
        upper, lower = widths[:60], widths[60:]
        self.assertGreater(max(upper), 10)
        self.assertGreater(max(lower), 2 * max(upper))

    def test_a_sharp_picture_has_more_pixels(self):
        done, picture = self.picture("slope", "--size", "320x200", "--sharpness", "2")
        self.assertEqual((done.returncode, picture.width, picture.height), (0, 640, 400), done.stderr)

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
        done = subprocess.run([Pages.program, "study", "orders", "--out", out], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"picture: {out / 'orders.png'}", done.stdout)
        picture = Picture((out / "orders.png").read_bytes())
        self.assertEqual((picture.width, picture.height), (1000, 600))
        self.assertEqual(picture.pixel(5, 5), (255, 255, 255))
        # The curves of the first two series.
        for colour in ((0x00, 0x72, 0xb2), (0xd5, 0x5e, 0x00)):
            self.assertGreater(picture.pixels(90, 50, 640, 530).count(colour), 100)

    def test_picture_of_a_field_that_was_not_written(self):
        done, picture = self.picture("column", "--color", "velocity")
        self.assertEqual((done.returncode, picture), (2, None))
        self.assertIn("no velocity", done.stderr)


if __name__ == "__main__":
    main()
