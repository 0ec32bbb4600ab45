#include "handway/geometric/setup/cloud_filters.h"

#include "collision/volumes/solid.h"
#include "collision/volumes/triangle_tree.h"
#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/io/input_error.h"
#include "setup/point_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace handway::geometric {
namespace {

// Mean distance (m) of each point from its nearest ones.
std::vector<double> neighbour_distances(const PointCloud& cloud, std::size_t neighbours) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(cloud.size());
  for (const Eigen::Vector3f& point : cloud.points) {
    points.push_back(point.cast<double>());
  }
  const PointTree tree(points);
  std::vector<double> distances(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    double sum = 0.0;
    for (const std::uint32_t near : tree.nearest(points[i], neighbours + 1)) {  // one is itself
      sum += (points[near] - points[i]).norm();
    }
    distances[i] = sum / static_cast<double>(neighbours);
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

std::vector<FilteredBody> filtered_bodies(const CollisionWorld& world, const Scene& scene,
                                          const Configuration& q, const BodyFilter& filter) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(world.model().link_count()));
  std::vector<Pose> X_WBody(world.bodies().size());
  world.place(q, X_BL, X_WBody);
  std::vector<FilteredBody> bodies;
  for (std::size_t i = 0; i < world.bodies().size(); ++i) {
    const CollisionBody& body = world.bodies()[i];
    const bool is_object = !body.moves() && find_object(scene, body.name) != nullptr;
    const bool is_filtered =
        is_object ? std::ranges::count(filter.objects, body.name) > 0 : filter.robots;
    if (is_filtered && body.mesh && !body.mesh->empty()) {
      bodies.emplace_back(body, X_WBody[i], filter.margin);
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
  const double most = std::max(mean + rule.deviations * std::sqrt(squares / count), 2.0 * mean);
  return points_where(cloud, [&](std::size_t i) { return distances[i] <= most; });
}

PointCloud without_bodies(const PointCloud& cloud, const Pose& X_WC, const Scene& scene,
                          const Configuration& q, const BodyFilter& filter) {
  for (const std::string& name : filter.objects) {
    if (find_object(scene, name) == nullptr) {
      throw InputError({scene.file.string(), "objects", "no object \"" + name + '"',
                        "an object of the scene", ""});
    }
  }
  if (!filter.robots && filter.objects.empty()) {
    return cloud;
  }
  const CollisionWorld world(scene);
  const std::vector<FilteredBody> bodies = filtered_bodies(world, scene, q, filter);
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
