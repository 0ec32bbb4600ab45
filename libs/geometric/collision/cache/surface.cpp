#include "collision/cache/surface.h"

#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/binary_object.hpp>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <sstream>
#include <utility>

namespace handway::geometric {
/// Reads and writes the members of volumes.
class VolumeArchive {
 public:
  template <typename Archive, typename Cover>
  static void cover(Archive& archive, Cover& cover) {
    plain(archive, cover.root_);
    list(archive, cover.nodes_);
    list(archive, cover.leaves_);
    list(archive, cover.triangles_);
  }

  template <typename Archive, typename Hull>
  static void hull(Archive& archive, Hull& hull) {
    plain(archive, hull.middle_);
    plain(archive, hull.lower_);
    plain(archive, hull.upper_);
    plain(archive, hull.margin_);
    plain(archive, hull.count_);
    list(archive, hull.x_);
    list(archive, hull.y_);
    list(archive, hull.z_);
  }

  template <typename Archive, typename Field>
  static void field(Archive& archive, Field& field) {
    plain(archive, field.centre_);
    plain(archive, field.half_);
    plain(archive, field.origin_);
    plain(archive, field.side_);
    plain(archive, field.per_cell_);
    plain(archive, field.counts_);
    list(archive, field.cells_);
    list(archive, field.blocks_);
  }

  template <typename Archive>
  static void balls(Archive& archive, std::vector<InnerBall>& balls) {
    list(archive, balls);
  }

 private:
  template <typename Archive, typename Value>
  static void plain(Archive& archive, Value& value) {
    bytes(archive, &value, sizeof value);
  }

  template <typename Archive, typename Element>
  static void list(Archive& archive, std::vector<Element>& elements) {
    std::size_t count = elements.size();
    archive& count;
    elements.resize(count);
    bytes(archive, elements.data(), count * sizeof(Element));
  }

  template <typename Archive>
  static void bytes(Archive& archive, void* data, std::size_t size) {
    auto object = boost::serialization::make_binary_object(data, size);
    archive& object;
  }
};

std::string archive_layout() {
  constexpr int kRevision = 22;  // to change with what volumes are made of
  return fmt::format("volumes {}, {} {} {}", kRevision, sizeof(SphereTree::Node),
                     sizeof(DistanceField::Cell), sizeof(TriangleBlock));
}

std::string archive_volumes(const MeshVolumes& volumes) {
  std::ostringstream stream(std::ios::binary);
  boost::archive::binary_oarchive archive(stream, boost::archive::no_header);
  MeshVolumes copy = volumes;  // archives want what they could also write to
  VolumeArchive::cover(archive, copy.cover);
  VolumeArchive::hull(archive, copy.hull);
  VolumeArchive::field(archive, copy.field);
  VolumeArchive::balls(archive, copy.balls);
  return stream.str();
}

MeshVolumes unarchive_volumes(const std::string& bytes) {
  std::istringstream stream(bytes, std::ios::binary);
  boost::archive::binary_iarchive archive(stream, boost::archive::no_header);
  MeshVolumes volumes;
  VolumeArchive::cover(archive, volumes.cover);
  VolumeArchive::hull(archive, volumes.hull);
  VolumeArchive::field(archive, volumes.field);
  VolumeArchive::balls(archive, volumes.balls);
  return volumes;
}

namespace {

constexpr double kSmallestLeaf = 0.002;   // m: spheres are split until they are this small, …
constexpr double kMostLeaves = 5000.0;    // … or as small as makes about so many
constexpr double kHullMargin = 0.0002;    // share of the size
constexpr std::size_t kCells = 1U << 12;  // cells of a field, …
constexpr std::size_t kCellsOfPlain = 1U << 16;  // … and where they are soon made,
constexpr std::size_t kPlain = 200;              // meshes with fewer triangles
constexpr std::size_t kLarge = 100'000;  // triangles: of more, volumes grow where queries come

CacheKey key_of(const TriangleMesh& mesh) {
  std::string content = std::to_string(mesh.vertices.size());
  const auto add = [&](const auto& elements) {
    content.append(reinterpret_cast<const char*>(elements.data()),
                   elements.size() * sizeof(elements[0]));
  };
  add(mesh.vertices);
  add(mesh.triangles);
  return cache_key(archive_layout(), content);
}

double leaf_radius(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d& p = mesh.vertices[a];
    area += 0.5 * (mesh.vertices[b] - p).cross(mesh.vertices[c] - p).norm();
  }
  return std::max(kSmallestLeaf, std::sqrt(area / (2.0 * kMostLeaves)));
}

/// The surfaces in use in this process.
class LivingSurfaces {
 public:
  std::shared_ptr<const Surface> find(const CacheKey& key) {
    const std::scoped_lock lock(mutex_);
    const auto found = surfaces_.find(key);
    return found == surfaces_.end() ? nullptr : found->second.lock();
  }

  void add(const CacheKey& key, const std::shared_ptr<const Surface>& surface) {
    const std::scoped_lock lock(mutex_);
    if (surfaces_.size() >= enough_) {  // seldom: scenes have thousands
      std::erase_if(surfaces_, [](const auto& entry) { return entry.second.expired(); });
      enough_ = std::max(kFew, 2 * surfaces_.size());
    }
    surfaces_[key] = surface;
  }

 private:
  static constexpr std::size_t kFew = 64;

  std::mutex mutex_;
  std::map<CacheKey, std::weak_ptr<const Surface>> surfaces_;
  std::size_t enough_ = kFew;  ///< Number of entries at which unused ones are removed.
};

LivingSurfaces& living_surfaces() {
  static LivingSurfaces surfaces;
  return surfaces;
}

std::size_t cells_for(const TriangleMesh& mesh) {
  return mesh.triangles.size() < kPlain ? kCellsOfPlain : kCells;
}

double hull_margin(const SphereTree& cover) {
  return kHullMargin * static_cast<double>(cover.root().radius);
}

OnDemand<TriangleTree> tree_of(const std::shared_ptr<const TriangleMesh>& mesh) {
  return OnDemand<TriangleTree>([mesh] { return TriangleTree(*mesh); });
}

MeshVolumes make_volumes(const TriangleMesh& mesh, const OnDemand<TriangleTree>& triangles,
                         const std::stop_token& stop) {
  end_if_stopped(stop);
  MeshVolumes volumes;
  volumes.cover = SphereTree(mesh, leaf_radius(mesh));
  end_if_stopped(stop);
  volumes.hull = ConvexCover(mesh, hull_margin(volumes.cover));
  volumes.field = DistanceField(mesh, *triangles, cells_for(mesh), stop);
  end_if_stopped(stop);
  volumes.balls = inner_balls(mesh, *triangles);
  return volumes;
}

// Loads the volumes from the cache, or adds them to it. Meshes that are being edited are not added:
// a drag would leave an entry behind for every size.
MeshVolumes volumes_of(const CacheKey& key, const TriangleMesh& mesh,
                       const OnDemand<TriangleTree>& triangles, const Preparation& preparation) {
  const DiskCache cache = DiskCache::of_user();
  if (std::optional<MeshVolumes> known = cache.read_as(key, unarchive_volumes)) {
    return *std::move(known);
  }
  MeshVolumes volumes = make_volumes(mesh, triangles, preparation.stop);
  if (preparation.keeps_volumes) {
    cache.write(key, archive_volumes(volumes));
  }
  return volumes;
}

Surface surface_of_primitive(const CacheKey& key, const std::shared_ptr<const TriangleMesh>& mesh,
                             const PrimitiveDistance& primitive) {
  const SphereTree cover = SphereTree::growing(mesh, leaf_radius(*mesh));
  const OnDemand<TriangleTree> triangles = tree_of(mesh);
  const double margin = hull_margin(cover);
  return {key,
          mesh,
          cover,
          DistanceField(primitive),
          triangles,
          OnDemand<ConvexCover>([mesh, margin] { return ConvexCover(*mesh, margin); }),
          OnDemand<std::vector<InnerBall>>(
              [mesh, triangles] { return inner_balls(*mesh, *triangles); })};
}

// Its hull is the box around it, and no balls are sought in it: better ones take long.
Surface surface_of_large_mesh(const CacheKey& key,
                              const std::shared_ptr<const TriangleMesh>& mesh) {
  const OnDemand<TriangleTree> triangles = tree_of(mesh);
  const Aabb box = bounding_box(*mesh);
  const TriangleMesh around =
      transformed(*tessellate(Box{box.size()}), Pose(Eigen::Translation3d(box.centre())));
  return {key,
          mesh,
          SphereTree::growing(mesh, leaf_radius(*mesh)),
          DistanceField::growing(mesh, triangles),
          triangles,
          OnDemand<ConvexCover>([around] { return ConvexCover(around, 0.0); }),
          OnDemand<std::vector<InnerBall>>(std::vector<InnerBall>())};
}

Surface surface_of_mesh(const CacheKey& key, const std::shared_ptr<const TriangleMesh>& mesh,
                        const Preparation& preparation) {
  const OnDemand<TriangleTree> triangles = tree_of(mesh);
  MeshVolumes volumes = volumes_of(key, *mesh, triangles, preparation);
  triangles.make();  // here, where all processors are at work: else the first plan waits for it
  return {key,
          mesh,
          std::move(volumes.cover),
          std::move(volumes.field),
          triangles,
          OnDemand<ConvexCover>(std::move(volumes.hull)),
          OnDemand<std::vector<InnerBall>>(std::move(volumes.balls))};
}

Surface surface_of(const CacheKey& key, const std::shared_ptr<const TriangleMesh>& mesh,
                   const Preparation& preparation) {
  if (const auto primitive = PrimitiveDistance::of(*mesh)) {
    return surface_of_primitive(key, mesh, *primitive);
  }
  return mesh->triangles.size() > kLarge ? surface_of_large_mesh(key, mesh)
                                         : surface_of_mesh(key, mesh, preparation);
}

std::shared_ptr<const Surface> make_surface(const CacheKey& key,
                                            const std::shared_ptr<const TriangleMesh>& mesh,
                                            const Preparation& preparation) {
  if (auto living = living_surfaces().find(key)) {
    return living;
  }
  auto surface = std::make_shared<const Surface>(surface_of(key, mesh, preparation));
  living_surfaces().add(key, surface);
  return surface;
}

}  // namespace

std::vector<std::shared_ptr<const Surface>> make_surfaces(
    const std::vector<std::shared_ptr<const TriangleMesh>>& meshes,
    const Preparation& preparation) {
  std::vector<CacheKey> keys(meshes.size());
  tbb::parallel_for(std::size_t{0}, meshes.size(),
                    [&](std::size_t i) { keys[i] = key_of(*meshes[i]); });
  std::map<CacheKey, std::size_t> first_of;
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
        surfaces[i] = make_surface(keys[i], meshes[i], preparation);
      },
      tbb::simple_partitioner());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    surfaces[i] = surfaces[first_of.at(keys[i])];
  }
  return surfaces;
}

}  // namespace handway::geometric
