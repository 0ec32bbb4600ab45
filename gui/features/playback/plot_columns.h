#pragma once

#include "model/playback/motion_analysis.h"

#include <QString>

#include <string>
#include <vector>

namespace handway::gui {

/// Quantities that a plot of a motion can show.
enum class PlotQuantity { kPosition, kVelocity, kAcceleration, kClearance, kUnlikeness };

/// Returns whether there is a curve for every joint, or one for all.
[[nodiscard]] bool is_of_joints(PlotQuantity quantity);

/// Returns the title of the axis with its unit: "velocity, °/s".
[[nodiscard]] QString axis_title(PlotQuantity quantity, bool slides);

/// The unit alone; empty: a pure number. @param slides of a joint that does not turn.
[[nodiscard]] QString unit_of(PlotQuantity quantity, bool slides);

[[nodiscard]] bool slides(const geometric::RobotModel& model, int variable);

/// A joint's position, velocity or acceleration at the motion's points, in degrees or
/// millimetres.
[[nodiscard]] std::vector<double> joint_values(const planning::Motion& motion, int variable,
                                               PlotQuantity quantity);

/// Returns the limits of a joint's values, lowest first.
[[nodiscard]] std::vector<double> joint_limits(const planning::Motion& motion, int variable,
                                               PlotQuantity quantity);

/// A curve as a table's column.
struct PlotColumn {
  std::string name;
  std::vector<double> values;
};

/// Clearance in millimetres, or the hand's distances to the subspace of its principal motion
/// directions and to the recorded postures, those of them that there are.
[[nodiscard]] std::vector<PlotColumn> motion_columns(const MotionCurves& curves,
                                                     PlotQuantity quantity);
/// Returns the title of a column of motion_columns() for display.
[[nodiscard]] QString title_of(const PlotColumn& column);

/// A table with a column for each curve.
[[nodiscard]] std::string csv_of(const std::vector<double>& times,
                                 const std::vector<PlotColumn>& columns);

}  // namespace handway::gui
