#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/scene/color.h"
#include "handway/geometric/scene/shape.h"

#include <string>
#include <vector>

namespace handway::geometric {

/// One shape fixed to a link; X_LG is the shape's frame in the link's.
struct LinkGeometry {
  Shape shape;
  Pose X_LG = Pose::Identity();
  Color color;
};

/// A rigid body of a robot. What is seen and what collides may differ.
struct Link {
  std::string name;
  std::vector<LinkGeometry> visual;
  std::vector<LinkGeometry> collision;
};

}  // namespace handway::geometric
