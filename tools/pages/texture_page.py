"""The texture's tables of docs/results/validation.md: means over the exemplars, and what misses its bar.

Used by tools/measure_synthesis. What was measured of a scene takes the place of what the page says of it; the rest
stays.
"""
from markdown import FAILS, GOAL, HOLDS, Page, PageError, clears, number, state

MEANS = ("scene", "measure", "mean", "must", "goal", "", "of")
MISSES = ("scene", "measure", "mean", "must", "", "exemplars that miss it")

# Must and goal by measure; written as in the page.
FIRST_FRAME = {"likeness": ("0.8", "0.55"), "sharpness": (">= 0.9", "0.97 to 1.03")}
LAST_FRAME = {
    "likeness": ("1.1", "0.7"), "sharpness": (">= 0.75", ">= 0.95"), "coverage": (">= 0.85", ">= 0.95"),
    "shape": ("1.4", "1.25"), "chips": ("0.05", "0.01"), "pop": ("0.13", "0.08"), "change": ("0.012", "0.006")}
# In the page's order. Of scenes at rest the first frame counts.
SCENES = {"ball and ring": FIRST_FRAME, "stretch": LAST_FRAME, "deformation": LAST_FRAME, "source_sink": LAST_FRAME,
          "dam_break": LAST_FRAME}


def mean(values):
    return sum(values) / len(values)


def named(misses, exemplars):
    """The exemplars of misses (values by name), worst first as they come; short where they are most of all."""
    if len(misses) == len(exemplars) > 1:
        return "all"
    if 2 * len(misses) > len(exemplars) > 1:
        return "all but " + ", ".join(name for name in exemplars if name not in misses)
    return ", ".join("%s %s" % (name, number(value)) for name, value in misses.items())


def rows_of(scene, exemplars, of):
    """Rows of both tables; exemplars: by name, the value of each measure."""
    means, missing = [], []
    for measure, (must, goal) in SCENES[scene].items():
        values = {name: figures[measure] for name, figures in exemplars.items() if figures.get(measure) is not None}
        if not values:
            continue
        average = mean(list(values.values()))
        # By what is printed, so that the page agrees with itself.
        judged = state(float(number(average)), must, goal)
        means.append([scene, measure, number(average), must, goal, judged, of])
        worst_first = sorted(values.items(), key=lambda item: item[1], reverse=not must.startswith(">="))
        misses = {name: value for name, value in worst_first if not clears(value, must)}
        if misses or judged == FAILS:
            shown = HOLDS if judged == GOAL else judged
            missing.append([scene, measure, number(average), must, shown, named(misses, list(values))])
    return means, missing


def updated_page(text, measured, of):
    """The page's text with the figures of a run: measured[scene][exemplar][measure]; `of` says what run it was."""
    page = Page(text)
    means, missing = ({(row[0], row[1]): row for row in page.rows(columns)} for columns in (MEANS, MISSES))
    for scene, exemplars in measured.items():
        new_means, new_missing = rows_of(scene, exemplars, of[scene])
        for row in new_means:
            means[row[0], row[1]] = row
            missing.pop((row[0], row[1]), None)
        missing.update({(row[0], row[1]): row for row in new_missing})
    order = [(scene, measure) for scene, measures in SCENES.items() for measure in measures]
    for rows, columns in ((means, MEANS), (missing, MISSES)):
        for scene, measure in rows:
            if (scene, measure) not in order:
                raise PageError("%s, %s: tools/pages/texture_page.py has no bar of it" % (scene, measure))
        page.replace(columns, [rows[key] for key in order if key in rows])
    return page.text()
