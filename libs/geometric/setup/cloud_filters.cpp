#include "handway/geometric/setup/cloud_filters.h"

#include "collision/volumes/solid.h"
#include "collision/volumes/triangle_tree.h"
#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/io/input_error.h"

#include <nanoflann.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace handway::geometric {
namespace {

/// Points as nanoflann reads them.
struct PointColumns {
  const std::vector<Eigen::Vector3f>& points;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] float kdtree_get_pt(std::size_t point, std::size_t axis) const {
    return points[point][static_cast<Eigen::Index>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
};

using PointTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, PointColumns>,
                                        PointColumns, 3, std::uint32_t>;

// Mean distance (m) of each point from its nearest ones.
std::vector<double> neighbour_distances(const PointCloud& cloud, std::size_t neighbours) {
  const PointColumns columns{cloud.points};
  const PointTree tree(3, columns, nanoflann::KDTreeSingleIndexAdaptorParams(16));
  std::vector<double> distances(cloud.size());
  tbb::parallel_for(std::size_t{0}, cloud.size(), [&](std::size_t i) {
    std::vector<std::uint32_t> indices(neighbours + 1);
    std::vector<float> squared(neighbours + 1);
    const std::size_t found =
        tree.knnSearch(cloud.points[i].data(), neighbours + 1, indices.data(), squared.data());
    double sum = 0.0;
    for (std::size_t k = 1; k < found; ++k) {  // the first one is the point itself
      sum += std::sqrt(static_cast<double>(squared[k]));
    }
    distances[i] = sum / static_cast<double>(std::max<std::size_t>(found - 1, 1));
  });
  return distances;
}

/// A body of a scene, for tests of points.
class FilteredBody {
 public:
  FilteredBody(const CollisionBody& body, const Pose& X_WBody, double margin)
      : body_(body),
        X_BodyW_(X_WBody.inverse()),
        margin_(margin),
        box_(bounding_box(*body.mesh)),
        tree_(*body.mesh) {
    box_.lower.array() -= margin;
    box_.upper.array() += margin;
  }

  [[nodiscard]] bool has(const Eigen::Vector3d& p_W) const {
    const Eigen::Vector3d p = X_BodyW_ * p_W;
    return (p.array() >= box_.lower.array()).all() && (p.array() <= box_.upper.array()).all() &&
           (tree_.is_nearer_than(p, margin_) || body_.solids->contains(p));
  }

 private:
  const CollisionBody& body_;
  Pose X_BodyW_;
  double margin_;
  Aabb box_;
  TriangleTree tree_;
};

// Links of robots, what they carry, and the named objects.
std::vector<FilteredBody> filtered_bodies(const CollisionWorld& world, const Scene& scene,
                                          const Configuration& q,
                                          std::span<const std::string> objects, double margin) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(world.model().link_count()));
  std::vector<Pose> X_WBody(world.bodies().size());
  world.place(q, X_BL, X_WBody);
  std::vector<FilteredBody> bodies;
  for (std::size_t i = 0; i < world.bodies().size(); ++i) {
    const CollisionBody& body = world.bodies()[i];
    const bool is_object = !body.moves() && find_object(scene, body.name) != nullptr;
    if (body.mesh && !body.mesh->empty() &&
        (!is_object || std::ranges::count(objects, body.name) > 0)) {
      bodies.emplace_back(body, X_WBody[i], margin);
    }
  }
  return bodies;
}

}  // namespace

PointCloud without_outliers(const PointCloud& cloud, const OutlierRule& rule) {
  const auto neighbours = static_cast<std::size_t>(std::max(rule.neighbours, 1));
  if (cloud.size() <= neighbours) {
    return cloud;
  }
  const std::vector<double> distances = neighbour_distances(cloud, neighbours);
  const auto count = static_cast<double>(distances.size());
  const double mean = std::accumulate(distances.begin(), distances.end(), 0.0) / count;
  double squares = 0.0;
  for (const double distance : distances) {
    squares += (distance - mean) * (distance - mean);
  }
  const double most = mean + rule.deviations * std::sqrt(squares / count);
  return points_where(cloud, [&](std::size_t i) { return distances[i] <= most; });
}

PointCloud without_bodies(const PointCloud& cloud, const Pose& X_WC, const Scene& scene,
                          const Configuration& q, std::span<const std::string> objects,
                          double margin) {
  for (const std::string& name : objects) {
    if (find_object(scene, name) == nullptr) {
      throw InputError({scene.file.string(), "objects", "no object \"" + name + '"',
                        "an object of the scene", ""});
    }
  }
  const CollisionWorld world(scene);
  const std::vector<FilteredBody> bodies = filtered_bodies(world, scene, q, objects, margin);
  std::vector<char> is_kept(cloud.size());
  tbb::parallel_for(std::size_t{0}, cloud.size(), [&](std::size_t i) {
    const Eigen::Vector3d p_W = X_WC * cloud.points[i].cast<double>();
    is_kept[i] =
        std::ranges::none_of(bodies, [&](const FilteredBody& body) { return body.has(p_W); });
  });
  return points_where(cloud, [&](std::size_t i) { return is_kept[i] != 0; });
}

PointCloud within_box(const PointCloud& cloud, const Pose& X_WC, const Aabb& box) {
  return points_where(cloud, [&](std::size_t i) {
    const Eigen::Vector3d p_W = X_WC * cloud.points[i].cast<double>();
    return (p_W.array() >= box.lower.array()).all() && (p_W.array() <= box.upper.array()).all();
  });
}

}  // namespace handway::geometric
