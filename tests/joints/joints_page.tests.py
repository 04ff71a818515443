"""The page's tables of joints: written anew from figures, the rest stays."""
import json
import os
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCRIPT = os.path.join(ROOT, "tools", "pages", "joints_page.py")
sys.path.insert(0, os.path.dirname(SCRIPT))
from joints_page import SEEN, WAYS, updated_page
from markdown import PageError, table_lines

PAGE = "\n".join(["# Synthesis", ""] + table_lines(SEEN, [["1", "2", "3%", "4%", "5"]]) + ["", "Prose.", ""] +
                 table_lines(WAYS, [["an older way", "1", "1%", "1%", "1"]]) + ["", "More prose.", ""])
FIGURES = {
    "frame": 36, "points": 74321, "joint_triangles": 0.231, "joint_pixels": 0.29, "cut_vertices": 2.58,
    "ways": [{"way": "points", "joints": {"gradient": 0.03, "steps": 0.0125, "deviation": 0.08},
              "elsewhere": {"gradient": 0.025, "steps": 0.006, "deviation": 0.1}},
             {"way": "cut", "joints": {"gradient": 0.05, "steps": 0.03, "deviation": 0.1},
              "elsewhere": {"gradient": 0.025, "steps": 0.006, "deviation": 0.1}}]}


class JointsPage(unittest.TestCase):
    def test_both_tables_are_written_anew(self):
        text = updated_page(PAGE, FIGURES)
        self.assertIn("| 36 | 74,321 | 23.1% | 29.0% | 2.58 |\n\nProse.\n", text)
        self.assertIn("| points | 1.20 | 1.2% | 0.6% | 0.80 |\n| cut | 2.00 | 3.0% | 0.6% | 1.00 |\n\nMore prose.", text)
        self.assertNotIn("older", text)

    def test_a_page_without_the_tables_is_refused_and_stays(self):
        with self.assertRaises(PageError):
            updated_page("# Synthesis\n", FIGURES)
        with tempfile.TemporaryDirectory() as folder:
            page, figures = os.path.join(folder, "page.md"), os.path.join(folder, "figures.json")
            with open(page, "w") as file:
                file.write("# Synthesis\n")
            with open(figures, "w") as file:
                json.dump(FIGURES, file)
            done = subprocess.run([sys.executable, SCRIPT, figures, page], stderr=subprocess.PIPE, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertIn(page + ": it has no table", done.stderr)
            with open(page) as file:
                self.assertEqual(file.read(), "# Synthesis\n")

    def test_the_page_of_the_project_has_them(self):
        with open(os.path.join(ROOT, "docs", "method", "synthesis.md")) as file:
            self.assertIn("| 36 | 74,321 |", updated_page(file.read(), FIGURES))


if __name__ == "__main__":
    unittest.main()
