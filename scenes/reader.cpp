#include "scenes/reader.h"

#include <algorithm>
#include <charconv>
#include <tuple>
#include <utility>

namespace fluidtex::scenes {

namespace {

std::string joined(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

std::string lastOf(const std::string& path) {
  return path.substr(path.rfind('.') + 1);
}

}  // namespace

Reader::Reader(const Node& document, std::filesystem::path folder, Faults& faults)
    : m_document(document), m_folder(std::move(folder)), m_faults(faults) {
  Level root;
  root.table = std::get_if<Table>(&document.value);
  root.origin = document.origin;
  m_levels.push_back(std::move(root));
}

std::filesystem::path Reader::folderOf(const Origin& origin) const {
  if (origin.commandLine()) return {};
  return origin.extended.empty() ? m_folder : std::filesystem::path(origin.extended).parent_path();
}

std::string Reader::pathOf(const std::string& key) const {
  return joined(m_levels.back().path, key);
}

const Node* Reader::look(const std::string& key, Need need, const std::string& right) {
  Level& here = level();
  here.known.push_back(key);
  const std::string path = pathOf(key);
  remember(path);
  if (here.broken) return nullptr;
  if (here.table) {
    if (const Entry* entry = find(*here.table, key)) return &entry->node;
  }
  if (need == Need::required) m_faults.add(here.origin, path, "missing key", right);
  return nullptr;
}

void Reader::remember(const std::string& path) {
  if (!level().insideList && std::find(m_paths.begin(), m_paths.end(), path) == m_paths.end())
    m_paths.push_back(path);
}

int Reader::alternative(int current, const std::vector<std::string>& keys, Need need) {
  Level& here = level();
  for (const std::string& key : keys) {
    here.known.push_back(key);
    remember(pathOf(key));
  }
  if (!here.table || here.broken) return need == Need::required ? -1 : current;
  std::vector<const Entry*> found;
  for (const std::string& key : keys) {
    if (const Entry* entry = find(*here.table, key)) found.push_back(entry);
  }
  if (found.empty()) {
    if (need == Need::optional) return current;
    m_faults.add(here.origin, here.path, "no shape", "give one of " + listed(keys, "or"));
    return -1;
  }
  const auto before = [](const Entry* a, const Entry* b) {
    const Origin &one = a->node.origin, &other = b->node.origin;
    return std::tie(one.layer, one.line, one.column) < std::tie(other.layer, other.line, other.column);
  };
  std::stable_sort(found.begin(), found.end(), before);
  for (std::size_t i = 1; i < found.size(); ++i) {
    m_faults.add(found[i]->node.origin, pathOf(found[i]->key), "given besides " + found.front()->key,
                 "give only one of " + listed(keys, "and"));
  }
  return int(std::find(keys.begin(), keys.end(), found.front()->key) - keys.begin());
}

void Reader::absent(const std::string& key) {
  level().known.push_back(key);
}

void Reader::enter(const std::string& key, Need need) {
  const bool wasBroken = level().broken;
  const Node* node = look(key, Need::optional);
  Level inner;
  inner.path = pathOf(key);
  inner.insideList = level().insideList;
  inner.origin = node ? node->origin : level().origin;
  // A table that is left out and whose keys all have defaults is as good as an empty one; so is a required
  // table, but its required keys are then found missing one by one, each by its full name.
  inner.broken = wasBroken;
  if (node) {
    inner.table = std::get_if<Table>(&node->value);
    if (!inner.table) {
      m_faults.add(
          node->origin, inner.path, "wrong type, " + kindName(*node) + " where a table is wanted",
          inner.insideList ? "write for example " + key + " = { ... }" : "head it with [" + inner.path + "]");
      inner.broken = true;
    }
  } else if (need == Need::optional) {
    inner.broken = true;
  }
  m_levels.push_back(std::move(inner));
}

std::size_t Reader::enterList(const std::string& key, std::size_t, Need need) {
  const Node* node = look(key, need, "give at least one [[" + pathOf(key) + "]]");
  Level inner;
  inner.path = pathOf(key);
  inner.insideList = true;
  inner.origin = node ? node->origin : level().origin;
  inner.broken = !node;
  const bool outer = !level().insideList;
  if (node) {
    inner.list = std::get_if<List>(&node->value);
    if (!inner.list || (need == Need::required && inner.list->empty())) {
      const std::string wrong = inner.list
                                    ? "an empty list"
                                    : "wrong type, " + kindName(*node) + " where a list of tables is wanted";
      m_faults.add(
          node->origin, inner.path, wrong,
          outer ? "head each member with [[" + inner.path + "]], or write " + inner.path + " = [ { ... } ]"
                : "write for example " + key + " = [ { ... }, { ... } ]");
      inner.broken = true;
    }
  }
  m_levels.push_back(std::move(inner));
  return level().list ? level().list->size() : 0;
}

void Reader::enterMember(std::size_t index) {
  const Node& node = (*level().list)[index];
  Level inner;
  inner.path = pathOf(std::to_string(index));
  inner.insideList = true;
  inner.origin = node.origin;
  inner.table = std::get_if<Table>(&node.value);
  if (!inner.table) {
    m_faults.add(node.origin, inner.path, "wrong type, " + kindName(node) + " where a table is wanted",
                 "write for example { box = { min = [0, 0, 0], max = [1, 1, 1] } }");
    inner.broken = true;
  }
  m_levels.push_back(std::move(inner));
}

void Reader::leave() {
  collectUnknown(m_levels.back());
  m_levels.pop_back();
}

void Reader::collectUnknown(const Level& done) {
  if (!done.table) return;
  for (const Entry& entry : *done.table) {
    if (m_unknown.size() >= Faults::kMost) return;
    if (std::find(done.known.begin(), done.known.end(), entry.key) == done.known.end())
      m_unknown.push_back({entry.node.origin, done.path, entry.key, done.known});
  }
}

void Reader::reportUnknownKeys() {
  collectUnknown(level());
  for (const UnknownKey& unknown : m_unknown) {
    if (m_faults.full()) return;
    // The very word in another table, then a similar one here, then a similar one elsewhere.
    std::vector<std::string> sameWord, lastWords;
    for (const std::string& path : m_paths) {
      lastWords.push_back(lastOf(path));
      if (lastOf(path) == unknown.key) sameWord.push_back(unknown.origin.prefix + path);
    }
    std::string right;
    const std::string near = nearestName(unknown.key, unknown.siblings),
                      far = nearestName(unknown.key, lastWords);
    if (!sameWord.empty()) {
      right = "did you mean " + listed(sameWord, "or") + "?";
    } else if (!near.empty()) {
      right = "did you mean " + unknown.origin.prefix + joined(unknown.path, near) + "?";
    } else if (!far.empty()) {
      const auto found = std::find(lastWords.begin(), lastWords.end(), far);
      right = "did you mean " + unknown.origin.prefix + m_paths[std::size_t(found - lastWords.begin())] + "?";
    } else {
      // A key that is asked for on more than one way is known once.
      std::vector<std::string> known;
      for (const std::string& key : unknown.siblings)
        if (std::find(known.begin(), known.end(), key) == known.end()) known.push_back(key);
      right = "known here: " + listed(known);
    }
    m_faults.add(unknown.origin, joined(unknown.path, unknown.key), "unknown key", right);
  }
}

const Node* Reader::findPath(const std::string& path, Origin* origin) const {
  const Node* node = &m_document;
  if (origin) *origin = node->origin;
  std::size_t start = 0;
  while (start <= path.size()) {
    const std::size_t dot = std::min(path.find('.', start), path.size());
    const std::string part = path.substr(start, dot - start);
    const Node* next = nullptr;
    if (const Table* table = std::get_if<Table>(&node->value)) {
      const Entry* entry = find(*table, part);
      if (entry) next = &entry->node;
    } else if (const List* list = std::get_if<List>(&node->value)) {
      std::size_t index = list->size();
      std::from_chars(part.data(), part.data() + part.size(), index);
      if (index < list->size()) next = &(*list)[index];
    }
    if (!next) return nullptr;
    node = next;
    if (origin) *origin = node->origin;
    start = dot + 1;
  }
  return node;
}

bool Reader::given(const std::string& path) const {
  return findPath(path, nullptr) != nullptr;
}

Origin Reader::originOf(const std::string& path) const {
  Origin origin;
  findPath(path, &origin);
  return origin;
}

void Reader::fault(const std::string& path, const std::string& wrong, const std::string& right) {
  m_faults.add(originOf(path), path, wrong, right);
}

}  // namespace fluidtex::scenes
