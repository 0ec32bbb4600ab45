#include "handway_test/motions.h"

#include "handway/geometric/formats/robot_loader.h"
#include "handway/planning/timing/time_path.h"
#include "handway_test/paths.h"
#include "handway_test/solid_robots.h"

#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

namespace handway::test {
namespace {

using geometric::Configuration;

geometric::RobotDescription tx90_sah_with_groups() {
  geometric::RobotDescription robot = solid_tx90_sah();
  robot.groups = {{"arm", {}}, {"hand", {}}};
  for (const geometric::Joint& joint : robot.joints) {
    if (joint.type != geometric::JointType::kFixed) {
      robot.groups[joint.name.starts_with("joint_") ? 0 : 1].joints.push_back(joint.name);
    }
  }
  return robot;
}

Configuration moved(const geometric::RobotModel& model, Configuration q,
                    const std::map<std::string, double>& values) {
  for (const auto& [joint, value] : values) {
    q[model.find_variable(joint).value()] = value;
  }
  return q;
}

planning::Motion cleared(planning::TimedPath timed) {
  if (!timed.cleared()) {
    throw std::logic_error(timed.blends.fault + to_text(timed.preflight));
  }
  return std::move(timed.motion);
}

}  // namespace

planning::PlanningProblem tx90_sah_problem() {
  geometric::Scene scene = scene_of(tx90_sah_with_groups());
  const planning::Path path = tx90_sah_path();
  scene.start = path.waypoints.front();
  scene.goal = path.waypoints.back();
  return planning::make_problem(std::make_shared<const geometric::Scene>(std::move(scene)),
                                nullptr);
}

planning::Path tx90_sah_path() {
  const geometric::RobotModel model(solid_tx90_sah());
  const Configuration start = moved(model, model.neutral(), {{"joint_3", 1.2}});
  const Configuration second = moved(
      model, start, {{"joint_1", 0.4}, {"joint_5", -0.3}, {"Index-Prox", -0.3}, {"Thumb", -0.5}});
  const Configuration third = moved(model, second, {{"Mid-Prox", -0.4}, {"Ring-Med", -0.6}});
  const Configuration fourth = moved(model, third, {{"joint_2", 0.3}, {"Index-Prox", -0.1}});
  return {{start, second, third, fourth}};
}

planning::Motion tx90_sah_motion(bool arcs, double speed) {
  planning::TimingOptions options;
  options.speed = speed;
  options.blends.deviation = arcs ? 0.05 : 0.0;
  return tx90_sah_motion(options);
}

planning::Motion tx90_sah_motion(const planning::TimingOptions& options) {
  return cleared(time_path(tx90_sah_problem(), tx90_sah_path(), "wave", options));
}

planning::Motion panda_motion(planning::TimingOptions options) {
  const auto model =
      geometric::load_robot(source_dir() / "resources/robots/panda_class/panda_class.urdf");
  const Configuration start = moved(*model, model->neutral(),
                                    {{"joint_2", -0.785}, {"joint_4", -2.356}, {"joint_6", 1.571}});
  const planning::Path path{{start, moved(*model, start, {{"joint_1", 0.3}, {"joint_4", -2.0}}),
                             moved(*model, start, {{"joint_1", 0.3}, {"joint_7", -0.4}})}};
  geometric::Scene scene = scene_of(model->description());
  scene.start = path.waypoints.front();
  scene.goal = path.waypoints.back();
  options.limits = planning::rate_limits(*model);
  options.limits.acceleration.setConstant(5.0);
  options.limits.jerk = Configuration::Constant(model->variable_count(), 100.0);
  options.limit_jerk = true;
  return cleared(time_path(
      planning::make_problem(std::make_shared<const geometric::Scene>(std::move(scene)), nullptr),
      path, "wave", options));
}

planning::Motion with_robot_name(planning::Motion motion, const std::string& name) {
  geometric::RobotDescription description = motion.model->description();
  description.name = name;
  description.file.clear();
  motion.model = std::make_shared<const geometric::RobotModel>(description);
  return motion;
}

planning::Motion with_stages(planning::Motion motion) {
  motion.stages = {{.name = "approach", .step = "pick can", .first = 0},
                   {.name = "close",
                    .step = "pick can",
                    .first = 1,
                    .hand = planning::HandAction::kClose,
                    .object = "can",
                    .squeezed = motion.path.waypoints[3]},
                   {.name = "lift", .step = "pick can", .first = 2}};
  return motion;
}

planning::Motion with_outputs_and_wait(planning::Motion motion,
                                       const std::vector<geometric::OutputStep>& outputs,
                                       double wait) {
  const std::size_t last = motion.path.waypoints.size() - 1;
  for (const geometric::OutputStep& output : outputs) {
    motion.stages.push_back(
        {.name = "output", .step = to_string(output), .first = last, .output = output});
  }
  motion.stages.push_back({.name = "wait", .step = "wait", .first = last, .waits = true});
  motion.path.waypoints.push_back(motion.path.waypoints.back());
  motion.waypoint_times.push_back(motion.waypoint_times.back() + wait);
  motion.trajectory.points.push_back(motion.trajectory.points.back());
  motion.trajectory.points.back().time += wait;
  return motion;
}

}  // namespace handway::test
