// The pages: every relative link leads to a file, and to a heading where it names one; a link leads to every
// file.
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> pages() {
  const fs::path root = FLUIDTEX_SOURCE;
  std::vector<fs::path> found{root / "README.md", root / "CONTRIBUTING.md", root / "scenes/README.md"};
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  return found;
}

// Calls body(page, link, file, heading) for each link to a file of the repository, or to a heading of the
// page itself.
template <class Body>
void forEachLink(const Body& body) {
  static const std::regex kLink("\\]\\(([^)# ]*)(#[^)]*)?\\)");
  for (const fs::path& page : pages()) {
    const std::string text = readBytes(page);
    for (std::sregex_iterator it(text.begin(), text.end(), kLink), end; it != end; ++it) {
      const std::string file = (*it)[1];
      if (file.find("://") == std::string::npos)
        body(page, (*it)[0].str(), file.empty() ? page : (page.parent_path() / file).lexically_normal(),
             (*it)[2].str());
    }
  }
}

// As web pages of the repository name a heading: lower case, spaces to hyphens, other signs left out.
std::string anchorOf(const std::string& heading) {
  std::string anchor;
  for (const unsigned char c : heading) {
    if (std::isalnum(c) || c == '-' || c == '_' || c >= 0x80) anchor += char(std::tolower(c));
    if (c == ' ') anchor += '-';
  }
  return anchor;
}

std::set<std::string> anchorsOf(const std::string& page) {
  static const std::regex kHeading("(^|\n)#+ ([^\n]*)");
  std::set<std::string> anchors;
  for (std::sregex_iterator it(page.begin(), page.end(), kHeading), end; it != end; ++it)
    anchors.insert(anchorOf((*it)[2]));
  return anchors;
}

}  // namespace

TEST_CASE("docs: links lead somewhere", "[tools]") {
  int links = 0;
  forEachLink(
      [&](const fs::path& page, const std::string& link, const fs::path& target, const std::string& heading) {
        INFO(page << ": " << link);
        CHECK(fs::exists(target));
        ++links;
        if (!heading.empty() && target.extension() == ".md" && fs::exists(target))
          CHECK(anchorsOf(readBytes(target)).contains(heading.substr(1)));
      });
  CHECK(links > 300);
}

TEST_CASE("docs: a link of another page leads to every page and picture", "[tools]") {
  std::set<fs::path> reached;
  forEachLink([&](const fs::path& page, const std::string&, const fs::path& target, const std::string&) {
    if (target != page) reached.insert(target);
  });
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(FLUIDTEX_SOURCE) / "docs")) {
    if (!entry.is_regular_file()) continue;
    INFO(entry.path());
    CHECK(reached.contains(entry.path().lexically_normal()));
    ++files;
  }
  CHECK(files > 100);
}
