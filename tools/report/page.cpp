#include "tools/report/page.h"

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>

namespace fluidtex::tools {
namespace {

// The template with `data` where the run goes.
std::string withData(std::string_view data) {
  constexpr std::string_view kPlace = "<!--data-->";
  const std::string_view page = pageTemplate();
  const std::size_t at = page.find(kPlace);
  std::string whole;
  whole.reserve(page.size() + data.size());
  whole += page.substr(0, at);
  whole += data;
  whole += page.substr(at + kPlace.size());
  return whole;
}

}  // namespace

std::string scriptSafe(const Json& json) {
  std::string text;
  // "<" stands in strings alone, where it may be written as an escape.
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace))
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

std::string base64(std::string_view bytes) {
  using namespace boost::archive::iterators;
  using Digits = base64_from_binary<transform_width<std::string_view::const_iterator, 6, 8>>;
  std::string text(Digits(bytes.begin()), Digits(bytes.end()));
  text.append((3 - bytes.size() % 3) % 3, '=');
  return text;
}

std::string pageOf(const Json& figures, const std::vector<Attachment>& attachments) {
  std::string data = "<script type=\"application/json\" id=\"run\">" + scriptSafe(figures) + "</script>\n";
  for (const Attachment& attachment : attachments)
    data += "<script type=\"text/plain\" id=\"" + attachment.id + "\">" + base64(attachment.bytes) +
            "</script>\n";
  return withData(data);
}

std::string servedPage() {
  return withData("");
}

}  // namespace fluidtex::tools
