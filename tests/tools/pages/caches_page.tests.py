"""The page of caches: what was measured takes its place, in both tables, the rest stays."""
import json
import os
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
SCRIPT = os.path.join(ROOT, "tools", "pages", "caches_page.py")
sys.path.insert(0, os.path.dirname(SCRIPT))
from caches_page import ALL, PLACED, SOME, place_and_speed, updated_page
from markdown import Page, PageError, table_lines

PAGE = "\n".join(
    ["# Liquids", "", "## Measured", "", "Prose.", ""]
    + table_lines(ALL, [["splash", "1 of 1", "10%", "10%", "20%", "20%", "0.50", "0.50 to 0.50", "1.00"],
                        ["pour", "2 of 2", "99%", "98%", "99%", "99%", "1.00", "1.00 to 1.00", "0.01"]])
    + [""]
    + table_lines(SOME, [["splash", "1, 2", "1.00", "1.00", "10%", "0.50", "1.00"],
                         ["pour", "1, 2", "0.10", "0.30", "99%", "1.00", "0.01"]])
    + [""]
    + table_lines(PLACED, [["fall", "0.500", "0.500", "1.000", "9.810"]])
    + ["", "More prose.", ""])


def figures(count, explained=lambda n: 0.9, cache="x"):
    """Pairs 1 to `count`; the n-th is explained so far, and of the bulk half of what is missing there, with a ratio of
    1 + n / 100 and n / 10 cells left. The speed gains 1 m/s a frame. Vertices lie at 0, 0.5 cells from the level set."""
    pairs = []
    for n in range(1, count + 1):
        known = explained(n) is not None
        pairs.append({"from": n, "to": n + 1, "fastest": 2.0 + n, "speed": 1.0 + n, "area": 1.0, "explained": explained(n),
                      "bulk": 0.5 + explained(n) / 2 if known else None, "offset": 0.5, "first": [[0, 0, 0]],
                      "moved": 1.25 if known else None, "left": n / 10 if known else None,
                      "ratio": 1 + n / 100 if known else None})
    return {"cache": cache, "cell": 0.1, "frame_rate": 10, "pairs": pairs}


class CachesPage(unittest.TestCase):
    def test_rows_take_the_place_of_those_of_their_cache(self):
        text = updated_page(PAGE, {"splash": figures(9, lambda n: n / 10)})
        page = Page(text)
        self.assertEqual(page.rows(ALL, "## Measured")[0],
                         ["splash", "9 of 9", "50%", "10%", "75%", "55%", "1.05", "1.01 to 1.09", "0.50"])
        self.assertEqual([row[0] for row in page.rows(ALL, "## Measured")], ["splash", "pour"])
        some = page.rows(SOME, "## Measured")
        self.assertEqual([row[1] for row in some], ["1, 2", "3, 4", "5, 6", "7, 8", "9, 10", "1, 2"])
        self.assertEqual(some[1], ["splash", "3, 4", "5.00", "1.25", "30%", "1.03", "0.30"])
        self.assertIn("\nProse.\n", text)
        self.assertIn("\nMore prose.\n", text)

    def test_a_new_cache_comes_behind_the_others(self):
        page = Page(updated_page(PAGE, {"drop": figures(2)}))
        self.assertEqual([row[0] for row in page.rows(ALL, "## Measured")], ["splash", "pour", "drop"])
        self.assertEqual([row[0] for row in page.rows(SOME, "## Measured")], ["splash", "pour", "drop", "drop"])

    def test_frames_of_which_nothing_is_known(self):
        page = Page(updated_page(PAGE, {"pour": figures(3, lambda n: 0.8 if n == 1 else None),
                                        "rest": figures(1, lambda n: None)}))
        self.assertEqual(page.rows(ALL, "## Measured")[1],
                         ["pour", "1 of 3", "80%", "80%", "90%", "90%", "1.01", "1.01 to 1.01", "0.10"])
        self.assertEqual(page.rows(ALL, "## Measured")[2], ["rest", "0 of 1", "too little to tell"] + [""] * 6)
        self.assertEqual(page.rows(SOME, "## Measured")[2],
                         ["pour", "2, 3", "4.00", "too little to tell", "", "", ""])

    def test_place_and_speed_beside_blenders(self):
        blender = {"scene": "fall", "time_scale": 0.5, "cell": 0.2,
                   "shown": {str(n): {"first": [[0, 0.03, 0.04]]} for n in range(1, 10)}}
        measured = place_and_speed(figures(3), blender)
        self.assertAlmostEqual(measured["vertices"], 0.25)
        self.assertAlmostEqual(measured["level set"], 0.25)
        self.assertAlmostEqual(measured["gain"], 10.0)
        self.assertAlmostEqual(measured["free fall"], 9.81 / 4)
        self.assertIsNone(place_and_speed(figures(3), dict(blender, scene="dam"))["gain"])
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "blender.json"), "w") as file:
                json.dump(blender, file)
            page = Page(updated_page(PAGE, {"fall": figures(3, cache=folder)}))
            self.assertEqual(page.rows(PLACED, "## Measured"), [["fall", "0.250", "0.250", "10.000", "2.453"]])
        self.assertEqual(Page(updated_page(PAGE, {"drop": figures(3)})).rows(PLACED, "## Measured"),
                         [["fall", "0.500", "0.500", "1.000", "9.810"]])

    def test_a_page_or_figures_that_are_not_as_they_should_be(self):
        with self.assertRaises(PageError):
            updated_page("# Liquids\n", {"splash": figures(2)})
        with self.assertRaises(PageError):
            updated_page(PAGE, {"splash": {"pairs": []}})

    def test_the_command_writes_the_page_whole_or_not_at_all(self):
        with tempfile.TemporaryDirectory() as folder:
            page, good, bad = (os.path.join(folder, name) for name in ("page.md", "good.json", "bad.json"))
            for path, text in ((page, PAGE), (good, json.dumps(figures(4))), (bad, "{")):
                with open(path, "w") as file:
                    file.write(text)
            wrong = subprocess.run([SCRIPT, page, "splash=" + good, "pour=" + bad], capture_output=True, text=True)
            self.assertEqual(wrong.returncode, 1)
            self.assertIn("bad.json: not what fluidtex check --json writes", wrong.stderr)
            with open(page) as file:
                self.assertEqual(file.read(), PAGE)
            subprocess.run([SCRIPT, page, "splash=" + good], check=True)
            with open(page) as file:
                self.assertEqual(file.read(), updated_page(PAGE, {"splash": figures(4)}))


if __name__ == "__main__":
    unittest.main()
