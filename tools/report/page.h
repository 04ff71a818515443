// The page of a run: one HTML file.
#pragma once

#include "tools/run_folder/report.h"

#include <string>
#include <string_view>
#include <vector>

namespace fluidtex::tools {

// Style, script and libraries of tools/report/page in one, as bundle.mjs makes it; no run yet.
std::string_view pageTemplate();

// A file that the page holds, found there by its id (tools/report/page/source.js).
struct Attachment {
  std::string id;  // letters, digits and hyphens
  std::string bytes;
};

// The page of one run, which needs no other file and no network. figures: tools/report/figures.h.
std::string pageOf(const Json& figures, const std::vector<Attachment>& attachments);

// The page that asks whoever serves it for its run (tools/report/serve.h).
std::string servedPage();

// Exposed for tests. JSON that can stand inside a <script> element whatever its strings hold.
std::string scriptSafe(const Json& json);
std::string base64(std::string_view bytes);

}  // namespace fluidtex::tools
