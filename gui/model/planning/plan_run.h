#pragma once

#include "handway/planning/core/planner.h"
#include "model/document/scene_state.h"

#include <QString>
#include <QTime>

namespace handway::gui {

/// A run of a planner: all that it takes to do it again, and what came of it.
struct PlanRun {
  int number = 0;  ///< From 1, in the order in which runs began.
  QTime begun;
  SceneState state;                  ///< Robots, objects, start and goal.
  geometric::PlannerChoice planner;  ///< With the settings that are not its own values.
  QString preset;                    ///< In words.
  planning::PlanRequest request;
  planning::PlanResult result;
  QString failure;  ///< Why it could not be done; empty if there is a result.
};

}  // namespace handway::gui
