#include "foreign/layers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <sstream>

namespace fluidtex::foreign {
namespace {

// Names of what a renderer shows, the surest first.
constexpr std::array kShown = {"rgba",  "rgb",  "beauty",  "combined", "composite", "color", "colour",
                               "final", "main", "primary", "default",  "image",     "c"};

std::string lowered(std::string text) {
  for (char& letter : text) letter = char(std::tolower(static_cast<unsigned char>(letter)));
  return text;
}

// "red" and "R" say the same.
std::string component(const std::string& word) {
  std::string small = lowered(word);
  for (const char* name : {"red", "green", "blue", "alpha", "depth"})
    if (small == name) return small == "depth" ? "z" : small.substr(0, 1);
  return small;
}

// The channels of one part that share all but the last word of their names.
struct Group {
  int part = 0;
  std::string prefix;                  // without the last dot
  std::string name;                    // the part's and the prefix, as it is told
  std::map<std::string, int> channel;  // by component

  bool has(const std::vector<const char*>& components) const {
    return std::all_of(components.begin(), components.end(), [&](auto c) { return channel.contains(c); });
  }
  // Those, and alpha behind them where there is one.
  Layer layer(const std::vector<const char*>& components) const {
    Layer result{part, {}};
    for (const char* c : components) result.channels.push_back(channel.at(c));
    if (const auto alpha = channel.find("a"); alpha != channel.end())
      result.channels.push_back(alpha->second);
    return result;
  }
};

std::vector<Group> groupsOf(const std::vector<Part>& parts) {
  std::vector<Group> groups;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::size_t first = groups.size();
    for (std::size_t c = 0; c < parts[p].channels.size(); ++c) {
      const std::string& full = parts[p].channels[c];
      const std::size_t dot = full.rfind('.');
      const std::string prefix = dot == full.npos ? "" : full.substr(0, dot);
      auto group = std::find_if(groups.begin() + std::ptrdiff_t(first), groups.end(),
                                [&](const Group& other) { return other.prefix == prefix; });
      if (group == groups.end()) {
        const std::string& part = parts[p].name;
        const char* between = part.empty() || prefix.empty() ? "" : ".";
        groups.push_back({int(p), prefix, std::string(part).append(between).append(prefix), {}});
        group = groups.end() - 1;
      }
      group->channel.emplace(component(dot == full.npos ? full : full.substr(dot + 1)), int(c));
    }
  }
  return groups;
}

// The lower, the surer that it is what is shown; `kShown.size() + 1` where its name does not tell.
std::size_t rankOf(const Group& group, const std::vector<Part>& parts) {
  const bool named = parts.size() > 1 && !parts[std::size_t(group.part)].name.empty();
  if (group.prefix.empty() && !named) return 0;
  std::size_t rank = kShown.size();
  std::istringstream words(lowered(named ? group.name : group.prefix));
  for (std::string word; std::getline(words, word, '.');)
    rank = std::min(rank, std::size_t(std::find(kShown.begin(), kShown.end(), word) - kShown.begin()));
  return rank + 1;
}

std::string told(const Group& group) {
  std::string name = asClause(group.name.substr(0, 60));
  if (name.empty())
    for (const auto& [component, index] : group.channel)
      name += (name.empty() ? "" : " ") + asClause(component.substr(0, 30));
  return name;
}

[[noreturn]] void refuse(const std::string& what, const std::vector<const Group*>& groups) {
  constexpr std::size_t kMostNames = 8;
  std::string names;
  for (std::size_t g = 0; g < std::min(groups.size(), kMostNames); ++g)
    names += (g == 0 ? "" : ", ") + told(*groups[g]);
  if (groups.size() > kMostNames) names += " and " + std::to_string(groups.size() - kMostNames) + " more";
  throw Unreadable(what + ": " + names + "; save the wanted one as a picture of its own");
}

std::vector<const Group*> having(const std::vector<Group>& groups,
                                 const std::vector<const char*>& components) {
  std::vector<const Group*> found;
  for (const Group& group : groups)
    if (group.has(components)) found.push_back(&group);
  return found;
}

// The one that its name, or being alone, tells; null where none does.
const Group* shownOf(const std::vector<const Group*>& candidates, const std::vector<Part>& parts) {
  if (candidates.size() == 1) return candidates.front();
  std::size_t best = kShown.size() + 1;
  const Group* found = nullptr;
  for (const Group* group : candidates) {
    const std::size_t rank = rankOf(*group, parts);
    if (rank > best || rank > kShown.size()) continue;
    found = rank < best ? group : nullptr;
    best = rank;
  }
  return found;
}

}  // namespace

Layer chooseLayer(const std::vector<Part>& parts, bool asNumbers) {
  const std::vector<Group> groups = groupsOf(parts);
  std::vector<const Group*> all;
  all.reserve(groups.size());
  for (const Group& group : groups) all.push_back(&group);
  std::vector<std::vector<const char*>> wanted = {{"r", "g", "b"}};
  if (asNumbers) wanted.push_back({"x", "y", "z"});
  wanted.push_back({"y"});
  for (const std::vector<const char*>& components : wanted) {
    std::vector<const Group*> candidates = having(groups, components);
    // The y of a vector is no grey.
    if (components.size() == 1)
      std::erase_if(candidates, [](const Group* group) { return group->has({"x", "z"}); });
    if (candidates.empty()) continue;
    if (const Group* shown = shownOf(candidates, parts)) return shown->layer(components);
    refuse("holds several layers, and no single one is called RGB, beauty or Combined", candidates);
  }
  // A lone channel is what the file is of, unless it is depth.
  const Group* lone = nullptr;
  int count = 0;
  for (const Group& group : groups)
    for (const auto& [name, index] : group.channel)
      if (name != "a" || group.channel.size() == 1) lone = &group, ++count;
  if (count == 1) {
    const auto channel = std::find_if(lone->channel.begin(), lone->channel.end(), [&](const auto& entry) {
      return entry.first != "a" || lone->channel.size() == 1;
    });
    const std::string name = lowered(lone->name);
    const bool depth = channel->first == "z" || name == "z" || name.ends_with("depth");
    if (!depth || asNumbers) {
      if (channel->first == "a") return {lone->part, {channel->second}};  // alpha alone is taken as grey
      return lone->layer({channel->first.c_str()});
    }
  }
  refuse("holds no layer of colours", all);
}

}  // namespace fluidtex::foreign
