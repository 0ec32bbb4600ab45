#include "handway/planning/tasks/resting_places.h"

#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/setup/placing.h"
#include "handway/planning/edits/scene_edits.h"
#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace handway::planning {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometric::Pose;

constexpr double kLeastRise = 0.985;  // of a normal: faces steeper than 10° are not stood on
constexpr double kLevel = 1e-3;       // m: what is that near to the underside belongs to it
constexpr int kTriesForEach = 40;

using Triangle = std::array<Vector3d, 3>;

double area_of(const Triangle& t) { return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm(); }

/// The faces of an object that look upwards, in the world.
class UpwardFaces {
 public:
  explicit UpwardFaces(const geometric::SceneObject& object) {
    const auto mesh = geometric::tessellate(object.shape);
    double sum = 0.0;
    for (const auto& corners : mesh->triangles) {
      Triangle t;
      for (std::size_t k = 0; k < 3; ++k) {
        t[k] = object.X_PO * mesh->vertices[static_cast<std::size_t>(corners[k])];
      }
      const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
      if (normal.z() > kLeastRise * normal.norm()) {
        sum += area_of(t);
        triangles_.push_back(t);
        sums_.push_back(sum);
      }
    }
  }

  [[nodiscard]] bool empty() const { return triangles_.empty(); }

  /// Returns a point anywhere on the faces.
  [[nodiscard]] Vector3d draw(sampling::RandomStream& random) const {
    const double at = random.uniform() * sums_.back();
    const auto found = std::ranges::upper_bound(sums_, at);
    const std::ptrdiff_t index = std::min(found - sums_.begin(), std::ssize(sums_) - 1);
    const Triangle& t = triangles_[static_cast<std::size_t>(index)];
    double u = random.uniform();
    double v = random.uniform();
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
  }

  /// Returns whether a face is below the point, at most kLevel from `z`.
  [[nodiscard]] bool is_below(const Vector2d& p, double z) const {
    return std::ranges::any_of(triangles_, [&](const Triangle& t) {
      const auto height = height_at(t, p);
      return height && std::abs(*height - z) <= kLevel;
    });
  }

 private:
  // The height of the triangle's plane at p; nothing beside the triangle.
  static std::optional<double> height_at(const Triangle& t, const Vector2d& p) {
    const Vector2d a = t[0].head<2>();
    const Vector2d u = t[1].head<2>() - a;
    const Vector2d v = t[2].head<2>() - a;
    const double cross = u.x() * v.y() - u.y() * v.x();
    if (cross == 0.0) {
      return std::nullopt;
    }
    constexpr double kRounding = 1e-9;
    const Vector2d d = p - a;
    const double s = (d.x() * v.y() - d.y() * v.x()) / cross;
    const double r = (u.x() * d.y() - u.y() * d.x()) / cross;
    if (s < -kRounding || r < -kRounding || s + r > 1.0 + kRounding) {
      return std::nullopt;
    }
    return t[0].z() + s * (t[1].z() - t[0].z()) + r * (t[2].z() - t[0].z());
  }

  std::vector<Triangle> triangles_;
  std::vector<double> sums_;  ///< Sums of the areas up to each triangle.
};

// The corners of the underside of an object in some orientation, relative to the middle of the
// underside of its bounding box; shape [corners][x, y].
struct Underside {
  std::vector<Vector2d> corners;
  Vector3d middle;  ///< From the object's origin.
};

Underside underside(const std::vector<Vector3d>& vertices, const Eigen::Matrix3d& R_WO) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : vertices) {
    box.extend(R_WO * p);
  }
  Underside side{{}, {box.center().x(), box.center().y(), box.min().z()}};
  for (const Vector3d& p : vertices) {
    const Vector3d q = R_WO * p - side.middle;
    if (q.z() <= kLevel) {
      side.corners.emplace_back(q.head<2>());
    }
  }
  return side;
}

}  // namespace

std::vector<Pose> resting_places(const geometric::Scene& scene,
                                 const geometric::SceneObject& object, const std::string& support,
                                 int count, std::uint64_t seed) {
  const UpwardFaces faces(need_object(scene, support));
  std::vector<Pose> places;
  if (faces.empty()) {
    return places;
  }
  const auto mesh = geometric::tessellate(object.shape);
  sampling::RandomStream random(seed);
  for (int trial = 0; trial < count * kTriesForEach && std::ssize(places) < count; ++trial) {
    const Vector3d p = faces.draw(random);
    const Eigen::AngleAxisd turn(2.0 * std::numbers::pi * random.uniform(), Vector3d::UnitZ());
    const Eigen::Matrix3d R_WO = turn.toRotationMatrix() * object.X_PO.linear();
    const Underside side = underside(mesh->vertices, R_WO);
    const bool is_supported = std::ranges::all_of(side.corners, [&](const Vector2d& corner) {
      return faces.is_below(p.head<2>() + corner, p.z());
    });
    if (is_supported) {
      Pose X_WO = Pose::Identity();
      X_WO.linear() = R_WO;
      X_WO.translation() = p - side.middle + geometric::kRestingGap * Vector3d::UnitZ();
      places.push_back(X_WO);
    }
  }
  return places;
}

std::vector<Pose> places_at(const geometric::SceneObject& object, const Pose& X_WF, int count) {
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  const auto mesh = geometric::tessellate(object.shape);
  const Eigen::Matrix3d incline =
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), X_WF.linear().col(2))
          .toRotationMatrix();
  std::vector<Pose> places;
  for (int i = 0; i < count; ++i) {
    const Eigen::AngleAxisd turn(i * golden_angle, Vector3d::UnitZ());
    const Eigen::Matrix3d upright = turn.toRotationMatrix() * object.X_PO.linear();
    const Underside side = underside(mesh->vertices, upright);
    Pose X_WO = Pose::Identity();
    X_WO.linear() = incline * upright;
    X_WO.translation() =
        X_WF.translation() + incline * (geometric::kRestingGap * Vector3d::UnitZ() - side.middle);
    places.push_back(X_WO);
  }
  return places;
}

std::vector<std::string> supports_of(const geometric::Scene& scene,
                                     const geometric::SceneObject& object) {
  std::vector<std::pair<double, std::string>> found;
  for (const geometric::SceneObject& other : scene.objects) {
    if (other.name == object.name || other.attachment) {
      continue;
    }
    geometric::Scene alone;
    alone.objects = {other};
    const auto gap = geometric::gap_to_support(alone, object);
    found.emplace_back(gap ? std::abs(*gap) : std::numeric_limits<double>::infinity(), other.name);
  }
  std::ranges::stable_sort(found, {}, &std::pair<double, std::string>::first);
  std::vector<std::string> names;
  std::ranges::transform(found, std::back_inserter(names), &std::pair<double, std::string>::second);
  return names;
}

}  // namespace handway::planning
