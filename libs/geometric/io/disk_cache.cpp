#include "handway/geometric/io/disk_cache.h"

#include "handway/geometric/io/replace_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>
#include <xxhash.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>
#include <vector>

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

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kChecksum = sizeof(Digest);  // bytes at the head of an entry

fs::path folder_of_user() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && *cache != '\0') {
    return fs::path(cache) / "handway";
  }
  const char* home = std::getenv("HOME");
  return home != nullptr && *home != '\0' ? fs::path(home) / ".cache" / "handway" : fs::path();
}

std::string bytes_of(const Digest& digest) { return {digest.begin(), digest.end()}; }

std::string checksum(const CacheKey& key, std::string_view bytes) {
  return bytes_of(digest_of(bytes_of(key) + bytes_of(digest_of(bytes))));
}

std::optional<std::string> content_of(const fs::path& file, std::uintmax_t most) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {  // a pipe would never end
    return std::nullopt;
  }
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream ? std::streamoff(stream.tellg()) : -1;
  if (size < static_cast<std::streamoff>(kChecksum) || static_cast<std::uintmax_t>(size) > most) {
    return std::nullopt;
  }
  std::string content(static_cast<std::size_t>(size), '\0');
  stream.seekg(0);
  stream.read(content.data(), size);
  return stream ? std::optional(std::move(content)) : std::nullopt;
}

}  // namespace

CacheKey cache_key(std::string_view layout, std::string_view content) {
  return digest_of(fmt::format("handway {}, {}:", HANDWAY_VERSION, layout) +
                   bytes_of(digest_of(content)));
}

DiskCache DiskCache::of_user() {
  const fs::path folder = folder_of_user();
  if (folder.empty()) {
    return DiskCache({});
  }
  std::error_code ignored;
  fs::remove_all(folder / "collision", ignored);
  return DiskCache(folder / "meshes");
}

DiskCache::DiskCache(fs::path folder, std::uintmax_t budget)
    : folder_(std::move(folder)), budget_(budget) {}

fs::path DiskCache::file_of(const CacheKey& key) const {
  return folder_ / fmt::format("{:02x}.bin", fmt::join(key, ""));
}

std::optional<std::string> DiskCache::read(const CacheKey& key) const {
  if (folder_.empty()) {
    return std::nullopt;
  }
  const fs::path file = file_of(key);
  std::optional<std::string> content = content_of(file, budget_);
  if (!content || checksum(key, std::string_view(*content).substr(kChecksum)) !=
                      content->substr(0, kChecksum)) {
    return std::nullopt;
  }
  std::error_code ignored;  // where nothing can be written, nothing is removed either
  fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
  content->erase(0, kChecksum);
  return content;
}

void DiskCache::write(const CacheKey& key, std::string_view bytes) const {
  if (folder_.empty() || bytes.size() + kChecksum > budget_) {
    return;
  }
  try {
    fs::create_directories(folder_);
    const fs::path file = file_of(key);
    if (fs::exists(file) && !fs::is_regular_file(file)) {  // not ours, and a pipe might block
      return;
    }
    replace_file(file, checksum(key, bytes).append(bytes));
    keep_within_budget();
  } catch (const std::exception& error) {
    spdlog::debug("what was derived is not kept: {}", error.what());
  }
}

void DiskCache::keep_within_budget() const {
  struct Entry {
    fs::path file;
    fs::file_time_type last_use;
    std::uintmax_t size;
  };
  std::vector<Entry> entries;
  std::uintmax_t total = 0;
  std::error_code error;
  for (const fs::directory_entry& found : fs::directory_iterator(folder_)) {
    if (found.is_symlink(error) || !found.is_regular_file(error)) {
      continue;
    }
    const std::uintmax_t size = found.file_size(error);
    const fs::file_time_type last_use = error ? fs::file_time_type() : found.last_write_time(error);
    if (!error) {  // else another process has removed it
      entries.push_back({found.path(), last_use, size});
      total += size;
    }
  }
  if (total <= budget_) {
    return;
  }
  std::ranges::sort(entries, {}, &Entry::last_use);
  const std::uintmax_t enough = budget_ - budget_ / 4;  // so as not to do this for every entry
  for (const Entry& entry : entries) {
    if (total <= enough) {
      return;
    }
    fs::remove(entry.file, error);
    total -= entry.size;
  }
}

}  // namespace handway::geometric
