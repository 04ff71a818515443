// fluidtex_sheet: draws contact sheets. On stdin, each field ended by a zero byte: file, columns, width,
// number of pictures, then name and label of each picture; and so on for the next sheet.
#include "tools/sheet/draw_sheet.h"

#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>

namespace {

std::string nextField() {
  std::string field;
  if (!std::getline(std::cin, field, '\0')) throw std::runtime_error("fluidtex_sheet: its input ends early");
  return field;
}

}  // namespace

int main() {
  std::signal(SIGXFSZ, SIG_IGN);  // the write reports it
  try {
    while (std::cin.peek() != std::char_traits<char>::eof()) {
      fluidtex::tools::ContactSheet sheet;
      sheet.file = nextField();
      sheet.columns = std::stoi(nextField());
      sheet.width = std::stoi(nextField());
      for (int left = std::stoi(nextField()); left > 0; --left) {
        const std::string file = nextField();
        sheet.pictures.push_back({file, nextField()});
      }
      fluidtex::tools::drawSheet(sheet);
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
