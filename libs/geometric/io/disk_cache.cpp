#include "handway/geometric/io/disk_cache.h"

#include "handway/geometric/io/replace_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>
#include <xxhash.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 1000;

std::optional<fs::path> cache_folder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && *cache != '\0') {
    return fs::path(cache) / "handway" / "meshes";
  }
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home != '\0') {
    return fs::path(home) / ".cache" / "handway" / "meshes";
  }
  return std::nullopt;
}

fs::path file_of(const fs::path& folder, const CacheKey& key) {
  return folder / fmt::format("{:02x}.bin", fmt::join(key, ""));
}

std::string checksum(std::string_view content) {
  const XXH64_hash_t sum = XXH3_64bits(content.data(), content.size());
  std::string bytes(sizeof sum, '\0');
  std::memcpy(bytes.data(), &sum, sizeof sum);
  return bytes;
}

void remove_oldest(const fs::path& folder) {
  std::vector<fs::directory_entry> files{fs::directory_iterator(folder), {}};
  if (files.size() <= kMostFiles) {
    return;
  }
  std::ranges::sort(files, {},
                    [](const fs::directory_entry& file) { return file.last_write_time(); });
  for (std::size_t i = 0; i < files.size() - kMostFiles / 2; ++i) {
    fs::remove(files[i]);
  }
}

}  // namespace

CacheKey cache_key(std::string_view made_how, std::string_view content) {
  const XXH64_hash_t how = XXH3_64bits(made_how.data(), made_how.size());
  const XXH128_hash_t hash = XXH3_128bits_withSeed(content.data(), content.size(), how);
  CacheKey key;
  static_assert(sizeof hash == sizeof key);
  std::memcpy(key.data(), &hash, sizeof hash);
  return key;
}

std::optional<std::string> read_cached(const CacheKey& key) {
  const std::optional<fs::path> folder = cache_folder();
  std::ifstream file;
  if (folder) {
    file.open(file_of(*folder, key), std::ios::binary | std::ios::ate);
  }
  if (!file.is_open()) {
    return std::nullopt;
  }
  std::string content(static_cast<std::size_t>(std::max<std::streamoff>(file.tellg(), 0)), '\0');
  file.seekg(0);
  file.read(content.data(), static_cast<std::streamsize>(content.size()));
  constexpr std::size_t kSum = sizeof(XXH64_hash_t);
  if (!file || content.size() < kSum ||
      checksum(std::string_view(content).substr(kSum)) != content.substr(0, kSum)) {
    return std::nullopt;
  }
  content.erase(0, kSum);
  return content;
}

void write_cached(const CacheKey& key, const std::string& bytes) {
  const std::optional<fs::path> folder = cache_folder();
  if (!folder) {
    return;
  }
  try {
    fs::create_directories(*folder);
    replace_file(file_of(*folder, key), checksum(bytes) + bytes);
    remove_oldest(*folder);
  } catch (const std::exception& error) {
    spdlog::debug("what was prepared of a mesh is not kept: {}", error.what());
  }
}

}  // namespace handway::geometric
