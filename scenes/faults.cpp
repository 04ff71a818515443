#include "scenes/faults.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <tuple>

namespace fluidtex::scenes {

namespace {

// A key of a scene has at most 60 letters, a message at most 600 of its own and a file's name.
constexpr std::size_t kLongestKey = 160, kLongestMessage = 1200, kLongestHint = 60;

std::string lowered(std::string text) {
  for (char& letter : text) letter = char(std::tolower(static_cast<unsigned char>(letter)));
  return text;
}

}  // namespace

void Faults::add(const Origin& origin, const std::string& key, const std::string& wrong,
                 const std::string& right) {
  add(Fault{origin, key, wrong + "; " + right});
}

void Faults::add(const Fault& fault) {
  if (!full() && !has(fault)) m_faults.push_back(fault);
}

bool Faults::has(const Fault& fault) const {
  return std::any_of(m_faults.begin(), m_faults.end(), [&](const Fault& known) {
    return known.origin.where == fault.origin.where && known.key == fault.key &&
           known.message == fault.message;
  });
}

bool Faults::clean(const std::string& key) const {
  return std::none_of(m_faults.begin(), m_faults.end(), [&](const Fault& fault) {
    return fault.key == key || fault.key.starts_with(key + ".");
  });
}

std::vector<std::string> Faults::lines() const {
  std::vector<Fault> sorted = m_faults;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Fault& a, const Fault& b) {
    return std::tie(a.origin.layer, a.origin.extended, a.origin.line, a.origin.column) <
           std::tie(b.origin.layer, b.origin.extended, b.origin.line, b.origin.column);
  });
  std::vector<std::string> result;
  for (const Fault& fault : sorted) {
    std::string line = fault.origin.where + ": error: " + fault.origin.prefix +
                       shortened(fault.key, kLongestKey) + ": " + shortened(fault.message, kLongestMessage);
    // A name in a message may hold anything; one fault stays one line, and moves no cursor.
    std::replace_if(
        line.begin(), line.end(), [](unsigned char letter) { return letter < ' ' || letter == 0x7f; }, ' ');
    result.push_back(std::move(line));
  }
  if (full())
    result.emplace_back("error: there may be more faults than these ")
        .append(std::to_string(kMost))
        .append("; mend them first");
  return result;
}

std::string shortened(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  const auto inside = [&](std::size_t at) { return (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80; };
  std::size_t head = most * 2 / 3, tail = text.size() - most / 3;
  while (head > 0 && inside(head)) --head;
  while (tail < text.size() && inside(tail)) ++tail;
  return text.substr(0, head) + " ... " + text.substr(tail);
}

int editDistance(const std::string& first, const std::string& second) {
  const std::string a = lowered(first), b = lowered(second);
  std::vector<std::vector<int>> cost(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = int(i);
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = int(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      cost[i][j] = std::min(
          {cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  }
  return cost[a.size()][b.size()];
}

std::string nearestName(const std::string& wrong, const std::vector<std::string>& names) {
  // Its distance takes time and memory by the product of both lengths.
  if (wrong.size() > kLongestHint) return "";
  // A third of the letters may be wrong; with more of them the guess would be as often misleading as helpful.
  int best = std::max(1, int(wrong.size()) / 3) + 1;
  std::string nearest;
  for (const std::string& name : names) {
    // As many letters at least are missing or too many.
    if (std::abs(int(name.size()) - int(wrong.size())) >= best) continue;
    const int distance = editDistance(wrong, name);
    if (distance < best) {
      best = distance;
      nearest = name;
    }
  }
  return nearest;
}

std::string listed(const std::vector<std::string>& names, const std::string& last) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " " + last + " " : ", ";
    text += names[i];
  }
  return text;
}

}  // namespace fluidtex::scenes
