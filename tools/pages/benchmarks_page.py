#!/usr/bin/env python3
"""tools/pages/benchmarks_page.py FIGURES.json PAGE: brings docs/results/benchmarks.md up to date.

FIGURES.json is what Google Benchmark wrote (tools/bench --json). Which figures the page shows, below which heading,
beside which peer and bars, says tools/benchmarks/bars.toml; the page is judged anew by them.

A figure that was measured takes its place on the page; the others stay. One beside a peer, or over that of another
row, counts as measured where both were, in one run. The list "What does not hold" is written anew, and so is the table
of the runs that figures are of. A row that bars.toml does not know is refused, and the page left as it is.
"""
import os
import re
import sys
import tomllib

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from markdown import FAILS, Page, PageError, main_of_one, number, state

BARS = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "benchmarks", "bars.toml")
COLUMNS = ("row", "figure", "ours", "peer", "peer / ours", "must", "goal", "", "run")
FAILURES = ("topic", "row", "figure", "ours", "peer / ours", "must")
RUNS = ("run", "processor", "cores", "load")
ROW, FIGURE, OURS, PEER, RATIO, MUST, GOAL, STATE, RUN = range(len(COLUMNS))


def figures_of(bars):
    """The figures of bars.toml, one a row: those of several rows are told apart."""
    figures = []
    for entry in bars["figure"]:
        for row in entry["rows"]:
            figure = dict(entry, row=row)
            if "peer" in entry:
                # Of several ways to the same end the peer has one.
                beside = row.replace(*entry["beside"]) if "beside" in entry else row
                figure["peer_row"] = "%s/peer:%s" % (beside, entry["peer"])
            figures.append(figure)
    return figures


def key_of(figure):
    return ("`%s`" % figure["row"], figure["is"], figure.get("peer", ""))


def key_on_page(cells):
    return (cells[ROW], cells[FIGURE], cells[PEER].split(" ")[0])


def counters_of(measured):
    """Counters by row; of repetitions the last one counts. Rows that could not run are left out."""
    counters = {}
    for run in measured["benchmarks"]:
        if run.get("run_type") == "aggregate" or run.get("error_occurred"):
            continue
        counters[re.sub(r"/(iterations:\d+|repeats:\d+|manual_time|real_time|process_time)", "", run["name"])] = run
    return counters


def refuse_unknown(counters, figures, not_shown):
    known = {name for figure in figures for name in (figure["row"], figure.get("peer_row"), figure.get("over"))}
    known.update(not_shown)
    for name in counters:
        if name not in known:
            raise PageError("%s: no figure of tools/benchmarks/bars.toml is of this row" % name)


def value_in(counters, row, figure):
    """None where the row was not measured."""
    if row not in counters:
        return None
    if figure["counter"] not in counters[row]:
        raise PageError("%s: it has no counter %s, which tools/benchmarks/bars.toml names" % (row, figure["counter"]))
    return counters[row][figure["counter"]] * figure.get("scale", 1.0)


def measured_cells(figure, counters, run):
    """The figure's row of the page; None where it was not measured. Bars and state are left empty."""
    ours = value_in(counters, figure["row"], figure)
    if ours is None:
        return None
    peer = ratio = ""
    if "over" in figure:
        base = value_in(counters, figure["over"], figure)
        if base is None:
            return None
        ours /= base
    if "peer" in figure:
        theirs = value_in(counters, figure["peer_row"], figure)
        if theirs is None:
            return None
        peer = "%s %s" % (figure["peer"], number(theirs))
        ratio = number(theirs / ours) if figure.get("ratio", True) else ""
    return list(key_of(figure)[:2]) + [number(ours), peer, ratio, "", "", "", run]


def judged(cells, figure):
    cells = list(cells)
    cells[MUST], cells[GOAL] = figure.get("must", ""), figure.get("goal", "")
    try:
        value = float(cells[RATIO] or cells[OURS])
    except ValueError:
        raise PageError("%s, %s: %s is not a number" % (cells[ROW], cells[FIGURE], cells[RATIO] or cells[OURS]))
    cells[STATE] = state(value, cells[MUST], cells[GOAL])
    return cells


def run_of(context):
    """Its row in the table of runs; named by its day."""
    load = [f"{value:.2g}" for value in context.get("load_avg") or []] or ["?"]
    return [context["date"][:10], context.get("processor", "?"), str(context["num_cpus"]), load[0]]


def anchor(topic):
    return re.sub(r"[^\w-]", "", topic.lower().replace(" ", "-"))


def updated_page(text, measured, bars):
    """The page's text with the figures of Google Benchmark's JSON; bars: what bars.toml holds. Throws PageError."""
    page, figures, failures, used = Page(text), figures_of(bars), [], set()
    counters = counters_of(measured)
    refuse_unknown(counters, figures, bars.get("not_shown", []))
    run = run_of(measured["context"]) if counters else None
    for topic in dict.fromkeys(figure["topic"] for figure in figures):
        heading = "## " + topic
        there = {key_on_page(cells): cells for cells in page.rows(COLUMNS, heading)}
        rows = []
        for figure in [figure for figure in figures if figure["topic"] == topic]:
            old = there.pop(key_of(figure), None)
            cells = measured_cells(figure, counters, run[0]) if run else None
            if cells or old:
                rows.append(judged(cells or old, figure))
        for row, what, _ in there:
            raise PageError("%s, %s: tools/benchmarks/bars.toml has no such figure" % (row, what))
        page.replace(COLUMNS, rows, heading)
        used.update(cells[RUN] for cells in rows)
        for cells in [cells for cells in rows if cells[STATE] == FAILS]:
            failures.append(["[%s](#%s)" % (topic, anchor(topic)), cells[ROW], cells[FIGURE], cells[OURS], cells[RATIO],
                             cells[MUST]])
    page.replace(FAILURES, failures, "## What does not hold")
    runs = page.rows(RUNS, "## Runs")
    if run:
        runs = [row for row in runs if row[0] != run[0]] + [run]
    page.replace(RUNS, [row for row in runs if row[0] in used], "## Runs")
    return page.text()


def known_bars():
    with open(BARS, "rb") as file:
        return tomllib.load(file)


if __name__ == "__main__":
    main_of_one(__doc__, "Google Benchmark", lambda text, figures: updated_page(text, figures, known_bars()))
