#include "franka_exporter.h"

#include "handway/geometric/io/input_error.h"
#include "handway/planning/extensions/arm_program.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/paths/path_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <variant>

namespace handway::export_franka {
namespace {

using Json = nlohmann::ordered_json;
using planning::TrajectoryPoint;

constexpr std::size_t kJoints = 7;
constexpr double kPeriod = 0.001;  // s

constexpr FrankaLimits kPanda = {"the Franka Emika Robot",
                                 {-2.8973, -1.7628, -2.8973, -3.0718, -2.8973, -0.0175, -2.8973},
                                 {2.8973, 1.7628, 2.8973, -0.0698, 2.8973, 3.7525, 2.8973},
                                 {2.1750, 2.1750, 2.1750, 2.1750, 2.6100, 2.6100, 2.6100},
                                 {15.0, 7.5, 10.0, 12.5, 15.0, 20.0, 20.0},
                                 {7500.0, 3750.0, 5000.0, 6250.0, 7500.0, 10000.0, 10000.0}};

constexpr FrankaLimits kResearch3 = {"Franka Research 3",
                                     {-2.7437, -1.7837, -2.9007, -3.0421, -2.8065, 0.5445, -3.0159},
                                     {2.7437, 1.7837, 2.9007, -0.1518, 2.8065, 4.5169, 3.0159},
                                     {2.62, 2.62, 2.62, 2.62, 5.26, 4.18, 5.26},
                                     {10.0, 10.0, 10.0, 10.0, 10.0, 10.0, 10.0},
                                     {5000.0, 5000.0, 5000.0, 5000.0, 5000.0, 5000.0, 5000.0}};

constexpr const char* kFranka = "panda|franka|(^|[^a-z0-9])(fr3|fer)($|[^a-z0-9])";

/// Compares the positions of an arm, one every millisecond, with its limits. Rates are differences
/// of positions, as the control interface computes them; before and after the motion the arm rests.
class LimitCheck {
 public:
  LimitCheck(const planning::Motion& motion, const FrankaLimits& limits)
      : motion_(motion), limits_(limits) {}

  void run() const {
    for (std::size_t j = 0; j < kJoints; ++j) {
      check_joint(j);
    }
  }

 private:
  void check_joint(std::size_t j) const {
    double q = position(0, j);
    double velocity = 0.0;
    double acceleration = 0.0;
    for (std::size_t i = 0; i < motion_.trajectory.points.size() + 2; ++i) {
      const double next = position(i, j);
      const double next_velocity = (next - q) / kPeriod;
      const double next_acceleration = (next_velocity - velocity) / kPeriod;
      const double jerk = (next_acceleration - acceleration) / kPeriod;
      if (next < limits_.lower[j] || next > limits_.upper[j]) {
        refuse(i, j, fmt::format("{:.4f} rad", next),
               fmt::format("{} to {} rad", limits_.lower[j], limits_.upper[j]), "");
      }
      compare(i, j, "velocity", next_velocity, limits_.velocity[j], "rad/s", "Run it slower");
      compare(i, j, "acceleration", next_acceleration, limits_.acceleration[j], "rad/s²",
              "Run it slower, or give the limits of acceleration");
      compare(i, j, "jerk", jerk, limits_.jerk[j], "rad/s³", "Time it with --jerk");
      q = next;
      velocity = next_velocity;
      acceleration = next_acceleration;
    }
  }

  [[nodiscard]] double position(std::size_t i, std::size_t j) const {
    const auto& points = motion_.trajectory.points;
    return points[std::min(i, points.size() - 1)].position[motion_.arm[j]];
  }

  void compare(std::size_t i, std::size_t j, const char* what, double value, double limit,
               const char* unit, const char* advice) const {
    constexpr double kRounding = 1e-6;  // relative
    if (std::abs(value) > limit * (1.0 + kRounding)) {
      refuse(i, j, fmt::format("{} {:.4g} {}", what, value, unit),
             fmt::format("at most {:g} {}", limit, unit), advice);
    }
  }

  [[noreturn]] void refuse(std::size_t i, std::size_t j, const std::string& found,
                           const std::string& expected, const std::string& advice) const {
    throw geometric::InputError(
        {"the motion",
         fmt::format("joint {} at {:.3f} s", motion_.model->variable(motion_.arm[j]).name,
                     kPeriod * static_cast<double>(i)),
         found, fmt::format("{}, the limit of {}", expected, limits_.robot), advice});
  }

  const planning::Motion& motion_;
  const FrankaLimits& limits_;
};

std::string table(const planning::Motion& motion) {
  std::string text = "time";
  for (const char* rate : {"q", "dq"}) {
    for (std::size_t j = 1; j <= kJoints; ++j) {
      text += fmt::format(",{}{}", rate, j);
    }
  }
  text += '\n';
  for (const TrajectoryPoint& point : motion.trajectory.points) {
    const Eigen::VectorXd q = point.position(motion.arm);
    const Eigen::VectorXd dq = point.velocity(motion.arm);
    fmt::format_to(std::back_inserter(text), "{},{},{}\n", planning::csv_time(point.time),
                   fmt::join(q.begin(), q.end(), ","), fmt::join(dq.begin(), dq.end(), ","));
  }
  return text;
}

Json rows(const planning::Motion& motion, const Eigen::VectorXd TrajectoryPoint::*values) {
  Json all = Json::array();
  for (const TrajectoryPoint& point : motion.trajectory.points) {
    const Eigen::VectorXd arm = (point.*values)(motion.arm);
    all.push_back(std::vector<double>(arm.begin(), arm.end()));
  }
  return all;
}

Json stages(const planning::Motion& motion) {
  Json all = Json::array();
  for (const planning::MotionStage& stage : motion.stages) {
    Json one = {{"stage", stage.name},
                {"step", stage.step},
                {"time_s", motion.waypoint_times[stage.first]},
                {"object", stage.object}};
    if (stage.output) {
      one["output"] = {{"name", stage.output->name}};
      std::visit([&](auto value) { one["output"]["value"] = value; }, stage.output->value);
    }
    all.push_back(std::move(one));
  }
  return all;
}

std::string object(const planning::Motion& motion, const FrankaLimits& limits) {
  Json joints = Json::array();
  for (const int v : motion.arm) {
    joints.push_back(motion.model->variable(v).name);
  }
  const Json message = {{"robot", motion.model->name()},
                        {"joint_names", joints},
                        {"period_s", kPeriod},
                        {"limits",
                         {{"robot", limits.robot},
                          {"lower", limits.lower},
                          {"upper", limits.upper},
                          {"velocity", limits.velocity},
                          {"acceleration", limits.acceleration},
                          {"jerk", limits.jerk}}},
                        {"stages", stages(motion)},
                        {"q", rows(motion, &TrajectoryPoint::position)},
                        {"dq", rows(motion, &TrajectoryPoint::velocity)}};
  return message.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

const FrankaLimits& franka_limits(const planning::Motion& motion) {
  return is_robot_named(motion, "(^|[^a-z0-9])fr3($|[^a-z0-9])") ? kResearch3 : kPanda;
}

std::string FrankaExporter::robot_objection(const planning::Motion& motion) const {
  return is_robot_named(motion, kFranka) ? std::string()
                                         : "an arm of Franka: libfranka moves its arms alone";
}

std::string FrankaExporter::output_objection(const geometric::OutputStep& /*output*/) const {
  return "only the stages in the JSON file have it";
}

std::vector<planning::ExportedFile> FrankaExporter::do_export(
    const planning::Motion& timed, const planning::ExportOptions& options) const {
  planning::Motion motion = timed;  // its other timing needs other names of files
  motion.name += "_franka";
  motion.trajectory = with_rests_sampled(timed.trajectory, kPeriod);
  require_arm(
      motion,
      {.language = "libfranka", .joints = kJoints, .advice = "Arms of Franka have seven joints"});
  const FrankaLimits& limits = franka_limits(motion);
  LimitCheck(motion, limits).run();
  std::vector<planning::ExportedFile> files = {{motion.name + ".csv", table(motion)},
                                               {motion.name + ".json", object(motion, limits)}};
  std::ranges::move(hand_target_files(motion, options), std::back_inserter(files));
  return files;
}

}  // namespace handway::export_franka

HANDWAY_PLUGIN({.name = "export_franka", .version = HANDWAY_VERSION, .make_exporters = [] {
                  std::vector<std::unique_ptr<handway::planning::Exporter>> exporters;
                  exporters.push_back(std::make_unique<handway::export_franka::FrankaExporter>());
                  return exporters;
                }});
