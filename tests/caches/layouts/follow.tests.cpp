#include "caches/layouts/follow.h"

#include "tests/caches/layouts/folder_files.h"

#include <chrono>

using namespace fluidtex::caches;

namespace {

// As if it had been written that long ago.
void writeAgo(const fs::path& file, std::chrono::seconds ago) {
  writeFile(file);
  fs::last_write_time(file, fs::file_time_type::clock::now() - ago);
}

}  // namespace

TEST_CASE("follow: a frame's files are whole once they rest, or the next frame's are there", "[caches]") {
  using std::chrono::seconds;
  const Scratch scratch;
  const auto at = [&](const char* name) { return scratch.path / name; };
  writeAgo(at("w_0001.ply"), seconds(60));
  writeAgo(at("v_0001.vdb"), seconds(60));
  Layout layout;
  layout.surface = numberedLike(at("w_0001.ply"));
  layout.velocity = numberedLike(at("v_0001.vdb"));
  layout.last = 1;
  CHECK_FALSE(awaitedFile(layout, 1));
  CHECK(awaitedFile(layout, 2) == at("w_0002.ply"));
  writeAgo(at("w_0002.ply"), seconds(0));
  CHECK(awaitedFile(layout, 2) == at("w_0002.ply"));
  writeAgo(at("w_0003.ply"), seconds(0));
  CHECK(awaitedFile(layout, 2) == at("v_0002.vdb"));
  CHECK(layout.last == 1);
  writeAgo(at("v_0002.vdb"), seconds(3));
  CHECK_FALSE(awaitedFile(layout, 2));
  CHECK(layout.last == 2);
  CHECK(layout.surface.at(2) == at("w_0002.ply"));
  // Made, and not written yet.
  fs::remove(at("w_0003.ply"));
  std::ofstream(at("w_0003.ply")).close();
  fs::last_write_time(at("w_0003.ply"), fs::file_time_type::clock::now() - seconds(60));
  writeAgo(at("v_0003.vdb"), seconds(60));
  CHECK(awaitedFile(layout, 3) == at("w_0003.ply"));
  writeAgo(at("w_0004.ply"), seconds(0));
  CHECK_FALSE(awaitedFile(layout, 3));
}
