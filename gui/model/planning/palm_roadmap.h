#pragma once

#include "handway/planning/roadmap/roadmap_recorder.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace handway::gui {

/// A roadmap with the palm's place in each of its nodes.
struct PalmRoadmap {
  static constexpr std::size_t kMostNodes = 20000;  ///< More are not kept.

  planning::RecordedRoadmap roadmap;
  std::vector<Eigen::Vector3d> palms;  ///< In the world, m; shape [nodes].
};

using SharedRoadmap = std::shared_ptr<const PalmRoadmap>;

}  // namespace handway::gui
