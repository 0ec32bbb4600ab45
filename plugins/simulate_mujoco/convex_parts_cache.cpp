#include "convex_parts.h"
#include "handway/geometric/io/disk_cache.h"

#include <cstddef>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace handway::simulate_mujoco {
namespace {

using geometric::TriangleMesh;

// To change with the bytes of an entry, and with what convex_parts() makes of a mesh.
constexpr std::string_view kLayout = "convex parts 1";

template <typename Value>
void append(std::span<const Value> values, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

std::string content_of(const TriangleMesh& mesh, const ConvexPartsLimits& limits) {
  std::string bytes;
  append(std::span<const double>(&limits.depth, 1), bytes);
  append(std::span<const int>(&limits.most, 1), bytes);
  append(std::span<const Eigen::Vector3d>(mesh.vertices), bytes);
  append(std::span(mesh.triangles), bytes);
  return bytes;
}

// An entry has the volume of each part, the number of its corners, and the corners.
std::string bytes_of(const std::vector<ConvexPart>& parts) {
  std::vector<double> numbers;
  for (const ConvexPart& part : parts) {
    numbers.push_back(part.volume);
    numbers.push_back(static_cast<double>(part.corners.size()));
    for (const Eigen::Vector3d& corner : part.corners) {
      numbers.insert(numbers.end(), corner.begin(), corner.end());
    }
  }
  std::string bytes;
  append(std::span<const double>(numbers), bytes);
  return bytes;
}

std::vector<ConvexPart> parts_of(const std::string& bytes) {
  std::vector<double> numbers(bytes.size() / sizeof(double));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(double));
  std::span<const double> left = numbers;
  const auto take = [&left](std::size_t count) {
    if (count > left.size()) {
      throw std::runtime_error("an entry of the cache is too short");
    }
    const std::span<const double> taken = left.first(count);
    left = left.subspan(count);
    return taken;
  };
  std::vector<ConvexPart> parts;
  while (!left.empty()) {
    const std::span<const double> head = take(2);
    ConvexPart part{{}, head[0]};
    const std::span<const double> corners = take(3 * static_cast<std::size_t>(head[1]));
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      part.corners.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace

std::vector<ConvexPart> cached_convex_parts(const TriangleMesh& mesh,
                                            const ConvexPartsLimits& limits) {
  const geometric::DiskCache cache = geometric::DiskCache::of_user();
  const geometric::CacheKey key = geometric::cache_key(kLayout, content_of(mesh, limits));
  if (auto known = cache.read_as(key, parts_of)) {
    return std::move(*known);
  }
  std::vector<ConvexPart> parts = convex_parts(mesh, limits);
  cache.write(key, bytes_of(parts));
  return parts;
}

}  // namespace handway::simulate_mujoco
