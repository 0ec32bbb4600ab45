#include "handway/planning/edits/resizing.h"

#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <memory>
#include <variant>

namespace handway::planning {

using Eigen::Vector3d;
using geometric::Aabb;
using geometric::Pose;

namespace {

constexpr double kSmallest = 1e-3;  // m
constexpr double kSnap = 0.01;      // m

double new_size(double size, double distance, bool snap) {
  const double wanted = size + distance;
  return std::max(kSmallest, snap ? std::round(wanted / kSnap) * kSnap : wanted);
}

Aabb box_of(const geometric::Shape& shape) {
  return geometric::bounding_box(*geometric::tessellate(shape));
}

struct Pull {
  const ResizeKnob& knob;
  double distance;
  bool snap;
  Pose& X_WO;

  /// One side stays: the centre goes half the way.
  void grow(double& size) const {
    const double grown = new_size(size, distance, snap);
    X_WO.translation() += 0.5 * knob.sign * (grown - size) * Vector3d(X_WO.linear().col(knob.axis));
    size = grown;
  }
  void operator()(geometric::Box& box) const { grow(box.size[knob.axis]); }
  void operator()(geometric::Sphere& sphere) const {
    sphere.radius = new_size(sphere.radius, distance, snap);
  }
  template <typename Round>
  void grow_round(Round& round) const {
    if (knob.axis == 2) {
      grow(round.length);
    } else {
      round.radius = new_size(round.radius, distance, snap);
    }
  }
  void operator()(geometric::Cylinder& cylinder) const { grow_round(cylinder); }
  void operator()(geometric::Cone& cone) const { grow_round(cone); }
  void operator()(geometric::Mesh& mesh) const {
    const Aabb box = box_of(mesh);
    const double size = std::max(box.size()[knob.axis], kSmallest);
    const double factor = new_size(size, distance, false) / size;
    Vector3d fixed = box.centre();
    fixed[knob.axis] -= 0.5 * knob.sign * size;
    X_WO.translation() += X_WO.linear() * ((1.0 - factor) * fixed);
    mesh = scaled(mesh, factor);
  }
  void operator()(geometric::Cloud& /*cloud*/) const {}  // measured
};

}  // namespace

std::vector<ResizeKnob> resize_knobs(const geometric::Shape& shape) {
  std::vector<ResizeKnob> knobs;
  if (std::holds_alternative<geometric::Cloud>(shape)) {
    return knobs;
  }
  const Aabb box = box_of(shape);
  for (int axis = 0; axis < 3; ++axis) {
    for (const int sign : {-1, 1}) {
      ResizeKnob knob{axis, sign, box.centre()};
      knob.p_O[axis] = sign > 0 ? box.upper[axis] : box.lower[axis];
      if (std::holds_alternative<geometric::Cone>(shape) && axis != 2) {
        knob.p_O.z() = box.lower.z();
      }
      knobs.push_back(knob);
    }
  }
  return knobs;
}

Resized resized(const geometric::Shape& shape, const Pose& X_WO, const ResizeKnob& knob,
                double distance, bool snap) {
  Resized result{shape, X_WO};
  std::visit(Pull{knob, distance, snap, result.X_WO}, result.shape);
  return result;
}

geometric::Mesh scaled(const geometric::Mesh& mesh, double factor) {
  geometric::Mesh larger = mesh;
  larger.scale *= factor;
  larger.triangles = std::make_shared<const geometric::TriangleMesh>(
      geometric::transformed(*mesh.triangles, Pose::Identity(), Vector3d::Constant(factor)));
  return larger;
}

}  // namespace handway::planning
