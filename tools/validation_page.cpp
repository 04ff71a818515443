#include "tools/validation_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

namespace fluidtex::tools {
namespace {

using validation::Row;

constexpr const char *kGoal = "goal", *kHolds = "holds", *kFails = "**fails**";

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == text.npos ? "" : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

// The cells of a line of a table, at bars that no backslash stands before; none for other lines.
std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  if (line.size() < 2 || line.front() != '|' || line.back() != '|') return cells;
  std::string cell;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] == '|' && line[i - 1] != '\\') {
      cells.push_back(trimmed(cell));
      cell.clear();
    } else {
      cell += line[i];
    }
  }
  return cells;
}

std::string lineOf(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  return line;
}

// A row of figures as it stands on the page.
struct Figure {
  std::string test, cells, measure, value, must, goal, published, state;

  std::string key() const { return test + '|' + cells + '|' + measure; }
  std::string line() const { return lineOf({test, cells, measure, value, must, goal, published, state}); }
};

std::optional<Figure> figureIn(const std::string& line) {
  const std::vector<std::string> c = cellsOf(line);
  const auto isDigit = [](char letter) { return letter >= '0' && letter <= '9'; };
  if (c.size() != 8 || c[1].empty() || !std::all_of(c[1].begin(), c[1].end(), isDigit)) return std::nullopt;
  return Figure{c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]};
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '|') result += '\\';
    result += letter;
  }
  return result;
}

std::string number(double value) {
  return value == 0.0 ? "0" : fmt::format("{:.3g}", value);
}

Figure figureOf(const Row& row) {
  const auto bound = [&](const std::optional<double>& value) {
    return value ? (row.atLeast ? ">= " : "") + number(*value) : std::string();
  };
  std::string published;
  for (const auto& [value, source] : row.published)
    published += (published.empty() ? "" : "; ") + number(value) + " " + source;
  Row asGoal = row;
  asGoal.must = row.goal;
  const bool reached = row.goal && asGoal.ok();
  const std::string state = !row.ok() ? kFails : reached ? kGoal : row.must ? kHolds : "";
  return {row.test,
          std::to_string(row.resolution),
          escaped(row.measure),
          number(row.value),
          bound(row.must),
          bound(row.goal),
          escaped(published),
          state};
}

// Replaces the figure's line, or puts it behind the last one of its test.
void put(const Figure& figure, std::vector<std::string>& lines) {
  std::optional<std::size_t> last;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    const std::optional<Figure> there = figureIn(lines[n]);
    if (!there || there->test != figure.test) continue;
    if (there->key() == figure.key()) {
      lines[n] = figure.line();
      return;
    }
    last = n;
  }
  if (!last) throw PageError("it has no table with rows of the test " + figure.test);
  lines.insert(lines.begin() + std::ptrdiff_t(*last) + 1, figure.line());
}

struct Count {
  int bars = 0, hold = 0, goal = 0, fail = 0;
};

// By the heading that the rows stand under.
std::map<std::string, Count> countsOf(const std::vector<std::string>& lines) {
  std::map<std::string, Count> counts;
  std::string topic;
  for (const std::string& line : lines) {
    if (line.starts_with("### ")) topic = line.substr(4);
    const std::optional<Figure> figure = figureIn(line);
    if (!figure || figure->must.empty()) continue;
    Count& count = counts[topic];
    ++count.bars;
    count.hold += figure->state != kFails;
    count.goal += figure->state == kGoal;
    count.fail += figure->state == kFails;
  }
  return counts;
}

// Rows | [Topic](#place) | tests | bars | hold | of these reach the goal | fail |
void countTopics(std::vector<std::string>& lines) {
  const std::map<std::string, Count> counts = countsOf(lines);
  for (std::string& line : lines) {
    std::vector<std::string> cells = cellsOf(line);
    if (cells.size() != 6 || !cells[0].starts_with("[")) continue;
    const auto found = counts.find(cells[0].substr(1, cells[0].find(']') - 1));
    if (found == counts.end()) continue;
    const Count& count = found->second;
    cells[2] = std::to_string(count.bars);
    cells[3] = std::to_string(count.hold);
    cells[4] = std::to_string(count.goal);
    cells[5] = count.fail > 0 ? std::to_string(count.fail) : "";
    line = lineOf(cells);
  }
}

void listFailures(std::vector<std::string>& lines) {
  auto at = std::find(lines.begin(), lines.end(), "Of the solver:");
  if (at == lines.end()) return;
  std::vector<std::string> failures{lineOf({"test", "cells", "measure", "value", "must"}),
                                    "|---|---|---|---|---|"};
  for (const std::string& line : lines)
    if (const std::optional<Figure> figure = figureIn(line); figure && figure->state == kFails)
      failures.push_back(lineOf({figure->test, figure->cells, figure->measure, figure->value, figure->must}));
  at = std::find_if(at, lines.end(), [](const std::string& line) { return line.starts_with("|"); });
  const auto end =
      std::find_if(at, lines.end(), [](const std::string& line) { return !line.starts_with("|"); });
  at = lines.erase(at, end);
  lines.insert(at, failures.begin(), failures.end());
}

}  // namespace

std::string updatedPage(const std::string& page, const std::vector<Row>& rows) {
  std::vector<std::string> lines = linesOf(page);
  for (const Row& row : rows) put(figureOf(row), lines);
  countTopics(lines);
  listFailures(lines);
  std::string result;
  for (const std::string& line : lines) result += line + "\n";
  return result;
}

}  // namespace fluidtex::tools
