#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/mesh/shape.h"
#include "handway/planning/export.h"

#include <Eigen/Core>

#include <vector>

namespace handway::planning {

/// A point of a shape's surface that can be pulled outwards: the middle of each of the six sides
/// of a box or mesh, of the ends and the mantle of a cylinder or cone, of a sphere on its axes.
struct ResizeKnob {
  int axis = 0;  ///< Axis of the shape's own frame.
  int sign = 1;  ///< Side of the axis: 1 or -1.
  Eigen::Vector3d p_O = Eigen::Vector3d::Zero();

  friend bool operator==(const ResizeKnob& a, const ResizeKnob& b) {
    return a.axis == b.axis && a.sign == b.sign;
  }
};

/// Returns the points at which a shape can be resized.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<ResizeKnob> resize_knobs(
    const geometric::Shape& shape);

/// A shape of another size, and its new pose.
struct Resized {
  geometric::Shape shape;
  geometric::Pose X_WO;
};

/// Pulls one knob outwards. The opposite side stays, but radii grow around the axis, and a
/// mesh grows in all directions alike. Nothing gets smaller than 1 mm.
/// @param distance m. @param snap to sizes (of meshes: none) in whole centimetres.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Resized resized(const geometric::Shape& shape,
                                                      const geometric::Pose& X_WO,
                                                      const ResizeKnob& knob, double distance,
                                                      bool snap);

/// Returns the mesh with each coordinate `factor` times as large.
[[nodiscard]] HANDWAY_PLANNING_EXPORT geometric::Mesh scaled(const geometric::Mesh& mesh,
                                                             double factor);

}  // namespace handway::planning
