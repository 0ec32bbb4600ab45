#include "goal_pose_options.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/hand_structure.h"
#include "handway/geometric/robot/inverse_kinematics.h"
#include "handway/geometric/scene/scene.h"
#include "handway/planning/core/select_joints.h"
#include "numbers.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace handway::tools {
namespace {

struct GivenPose {
  std::string link;  ///< Empty: not given.
  Eigen::Vector3d xyz;
  std::optional<Eigen::Vector3d> rpy;  ///< rad
};

std::optional<std::vector<double>> numbers_of(const std::string& text) {
  constexpr double kLargest = 1e6;  // as in scene files
  std::vector<double> numbers;
  for (const std::string& part : CLI::detail::split(text, ',')) {
    double number = 0.0;
    if (!CLI::detail::lexical_cast(CLI::detail::trim_copy(part), number) ||
        !(std::abs(number) <= kLargest)) {
      return std::nullopt;
    }
    numbers.push_back(number);
  }
  return numbers;
}

std::optional<GivenPose> given_pose_of(const std::string& text) {
  const std::size_t colon = text.rfind(':');  // names may hold colons
  const bool has_link = colon != std::string::npos && colon > 0;
  const auto numbers = numbers_of(has_link ? text.substr(colon + 1) : text);
  if (!numbers || (numbers->size() != 3 && numbers->size() != 6)) {
    return std::nullopt;
  }
  const std::vector<double>& n = *numbers;
  GivenPose pose{has_link ? text.substr(0, colon) : "", {n[0], n[1], n[2]}, std::nullopt};
  if (n.size() == 6) {
    pose.rpy = geometric::kDegree * Eigen::Vector3d(n[3], n[4], n[5]);
  }
  return pose;
}

// The palm of the moving hand, or the arm's other tool.
// @throws InputError if several hands are possible.
std::string palm_of(const std::string& option, const planning::SceneState& loaded) {
  const geometric::Scene& scene = *loaded.scene;
  const geometric::RobotModel& model = *scene.robots.front().model;
  const geometric::JointSelection chosen = planning::select_joints(scene, loaded.basis.get());
  const auto moves = [&](int v) {
    return std::ranges::binary_search(chosen.moving, v) &&
           !std::ranges::binary_search(chosen.fixed_limb_joints, v);
  };
  const auto all = geometric::JointSelection::with_hand(model, chosen.whole_hand);
  std::vector<std::string> palms;
  for (const geometric::Limb& limb : limbs(model, all)) {
    if (!limb.hand.empty() &&
        (std::ranges::any_of(limb.arm, moves) || std::ranges::any_of(limb.hand, moves))) {
      palms.push_back(
          model.link(geometric::HandStructure::of(model, limb.arm, limb.hand).palm).name);
    }
  }
  if (palms.size() > 1) {
    throw geometric::InputError({scene.file.string(), option,
                                 fmt::format("no link, of a robot with {} hands", palms.size()),
                                 fmt::format("the link: {}", fmt::join(palms, ", ")),
                                 "Write --goal-link LINK, or LINK: before the numbers"});
  }
  return palms.empty()
             ? model.link(geometric::HandStructure::of(model, all.arm, all.hand).palm).name
             : palms.front();
}

// Returns the link named `name` or, if it is empty, palm_of().
std::string goal_link_of(const std::string& name, const std::string& option,
                         const planning::SceneState& loaded) {
  const geometric::Scene& scene = *loaded.scene;
  const geometric::RobotModel& model = *scene.robots.front().model;
  if (name.empty()) {
    return palm_of(option, loaded);
  }
  const std::optional<int> link = model.find_link(name);
  if (!link || geometric::chain_variables(model, *link).empty()) {
    std::vector<std::string> links;
    for (int other = 1; other < model.link_count(); ++other) {
      links.push_back(model.link(other).name);
    }
    throw geometric::InputError(
        {scene.file.string(), option,
         name + (link ? ", which no joint moves" : ", which is no link of the robot"),
         "a link of " + scene.robots.front().name + " that moves",
         link ? "" : geometric::advise_name(name, links)});
  }
  return name;
}

}  // namespace

void add_goal_pose_options(CLI::App& command, GoalPoseOptions& options) {
  command
      .add_option("--goal-pose", options.poses,
                  "Goal as the pose of a link in the world, m and degrees, instead of the scene's "
                  "goal; without angles the orientation is free. If given several times, the path "
                  "ends at one of these poses")
      ->type_name("[LINK:]X,Y,Z[,ROLL,PITCH,YAW]")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->check([](const std::string& text) {
        return given_pose_of(text)
                   ? std::string()
                   : "\"" + text +
                         "\" is not [LINK:]X,Y,Z or [LINK:]X,Y,Z,ROLL,PITCH,YAW with numbers "
                         "within ±1000000";
      });
  command.add_option(
      "--goal-link", options.link,
      "Link of goal poses without a link (default: the hand that moves, or the arm's last link)");
  command
      .add_option(
          "--goal-tolerance", options.tolerance,
          "Tolerance of goal poses along and about each axis (default: 0.1 mm and 0.1 degrees)")
      ->type_name("MM,DEGREES")
      ->delimiter(',')
      ->expected(2)
      ->check(number_in(0.0, 1e4));
}

void set_goal_poses(const GoalPoseOptions& options, planning::SceneState& loaded) {
  if (options.poses.empty()) {
    return;
  }
  geometric::Scene scene = *loaded.scene;
  scene.goal_poses.clear();
  for (const std::string& text : options.poses) {
    const GivenPose given = given_pose_of(text).value();
    geometric::PoseGoal goal;
    goal.link = given.link.empty() ? goal_link_of(options.link, "--goal-link", loaded)
                                   : goal_link_of(given.link, "--goal-pose", loaded);
    const Eigen::Vector3d rpy = given.rpy.value_or(Eigen::Vector3d::Zero());
    goal.X_WG = geometric::pose_from_rpy(given.xyz, rpy.x(), rpy.y(), rpy.z());
    if (!options.tolerance.empty()) {
      goal.position_tolerance.setConstant(geometric::metres(options.tolerance[0]));
      goal.rotation_tolerance.setConstant(geometric::radians(options.tolerance[1]));
    }
    if (!given.rpy) {
      goal.rotation_tolerance.setConstant(std::numbers::pi);
    }
    scene.goal_poses.push_back(std::move(goal));
  }
  loaded.scene = std::make_shared<const geometric::Scene>(std::move(scene));
}

}  // namespace handway::tools
