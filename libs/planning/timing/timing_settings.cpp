#include "handway/planning/timing/timing_settings.h"

#include <Eigen/Core>

namespace handway::planning {

using geometric::in_thousandths;

std::vector<geometric::BoundParameter> parameters_of(TimingSettings& settings) {
  return {
      {"speed", "Speed", "", "Share of the full speed that the joint limits allow", &settings.speed,
       0.001, 1.0},
      in_thousandths({"period_ms", "Period", "ms", "Time from one point to the next",
                      &settings.period, 0.1, 1000.0}),
      {"blend", "Round the corners", "",
       "Round waypoints by collision-free arcs instead of stopping there", &settings.blend},
      {"deviation", "Deviation", "rad",
       "Largest distance of an arc from its waypoint, over all joints together",
       &settings.deviation, 1e-4, 10.0},
      in_thousandths({"arc_clearance_mm", "Clearance of arcs", "mm",
                      "Least clearance of arcs; arcs with less clearance are made smaller",
                      &settings.arc_clearance, 0.05, 1000.0}),
      {"jerk", "Limit the jerk", "", "Also limit jerk", &settings.jerk},
      in_thousandths({"margin", "Margin", "mm",
                      "Clearance that has to remain if the robot is off by its following error; "
                      "less is cleared with a warning",
                      &settings.margin, 0.0, 1000.0}),
      {"following_error", "Following error", "rad",
       "Following error of joints at their velocity limit, rad or m; -1: 0.01 rad or 0.001 m",
       &settings.following_error, -1.0, 1.0}};
}

TimingOptions timing_options(const TimingSettings& settings, const geometric::RobotModel& model) {
  TimingOptions options;
  options.speed = settings.speed;
  options.period = settings.period;
  options.blends.deviation = settings.blend ? settings.deviation : 0.0;
  options.blends.arc_clearance = settings.arc_clearance;
  options.limit_jerk = settings.jerk;
  options.limits = rate_limits(model);
  options.safety.margin = settings.margin;
  if (settings.following_error >= 0.0) {
    options.safety.following_error =
        Eigen::VectorXd::Constant(model.variable_count(), settings.following_error);
  }
  return options;
}

}  // namespace handway::planning
