# Tests of what times Blender (tools/blender/time_frames.py), and of the page's table, run by Blender.
import json
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..", "..")
sys.path[:0] = [HERE, os.path.join(ROOT, "tools", "blender"), os.path.join(ROOT, "tools", "pages")]
import blender_page
import fluidtex
import markdown
import small_run
import time_frames
from addon_tests import InBlender, run_tests

FIGURES = {
    "machine": "one, 2 cores",
    "blender": "3.4.1",
    "runs": [{"vertices": 7, "wall": 1, "processor": 1}],
}


class TimeFrames(InBlender):
    def test_the_points_and_times_of_the_last_frame(self):
        run, file = os.path.join(self.folder, "run"), os.path.join(self.folder, "figures.json")
        small_run.write_run(run, sides=(12, 16, 9))
        time_frames.main([run, "--goes", "3", "--json", file])
        with open(file) as opened:
            figures = json.load(opened)
        self.assertEqual([found["vertices"] for found in figures["runs"]], [81])
        self.assertGreater(figures["runs"][0]["wall"], 0)
        self.assertGreater(figures["runs"][0]["processor"], 0)

    def test_more_points_take_longer(self):
        small, large = os.path.join(self.folder, "small"), os.path.join(self.folder, "large")
        small_run.write_run(small, sides=(5, 5))
        small_run.write_run(large, sides=(5, 300))
        self.assertGreater(time_frames.timed(large, 3)["processor"], time_frames.timed(small, 3)["processor"])

    def test_a_run_of_one_frame_is_refused(self):
        run = os.path.join(self.folder, "run")
        small_run.write_run(run, sides=(12,))
        with self.assertRaisesRegex(fluidtex.Problem, "give a run of two"):
            time_frames.main([run])

    def test_the_table_is_written_anew(self):
        page = "\n".join(["Prose.", ""] + markdown.table_lines(blender_page.COLUMNS, [["1", "2", "3", "x"]]) + ["", "More."])
        runs = [{"vertices": 501264, "wall": 1.3, "processor": 1.25}, {"vertices": 7987, "wall": 0.02, "processor": 0.018}]
        of = "| one, 2 cores, Blender 3.4.1 |\n"
        text = blender_page.updated_page(page, {**FIGURES, "runs": runs})
        self.assertTrue(text.endswith(of.join(["|---|---|---|---|\n| 7,987 | 0.02 | 0.018 ", "| 501,264 | 1.3 | 1.25 ", "\nMore."])), text)

    def test_the_page_of_the_project_has_it(self):
        with open(os.path.join(ROOT, "docs", "tutorial-blender.md")) as file:
            text = blender_page.updated_page(file.read(), FIGURES)
        self.assertIn("| 7 | 1 | 1 | one, 2 cores, Blender 3.4.1 |", text)


if __name__ == "__main__":
    run_tests(sys.modules["__main__"])
