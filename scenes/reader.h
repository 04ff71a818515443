// Fills a scene from a document by visiting the schema, and collects all faults.
#pragma once

#include "scenes/document.h"
#include "scenes/visitor.h"

#include <filesystem>
#include <string>
#include <vector>

namespace fluidtex::scenes {

class Reader : public Visitor {
 public:
  // folder: base of relative file names of the scene; those in a file that it extends are relative to that
  // file's folder, those on the command line to the current folder.
  Reader(const Node& document, std::filesystem::path folder, Faults& faults);

  void flag(const std::string& key, bool& value) override;
  void integer(const std::string& key, int& value, const Limits& limits, Need need) override;
  void seed(const std::string& key, std::uint64_t& value) override;
  void number(const std::string& key, double& value, const Limits& limits, Need need) override;
  void text(const std::string& key, std::string& value) override;
  void vector(const std::string& key, Vec3d& value, const Limits& limits, Need need) override;
  void integers(const std::string& key, std::vector<int>& value, const Limits& limits) override;
  void pixels(const std::string& key, int& width, int& height, const Limits& limits) override;
  void file(const std::string& key, std::filesystem::path& value,
            const std::vector<std::string>& endings) override;
  void files(const std::string& key, std::filesystem::path& value,
             const std::vector<std::string>& endings) override;
  void picture(const std::string& key, std::filesystem::path& value,
               texture::AnimationOptions& sequence) override;
  void path(const std::string& key, std::filesystem::path& value) override;
  void choice(const std::string& key, int& value, const std::vector<std::string>& words) override;
  int alternative(int current, const std::vector<std::string>& keys, Need need) override;
  void absent(const std::string& key) override;
  void enter(const std::string& key, Need need) override;
  std::size_t enterList(const std::string& key, std::size_t size, Need need) override;
  void enterMember(std::size_t index) override;
  void leave() override;

  // To be called after the whole schema: reports unknown keys, with suggestions.
  void reportUnknownKeys();

  // For validation across several keys.
  bool given(const std::string& path) const;
  Origin originOf(const std::string& path) const;  // of the deepest part of the path that was written
  void fault(const std::string& path, const std::string& wrong, const std::string& right);
  bool clean(const std::string& path) const { return m_faults.clean(path); }

 private:
  struct Level {
    const Table* table = nullptr;  // null where it was not written
    const List* list = nullptr;    // for a list of tables
    Origin origin;                 // of the deepest table that was written
    std::string path;
    bool broken = false;  // it has a fault of its own: nothing is asked for inside
    bool insideList = false;
    std::vector<std::string> known;  // keys asked for
  };
  struct UnknownKey {
    Origin origin;
    std::string path, key;
    std::vector<std::string> siblings;
  };

  Level& level() { return m_levels.back(); }
  void collectUnknown(const Level& done);
  std::string pathOf(const std::string& key) const;
  // The key's value, if it was written; `right`: what to say would be right where it is required and missing.
  const Node* look(const std::string& key, Need need, const std::string& right = "");
  void remember(const std::string& path);  // as a key that could have been meant elsewhere
  const Node* findPath(const std::string& path, Origin* origin) const;
  void wrongType(const std::string& path, const Node& node, const std::string& wanted,
                 const std::string& example);
  // Whether the node is such a number, inside the limits; if not, the fault is added.
  bool readNumber(const std::string& path, const Node& node, const Limits& limits, const std::string& example,
                  double& value);
  // The file's name behind a key that must be there, as it is written and from where the program runs; false,
  // and the fault added, where there is none.
  bool readName(const std::string& key, const std::string& example, const Node*& node,
                std::filesystem::path& full);
  // Whether the file's name ends in one of those, if any; if not, the fault is added.
  bool hasEnding(const std::string& path, const Node& node, const std::filesystem::path& full,
                 const std::vector<std::string>& endings);
  bool readInteger(const std::string& path, const Node& node, const Limits& limits,
                   const std::string& example, std::int64_t& value);

  // Where file names begin that were given there.
  std::filesystem::path folderOf(const Origin& origin) const;

  const Node& m_document;
  std::filesystem::path m_folder;
  Faults& m_faults;
  std::vector<Level> m_levels;
  std::vector<std::string> m_paths;  // of all keys asked for outside of lists
  std::vector<UnknownKey> m_unknown;
};

}  // namespace fluidtex::scenes
