#include "scene_model.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/robot/inverse_kinematics.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "planner_model.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace handway::python {

using geometric::CollisionChecker;

CheckerPool::CheckerPool(std::shared_ptr<const CollisionChecker> prototype)
    : prototype_(std::move(prototype)) {}

std::unique_ptr<CollisionChecker> CheckerPool::take() {
  const std::lock_guard lock(mutex_);
  if (idle_.empty()) {
    return prototype_->clone();
  }
  std::unique_ptr<CollisionChecker> checker = std::move(idle_.back());
  idle_.pop_back();
  return checker;
}

void CheckerPool::lend(const std::function<void(CollisionChecker&)>& work) {
  std::unique_ptr<CollisionChecker> checker = take();
  work(*checker);
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(checker));
}

namespace {

using geometric::Configuration;
using geometric::InputError;
using geometric::Scene;

planning::SceneState load(const std::filesystem::path& file, const std::string& basis,
                          const geometric::XacroArguments& xacro) {
  planning::SceneState loaded = planning::load_scene(file, plugin_manager(), xacro);
  if (loaded.scene->robots.empty()) {
    throw InputError({file.string(), "robots", "none", "a robot to plan for", ""});
  }
  if (!basis.empty()) {
    loaded.basis = find_basis(basis);
  }
  return loaded;
}

std::shared_ptr<const Scene> with_goal(const std::shared_ptr<const Scene>& scene) {
  if (scene->goal || !scene->goal_poses.empty()) {
    return scene;
  }
  auto whole = std::make_shared<Scene>(*scene);
  whole->goal = scene->start.value_or(scene->robots.front().configuration);
  return whole;
}

Configuration goal_of(const Scene& scene, const std::optional<Configuration>& given) {
  if (!given && !scene.goal) {
    throw InputError({scene.file.string(), "goal", "nothing", "a configuration",
                      "Give it in the scene or as an argument"});
  }
  return given ? *given : *scene.goal;
}

}  // namespace

int needed_link(const geometric::RobotModel& robot, const std::string& name) {
  if (const std::optional<int> link = robot.find_link(name)) {
    return *link;
  }
  std::vector<std::string> names;
  std::ranges::transform(robot.description().links, std::back_inserter(names),
                         &geometric::Link::name);
  throw InputError({"link", "", "\"" + name + "\"", "a link of " + robot.name(),
                    geometric::advise_name(name, names)});
}

std::shared_ptr<const sampling::PmdBasis> find_basis(const std::string& reference) {
  const std::filesystem::path file = geometric::find_resource(
      geometric::ResourceKind::kHandBasis, reference, std::filesystem::current_path(), "basis");
  return std::make_shared<const sampling::PmdBasis>(sampling::read_pmd_basis(file));
}

SceneModel::SceneModel(std::shared_ptr<const Scene> scene,
                       const std::shared_ptr<const sampling::PmdBasis>& basis)
    : scene_(std::move(scene)),
      problem_(planning::make_problem(with_goal(scene_), basis)),
      checkers_(std::make_unique<CheckerPool>(problem_.checker)) {}

SceneModel::SceneModel(const std::filesystem::path& file, const std::string& basis,
                       const geometric::XacroArguments& xacro)
    : SceneModel(load(file, basis, xacro)) {}

planning::PlanningProblem SceneModel::problem_between(
    const std::optional<Configuration>& start, const std::optional<Configuration>& goal,
    const std::vector<geometric::PoseGoal>& goal_poses) const {
  auto scene = std::make_shared<Scene>(*scene_);
  scene->start = start ? *start : problem_.start;
  if (!goal_poses.empty()) {
    scene->goal_poses = goal_poses;
  } else if (goal) {
    scene->goal_poses.clear();
  }
  if (goal || scene->goal_poses.empty()) {
    scene->goal = goal_of(*scene_, goal);
  }
  for (const geometric::PoseGoal& pose : scene->goal_poses) {
    if (chain_variables(robot(), needed_link(robot(), pose.link)).empty()) {
      throw InputError({"goal_pose", "link", "\"" + pose.link + "\", which no joint moves",
                        "a link that moves", ""});
    }
  }
  return updated_problem(problem_, scene, problem_.basis);
}

}  // namespace handway::python
