#include "commands.h"
#include "handway/device/retargeting/workspace_overlap.h"
#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/plural.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/limit_violation.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/core/pose_goals.h"
#include "handway/planning/core/select_joints.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "printing.h"
#include "robot_report.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace handway::tools {
namespace {

using geometric::RobotModel;
using Json = nlohmann::ordered_json;

constexpr int kInfoSamples = 1000;
constexpr std::uint64_t kInfoSeed = 1;

std::size_t triangle_count(const std::vector<geometric::LinkGeometry>& geometry) {
  std::size_t count = 0;
  for (const geometric::LinkGeometry& part : geometry) {
    count += tessellate(part.shape)->triangles.size();
  }
  return count;
}

std::vector<std::string> links_with_open_meshes(const RobotModel& model) {
  std::vector<std::string> links;
  for (const geometric::Link& link : model.description().links) {
    if (std::ranges::any_of(link.collision, [](const geometric::LinkGeometry& geometry) {
          return !is_closed(geometry.shape);
        })) {
      links.push_back(link.name);
    }
  }
  return links;
}

void print_robot(const geometric::RobotInstance& robot) {
  const RobotModel& model = *robot.model;
  std::size_t visual = 0;
  std::size_t collision = 0;
  for (int i = 0; i < model.link_count(); ++i) {
    visual += triangle_count(model.link(i).visual);
    collision += triangle_count(model.link(i).collision);
  }
  print_out("robot {}: {} links, {} independent joints, {} visual and {} collision triangles\n",
            robot.name, model.link_count(), model.variable_count(), visual, collision);
  std::size_t widest = 18;
  for (int i = 1; i < model.link_count(); ++i) {
    widest = std::max(widest, model.joint(i).name.size());
  }
  print_out("  {:<{}} {:>10} {:>10} {:>10}  {}\n", "joint", widest, "lower", "upper", "max speed",
            "coupled to");
  for (int i = 1; i < model.link_count(); ++i) {
    const geometric::Joint& joint = model.joint(i);
    if (joint.type == geometric::JointType::kFixed) {
      continue;
    }
    const bool turns = joint.type == geometric::JointType::kRevolute;
    const auto shown = [&](double value) {
      return turns ? geometric::degrees(value) : geometric::millimetres(value);
    };
    const auto limit = [&](double value) {
      return joint.is_continuous() ? "none" : fmt::format("{:.2f}", shown(value));
    };
    print_out("  {:<{}} {:>10} {:>10} {:>10.1f}  {} {}\n", joint.name, widest,
              limit(joint.limits.lower), limit(joint.limits.upper), shown(joint.limits.velocity),
              joint.mimic ? joint.mimic->joint : "", turns ? "(deg)" : "(mm)");
  }
  if (const std::vector<std::string> open = links_with_open_meshes(model); !open.empty()) {
    print_out("  open collision meshes, treated as surfaces instead of solids: {}\n",
              fmt::join(open, ", "));
  }
  for (const geometric::JointGroup& group : model.description().groups) {
    const auto count = std::ranges::count_if(group.joints, [&](const std::string& joint) {
      return std::ranges::any_of(model.description().joints, [&](const geometric::Joint& other) {
        return other.name == joint && other.type != geometric::JointType::kFixed;
      });
    });
    print_out("  group {}: {}\n", group.name, geometric::plural(count, "joint"));
  }
  for (const geometric::RobotPart& part : robot.parts) {
    print_out("  part {}: {}{}\n", part.name, part.model->name(),
              part.carrier < 0
                  ? ""
                  : fmt::format(", on {} of {}", part.link,
                                robot.parts[static_cast<std::size_t>(part.carrier)].name));
  }
}

void print_basis(const sampling::PmdBasis& basis) {
  print_out("basis for {}: {} joints, {} free, {} principal directions ({})\n", basis.hand,
            basis.joints.size(), basis.free_joints.size(), basis.directions.size(), basis.source);
}

// Start or goal: whether it is free of collision, and the touching or closest pairs.
struct End {
  const char* which;
  bool within_limits = true;
  std::vector<geometric::LimitViolation> violations = {};
  std::vector<geometric::NamedPair> touching = {};
  std::vector<std::string> violated = {};  ///< Constraints.
  std::optional<geometric::NamedPair> closest =
      std::nullopt;  ///< Closest pair of a free end, if any.
};

std::vector<End> examine_ends(const geometric::Scene& scene, geometric::CollisionChecker& checker) {
  const RobotModel& model = checker.world().model();
  std::vector<End> ends;
  for (const auto& [which, q] :
       {std::pair("start", &scene.start), std::pair("goal", &scene.goal)}) {
    const bool is_for_poses = q == &scene.goal && !scene.goal_poses.empty();
    if (!q->has_value() || is_for_poses) {
      continue;
    }
    End end{which};
    end.violations = geometric::limit_violations(model, **q);
    end.within_limits = end.violations.empty();
    end.touching = geometric::find_collisions(checker, **q);
    end.violated = geometric::violated_constraints(checker, **q);
    if (end.touching.empty() && !checker.world().pairs().empty()) {
      end.closest = geometric::find_clearance(checker, **q);
    }
    ends.push_back(std::move(end));
  }
  return ends;
}

void print_ends(const std::vector<End>& ends, const geometric::CollisionChecker& checker) {
  for (const End& end : ends) {
    for (const geometric::LimitViolation& violation : end.violations) {
      print_out("{}: OUT OF LIMITS, {}\n", end.which, to_string(violation));
    }
    for (const std::string& violated : end.violated) {
      print_out("{}: VIOLATES {}\n", end.which, violated);
    }
    if (end.closest) {
      print_out("{}: free, closest {} with {} at {:.3f} mm\n", end.which, end.closest->a,
                end.closest->b, geometric::millimetres(end.closest->distance));
    } else if (end.touching.empty()) {
      print_out("{}: free\n", end.which);
    }
    for (const geometric::NamedPair& pair : end.touching) {
      print_out("{}: IN COLLISION, {} with {}\n", end.which, pair.a, pair.b);
    }
  }
  print_out("checked pairs of bodies: {}\n", checker.world().pairs().size());
}

// For each goal pose, the number of free configurations found that reach it.
std::vector<std::ptrdiff_t> counts_of(const geometric::Scene& scene,
                                      const planning::PoseGoalSolutions& solutions) {
  std::vector<std::ptrdiff_t> counts;
  for (std::size_t pose = 0; pose < scene.goal_poses.size(); ++pose) {
    counts.push_back(
        std::ranges::count(solutions.candidates, pose, &planning::GoalCandidate::pose));
  }
  return counts;
}

void print_goal_poses(const geometric::Scene& scene, const planning::PoseGoalSolutions& solutions) {
  const std::vector<std::ptrdiff_t> counts = counts_of(scene, solutions);
  for (std::size_t pose = 0; pose < counts.size(); ++pose) {
    print_out("{}: {} free configuration{} found\n", planning::name_of_pose_goal(scene, pose),
              counts[pose], counts[pose] == 1 ? "" : "s");
  }
  if (!solutions.fault.empty()) {
    print_out("{}\n", solutions.fault);
  }
}

Json json_of(const geometric::Scene& scene, const planning::PoseGoalSolutions& solutions) {
  const std::vector<std::ptrdiff_t> counts = counts_of(scene, solutions);
  Json poses = Json::array();
  for (std::size_t pose = 0; pose < counts.size(); ++pose) {
    poses.push_back({{"link", scene.goal_poses[pose].link}, {"configurations", counts[pose]}});
  }
  return poses;
}

Json json_of(const End& end) {
  const geometric::NamedPair* pair =
      end.touching.empty() ? (end.closest ? &*end.closest : nullptr) : &end.touching.front();
  Json object{{"free", end.touching.empty()},
              {"within_limits", end.within_limits},
              {"violated", end.violated}};
  object["pair"] = pair ? Json::array({pair->a, pair->b}) : Json();
  object["distance_mm"] = pair ? Json(geometric::millimetres(pair->distance)) : Json();
  return object;
}

// Returns the kind of the object's shape in collision checking.
const char* form_of(const geometric::SceneObject& object) {
  const bool closed = is_closed(object.shape);
  return closed && object.solid ? "solid"
         : closed               ? "surface (solid: false)"
                                : "surface (open mesh)";
}

const char* kind_of(const geometric::PathConstraint& constraint) {
  return std::holds_alternative<geometric::OrientationConstraint>(constraint.what) ? "orientation"
                                                                                   : "position";
}

std::vector<std::string> part_names(const geometric::RobotInstance& robot) {
  std::vector<std::string> names;
  std::ranges::transform(robot.parts, std::back_inserter(names), &geometric::RobotPart::name);
  return names;
}

device::WorkspaceOverlap overlap_of(const geometric::Scene& scene) {
  device::RetargetingSettings only_kinematics;
  only_kinematics.self_collision = false;
  return device::workspace_overlap(
      device::FingertipRetargeter(scene.robots.front().model, only_kinematics));
}

void print_overlap(const device::WorkspaceOverlap& overlap) {
  print_out("fingertips reach {:.0f} % of the workspaces of a human hand's five\n",
            100.0 * overlap.coverage());
  for (const device::FingertipOverlap& finger : overlap.fingers) {
    print_out("  {:<8} {:>3.0f} % of the human workspace; {:.0f} % of its own is human\n",
              device::name_of(finger.finger), 100.0 * finger.coverage(),
              100.0 * finger.human_share());
  }
}

Json json_of(const device::WorkspaceOverlap& overlap) {
  Json fingers = Json::array();
  for (const device::FingertipOverlap& finger : overlap.fingers) {
    fingers.push_back({{"finger", device::name_of(finger.finger)},
                       {"coverage", finger.coverage()},
                       {"human_share", finger.human_share()}});
  }
  return {{"coverage", overlap.coverage()}, {"fingers", fingers}};
}

/// Findings that take more than reading the files.
struct Examination {
  std::optional<RobotReport> robot;
  std::optional<device::WorkspaceOverlap> overlap;
};

void print_json(const geometric::Scene& scene, const std::vector<End>& ends,
                const std::optional<planning::PoseGoalSolutions>& solutions,
                const Examination& examined, const std::vector<std::string>& warnings) {
  Json robots = Json::array();
  for (const geometric::RobotInstance& robot : scene.robots) {
    robots.push_back({{"name", robot.name},
                      {"links", robot.model->link_count()},
                      {"joints", robot.model->variable_count()},
                      {"links_with_open_meshes", links_with_open_meshes(*robot.model)},
                      {"parts", part_names(robot)}});
  }
  Json objects = Json::array();
  for (const geometric::SceneObject& object : scene.objects) {
    objects.push_back({{"name", object.name},
                       {"shape", shape_name(object.shape)},
                       {"solid", object.solid && is_closed(object.shape)}});
  }
  Json constraints = Json::array();
  for (const geometric::PathConstraint& constraint : scene.constraints) {
    constraints.push_back(
        {{"name", constraint.name}, {"body", constraint.body}, {"kind", kind_of(constraint)}});
  }
  Json report{{"name", scene.name},   {"robots", robots},          {"objects", objects},
              {"start", nullptr},     {"goal", nullptr},           {"warnings", warnings},
              {"group", scene.group}, {"constraints", constraints}};
  for (const End& end : ends) {
    report[end.which] = json_of(end);
  }
  if (solutions) {
    report["goal_poses"] = json_of(scene, *solutions);
    report["goal_fault"] = solutions->fault;
  }
  if (examined.robot) {
    report["findings"] = findings_json(*examined.robot);
  }
  if (examined.overlap) {
    report["anthropomorphism"] = json_of(*examined.overlap);
  }
  print_out("{}\n", report.dump(2));
}

// Returns whether the shape is approximated by a polyhedron around it.
bool is_round(const geometric::Shape& shape) {
  return !std::holds_alternative<geometric::Box>(shape) &&
         !std::holds_alternative<geometric::Mesh>(shape) &&
         !std::holds_alternative<geometric::Cloud>(shape);
}

void print_text(const std::filesystem::path& file, const planning::SceneState& loaded,
                const std::vector<End>& ends,
                const std::optional<planning::PoseGoalSolutions>& solutions,
                const geometric::CollisionChecker* checker, const Examination& examined,
                const std::vector<std::string>& warnings) {
  const geometric::Scene& scene = *loaded.scene;
  print_out("{}\n", scene.name.empty() ? file.string() : scene.name);
  if (!scene.description.empty()) {
    print_out("{}\n", scene.description);
  }
  for (const geometric::RobotInstance& robot : scene.robots) {
    print_robot(robot);
  }
  for (const geometric::SceneObject& object : scene.objects) {
    print_out("object {}: {}, {} triangles{}, {}{}\n", object.name, shape_name(object.shape),
              tessellate(object.shape)->triangles.size(),
              is_round(object.shape)
                  ? fmt::format(" up to {:g} mm outside",
                                geometric::millimetres(geometric::kRoundTolerance))
                  : "",
              form_of(object), object.attachment ? ", carried by " + object.attachment->link : "");
  }
  for (const geometric::PathConstraint& constraint : scene.constraints) {
    print_out("constraint {}: {} of {} along the path\n", constraint.name, kind_of(constraint),
              constraint.body);
  }
  if (loaded.basis) {
    print_basis(*loaded.basis);
  }
  const geometric::JointSelection joints = planning::select_joints(scene, nullptr);
  if (!scene.group.empty()) {
    print_out("moves: {} ({} of {} joints)\n", fmt::join(scene.group, ", "), joints.moving.size(),
              joints.moving.size() + joints.fixed.size());
  }
  if (!joints.fixed_limb_joints.empty()) {
    print_out("stays at the start: {} joints of arms that the goal does not move\n",
              joints.fixed_limb_joints.size());
  }
  if (checker) {
    print_ends(ends, *checker);
  }
  if (solutions) {
    print_goal_poses(scene, *solutions);
  }
  if (examined.overlap) {
    print_overlap(*examined.overlap);
  }
  if (examined.robot) {
    print_findings(*examined.robot);
  }
  for (const std::string& warning : warnings) {
    print_out("warning: {}\n", warning);
  }
}

int info(const std::filesystem::path& file, bool as_json, bool with_overlap) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  const planning::SceneState loaded = planning::load_scene(file, plugins);
  const geometric::Scene& scene = *loaded.scene;
  std::unique_ptr<geometric::CollisionChecker> checker;
  std::vector<End> ends;
  std::optional<planning::PoseGoalSolutions> solutions;
  if (scene.start || scene.goal || !scene.goal_poses.empty()) {
    checker =
        geometric::make_collision_checker(std::make_shared<const geometric::CollisionWorld>(scene));
    ends = examine_ends(scene, *checker);
    if (!scene.goal_poses.empty()) {
      solutions = planning::solve_pose_goals(
          scene, *checker, scene.start.value_or(scene.robots.front().configuration));
    }
  }
  std::vector<std::string> warnings = scene.warnings;
  for (const planning::RefusedPlugin& plugin : plugins.refused()) {
    warnings.push_back(
        fmt::format("plugin {} was not loaded: {}", plugin.file.string(), plugin.reason));
  }
  Examination examined;
  if (geometric::is_robot_file(file)) {
    const std::shared_ptr<const RobotModel>& model = scene.robots.front().model;
    examined.robot =
        robot_report(model, geometric::propose_groups(*model), kInfoSamples, kInfoSeed);
  }
  if (with_overlap && !scene.robots.empty()) {
    examined.overlap = overlap_of(scene);
  }
  if (as_json) {
    print_json(scene, ends, solutions, examined, warnings);
  } else {
    print_text(file, loaded, ends, solutions, checker.get(), examined, warnings);
  }
  return kDone;
}

}  // namespace

void add_info_command(CLI::App& app, int& exit_code) {
  auto file = std::make_shared<std::filesystem::path>();
  CLI::App* command = app.add_subcommand("info", "Show the contents of a scene or robot file");
  command
      ->add_option("file", *file,
                   "Scene, problem or robot file, or the name of a robot of the library")
      ->required();
  auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "Print JSON");
  auto with_overlap = std::make_shared<bool>(false);
  command->add_flag("--anthropomorphism", *with_overlap,
                    "Compare the fingertips' workspaces with those of a human hand");
  command->callback([file, as_json, with_overlap, &exit_code] {
    exit_code = info(*file, *as_json, *with_overlap);
  });
}

}  // namespace handway::tools
