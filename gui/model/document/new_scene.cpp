#include "model/document/new_scene.h"

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/robot/composed_robot.h"
#include "handway/geometric/setup/mounting.h"
#include "handway/geometric/setup/placing.h"
#include "handway/geometric/setup/seat.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/edits/arranging.h"
#include "handway/planning/edits/robot_edits.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/queries/nearest_free.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <QString>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace handway::gui {
namespace {

using geometric::Configuration;
using geometric::Pose;
using geometric::ResourceKind;
using geometric::RobotInstance;
using geometric::Scene;

constexpr double kTableHeight = 0.72;  // m
constexpr double kTableLength = 1.4;   // m, in the direction that the arm reaches in
constexpr double kTableWidth = 1.2;    // m
constexpr double kTableAhead = 0.35;   // m, of its middle before the robot
constexpr geometric::Color kTableColor{0.72F, 0.70F, 0.66F, 1.0F};

RobotInstance library_robot(const std::string& name, const planning::PluginManager& plugins) {
  const planning::SceneState loaded = planning::load_scene(
      geometric::find_resource(ResourceKind::kRobot, name, geometric::resource_dir()), plugins);
  return loaded.scene->robots.front();
}

bool is_called(const geometric::NamedPosture& posture, const char* name) {
  return QString::fromStdString(posture.name).contains(QLatin1String(name), Qt::CaseInsensitive);
}

/// Returns the depth of the root link below the base's origin, m.
double depth_below_base(const geometric::RobotModel& model) {
  double lowest = 0.0;
  for (const geometric::LinkGeometry& part : model.link(0).collision) {
    const auto mesh = geometric::tessellate(part.shape);
    if (mesh && !mesh->vertices.empty()) {
      const geometric::Aabb box = geometric::bounding_box(geometric::transformed(*mesh, part.X_LG));
      lowest = std::min(lowest, box.lower.z());
    }
  }
  return -lowest;
}

/// Stands the first robot on a table that reaches to where it works.
void put_on_table(Scene& scene) {
  RobotInstance& robot = scene.robots.front();
  std::vector<Pose> X_BL(static_cast<std::size_t>(robot.model->link_count()));
  robot.model->forward_kinematics(robot.configuration, X_BL);
  const Eigen::Vector3d reach = X_BL.back().translation();
  const Eigen::Index axis = std::abs(reach.y()) > std::abs(reach.x()) ? 1 : 0;
  const double sign = reach[axis] < 0.0 ? -1.0 : 1.0;
  geometric::SceneObject table;
  table.name = "table";
  Eigen::Vector3d size(kTableWidth, kTableWidth, kTableHeight);
  size[axis] = kTableLength;
  table.shape = geometric::Box{size};
  table.X_PO = Eigen::Translation3d(sign * kTableAhead * Eigen::Vector3d::Unit(axis) +
                                    0.5 * kTableHeight * Eigen::Vector3d::UnitZ());
  table.color = kTableColor;
  scene.objects.push_back(table);
  robot.X_WB = Eigen::Translation3d(
      0.0, 0.0, kTableHeight + geometric::kRestingGap + depth_below_base(*robot.model));
}

/// The scene's collision checks, at the posture that is shown.
planning::PlanningProblem problem_at_rest(const Scene& scene) {
  auto asked = std::make_shared<Scene>(scene);
  asked->start = asked->goal = scene.robots.front().configuration;
  return planning::make_problem(std::move(asked), nullptr);
}

bool is_free(const planning::PlanningProblem& problem) {
  return !problem.checker->clone()->first_collision(problem.start);
}

/// Turns the mounted hand about the axis of its seat until nothing touches. @returns whether it
/// could.
bool turn_hand(Scene& scene) {
  RobotInstance& robot = scene.robots.front();
  if (robot.parts.size() < 2) {
    return false;
  }
  const std::string hand = robot.parts.back().name;
  const Pose seat = robot.parts.back().X_LB;
  for (const double eighths : {4.0, 2.0, -2.0, 1.0, -1.0, 3.0, -3.0}) {
    const Eigen::AngleAxisd turn(0.25 * eighths * std::numbers::pi, Eigen::Vector3d::UnitZ());
    Scene turned = scene;
    geometric::move_mount(turned, hand, seat * turn);
    turned.robots.front().configuration = ready_posture(*turned.robots.front().model);
    if (is_free(problem_at_rest(turned))) {
      scene = std::move(turned);
      return true;
    }
  }
  return false;
}

/// Makes the posture that is shown free of collision, if there is a free one near.
void clear_posture(Scene& scene) {
  const planning::PlanningProblem problem = problem_at_rest(scene);
  if (is_free(problem) || turn_hand(scene)) {
    return;
  }
  planning::NearestFreeOptions options;
  options.most_distance = std::numbers::pi / 2.0;
  const planning::NearestFree near = planning::find_nearest_free(problem, problem.start, options);
  if (near.q) {
    scene.robots.front().configuration = *near.q;
  }
}

/// Mounts a hand on the end of the scene's arm.
void mount_hand(Scene& scene, const std::string& hand, const planning::PluginManager& plugins) {
  const std::optional<planning::LinkOfRobot> end = planning::end_of_arm(scene);
  if (!end) {
    throw geometric::InputError({"", "robot " + scene.robots.front().name, "no end of an arm",
                                 "an arm without a hand", ""});
  }
  scene.robots.push_back(library_robot(hand, plugins));
  const auto seat = geometric::find_seat(*scene.robots.front().model, *scene.robots.back().model);
  geometric::mount_robot(scene, scene.robots.back().name, end->robot, seat ? seat->link : end->link,
                         seat ? seat->X_LB : Pose::Identity());
}

}  // namespace

Configuration ready_posture(const geometric::RobotModel& model) {
  Configuration q = model.neutral();
  const auto& postures = model.description().postures;
  std::vector<std::string> placed;  // groups
  for (const char* name : {"ready", "home"}) {
    for (const geometric::NamedPosture& posture : postures) {
      if (!is_called(posture, name) || std::ranges::count(placed, posture.group) > 0) {
        continue;
      }
      placed.push_back(posture.group);
      for (const auto& [joint, value] : posture.values) {
        if (const auto variable = geometric::find_variable_of_part(model, joint)) {
          q[*variable] = value;
        }
      }
    }
  }
  return q;
}

planning::SceneState new_scene(const std::string& robot, const std::string& hand,
                               const planning::PluginManager& plugins) {
  Scene scene;
  scene.robots = {library_robot(robot, plugins)};
  const bool is_arm = planning::end_of_arm(scene).has_value() ||
                      scene.robots.front().model->find_group("arm").has_value();
  if (!hand.empty()) {
    mount_hand(scene, hand, plugins);
  }
  RobotInstance& first = scene.robots.front();
  first.configuration = ready_posture(*first.model);
  if (is_arm) {
    put_on_table(scene);
  }
  clear_posture(scene);
  std::shared_ptr<const sampling::PmdBasis> basis;
  if (auto fitting = planning::fitting_basis(*scene.robots.front().model)) {
    scene.hand_basis = fitting->first;
    basis = std::make_shared<const sampling::PmdBasis>(std::move(fitting->second));
  }
  return {std::make_shared<const Scene>(std::move(scene)), basis};
}

}  // namespace handway::gui
