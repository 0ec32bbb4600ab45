#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/scene/program.h"

#include <cstddef>
#include <optional>
#include <string>

namespace handway::planning {

/// Action of a hand on an object.
enum class HandAction {
  kNone,
  kClose,  ///< Grasps it: from the end of the stage the hand carries it.
  kOpen,   ///< Releases it.
};

/// A part of a motion that has a name, such as a stage of a task. The robot rests at both ends.
struct MotionStage {
  std::string name;       ///< Word for display: "lift".
  std::string step = {};  ///< The step of the task that it belongs to: "pick can".
  /// Index of the waypoint at which the stage begins; it ends where the next one begins.
  std::size_t first = 0;
  HandAction hand = HandAction::kNone;  ///< During this stage.
  std::string object = {};              ///< The object of the action; empty: none.
  /// Joint targets with which the hand holds the object after this stage; shape [variable_count],
  /// or of size 0.
  geometric::Configuration squeezed = {};
  /// The robot rests during this stage: the trajectory has its ends alone.
  bool waits = false;
  /// Output that is set in this stage, which has no length.
  std::optional<geometric::OutputStep> output = {};
};

}  // namespace handway::planning
