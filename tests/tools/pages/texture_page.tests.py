"""The texture's tables: a scene that was measured takes the place of what the page said of it."""
import os
import sys
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
sys.path.insert(0, os.path.join(ROOT, "tools", "pages"))
from markdown import PageError
from texture_page import FIRST_FRAME, MEANS, MISSES, SCENES, rows_of, updated_page
from markdown import Page, state

PAGE = """# Validation

| scene | measure | mean | must |  | exemplars that miss it |
|---|---|---|---|---|---|
| stretch | change | 0.011 | 0.012 | holds | ice 0.02 |
| dam_break | pop | 0.26 | 0.13 | **fails** | all |

Prose.

| scene | measure | mean | must | goal |  | of |
|---|---|---|---|---|---|---|
| stretch | change | 0.011 | 0.012 | 0.006 | holds | 16 exemplars, frame 72 |
| dam_break | pop | 0.26 | 0.13 | 0.08 | **fails** | 16 exemplars, frame 72 |
"""


class TexturePage(unittest.TestCase):
    def test_a_scene_is_updated_and_the_others_stay(self):
        measured = {"stretch": {"ice": {"change": 0.02, "likeness": 0.5}, "bark": {"change": 0.01, "likeness": 0.7}}}
        text = updated_page(PAGE, measured, {"stretch": "2 exemplars, frame 9"})
        self.assertIn("| stretch | likeness | 0.6 | 1.1 | 0.7 | goal | 2 exemplars, frame 9 |\n"
                      "| stretch | change | 0.015 | 0.012 | 0.006 | **fails** | 2 exemplars, frame 9 |\n"
                      "| dam_break | pop | 0.26 | 0.13 | 0.08 | **fails** | 16 exemplars, frame 72 |\n", text)
        self.assertIn("| stretch | change | 0.015 | 0.012 | **fails** | ice 0.02 |\n"
                      "| dam_break | pop | 0.26 | 0.13 | **fails** | all |\n\nProse.\n", text)

    def test_a_new_scene_stands_in_the_order_of_the_scenes(self):
        text = updated_page(PAGE, {"deformation": {"ice": {"pop": 0.1}}}, {"deformation": "1 exemplar"})
        self.assertLess(text.index("| stretch | change | 0.011 | 0.012 | 0.006"),
                        text.index("| deformation | pop | 0.1 | 0.13 | 0.08 | holds | 1 exemplar |"))
        self.assertLess(text.index("| deformation"), text.index("| dam_break | pop | 0.26 | 0.13 | 0.08"))

    def test_a_scene_that_holds_everywhere_is_no_longer_listed(self):
        text = updated_page(PAGE, {"dam_break": {"ice": {"pop": 0.1}}}, {"dam_break": "1 exemplar"})
        self.assertNotIn("**fails**", text)
        self.assertEqual(text.count("| dam_break"), 1)

    def test_single_exemplars_that_miss_a_bar_stand_worst_first(self):
        names = {"a": 0.95, "b": 0.7, "c": 0.6, "d": 1.0, "e": 1.1}
        _, missing = rows_of("stretch", {name: {"sharpness": value} for name, value in names.items()}, "")
        self.assertEqual(missing, [["stretch", "sharpness", "0.87", ">= 0.75", "holds", "c 0.6, b 0.7"]])

    def test_where_most_miss_it_the_others_are_named(self):
        few = {name: {"pop": value} for name, value in (("a", 0.2), ("b", 0.3), ("c", 0.1))}
        self.assertEqual(rows_of("stretch", few, "")[1][0][-1], "all but c")
        self.assertEqual(rows_of("stretch", {name: {"pop": 1.0} for name in "abc"}, "")[1][0][-1], "all")

    def test_a_mean_can_miss_its_goal_on_either_side(self):
        self.assertEqual([rows_of("ball and ring", {"a": {"sharpness": value}}, "")[0][0][5]
                          for value in (0.8, 0.95, 1.0, 1.2)], ["**fails**", "holds", "goal", "holds"])

    def test_a_measure_that_was_not_measured_stays(self):
        text = updated_page(PAGE, {"dam_break": {"ice": {"shape": 2.0, "pop": None}}}, {"dam_break": "1 exemplar"})
        self.assertIn("| dam_break | shape | 2 | 1.4 | 1.25 | **fails** | 1 exemplar |\n"
                      "| dam_break | pop | 0.26 | 0.13 | 0.08 | **fails** | 16 exemplars, frame 72 |\n", text)
        self.assertIn("| dam_break | shape | 2 | 1.4 | **fails** | ice 2 |\n| dam_break | pop | 0.26 |", text)

    def test_a_row_without_a_bar_is_refused(self):
        with self.assertRaisesRegex(PageError, "^stretch, charm: tools/pages/texture_page.py has no bar of it$"):
            updated_page(PAGE.replace("| stretch | change |", "| stretch | charm |"), {}, {})

    def test_a_page_without_the_tables_is_refused(self):
        with self.assertRaisesRegex(PageError, "^it has no table"):
            updated_page("# Validation\n", {}, {})


class TheProjectsOwn(unittest.TestCase):
    def test_its_rows_are_judged_by_the_bars_and_all_that_fail_are_listed(self):
        with open(os.path.join(ROOT, "docs", "results", "validation.md")) as file:
            page = Page(file.read())
        means, missing = page.rows(MEANS), {(row[0], row[1]): row for row in page.rows(MISSES)}
        self.assertEqual(len(means), len(FIRST_FRAME) + sum(len(SCENES[scene]) for scene in list(SCENES)[1:]))
        for scene, measure, value, must, goal, judged, _ in means:
            self.assertEqual((must, goal), SCENES[scene][measure])
            self.assertEqual(judged, state(float(value), must, goal), (scene, measure))
            if judged == "**fails**":
                self.assertEqual(missing[scene, measure][2:5], [value, must, judged])


if __name__ == "__main__":
    unittest.main()
