#include "collision/volume_cache.h"

#include "collision/volume_archive.h"
#include "handway/geometric/io/replace_file.h"

#include <boost/crc.hpp>
#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMadeHow = "handway volumes 1";  // to change with what they are made of
constexpr std::size_t kMostFiles = 1000;

std::optional<fs::path> cache_folder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && *cache != '\0') {
    return fs::path(cache) / "handway" / "volumes";
  }
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home != '\0') {
    return fs::path(home) / ".cache" / "handway" / "volumes";
  }
  return std::nullopt;
}

fs::path file_of(const fs::path& folder, const MeshKey& key) {
  return folder / (to_string(key) + ".bin");
}

std::string checksum(std::string_view content) {
  boost::crc_32_type crc;
  crc.process_bytes(content.data(), content.size());
  const std::uint32_t sum = crc.checksum();
  std::string bytes(sizeof sum, '\0');
  std::memcpy(bytes.data(), &sum, sizeof sum);
  return bytes;
}

void remove_oldest(const fs::path& folder) {
  std::vector<fs::directory_entry> files{fs::directory_iterator(folder), {}};
  if (files.size() <= kMostFiles) {
    return;
  }
  std::ranges::sort(files, {}, [](const fs::directory_entry& file) {
    return file.last_write_time();
  });
  for (std::size_t i = 0; i < files.size() - kMostFiles / 2; ++i) {
    fs::remove(files[i]);
  }
}

}  // namespace

MeshKey mesh_key(const TriangleMesh& mesh) {
  std::string content(kMadeHow);
  const auto add = [&](const auto& elements) {
    content.append(reinterpret_cast<const char*>(elements.data()),
                   elements.size() * sizeof(elements[0]));
  };
  content += std::to_string(mesh.vertices.size());
  add(mesh.vertices);
  add(mesh.triangles);
  return boost::uuids::name_generator_sha1(boost::uuids::uuid{})(content.data(), content.size());
}

std::optional<CachedVolumes> read_volumes(const MeshKey& key) {
  const std::optional<fs::path> folder = cache_folder();
  std::ifstream file;
  if (folder) {
    file.open(file_of(*folder, key), std::ios::binary);
  }
  if (!file.is_open()) {
    return std::nullopt;
  }
  const std::string content(std::istreambuf_iterator<char>(file), {});
  constexpr std::size_t kSum = sizeof(std::uint32_t);
  if (content.size() < kSum ||
      checksum(std::string_view(content).substr(kSum)) != content.substr(0, kSum)) {
    return std::nullopt;
  }
  return unarchive_volumes(content.substr(kSum));
}

void write_volumes(const MeshKey& key, const CachedVolumes& volumes) {
  const std::optional<fs::path> folder = cache_folder();
  if (!folder) {
    return;
  }
  try {
    fs::create_directories(*folder);
    const std::string content = archive_volumes(volumes);
    replace_file(file_of(*folder, key), checksum(content) + content);
    remove_oldest(*folder);
  } catch (const std::exception& error) {
    spdlog::debug("collision volumes are not cached: {}", error.what());
  }
}

}  // namespace handway::geometric
