#!/usr/bin/env python3
"""tools/pages/blender_page.py FIGURES.json PAGE: the times of docs/tutorial-blender.md.

FIGURES.json is what tools/blender/time_frames.py wrote (tools/measure_blender). The table is written anew, fewest points
first.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from markdown import Page, main_of_one, number

COLUMNS = ("points", "wall s a frame", "CPU s", "on")


def updated_page(text, figures):
    """The page's text with the figures. Throws PageError."""
    page = Page(text)
    runs = sorted(figures["runs"], key=lambda run: run["vertices"])
    of = "%s, Blender %s" % (figures["machine"], figures["blender"])
    page.replace(COLUMNS, [["{:,}".format(run["vertices"]), number(run["wall"]), number(run["processor"]), of]
                           for run in runs])
    return page.text()


if __name__ == "__main__":
    main_of_one(__doc__, "tools/blender/time_frames.py", updated_page)
