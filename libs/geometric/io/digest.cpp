#include "handway/geometric/io/digest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <xxhash.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

namespace handway::geometric {

Digest digest_of(std::string_view content) {
  const XXH128_hash_t hash = XXH3_128bits(content.data(), content.size());
  Digest digest;
  static_assert(sizeof hash == sizeof digest);
  std::memcpy(digest.data(), &hash, sizeof hash);
  return digest;
}

std::string digest_of_file(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    return {};
  }
  std::ifstream stream(file, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(stream), {}};
  return stream ? fmt::format("{:02x}", fmt::join(digest_of(content), "")) : std::string();
}

}  // namespace handway::geometric
