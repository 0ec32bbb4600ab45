#include "view3d/body_meshes.h"

#include "handway/geometric/collision/cache/bounding_volumes.h"
#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/mesh/convex_hull.h"
#include "model/meshes/shaded_meshes.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <utility>

namespace handway::gui {

using geometric::Pose;

namespace {

constexpr double kLargestSphere = 0.12;  // m: larger ones hide what they are of

using geometric::TriangleMesh;
using SharedMesh = std::shared_ptr<const TriangleMesh>;
using SharedModel = std::shared_ptr<const geometric::RobotModel>;

// A ball of radius 1 with few faces: points on a golden spiral.
const TriangleMesh& plain_ball() {
  constexpr int kPoints = 72;
  static const TriangleMesh kBall = [] {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < kPoints; ++i) {
      const double height = 1.0 - (2.0 * i + 1.0) / kPoints;
      const double angle = 2.0 * std::numbers::pi * i / std::numbers::phi;
      const double radius = std::sqrt(1.0 - height * height);
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
    }
    return geometric::convex_hull(points);
  }();
  return kBall;
}

TriangleMesh balls(const std::vector<geometric::CoveringSphere>& spheres) {
  TriangleMesh all;
  for (const geometric::CoveringSphere& sphere : spheres) {
    append(all, transformed(plain_ball(), geometric::Pose(Eigen::Translation3d(sphere.centre)),
                            Eigen::Vector3d::Constant(sphere.radius)));
  }
  return all;
}

// Returns the mesh that is drawn for a body with these triangles; null if it has none.
SharedMesh drawn(const SharedMesh& mesh, BodyDisplay display) {
  if (!mesh || mesh->empty()) {
    return nullptr;
  }
  SharedMesh made = mesh;
  if (display != BodyDisplay::kCollision) {
    geometric::BoundingVolumes volumes =
        geometric::bounding_volumes({mesh}, kLargestSphere).front();
    made = std::make_shared<const TriangleMesh>(
        display == BodyDisplay::kHulls ? std::move(volumes.hull) : balls(volumes.spheres));
  }
  static_cast<void>(shaded(made));
  return made;
}

/// Drawings that were made for the links of existing robots.
class LinkShop {
 public:
  std::vector<SharedMesh> meshes(const SharedModel& model, BodyDisplay display,
                                 const std::stop_token& stop) {
    const std::lock_guard lock(mutex_);
    std::erase_if(made_, [](const auto& entry) { return entry.first.first.expired(); });
    const auto found = made_.find(std::pair(std::weak_ptr(model), display));
    if (found != made_.end()) {
      return found->second;
    }
    std::vector<SharedMesh> meshes;
    for (int link = 0; link < model->link_count(); ++link) {
      if (stop.stop_requested()) {
        return {};
      }
      meshes.push_back(
          drawn(std::make_shared<const TriangleMesh>(collision_mesh(model->link(link))), display));
    }
    made_.emplace(std::pair(std::weak_ptr(model), display), meshes);
    return meshes;
  }

 private:
  using Key = std::pair<std::weak_ptr<const geometric::RobotModel>, BodyDisplay>;
  struct Less {
    bool operator()(const Key& a, const Key& b) const {
      const std::owner_less<> less;
      return less(a.first, b.first) || (!less(b.first, a.first) && a.second < b.second);
    }
  };

  std::mutex mutex_;
  std::map<Key, std::vector<SharedMesh>, Less> made_;
};

LinkShop& link_shop() {
  static LinkShop shop;
  return shop;
}

}  // namespace

BodyMeshes body_meshes(const geometric::Scene& scene, BodyDisplay display,
                       const std::stop_token& stop) {
  BodyMeshes meshes;
  if (display == BodyDisplay::kVisual) {
    return meshes;
  }
  for (const geometric::RobotInstance& robot : scene.robots) {
    meshes.links.push_back(link_shop().meshes(robot.model, display, stop));
  }
  for (const geometric::SceneObject& object : scene.objects) {
    if (stop.stop_requested()) {
      break;
    }
    if (auto mesh = drawn(geometric::tessellate(object.shape), display)) {
      meshes.objects.emplace(object.name, std::move(mesh));
    }
  }
  return meshes;
}

}  // namespace handway::gui
