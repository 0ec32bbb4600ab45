#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/extensions/plugin.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace handway::python {

/// Lends collision checkers, one to a thread at a time, and keeps the returned
/// ones.
class CheckerPool {
 public:
  explicit CheckerPool(std::shared_ptr<const geometric::CollisionChecker> prototype);

  /// Runs `work` with a checker of its own. May be called from several threads.
  void lend(const std::function<void(geometric::CollisionChecker&)>& work);

 private:
  [[nodiscard]] std::unique_ptr<geometric::CollisionChecker> take();

  std::shared_ptr<const geometric::CollisionChecker> prototype_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<geometric::CollisionChecker>> idle_;
};

/// A scene for Python: the contents of a file, ready for planning and queries. Immutable; shared by
/// threads.
class SceneModel {
 public:
  /// @param basis file or name in the library, instead of the scene's; empty: the scene's.
  /// @param xacro arguments of a robot file in xacro.
  /// @throws InputError as load_scene(), make_problem() and read_pmd_basis(); but start and goal
  /// may be missing.
  SceneModel(const std::filesystem::path& file, const std::string& basis,
             const geometric::XacroArguments& xacro = {});

  /// @param basis null: none.
  /// @throws InputError as make_problem().
  SceneModel(std::shared_ptr<const geometric::Scene> scene,
             const std::shared_ptr<const sampling::PmdBasis>& basis);

  [[nodiscard]] const geometric::Scene& scene() const { return *scene_; }
  [[nodiscard]] const geometric::RobotModel& robot() const { return *scene_->robots[0].model; }
  [[nodiscard]] const planning::PlanningProblem& problem() const { return problem_; }
  [[nodiscard]] CheckerPool& checkers() const { return *checkers_; }

  /// The query from `start` to `goal`; missing ones are the scene's.
  /// @param goal_poses replace the scene's; `goal` is then for the joints that don't move their
  /// links. Without poses, a given `goal` is the goal, even if the scene has poses.
  /// @throws InputError if the scene has none either, or lacks a goal's link.
  [[nodiscard]] planning::PlanningProblem problem_between(
      const std::optional<geometric::Configuration>& start,
      const std::optional<geometric::Configuration>& goal,
      const std::vector<geometric::PoseGoal>& goal_poses = {}) const;

 private:
  explicit SceneModel(const planning::SceneState& loaded)
      : SceneModel(loaded.scene, loaded.basis) {}

  std::shared_ptr<const geometric::Scene> scene_;  ///< The scene as read.
  planning::PlanningProblem problem_;              ///< Ends that the scene lacks are the robot's.
  std::unique_ptr<CheckerPool> checkers_;
};

/// Index of the link called `name`.
/// @throws InputError naming the nearest link if it does not exist.
[[nodiscard]] int needed_link(const geometric::RobotModel& robot, const std::string& name);

/// A basis of the library by name, or a file.
/// @throws InputError if it does not exist or can't be read.
[[nodiscard]] std::shared_ptr<const sampling::PmdBasis> find_basis(const std::string& reference);

}  // namespace handway::python
