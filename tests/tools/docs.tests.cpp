// The pages: every relative link leads to a file, and to a heading where it names one.
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
  static const std::regex kLink("\\]\\(([^)# ]*)(#[^)]*)?\\)");
  int links = 0;
  for (const fs::path& page : pages()) {
    const std::string text = readBytes(page);
    for (std::sregex_iterator it(text.begin(), text.end(), kLink), end; it != end; ++it) {
      const std::string file = (*it)[1], place = (*it)[2];
      if (file.find("://") != std::string::npos) continue;
      const fs::path target = file.empty() ? page : (page.parent_path() / file).lexically_normal();
      INFO(page << ": " << (*it)[0]);
      CHECK(fs::exists(target));
      ++links;
      if (!place.empty() && target.extension() == ".md" && fs::exists(target))
        CHECK(anchorsOf(readBytes(target)).contains(place.substr(1)));
    }
  }
  CHECK(links > 300);
}
