#include "tools/report/page.h"

#include <catch2/catch.hpp>

using namespace fluidtex::tools;
using Catch::Matchers::Contains;

namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("page: base64 as in RFC 4648", "[tools]") {
  // The test vectors of its section 10, and bytes with the high bit.
  CHECK(base64("") == "");
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foob") == "Zm9vYg==");
  CHECK(base64("fooba") == "Zm9vYmE=");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64(std::string_view("\0\xff\xfb\x80", 4)) == "AP/7gA==");
}

TEST_CASE("page: no string of the run ends the element that it stands in", "[tools]") {
  const Json nasty = {{"scene", "</script><script>alert(1)</script><!-- \xff &amp; \xe2\x80\xa8"},
                      {"title", "<b>ü"}};
  const std::string text = scriptSafe(nasty);
  CHECK(text.find('<') == text.npos);
  const Json read = Json::parse(text);
  CHECK(read["title"] == "<b>ü");
  CHECK_THAT(read["scene"].get<std::string>(), Contains("</script><script>alert(1)</script><!-- "));
  const std::string page = pageOf(nasty, {{"mesh-1", "ab"}});
  CHECK(count(page, "alert(1)") == 1);
  CHECK(count(page, "<script>alert") == 0);
  CHECK(count(page, "id=\"run\"") == 1);
  CHECK_THAT(page, Contains("<script type=\"text/plain\" id=\"mesh-1\">YWI=</script>"));
}

TEST_CASE("page: it is whole, and loads nothing from elsewhere", "[tools]") {
  const std::string page = servedPage();
  CHECK_THAT(page, Catch::Matchers::StartsWith("<!doctype html>"));
  CHECK_THAT(page, Contains("</html>"));
  for (const char* place : {"/*style*/", "/*script*/", "<!--data-->"}) CHECK(count(page, place) == 0);
  for (const char* address : {"src=\"http", "href=\"http", "url(http", "import(\"http"})
    CHECK(count(page, address) == 0);
  CHECK(count(page, "id=\"run\"") == 0);
  CHECK(count(page, "default-src 'none'") == 1);
}
