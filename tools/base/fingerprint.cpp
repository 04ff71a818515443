#include "tools/base/fingerprint.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <fmt/core.h>

#include <cerrno>
#include <fstream>
#include <memory>
#include <system_error>
#include <vector>

namespace fluidtex::tools {
namespace {

std::string digits(const XXH128_hash_t& hash) {
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace

Fingerprint fingerprintOf(const std::filesystem::path& file) {
  const auto fail = [&] {
    throw std::system_error(errno, std::generic_category(), file.string() + ": cannot be read");
  };
  std::ifstream in(file, std::ios::binary);
  if (!in) fail();
  const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(),
                                                                              XXH3_freeState);
  XXH3_128bits_reset(state.get());
  std::vector<char> part(std::size_t{1} << 20);
  std::uint64_t bytes = 0;
  while (in) {
    in.read(part.data(), static_cast<std::streamsize>(part.size()));
    if (in.bad()) fail();
    XXH3_128bits_update(state.get(), part.data(), static_cast<std::size_t>(in.gcount()));
    bytes += static_cast<std::uint64_t>(in.gcount());
  }
  return {bytes, digits(XXH3_128bits_digest(state.get()))};
}

std::string hashOf(std::string_view text) {
  return digits(XXH3_128bits(text.data(), text.size()));
}

}  // namespace fluidtex::tools
