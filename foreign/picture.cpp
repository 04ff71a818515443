#include "foreign/picture.h"

#include <cstring>
#include <type_traits>

namespace fluidtex::foreign {
namespace {

static_assert(std::is_trivially_copyable_v<PictureHead>);

std::size_t bytesOf(const Picture& picture) {
  return std::size_t(picture.width) * std::size_t(picture.height) * std::size_t(picture.channels) *
         picture.sampleSize();
}

// What has read a damaged file is not to be believed blindly.
bool isPossible(const PictureHead& head, Wanted wanted) {
  const auto between = [](auto value, auto low, auto high) { return value >= low && value <= high; };
  return between(head.width, 1, kLargestSide) && between(head.height, 1, kLargestSide) &&
         (wanted == Wanted::heights || std::int64_t(head.width) * head.height <= kLargestArea) &&
         between(head.channels, 1, 4) && between(head.sample, Sample::byte, Sample::real) &&
         between(head.curve, Curve::linear, Curve::power);
}

Picture readPicture(Wanted wanted, const std::filesystem::path& file) {
  const Unreadable wrongAnswer("cannot be read: its reader gave no whole picture");
  Picture picture;
  bool begun = false;
  ask(wanted, file, [&](std::string_view piece) {
    if (begun) {
      if (picture.samples.size() + piece.size() > bytesOf(picture)) throw wrongAnswer;
      picture.samples += piece;
      return;
    }
    begun = true;
    if (piece.size() != sizeof(PictureHead)) throw wrongAnswer;
    std::memcpy(static_cast<PictureHead*>(&picture), piece.data(), sizeof(PictureHead));
    if (!isPossible(picture, wanted)) throw wrongAnswer;
    picture.samples.reserve(bytesOf(picture));
  });
  if (!begun || picture.samples.size() != bytesOf(picture)) throw wrongAnswer;
  return picture;
}

}  // namespace

Picture readColors(const std::filesystem::path& file) {
  return readPicture(Wanted::colors, file);
}

Picture readNumbers(const std::filesystem::path& file) {
  return readPicture(Wanted::numbers, file);
}

Picture readHeights(const std::filesystem::path& file) {
  return readPicture(Wanted::heights, file);
}

std::string colorNote(const std::filesystem::path& file) {
  std::string note;
  ask(Wanted::color_note, file, [&](std::string_view piece) { note += piece; });
  return note;
}

}  // namespace fluidtex::foreign
