#!/usr/bin/env python3
"""tools/pages/joints_page.py FIGURES.json PAGE: the table of joints of docs/method/synthesis.md.

FIGURES.json is what fluidtex_joints wrote (tools/measure_joints). Both tables are written anew: what was looked at, and
how joints look, drawn in each way.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from markdown import Page, main_of_one, number

SEEN = ("frame", "points", "joints, of the triangles", "of the pixels", "vertices when cut, over the points")
WAYS = ("in joints", "gradient over that elsewhere", "steps above 0.1", "elsewhere", "deviation over that elsewhere")


def percent(share):
    return "%.1f%%" % (100 * share)


def row_of(way):
    joints, elsewhere = way["joints"], way["elsewhere"]
    return [way["way"], "%.2f" % (joints["gradient"] / elsewhere["gradient"]), percent(joints["steps"]),
            percent(elsewhere["steps"]), "%.2f" % (joints["deviation"] / elsewhere["deviation"])]


def updated_page(text, figures):
    """The page's text with the figures. Throws PageError."""
    page = Page(text)
    page.replace(SEEN, [[str(figures["frame"]), "{:,}".format(figures["points"]), percent(figures["joint_triangles"]),
                         percent(figures["joint_pixels"]), number(figures["cut_vertices"])]])
    page.replace(WAYS, [row_of(way) for way in figures["ways"]])
    return page.text()


if __name__ == "__main__":
    main_of_one(__doc__, "fluidtex_joints", updated_page)
