#include "scene_options.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/hand_structure.h"
#include "handway/geometric/robot/inverse_kinematics.h"
#include "handway/geometric/setup/moving_group.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/core/select_joints.h"
#include "handway/planning/paths/path_file.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "numbers.h"
#include "printing.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace handway::tools {
void choose_basis(std::vector<std::string>& settings, planning::SceneState& scene) {
  const std::string key = "basis=";
  for (const std::string& setting : settings) {
    if (!setting.starts_with(key)) {
      continue;
    }
    const std::filesystem::path file =
        geometric::find_resource(geometric::ResourceKind::kHandBasis, setting.substr(key.size()),
                                 std::filesystem::current_path(), "--set basis");
    auto basis = std::make_shared<const sampling::PmdBasis>(sampling::read_pmd_basis(file));
    const geometric::RobotModel& model = *scene.scene->robots.front().model;
    for (const std::string& joint : basis->joints) {
      if (!geometric::find_variable_of_part(model, joint)) {
        throw geometric::InputError({file.string(), "hand", basis->hand,
                                     "a basis for the hand of " + model.name(),
                                     "The scene's robot has another hand, without joint " + joint});
      }
    }
    scene.basis = std::move(basis);
  }
  std::erase_if(settings, [&](const std::string& setting) { return setting.starts_with(key); });
}

std::unique_ptr<planning::Planner> scene_planner(const std::string& name,
                                                 const geometric::PlannerRequest& choice,
                                                 const planning::PlannerRegistry& registry) {
  const std::string taken = !name.empty()          ? name
                            : !choice.name.empty() ? choice.name
                                                   : registry.names().front();
  std::unique_ptr<planning::Planner> planner = registry.create(taken);
  using planning::PlannerRegistry;
  const bool same =
      PlannerRegistry::current_name(taken) == PlannerRegistry::current_name(choice.name);
  if (same || choice.name.empty()) {
    for (const auto& [key, value] : choice.settings) {
      planner->set_parameter(key, value);
    }
  }
  return planner;
}

void apply_settings(planning::Planner& planner, const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      throw CLI::ValidationError("--set", "\"" + setting + "\" is not KEY=VALUE");
    }
    planner.set_parameter(setting.substr(0, equals), setting.substr(equals + 1));
  }
}

namespace {

void print_warnings(const std::vector<std::string>& warnings) {
  if (warnings.empty()) {
    return;
  }
  const std::size_t count = warnings.size();
  std::string summary = fmt::format("{} warning{}\n", count, count == 1 ? "" : "s");
  for (const std::string& warning : warnings) {
    summary += fmt::format("  warning: {}\n", warning);
  }
  print_error("handway: {}", summary);
}

}  // namespace

void print_warnings(const geometric::Scene& scene) { print_warnings(scene.warnings); }

void print_warnings(const planning::PlanningProblem& problem) {
  std::vector<std::string> warnings = problem.scene->warnings;
  warnings.insert(warnings.end(), problem.warnings.begin(), problem.warnings.end());
  print_warnings(warnings);
}

planning::Path read_path(const planning::PlanningProblem& problem,
                         const std::filesystem::path& file) {
  planning::JointsAtRest rest{problem.start};
  planning::Path path = planning::read_path(problem.model(), file, &rest);
  if (const std::string remark = rest.remark(file); !remark.empty()) {
    print_error("handway: {}\n", remark);
  }
  return path;
}

namespace {

struct Upright {
  std::string body;  // names may hold colons
  double degrees;
};

std::optional<Upright> upright_of(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  double degrees = 0.0;
  const bool good = colon != std::string::npos && colon > 0 &&
                    CLI::detail::lexical_cast(text.substr(colon + 1), degrees) && degrees > 0.0 &&
                    degrees <= 180.0;
  return good ? std::optional(Upright{text.substr(0, colon), degrees}) : std::nullopt;
}

std::string unused_name(const geometric::Scene& scene, const std::string& name) {
  std::string unused = name;
  for (int number = 2;
       std::ranges::count(scene.constraints, unused, &geometric::PathConstraint::name) > 0;
       ++number) {
    unused = name + " " + std::to_string(number);
  }
  return unused;
}

}  // namespace

void add_upright_option(CLI::App& command, std::vector<std::string>& uprights) {
  command
      .add_option("--upright", uprights,
                  "Keep the z axis of an attached object or a link within DEGREES of the world's z "
                  "axis along the whole path")
      ->type_name("OBJECT:DEGREES")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->check([](const std::string& text) {
        return upright_of(text) ? std::string()
                                : "\"" + text +
                                      "\" is not OBJECT:DEGREES with an angle above 0 "
                                      "and up to 180 degrees";
      });
}

void add_uprights(const std::vector<std::string>& uprights, planning::SceneState& loaded) {
  if (uprights.empty()) {
    return;
  }
  geometric::Scene scene = *loaded.scene;
  const std::vector<std::string> bodies = constrainable_bodies(scene);
  for (const std::string& text : uprights) {
    const Upright upright = upright_of(text).value();
    if (std::ranges::count(bodies, upright.body) == 0) {
      throw geometric::InputError(
          {scene.file.string(), "--upright " + text,
           upright.body + (find_object(scene, upright.body) ? ", which is not attached to a link"
                                                            : ", which is not in the scene"),
           "an object on a link of " + scene.robots.front().name + ", or one of its links",
           geometric::advise_name(upright.body, bodies)});
    }
    geometric::OrientationConstraint what;
    what.angle = geometric::radians(upright.degrees);
    scene.constraints.push_back(
        {unused_name(scene, upright.body + " upright"), upright.body, what});
  }
  loaded.scene = std::make_shared<const geometric::Scene>(std::move(scene));
}

void add_group_option(CLI::App& command, std::vector<std::string>& group) {
  command
      .add_option("--group", group,
                  "Groups, robots and joints that move, instead of the scene's group; all others "
                  "stay at the start")
      ->type_name("NAME[,NAME]")
      ->delimiter(',')
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void set_group(const std::vector<std::string>& group, planning::SceneState& loaded) {
  if (group.empty()) {
    return;
  }
  geometric::Scene scene = *loaded.scene;
  geometric::set_moving_group(scene, group);
  loaded.scene = std::make_shared<const geometric::Scene>(std::move(scene));
}

namespace {

struct GivenPose {
  std::string link;  ///< Empty: not given.
  Eigen::Vector3d xyz;
  std::optional<Eigen::Vector3d> rpy;  ///< rad
};

std::optional<std::vector<double>> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& part : CLI::detail::split(text, ',')) {
    double number = 0.0;
    if (!CLI::detail::lexical_cast(CLI::detail::trim_copy(part), number) ||
        !std::isfinite(number)) {
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
                   : "\"" + text + "\" is not [LINK:]X,Y,Z or [LINK:]X,Y,Z,ROLL,PITCH,YAW";
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
