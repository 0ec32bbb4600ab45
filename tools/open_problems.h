#pragma once

#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/edits/scene_state.h"

#include <cstdint>
#include <memory>
#include <string>

namespace handway::tools {

/// A problem of the open benchmark for hands on arms.
struct OpenProblem {
  int number = 1;              ///< From 1.
  planning::ProblemTags tags;  ///< task, family, level, arm and hand.
  planning::SceneState state;  ///< With start and goal; no scene: none was found.
  int draws = 0;               ///< Scenes that were drawn.
};

/// Makes problems of the open benchmark: arms and hands that ship, mounted on each other, reach
/// for, grasp or place an object in scenes of ten families and three levels. Arms, hands, tasks,
/// families and levels come equally often.
///
/// - reach: from a posture in front of the robot to a pose of the palm that faces the object, 9 to
///   16 cm from its middle;
/// - grasp: from there to a pre-grasp of the object (find_pregrasps());
/// - place: the hand holds the object, and puts it to another place on the same support.
///
/// Starts and goals are free by the exact checker. Where the level is above 1, scenes in which the
/// straight motion is free are drawn again, up to a limit.
///
/// A problem depends on number and seed alone. May be used by several threads.
class OpenProblemGenerator {
 public:
  explicit OpenProblemGenerator(std::uint64_t seed);
  ~OpenProblemGenerator();
  OpenProblemGenerator(const OpenProblemGenerator&) = delete;
  OpenProblemGenerator& operator=(const OpenProblemGenerator&) = delete;

  /// @param number ≥ 1.
  [[nodiscard]] OpenProblem make(int number) const;

 private:
  class Robots;

  std::uint64_t seed_;
  std::unique_ptr<const Robots> robots_;
};

}  // namespace handway::tools
