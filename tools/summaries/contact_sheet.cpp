#include "tools/summaries/contact_sheet.h"

#include "foreign/program_beside.h"
#include "render/other_program.h"

#include <stdexcept>

namespace fluidtex::tools {

void writeContactSheets(const std::vector<ContactSheet>& sheets) {
  // As tools/sheet/main.cpp reads it.
  std::string wishes;
  const auto put = [&](const std::string& field) { (wishes += field) += '\0'; };
  for (const ContactSheet& sheet : sheets) {
    put(sheet.file.string());
    for (const int number : {sheet.columns, sheet.width, int(sheet.pictures.size())})
      put(std::to_string(number));
    for (const LabelledPicture& picture : sheet.pictures) {
      put(picture.file.string());
      put(picture.label);
    }
  }
  const render::Outcome drawn =
      render::runOther({foreign::programBeside("fluidtex_sheet", FLUIDTEX_SHEET).string()}, wishes);
  if (drawn.exitCode != 0) throw std::runtime_error(render::lastLine(drawn.complaints));
}

}  // namespace fluidtex::tools
