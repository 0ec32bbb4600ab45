#include "handway/geometric/setup/placing.h"

#include "handway/geometric/collision/collision_world.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace handway::geometric {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::optional<Pose> link_pose(const Scene& scene, const Configuration& q, std::string_view robot,
                              std::string_view link) {
  const RobotInstance* instance = find_robot(scene, robot);
  const auto index = instance ? instance->model->find_link(std::string(link)) : std::nullopt;
  if (!index) {
    return std::nullopt;
  }
  std::vector<Pose> X_BL(static_cast<std::size_t>(instance->model->link_count()));
  const bool is_first = instance == &scene.robots.front();
  instance->model->forward_kinematics(is_first ? q : instance->configuration, X_BL);
  return instance->X_WB * X_BL[static_cast<std::size_t>(*index)];
}

Pose object_pose(const Scene& scene, const Configuration& q, const SceneObject& object) {
  if (!object.attachment) {
    return object.X_PO;
  }
  const auto X_WL = link_pose(scene, q, object.attachment->robot, object.attachment->link);
  return X_WL ? *X_WL * object.X_PO : object.X_PO;
}

Pose in_parent(const Scene& scene, const Configuration& q, const SceneObject& object,
               const Pose& X_WO) {
  if (!object.attachment) {
    return X_WO;
  }
  const auto X_WL = link_pose(scene, q, object.attachment->robot, object.attachment->link);
  return X_WL ? X_WL->inverse() * X_WO : X_WO;
}

namespace {

Aabb box_of(const Scene& scene, const Configuration& q, const SceneObject& object) {
  return bounding_box(transformed(*tessellate(object.shape), object_pose(scene, q, object)));
}

}  // namespace

Aabb bounds(const Scene& scene, const Configuration& q, const std::vector<std::string>& names) {
  Aabb whole{Vector3d::Constant(HUGE_VAL), Vector3d::Constant(-HUGE_VAL)};
  for (const std::string& name : names) {
    if (const SceneObject* object = find_object(scene, name)) {
      const Aabb box = box_of(scene, q, *object);
      whole.lower = whole.lower.cwiseMin(box.lower);
      whole.upper = whole.upper.cwiseMax(box.upper);
    }
  }
  return whole;
}

namespace {

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Corners of a vertex, an edge or a triangle; in order of the least x.
template <std::size_t N>
struct Part {
  std::array<Vector3d, N> corners;
  Vector2d lower;
  Vector2d upper;

  explicit Part(const std::array<Vector3d, N>& points)
      : corners(points), lower(points[0].template head<2>()), upper(points[0].template head<2>()) {
    for (const Vector3d& p : points) {
      lower = lower.cwiseMin(p.head<2>());
      upper = upper.cwiseMax(p.head<2>());
    }
  }
  [[nodiscard]] bool overlaps(const Vector2d& from, const Vector2d& to) const {
    return (lower.array() <= to.array()).all() && (upper.array() >= from.array()).all();
  }
};

struct Parts {
  std::vector<Part<1>> vertices;
  std::vector<Part<2>> edges;
  std::vector<Part<3>> triangles;
};

template <std::size_t N>
void keep(std::vector<Part<N>>& parts, const Part<N>& part, const Aabb& region) {
  if (part.overlaps(region.lower.head<2>(), region.upper.head<2>())) {
    parts.push_back(part);
  }
}

template <std::size_t N>
void sort(std::vector<Part<N>>& parts) {
  std::ranges::sort(parts, {}, [](const Part<N>& part) { return part.lower.x(); });
}

// Returns the parts of the mesh in the region, seen from above.
Parts parts_in(const TriangleMesh& mesh, const Aabb& region) {
  Parts parts;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Vector3d& v : mesh.vertices) {
    keep(parts.vertices, Part<1>({v}), region);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    keep(parts.triangles, Part<3>({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}), region);
    for (const auto& edge : {std::minmax(a, b), std::minmax(b, c), std::minmax(c, a)}) {
      edges.emplace_back(edge.first, edge.second);
    }
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const auto& [a, b] : edges) {
    keep(parts.edges, Part<2>({mesh.vertices[a], mesh.vertices[b]}), region);
  }
  sort(parts.vertices);
  sort(parts.edges);
  sort(parts.triangles);
  return parts;
}

// Height of the triangle's plane above a point in it.
std::optional<double> height_at(const Part<3>& triangle, const Vector2d& p) {
  const auto& [a, b, c] = triangle.corners;
  const Vector2d ab = (b - a).head<2>(), ac = (c - a).head<2>(), ap = p - a.head<2>();
  const double area = cross(ab, ac);
  if (area == 0.0) {
    return std::nullopt;
  }
  const double v = cross(ap, ac) / area, w = cross(ab, ap) / area;
  if (v < 0.0 || w < 0.0 || v + w > 1.0) {
    return std::nullopt;
  }
  return a.z() + v * (b.z() - a.z()) + w * (c.z() - a.z());
}

class LeastGap {
 public:
  explicit LeastGap(double middle) : middle_(middle) {}

  void add(double upper, double lower) {
    if (lower <= middle_) {
      gap_ = std::min(gap_, upper - lower);
    }
  }
  void add_crossing(const Part<2>& upper, const Part<2>& lower) {
    const Vector2d u = (upper.corners[1] - upper.corners[0]).head<2>();
    const Vector2d l = (lower.corners[1] - lower.corners[0]).head<2>();
    const double turn = cross(u, l);
    if (turn == 0.0) {
      return;
    }
    const Vector2d between = (lower.corners[0] - upper.corners[0]).head<2>();
    const double s = cross(between, l) / turn, t = cross(between, u) / turn;
    if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) {
      add(upper.corners[0].z() + s * (upper.corners[1].z() - upper.corners[0].z()),
          lower.corners[0].z() + t * (lower.corners[1].z() - lower.corners[0].z()));
    }
  }
  [[nodiscard]] std::optional<double> value() const {
    return gap_ < std::numeric_limits<double>::infinity() ? std::optional(gap_) : std::nullopt;
  }

 private:
  double middle_;
  double gap_ = std::numeric_limits<double>::infinity();
};

// Calls `visit` for all pairs that overlap from above; both sorted.
template <std::size_t M, std::size_t N, typename Visit>
void for_overlapping(const std::vector<Part<M>>& first, const std::vector<Part<N>>& second,
                     const Visit& visit) {
  for (const Part<M>& a : first) {
    for (const Part<N>& b : second) {
      if (b.lower.x() > a.upper.x()) {
        break;
      }
      if (b.overlaps(a.lower, a.upper)) {
        visit(a, b);
      }
    }
  }
}

}  // namespace

std::optional<double> vertical_gap(const TriangleMesh& upper, const TriangleMesh& lower) {
  if (upper.empty() || lower.empty()) {
    return std::nullopt;
  }
  const Aabb above = bounding_box(upper), below = bounding_box(lower);
  const Aabb region{above.lower.cwiseMax(below.lower), above.upper.cwiseMin(below.upper)};
  if (region.lower.x() > region.upper.x() || region.lower.y() > region.upper.y()) {
    return std::nullopt;
  }
  const Parts a = parts_in(upper, region), b = parts_in(lower, region);
  LeastGap gap(above.centre().z());
  for_overlapping(a.vertices, b.triangles, [&](const Part<1>& vertex, const Part<3>& triangle) {
    const Vector3d& v = vertex.corners[0];
    if (const auto z = height_at(triangle, v.head<2>())) {
      gap.add(v.z(), *z);
    }
  });
  for_overlapping(b.vertices, a.triangles, [&](const Part<1>& vertex, const Part<3>& triangle) {
    const Vector3d& v = vertex.corners[0];
    if (const auto z = height_at(triangle, v.head<2>())) {
      gap.add(*z, v.z());
    }
  });
  for_overlapping(a.edges, b.edges,
                  [&](const Part<2>& u, const Part<2>& l) { gap.add_crossing(u, l); });
  return gap.value();
}

std::optional<double> gap_to_support(const Scene& scene, const SceneObject& object) {
  const TriangleMesh upper = transformed(*tessellate(object.shape), object.X_PO);
  std::optional<double> least;
  for (const SceneObject& other : scene.objects) {
    if (other.name == object.name || other.attachment) {
      continue;
    }
    const auto gap = vertical_gap(upper, transformed(*tessellate(other.shape), other.X_PO));
    if (gap && (!least || *gap < *least)) {
      least = gap;
    }
  }
  return least;
}

double height_above_floor(const SceneObject& object) {
  return bounding_box(transformed(*tessellate(object.shape), object.X_PO)).lower.z();
}

namespace {

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
