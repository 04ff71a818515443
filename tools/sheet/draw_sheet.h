// Drawing of a contact sheet.
#pragma once

#include "tools/summaries/contact_sheet.h"

namespace fluidtex::tools {

// Throws std::runtime_error as writeContactSheets().
void drawSheet(const ContactSheet& sheet);

}  // namespace fluidtex::tools
