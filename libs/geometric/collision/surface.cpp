#include "collision/surface.h"

#include "collision/volume_cache.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

namespace handway::geometric {
namespace {

constexpr double kLargestLeaf = 0.002;    // m: spheres that cover a body are this small at last, …
constexpr double kLeavesAcross = 120.0;   // … or this share of its size if that is more
constexpr std::size_t kCells = 1U << 14;  // of a field

double leaf_radius(const TriangleMesh& mesh) {
  return std::max(kLargestLeaf, bounding_box(mesh).size().norm() / kLeavesAcross);
}

/// The surfaces that something in this process holds.
class LivingSurfaces {
 public:
  std::shared_ptr<const Surface> find(const MeshKey& key) {
    const std::scoped_lock lock(mutex_);
    const auto found = surfaces_.find(key);
    return found == surfaces_.end() ? nullptr : found->second.lock();
  }

  void add(const MeshKey& key, const std::shared_ptr<const Surface>& surface) {
    const std::scoped_lock lock(mutex_);
    std::erase_if(surfaces_, [](const auto& entry) { return entry.second.expired(); });
    surfaces_[key] = surface;
  }

 private:
  std::mutex mutex_;
  std::map<MeshKey, std::weak_ptr<const Surface>> surfaces_;
};

LivingSurfaces& living_surfaces() {
  static LivingSurfaces surfaces;
  return surfaces;
}

std::shared_ptr<const Surface> make_surface(const MeshKey& key,
                                            const std::shared_ptr<const TriangleMesh>& mesh) {
  if (auto living = living_surfaces().find(key)) {
    return living;
  }
  BoxTree boxes(*mesh);
  std::optional<CachedVolumes> volumes = read_volumes(key);
  if (!volumes) {
    volumes.emplace(CachedVolumes{SphereCover(*mesh, leaf_radius(*mesh)),
                                  ClearanceField(*mesh, boxes, kCells)});
    write_volumes(key, *volumes);
  }
  auto surface = std::make_shared<const Surface>(Surface{
      mesh, std::move(boxes), std::move(volumes->cover), std::move(volumes->field)});
  living_surfaces().add(key, surface);
  return surface;
}

}  // namespace

std::vector<std::shared_ptr<const Surface>> make_surfaces(
    const std::vector<std::shared_ptr<const TriangleMesh>>& meshes) {
  std::vector<MeshKey> keys(meshes.size());
  tbb::parallel_for(std::size_t{0}, meshes.size(),
                    [&](std::size_t i) { keys[i] = mesh_key(*meshes[i]); });
  std::map<MeshKey, std::size_t> first_of;
  std::vector<std::size_t> different;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (first_of.emplace(keys[i], i).second) {
      different.push_back(i);
    }
  }
  std::vector<std::shared_ptr<const Surface>> surfaces(meshes.size());
  tbb::parallel_for(
      std::size_t{0}, different.size(),
      [&](std::size_t k) {
        const std::size_t i = different[k];
        surfaces[i] = make_surface(keys[i], meshes[i]);
      },
      tbb::simple_partitioner());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    surfaces[i] = surfaces[first_of.at(keys[i])];
  }
  return surfaces;
}

}  // namespace handway::geometric
