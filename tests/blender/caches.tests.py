"""Caches that Blender makes on the spot, read by `fluidtex check`: place, speed and motion beside what Blender shows.

    caches.tests.py FLUIDTEX      exits with 77 where Blender is not installed
"""
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "tools", "pages"))
from caches_page import place_and_speed

PROGRAM = None


class Caches(unittest.TestCase):
    def checked(self, *wishes, settings=()):
        """What `check` says of a cache made to these wishes, and what Blender shows of it."""
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        cache, figures = os.path.join(folder, "cache"), os.path.join(folder, "figures.json")
        subprocess.run([os.path.join(ROOT, "tools", "blender_cache"), cache, *wishes], check=True, capture_output=True)
        command = [PROGRAM, "check", cache, "--pairs", "9999", "--json", figures]
        for setting in settings:
            command += ["--set", setting]
        subprocess.run(command, check=True, capture_output=True)
        with open(figures) as file, open(os.path.join(cache, "blender.json")) as shown:
            return json.load(file), json.load(shown)

    def test_free_fall(self):
        for rate, scale in ((24, 1.0), (30, 0.5)):
            with self.subTest(rate=rate):
                figures, blender = self.checked("--scene", "fall", "--cells", "64", "--frames", "10", "--rate",
                                                str(rate), "--time-scale", str(scale),
                                                settings=["frame_rate=%d" % rate])
                measured = place_and_speed(figures, blender)
                self.assertAlmostEqual(measured["gain"] / measured["free fall"], 1.0, delta=0.01)
                # In the first frame the liquid appears. In a single one the ratio tells how the particles shape
                # the mesh, too: by a tenth of a cell.
                ratios = [pair["ratio"] for pair in figures["pairs"][1:] if pair["ratio"] is not None]
                self.assertGreaterEqual(len(ratios), 7)
                self.assertAlmostEqual(statistics.median(ratios), 1.0, delta=0.05)

    def test_place_in_a_domain_as_it_is_and_moved_turned_and_scaled(self):
        for wishes in ([], ["--placed"]):
            with self.subTest(wishes):
                figures, blender = self.checked("--scene", "dam", "--cells", "16", "--frames", "8", *wishes)
                measured = place_and_speed(figures, blender)
                self.assertLess(measured["vertices"], 0.001)
                self.assertLess(measured["level set"], 0.1)
                for pair in figures["pairs"]:
                    shown = blender["shown"][str(pair["from"])]
                    for ours, theirs in zip(pair["low"] + pair["high"], shown["low"] + shown["high"]):
                        self.assertAlmostEqual(ours, theirs, delta=0.001 * blender["cell"])

    def test_a_dam_breaks_as_its_velocities_say(self):
        for settings in ([], ["files.surface_name=phi"]):
            with self.subTest(settings):
                figures, _ = self.checked("--scene", "dam", "--cells", "32", "--frames", "12", "--resumable",
                                          settings=settings)
                explained = [pair["explained"] for pair in figures["pairs"]]
                ratios = [pair["ratio"] for pair in figures["pairs"]]
                self.assertGreater(statistics.median(explained), 0.9)
                self.assertTrue(0.95 < statistics.median(ratios) < 1.05, ratios)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    if not shutil.which("blender"):
        print("blender is not installed: apt-get install --no-install-recommends blender")
        sys.exit(77)
    PROGRAM = os.path.abspath(sys.argv.pop())
    unittest.main()
