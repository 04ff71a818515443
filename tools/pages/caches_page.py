#!/usr/bin/env python3
"""tools/pages/caches_page.py PAGE NAME=FIGURES.json...: brings the tables of docs/reference/caches.md up to date.

FIGURES.json is what `fluidtex check CACHE --pairs 9999 --json FIGURES.json` wrote of the cache that the page calls
NAME. Its rows take the place of those of that name, or come behind the others.
"""
import os
import statistics
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from markdown import Page, PageError, bring_up_to_date

HEADING = "## Measured"
ALL = ("cache", "moves", "explained, median", "least", "displacement over velocity, median", "least to most",
       "left, cells, median")
SOME = ("cache", "pair", "fastest, m/s", "surface moves, cells", "explained", "displacement over velocity",
        "left, cells")
SHOWN = 5  # pairs of a cache in the second table
UNKNOWN = "too little to tell"


def figure(value):
    return "" if value is None else "%.2f" % value


def share(value):
    return "%.0f%%" % (100 * value)


def row_of_all(name, pairs):
    known = [pair for pair in pairs if pair["explained"] is not None]
    if not known:
        return [name, "0 of %d" % len(pairs), UNKNOWN, "", "", "", ""]
    explained = [pair["explained"] for pair in known]
    ratios = [pair["ratio"] for pair in known if pair["ratio"] is not None]
    spread = "%.2f to %.2f" % (min(ratios), max(ratios)) if ratios else ""
    return [name, "%d of %d" % (len(known), len(pairs)), share(statistics.median(explained)), share(min(explained)),
            figure(statistics.median(ratios)) if ratios else "", spread,
            figure(statistics.median(pair["left"] for pair in known))]


def rows_of_some(name, pairs):
    """Evenly taken, as the program does where fewer pairs are asked for."""
    count = min(SHOWN, len(pairs))
    places = [0] if count == 1 else [(len(pairs) - 1) * n // (count - 1) for n in range(count)]
    rows = []
    for pair in (pairs[place] for place in places):
        row = [name, "%d, %d" % (pair["from"], pair["to"]), figure(pair["fastest"])]
        if pair["explained"] is None:
            rows.append(row + [UNKNOWN, "", "", ""])
        else:
            rows.append(row + [figure(pair["moved"]), share(pair["explained"]), figure(pair["ratio"]),
                               figure(pair["left"])])
    return rows


def replaced(rows, name, new):
    """Rows with those of this name replaced where the first of them was, or at the end."""
    at = next((n for n, row in enumerate(rows) if row[0] == name), len(rows))
    return rows[:at] + new + [row for row in rows[at:] if row[0] != name]


def updated_page(text, measured):
    """The page's text with what was measured, by the caches' names: the JSON of `fluidtex check`. Throws PageError."""
    page = Page(text)
    for columns, rows_of in ((ALL, lambda name, pairs: [row_of_all(name, pairs)]), (SOME, rows_of_some)):
        rows = page.rows(columns, HEADING)
        for name, figures in measured.items():
            if not figures.get("pairs"):
                raise PageError("%s: no pair of its frames was compared" % name)
            rows = replaced(rows, name, rows_of(name, figures["pairs"]))
        page.replace(columns, rows, HEADING)
    return page.text()


def main():
    if len(sys.argv) < 3 or not all("=" in argument for argument in sys.argv[2:]):
        sys.exit(__doc__)
    names, files = zip(*(argument.split("=", 1) for argument in sys.argv[2:]))
    bring_up_to_date(sys.argv[1], files, "fluidtex check --json",
                     lambda text, found: updated_page(text, dict(zip(names, found))))


if __name__ == "__main__":
    main()
