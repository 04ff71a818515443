"""Tables of pages, and figures judged by their bars: what the pages of docs/results/ have in common.

A bar is text as it stands in the columns must and goal: `400` (at most so much), `>= 4` (at least), `0.98 to 1.02`
(within), or nothing.
"""
import json
import os
import sys
import tempfile

GOAL, HOLDS, FAILS = "goal", "holds", "**fails**"


class PageError(Exception):
    """A page, or what is to be written into it, is not as it should be; one sentence."""


def number(value):
    """Three digits, and no fewer than the integer has."""
    return "%.0f" % value if abs(value) >= 100 else "%.3g" % value


def limits(bar):
    """Least and greatest value of a bar; None where it has none."""
    words = bar.split()
    try:
        if not words:
            return None, None
        if len(words) == 1:
            return None, float(words[0])
        if len(words) == 2 and words[0] == ">=":
            return float(words[1]), None
        if len(words) == 3 and words[1] == "to":
            return float(words[0]), float(words[2])
    except ValueError:
        pass
    raise PageError("%s: not a bar; one is like 400, >= 4 or 0.98 to 1.02" % bar)


def clears(value, bar):
    least, most = limits(bar)
    return (least is None or value >= least) and (most is None or value <= most)


def state(value, must, goal):
    """Of a figure beside its bars; nothing where it has none that it must clear."""
    if not must:
        return ""
    if not clears(value, must):
        return FAILS
    return GOAL if goal and clears(value, goal) else HOLDS


def line_of(cells):
    return "|" + "".join(" %s |" % cell for cell in cells)


def cells_of(line):
    return [cell.strip() for cell in line[1:-1].split("|")] if line.startswith("|") and line.endswith("|") else []


def table_lines(columns, rows):
    return [line_of(columns), "|" + "---|" * len(columns)] + [line_of(row) for row in rows]


class Page:
    """A page by its lines, of which tables are replaced."""

    def __init__(self, text):
        self.lines = text.split("\n")

    def text(self):
        return "\n".join(self.lines)

    def _table(self, columns, heading):
        """First and last line of the table with these columns below a heading, header included."""
        head, at = line_of(columns), 0
        if heading is not None:
            if heading not in self.lines:
                raise PageError("it has no line \"%s\"" % heading)
            at = self.lines.index(heading) + 1
        for first in range(at, len(self.lines)):
            if heading is not None and self.lines[first].startswith("#"):
                break
            if self.lines[first] != head:
                continue
            last = first
            while last + 1 < len(self.lines) and self.lines[last + 1].startswith("|"):
                last += 1
            return first, last
        raise PageError("it has no table %s%s" % (head, " below \"%s\"" % heading if heading else ""))

    def rows(self, columns, heading=None):
        first, last = self._table(columns, heading)
        found = [cells_of(line) for line in self.lines[first + 2:last + 1]]
        for row in found:
            if len(row) != len(columns):
                raise PageError("a row has %d cells, not %d: %s" % (len(row), len(columns), line_of(row)))
        return found

    def replace(self, columns, rows, heading=None):
        first, last = self._table(columns, heading)
        self.lines[first:last + 1] = table_lines(columns, rows)


def bring_up_to_date(path, files, written_by, updated):
    """Writes updated(page's text, what is in the JSON files) in place of the page, or ends with what is wrong."""
    read = None
    try:
        found = []
        for read in files:
            with open(read) as figures:
                found.append(json.load(figures))
        with open(path) as page:
            text = updated(page.read(), found)
        write_whole(path, text)
    except PageError as error:
        sys.exit("error: %s: %s" % (path, error))
    except OSError as error:
        sys.exit("error: %s: %s" % (error.filename, error.strerror))
    except json.JSONDecodeError:
        sys.exit("error: %s: not what %s writes" % (read, written_by))


def main_of_one(usage, written_by, updated):
    """main() of a script FIGURES.json PAGE: updated(page's text, the figures) takes the page's place."""
    if len(sys.argv) != 3:
        sys.exit(usage)
    figures, path = sys.argv[1:]
    bring_up_to_date(path, [figures], written_by, lambda text, found: updated(text, found[0]))


def write_whole(path, text):
    """A file that is there whole or as it was before."""
    folder = os.path.dirname(os.path.abspath(path))
    mode = os.stat(path).st_mode & 0o777 if os.path.exists(path) else 0o644
    handle, name = tempfile.mkstemp(dir=folder)
    try:
        with os.fdopen(handle, "w") as file:
            file.write(text)
        os.chmod(name, mode)
        os.replace(name, path)
    except BaseException:
        os.unlink(name)
        raise
