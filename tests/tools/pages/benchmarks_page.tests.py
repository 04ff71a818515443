"""The benchmarks' page: what was measured takes its place, what fails is listed, the rest stays."""
import json
import os
import subprocess
import sys
import tempfile
import tomllib
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
sys.path.insert(0, os.path.join(ROOT, "tools", "pages"))
from benchmarks_page import updated_page
from markdown import PageError

BARS = {"not_shown": ["pour/9"], "figure": [
    {"topic": "Wave tank", "rows": ["wave/8", "wave/16"], "counter": "ns", "scale": 1e-3, "is": "us", "peer": "rival",
     "must": ">= 4", "goal": ">= 10"},
    {"topic": "Wave tank", "rows": ["wave/16"], "counter": "volume", "is": "volume", "peer": "rival", "ratio": False,
     "must": "0.98 to 1.02"},
    {"topic": "Wave tank", "rows": ["wave/16"], "counter": "ns", "is": "over that of 8 cells", "over": "wave/8",
     "must": "2.5"},
    {"topic": "Memory", "rows": ["bytes/8", "bytes/16"], "counter": "bytes", "is": "bytes", "must": "400",
     "goal": "250"}]}

PAGE = """# Benchmarks

## What does not hold

| topic | row | figure | ours | peer / ours | must |
|---|---|---|---|---|---|
| [Gone](#gone) | `gone` | s | 1 |  | 0.5 |

## Wave tank

Prose.

| row | figure | ours | peer | peer / ours | must | goal |  | run |
|---|---|---|---|---|---|---|---|---|
| `wave/8` | us | 2 | rival 10 | 5 | >= 4 | >= 10 | holds | 2026-01-01 |

## Memory

| row | figure | ours | peer | peer / ours | must | goal |  | run |
|---|---|---|---|---|---|---|---|---|
| `bytes/8` | bytes | 300 |  |  | 400 | 250 | holds | 2026-01-01 |
| `bytes/16` | bytes | 410 |  |  | 400 | 250 | **fails** | 2025-12-31 |

## Runs

| run | processor | cores | load |
|---|---|---|---|
| 2025-12-31 | Old | 1 | 0 |
| 2026-01-01 | Older | 2 | 1 |
"""


def measured(rows):
    """Google Benchmark's JSON of rows by name."""
    context = {"date": "2026-02-03T04:05:06+00:00", "num_cpus": 2, "load_avg": [1.5, 1, 1], "processor": "New"}
    return {"context": context, "benchmarks": [dict(counters, name=name + "/iterations:1/manual_time")
                                               for name, counters in rows.items()]}


class BenchmarksPage(unittest.TestCase):
    def test_a_row_is_updated_and_the_others_stay(self):
        text = updated_page(PAGE, measured({"bytes/16": {"bytes": 200.04}}), BARS)
        self.assertIn("| `bytes/16` | bytes | 200 |  |  | 400 | 250 | goal | 2026-02-03 |\n", text)
        self.assertIn("| `bytes/8` | bytes | 300 |  |  | 400 | 250 | holds | 2026-01-01 |\n", text)
        self.assertIn("| `wave/8` | us | 2 | rival 10 | 5 | >= 4 | >= 10 | holds | 2026-01-01 |\n", text)
        self.assertIn("\nProse.\n", text)

    def test_a_run_is_listed_while_a_figure_is_of_it(self):
        text = updated_page(PAGE, measured({"bytes/16": {"bytes": 200.0}}), BARS)
        self.assertTrue(text.endswith("|---|---|---|---|\n| 2026-01-01 | Older | 2 | 1 |\n"
                                      "| 2026-02-03 | New | 2 | 1.5 |\n"))

    def test_rows_beside_a_peer_give_a_ratio_and_new_rows_stand_in_the_order_of_the_bars(self):
        text = updated_page(PAGE, measured({
            "wave/8": {"ns": 1000.0}, "wave/8/peer:rival": {"ns": 12000.0},
            "wave/16": {"ns": 3000.0, "volume": 1.01}, "wave/16/peer:rival": {"ns": 6000.0, "volume": 1.5}}), BARS)
        self.assertIn("| `wave/8` | us | 1 | rival 12 | 12 | >= 4 | >= 10 | goal | 2026-02-03 |\n"
                      "| `wave/16` | us | 3 | rival 6 | 2 | >= 4 | >= 10 | **fails** | 2026-02-03 |\n"
                      "| `wave/16` | volume | 1.01 | rival 1.5 |  | 0.98 to 1.02 |  | holds | 2026-02-03 |\n"
                      "| `wave/16` | over that of 8 cells | 3 |  |  | 2.5 |  | **fails** | 2026-02-03 |\n\n", text)

    def test_what_fails_is_listed_and_nothing_else(self):
        text = updated_page(PAGE, measured({"bytes/8": {"bytes": 500.0}}), BARS)
        self.assertIn("|---|---|---|---|---|---|\n| [Memory](#memory) | `bytes/8` | bytes | 500 |  | 400 |\n"
                      "| [Memory](#memory) | `bytes/16` | bytes | 410 |  | 400 |\n\n## Wave tank\n", text)

    def test_a_row_whose_peer_did_not_run_stays(self):
        rows = {"wave/8": {"ns": 1000.0}, "wave/8/peer:rival": {"error_occurred": True, "error_message": "missing"}}
        text = updated_page(PAGE, measured(rows), BARS)
        self.assertIn("| `wave/8` | us | 2 | rival 10 | 5 |", text)

    def test_bars_that_have_changed_judge_figures_anew(self):
        bars = {"figure": [dict(entry, must="450") if entry["topic"] == "Memory" else entry
                           for entry in BARS["figure"]]}
        text = updated_page(PAGE, {"context": {}, "benchmarks": []}, bars)
        self.assertIn("| `bytes/16` | bytes | 410 |  |  | 450 | 250 | holds | 2025-12-31 |\n", text)
        self.assertNotIn("fails", text)

    def test_the_same_figures_leave_it_as_it_was(self):
        text = updated_page(PAGE, measured({"bytes/16": {"bytes": 410.0}}), BARS)
        self.assertEqual(updated_page(text, measured({"bytes/16": {"bytes": 410.0}}), BARS), text)

    def test_an_unknown_row_is_refused(self):
        with self.assertRaisesRegex(PageError, "^tide/8: no figure of tools/benchmarks/bars.toml is of this row$"):
            updated_page(PAGE, measured({"tide/8": {"ns": 1.0}}), BARS)
        with self.assertRaisesRegex(PageError, "^wave/8/peer:other: "):
            updated_page(PAGE, measured({"wave/8/peer:other": {"ns": 1.0}}), BARS)

    def test_a_row_that_is_not_shown_is_not_refused(self):
        self.assertNotIn("pour", updated_page(PAGE, measured({"pour/9": {"ns": 1.0}}), BARS))

    def test_a_figure_of_the_page_without_bars_is_refused(self):
        page = PAGE.replace("`bytes/8` | bytes", "`bytes/8` | bits")
        with self.assertRaisesRegex(PageError, "^`bytes/8`, bits: "):
            updated_page(page, measured({}), BARS)

    def test_a_page_without_the_topic_is_refused(self):
        with self.assertRaisesRegex(PageError, "no line \"## Memory\""):
            updated_page(PAGE.replace("## Memory", "## Bytes"), measured({}), BARS)


class TheProgram(unittest.TestCase):
    def test_what_is_refused_leaves_the_page_as_it_was(self):
        with open(os.path.join(ROOT, "docs", "results", "benchmarks.md")) as file:
            before = file.read()
        with tempfile.TemporaryDirectory() as folder:
            figures, page = os.path.join(folder, "figures.json"), os.path.join(folder, "page.md")
            with open(figures, "w") as file:
                json.dump(measured({"tide/8": {"ns": 1.0}}), file)
            with open(page, "w") as file:
                file.write(before)
            done = subprocess.run([sys.executable, os.path.join(ROOT, "tools", "pages", "benchmarks_page.py"), figures,
                                   page], stderr=subprocess.PIPE, text=True)
            with open(page) as file:
                self.assertEqual(file.read(), before)
            self.assertEqual(sorted(os.listdir(folder)), ["figures.json", "page.md"])
        self.assertEqual(done.returncode, 1)
        refusal = "tide/8: no figure of tools/benchmarks/bars.toml is of this row"
        self.assertEqual(done.stderr, "error: %s: %s\n" % (page, refusal))


class TheProjectsOwn(unittest.TestCase):
    def test_it_is_as_its_bars_say(self):
        with open(os.path.join(ROOT, "docs", "results", "benchmarks.md")) as file:
            page = file.read()
        with open(os.path.join(ROOT, "tools", "benchmarks", "bars.toml"), "rb") as file:
            bars = tomllib.load(file)
        self.assertEqual(updated_page(page, {"context": {}, "benchmarks": []}, bars), page)


if __name__ == "__main__":
    unittest.main()
