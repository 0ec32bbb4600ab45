#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/setup/placing.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

using Corners = std::array<Vector3d, 3>;

constexpr double kRoomAround = 5e-3;      // m, between what is new and what is beside it
constexpr double kLeastStep = 0.02;       // m, between places that are tried
constexpr double kOnSupport = 2e-3;       // m
constexpr double kSameLevelWithin = 1.0;  // m: farther away any height will do
constexpr double kMiddlePart = 0.5;       // share of a box
constexpr double kGrowth = 1.08;          // factor of the rings

bool overlap(const Aabb& a, const Aabb& b) {
  return (a.lower.array() <= b.upper.array()).all() && (b.lower.array() <= a.upper.array()).all();
}

// By separating axes (Gottschalk, Lin and Manocha, SIGGRAPH 1996): those of the box, the
// triangle's normal, and the products of their edges.
bool touches(const Aabb& box, const Corners& triangle) {
  const Vector3d centre = box.centre(), half = 0.5 * box.size();
  const Corners p{triangle[0] - centre, triangle[1] - centre, triangle[2] - centre};
  const Corners edges{p[1] - p[0], p[2] - p[1], p[0] - p[2]};
  const auto apart = [&](const Vector3d& axis) {
    const auto [least, most] = std::minmax({axis.dot(p[0]), axis.dot(p[1]), axis.dot(p[2])});
    const double reach = half.dot(axis.cwiseAbs());
    return least > reach || most < -reach;
  };
  for (int i = 0; i < 3; ++i) {
    if (apart(Vector3d::Unit(i))) {
      return false;
    }
  }
  for (int i = 0; i < 3; ++i) {
    for (const Vector3d& edge : edges) {
      if (apart(Vector3d::Unit(i).cross(edge))) {
        return false;
      }
    }
  }
  return !apart(edges[0].cross(edges[1]));
}

// Returns whether a ray upwards from the point goes through the triangle.
bool is_below(const Vector3d& point, const Corners& triangle) {
  const Vector3d a = triangle[0] - point, b = triangle[1] - point, c = triangle[2] - point;
  const auto side = [](const Vector3d& u, const Vector3d& v) {
    return u.x() * v.y() - u.y() * v.x() >= 0.0;
  };
  if (side(a, b) != side(b, c) || side(b, c) != side(c, a)) {
    return false;
  }
  const Vector3d normal = (b - a).cross(c - a);
  return normal.z() != 0.0 && normal.dot(a) / normal.z() > 0.0;
}

// A point in the box, but not on the diagonals of other boxes' faces.
Vector3d off_the_middle(const Aabb& box) {
  return box.lower + Vector3d(0.487, 0.521, 0.5).cwiseProduct(box.size());
}

/// Obstacle for a placement, in the world.
class Obstacle {
 public:
  Obstacle(TriangleMesh mesh, bool is_solid)
      : mesh_(std::move(mesh)), box_(bounding_box(mesh_)), is_solid_(is_solid) {}

  [[nodiscard]] bool is_in(const Aabb& box) const {
    return overlap(box, box_) &&
           (std::ranges::any_of(mesh_.triangles,
                                [&](const auto& t) { return touches(box, corners_of(t)); }) ||
            (is_solid_ && is_inside(off_the_middle(box))));
  }

 private:
  [[nodiscard]] Corners corners_of(const std::array<std::uint32_t, 3>& triangle) const {
    return {mesh_.vertices[triangle[0]], mesh_.vertices[triangle[1]], mesh_.vertices[triangle[2]]};
  }
  // Returns whether the point is in one of its pieces, regardless of the other pieces.
  [[nodiscard]] bool is_inside(const Vector3d& point) const {
    std::vector<std::uint32_t> above;  // a vertex of each triangle
    for (const auto& triangle : mesh_.triangles) {
      if (is_below(point, corners_of(triangle))) {
        above.push_back(triangle[0]);
      }
    }
    if (above.empty()) {
      return false;
    }
    const std::vector<std::uint32_t> pieces = piece_numbers(mesh_);
    std::map<std::uint32_t, int> crossings;
    for (const std::uint32_t vertex : above) {
      ++crossings[pieces[vertex]];
    }
    return std::ranges::any_of(crossings, [](const auto& piece) { return piece.second % 2 == 1; });
  }

  TriangleMesh mesh_;
  Aabb box_;
  bool is_solid_;
};

void add_robot(std::vector<Obstacle>& obstacles, const RobotInstance& robot,
               const Configuration& q) {
  const RobotModel& model = *robot.model;
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(q, X_BL);
  for (int i = 0; i < model.link_count(); ++i) {
    const TriangleMesh mesh = collision_mesh(model.link(i));
    if (!mesh.empty()) {
      obstacles.emplace_back(transformed(mesh, robot.X_WB * X_BL[static_cast<std::size_t>(i)]),
                             true);
    }
  }
}

std::vector<Obstacle> obstacles_of(const Scene& scene, const Configuration& q) {
  std::vector<Obstacle> obstacles;
  for (const SceneObject& object : scene.objects) {
    const TriangleMesh mesh = *tessellate(object.shape);
    if (!mesh.empty()) {
      obstacles.emplace_back(transformed(mesh, object_pose(scene, q, object)), object.solid);
    }
  }
  for (const RobotInstance& robot : scene.robots) {
    const bool is_first = &robot == &scene.robots.front();
    add_robot(obstacles, robot, is_first ? q : robot.configuration);
    for (const auto& posture : {scene.start, scene.goal}) {
      if (is_first && posture && *posture != q) {
        add_robot(obstacles, robot, *posture);
      }
    }
  }
  return obstacles;
}

// Rounds along x and y to values that a user would type.
Vector3d rounded(const Vector3d& place) {
  constexpr double kGrid = 5e-3;  // m
  return {std::round(place.x() / kGrid) * kGrid, std::round(place.y() / kGrid) * kGrid, place.z()};
}

class FreeFoot {
 public:
  /// @param falls whether the box drops onto its support.
  FreeFoot(const Scene& scene, const Configuration& q, const Vector3d& size, bool falls)
      : scene_(scene), size_(size), falls_(falls), obstacles_(obstacles_of(scene, q)) {}

  [[nodiscard]] Vector3d beside(const Vector3d& wanted) const {
    const double step = std::max(kLeastStep, 0.25 * size_.head<2>().maxCoeff());
    std::optional<Vector3d> lower;
    for (double radius = 0.0; true; radius = std::max(radius + step, kGrowth * radius)) {
      if (lower && radius > kSameLevelWithin) {
        return *lower;
      }
      const int count = radius == 0.0 ? 1 : static_cast<int>(2 * std::numbers::pi * radius / step);
      for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / count;
        const Vector3d foot =
            wanted + rounded(radius * Vector3d(std::cos(angle), std::sin(angle), 0.0));
        if (const auto place = standing_at(foot)) {
          if (foot.z() - place->z() < kOnSupport) {
            return *place;
          }
          lower = lower ? lower : place;
        }
      }
    }
  }

 private:
  // The place, or its place after dropping, if both are free.
  [[nodiscard]] std::optional<Vector3d> standing_at(Vector3d foot) const {
    foot.z() += falls_ ? kRestingGap : 0.0;
    if (!is_free(foot) || !falls_) {
      return is_free(foot) ? std::optional(foot) : std::nullopt;
    }
    const double fall = height_above_support(foot, size_);
    // A corner alone is no support.
    if (std::abs(height_above_support(foot, kMiddlePart * size_) - fall) > kOnSupport) {
      return std::nullopt;
    }
    foot.z() -= fall;
    return is_free(foot) ? std::optional(foot) : std::nullopt;
  }
  /// Drop of a box until it comes to rest, m; kRestingGap without a body or the floor below.
  [[nodiscard]] double height_above_support(const Vector3d& foot, const Vector3d& size) const {
    SceneObject stand_in;
    stand_in.shape = Box{size};
    stand_in.X_PO.translation() = foot + 0.5 * size.z() * Vector3d::UnitZ();
    double height = foot.z() > 0.0 ? foot.z() : HUGE_VAL;
    if (const auto gap = gap_to_support(scene_, stand_in)) {
      height = std::min(height, *gap - kRestingGap);
    }
    return std::isfinite(height) ? height : kRestingGap;
  }
  [[nodiscard]] bool is_free(const Vector3d& foot) const {
    const Vector3d half(0.5 * size_.x() + kRoomAround, 0.5 * size_.y() + kRoomAround, 0.0);
    const Aabb box{foot - half + 0.5 * kRestingGap * Vector3d::UnitZ(),
                   foot + half + (size_.z() + kRoomAround) * Vector3d::UnitZ()};
    return std::ranges::none_of(obstacles_, [&](const Obstacle& o) { return o.is_in(box); });
  }

  const Scene& scene_;
  Vector3d size_;
  bool falls_;
  std::vector<Obstacle> obstacles_;
};

bool stands(const Scene& scene, const SceneObject& object) {
  return !object.attachment &&
         (std::abs(height_above_floor(object)) < kOnSupport ||
          std::abs(gap_to_support(scene, object).value_or(HUGE_VAL)) < kOnSupport);
}

}  // namespace

Vector3d free_foot(const Scene& scene, const Configuration& q, const Vector3d& size,
                   const Vector3d& wanted) {
  return FreeFoot(scene, q, size, true).beside(rounded(wanted));
}

Pose motion_into_free(const Scene& scene, const Configuration& q, const Scene& added,
                      const std::vector<std::string>& names) {
  const Aabb box = bounds(added, q, names);
  const Vector3d foot(box.centre().x(), box.centre().y(), box.lower.z());
  const bool falls = std::ranges::any_of(
      names, [&](const std::string& name) { return stands(scene, *find_object(added, name)); });
  return Pose(Eigen::Translation3d(FreeFoot(scene, q, box.size(), falls).beside(foot) - foot));
}

}  // namespace handway::geometric
