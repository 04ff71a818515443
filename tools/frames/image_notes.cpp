#include "tools/frames/image_notes.h"

#include "foreign/picture.h"

namespace fluidtex::tools {

std::vector<std::string> imageNotes(const std::vector<std::filesystem::path>& pictures) {
  std::vector<std::string> notes;
  for (const std::filesystem::path& file : pictures) {
    try {
      const std::string note = foreign::colorNote(file);
      if (!note.empty()) notes.push_back(file.string() + ": " + note);
    } catch (const foreign::Unreadable&) {
    }
  }
  return notes;
}

std::vector<std::filesystem::path> colorPictures(const texture::ExemplarOptions& options) {
  std::vector<std::filesystem::path> pictures{options.file};
  if (!options.betweenFile.empty()) pictures.push_back(options.betweenFile);
  return pictures;
}

}  // namespace fluidtex::tools
