#!/usr/bin/env python3
"""tools/pages/caches_page.py PAGE NAME=FIGURES.json...: brings the tables of docs/reference/caches.md up to date.

FIGURES.json is what `fluidtex check CACHE --pairs 9999 --json FIGURES.json` wrote of the cache that the page calls
NAME. Its rows take the place of those of that name, or come behind the others. Of a cache that tools/blender_cache
made, with the blender.json that it left there, place and speed are compared with Blender's too.
"""
import json
import math
import os
import statistics
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from markdown import Page, PageError, bring_up_to_date

HEADING = "## Measured"
ALL = ("cache", "moves", "explained, median", "least", "away from thin parts, median", "least there",
       "displacement over velocity, median", "least to most", "left, cells, median")
SOME = ("cache", "pair", "fastest, m/s", "surface moves, cells", "explained", "displacement over velocity",
        "left, cells")
PLACED = ("cache", "vertices from Blender's, cells", "level set from the mesh, cells", "gain of speed, m/s2",
          "free fall, m/s2")
GRAVITY = 9.81  # of all that tools/blender_cache makes, m/s2
SHOWN = 5  # pairs of a cache in the second table
UNKNOWN = "too little to tell"


def figure(value):
    return "" if value is None else "%.2f" % value


def share(value):
    return "%.0f%%" % (100 * value)


def row_of_all(name, pairs):
    known = [pair for pair in pairs if pair["explained"] is not None]
    if not known:
        return [name, "0 of %d" % len(pairs), UNKNOWN] + [""] * (len(ALL) - 3)
    explained = [pair["explained"] for pair in known]
    bulk = [pair["bulk"] for pair in known if pair["bulk"] is not None]
    ratios = [pair["ratio"] for pair in known if pair["ratio"] is not None]
    spread = "%.2f to %.2f" % (min(ratios), max(ratios)) if ratios else ""
    return [name, "%d of %d" % (len(known), len(pairs)), share(statistics.median(explained)), share(min(explained)),
            share(statistics.median(bulk)) if bulk else "", share(min(bulk)) if bulk else "",
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


def place_and_speed(figures, blender):
    """Of a cache beside what Blender shows of it: how far the mesh's first vertices lie from Blender's and the level set
    from the mesh, both in Blender's cells, the mean of the frames; what the mean speed on the surface gains in a second, and should
    gain where all falls. None where a value is not known."""
    cell, pairs = blender["cell"], figures["pairs"]
    apart = [math.dist(ours, theirs) / cell
             for pair in pairs if pair["offset"] is not None
             for ours, theirs in zip(pair["first"], blender["shown"][str(pair["from"])]["first"])]
    offset = [pair["offset"] * figures["cell"] / cell for pair in pairs if pair["offset"] is not None]
    gain = free_fall = None
    if blender["scene"] == "fall" and len(pairs) > 1:
        seconds = (pairs[-1]["from"] - pairs[0]["from"]) / figures["frame_rate"]
        gain = (pairs[-1]["speed"] - pairs[0]["speed"]) / seconds
        free_fall = GRAVITY * blender["time_scale"] ** 2
    return {"vertices": statistics.mean(apart) if apart else None,
            "level set": statistics.mean(offset) if offset else None,
            "gain": gain, "free fall": free_fall}


def rows_of_place(name, figures):
    """One row, or none where Blender's side is not known, or nothing of it can be compared."""
    file = os.path.join(figures["cache"], "blender.json")
    if not os.path.exists(file):
        return []
    with open(file) as opened:
        measured = place_and_speed(figures, json.load(opened))
    values = [measured[key] for key in ("vertices", "level set", "gain", "free fall")]
    if all(value is None for value in values):
        return []
    return [[name] + ["" if value is None else "%.3f" % value for value in values]]


def replaced(rows, name, new):
    """Rows with those of this name replaced where the first of them was, or at the end."""
    at = next((n for n, row in enumerate(rows) if row[0] == name), len(rows))
    return rows[:at] + new + [row for row in rows[at:] if row[0] != name]


def updated_page(text, measured):
    """The page's text with what was measured, by the caches' names: the JSON of `fluidtex check`. Throws PageError."""
    page = Page(text)
    for columns, rows_of in ((ALL, lambda name, figures: [row_of_all(name, figures["pairs"])]),
                             (SOME, lambda name, figures: rows_of_some(name, figures["pairs"])),
                             (PLACED, rows_of_place)):
        rows = page.rows(columns, HEADING)
        for name, figures in measured.items():
            if not figures.get("pairs"):
                raise PageError("%s: no pair of its frames was compared" % name)
            rows = replaced(rows, name, rows_of(name, figures))
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
