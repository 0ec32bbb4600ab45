#pragma once

#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/Core>

namespace handway::sampling {

[[nodiscard]] inline bool in_unit_cube(const Eigen::VectorXd& point) {
  return (point.array() >= 0.0 && point.array() <= 1.0).all();
}

/// Uniform on the unit sphere, shape [dimension].
[[nodiscard]] inline Eigen::VectorXd random_direction(RandomStream& stream, int dimension) {
  for (;;) {
    const Eigen::VectorXd direction = stream.normal(dimension);
    if (const double length = direction.norm(); length > 1e-9) {
      return direction / length;
    }
  }
}

}  // namespace handway::sampling
