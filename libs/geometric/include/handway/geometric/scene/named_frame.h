#pragma once

#include "handway/geometric/math/pose.h"

#include <string>

namespace handway::geometric {

/// A frame of a scene that has a name: a place on the board of a shelf, the centre of a tool.
struct NamedFrame {
  std::string name;  ///< Unique among frames, objects, robots and links of robots[0].
  /// The object or the link of robots[0] that the frame is fixed to; empty: the world.
  std::string parent = {};
  Pose X_PF = Pose::Identity();  ///< In the parent's frame.

  friend bool operator==(const NamedFrame& a, const NamedFrame& b) {
    return a.name == b.name && a.parent == b.parent && a.X_PF.matrix() == b.X_PF.matrix();
  }
};

}  // namespace handway::geometric
