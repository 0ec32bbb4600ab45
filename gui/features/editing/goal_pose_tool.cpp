#include "features/editing/goal_pose_tool.h"

#include "features/workbench.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/setup/moving_group.h"
#include "handway/planning/queries/palm_ik.h"
#include "model/document/prepared_problem.h"
#include "model/document/reach_words.h"
#include "view3d/goal_drawings.h"
#include "view3d/overlay.h"
#include "view3d/scene_view.h"
#include "widgets/style/actions.h"

#include <QAction>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

namespace handway::gui {

using geometric::NumericInverseKinematics;

namespace {

// Makes kinematics of the joints that move. Returns null if none of them moves the link.
std::unique_ptr<const NumericInverseKinematics> kinematics_of(const geometric::Scene& scene,
                                                              const geometric::PoseGoal& goal) {
  const geometric::RobotModel& model = *scene.robots.front().model;
  std::vector<std::string> joints;
  const std::vector<int> chain = chain_variables(model, model.find_link(goal.link).value());
  for (const int v : geometric::moving_variables(scene)) {
    if (std::ranges::count(chain, v) > 0) {
      joints.push_back(model.variable(v).name);
    }
  }
  if (joints.empty()) {
    return nullptr;
  }
  geometric::NumericIkOptions options;
  options.X_LT = goal.X_LT;
  options.stay_near = true;
  options.max_restarts = 2;  // it follows the pointer
  options.position_tolerance = 1e-4;
  options.orientation_tolerance = 1e-3;
  const auto is_free = goal.rotation_tolerance.array() >= std::numbers::pi;
  options.position_only = is_free.all();
  options.rotation_slack =
      is_free.select(Eigen::Vector3d::Constant(std::numbers::pi), Eigen::Vector3d::Zero());
  return std::make_unique<const NumericInverseKinematics>(scene.robots.front().model, goal.link,
                                                          joints, options);
}

std::vector<PoseReached> reached_poses(const planning::PlanningProblem& problem) {
  std::vector<PoseReached> reached(problem.scene->goal_poses.size(), PoseReached::kNo);
  for (const planning::GoalCandidate& candidate : problem.goals) {
    reached[candidate.pose] = PoseReached::kYes;
  }
  return reached;
}

}  // namespace

GoalPoseTool::GoalPoseTool(Workbench& workbench) : workbench_(workbench) {
  add_command();
  connect(&workbench_, &Workbench::scene_shown, this, &GoalPoseTool::show);
  connect(&workbench_.document, &Document::edited, this,
          [this](const planning::SceneState& before) {
            if (before.scene != workbench_.document.scene()) {
              show();
            }
          });
  connect(&workbench_.view, &SceneView::dragged, this, &GoalPoseTool::drag);
  connect(&workbench_.view, &SceneView::dropped, this, [this] { ik_.reset(); });
}

void GoalPoseTool::add_command() {
  QAction* add = workbench_.make_action(
      "goal", tr("Add a &goal pose"), {},
      tr("A goal that is given by where the palm has to be: here at first, to be dragged"));
  add->setObjectName(QStringLiteral("add_goal_pose"));
  workbench_.add_to_menu(MainMenu::kPlan, {1, 8}, add);
  workbench_.add_to_menu(MainMenu::kContext, {5, 8}, add);
  const auto update_enabled = [this, add] {
    allow(*add, workbench_.editor.can_add_goal_pose()
                    ? QString()
                    : tr("The scene has no robot whose palm an arm moves."));
  };
  connect(add, &QAction::triggered, &workbench_.editor, &SceneEditor::add_goal_pose);
  connect(&workbench_.document, &Document::opened, add, update_enabled);
  connect(&workbench_.document, &Document::hand_changed, add, update_enabled);
  update_enabled();
}

void GoalPoseTool::show() {
  const auto& scene = workbench_.document.scene();
  const bool has_any = scene && !scene->goal_poses.empty();
  workbench_.view.set_overlay(Overlay::kGoalPoses,
                              has_any ? make_goal_poses_node(*scene, {}) : Drawing());
  job_.cancel();
  if (has_any) {
    show_solution();
  }
}

void GoalPoseTool::show_solution() {
  job_.run([this, problem = workbench_.document.problem()](
               const std::stop_token& stop) -> LatestJob::Answer {
    try {
      const PreparedProblem::Problem prepared = problem->wait(stop);
      if (!prepared) {
        return nullptr;
      }
      return [this, prepared] {
        workbench_.view.preview_ghost(false, prepared->goal);
        workbench_.view.set_overlay(
            Overlay::kGoalPoses, make_goal_poses_node(*prepared->scene, reached_poses(*prepared)));
      };
    } catch (const geometric::InputError&) {  // planning says what is wrong
      return nullptr;
    }
  });
}

bool GoalPoseTool::follow(const geometric::PoseGoal& goal, const geometric::Pose& X_WG) {
  const geometric::RobotInstance& robot = *workbench_.document.robot();
  if (!ik_) {
    job_.cancel();
    ik_ = kinematics_of(*workbench_.document.scene(), goal);
    const auto prepared = workbench_.document.problem()->if_ready();
    q_ = prepared ? prepared->goal : workbench_.document.configuration();
  }
  if (!ik_) {
    return false;
  }
  const geometric::NumericIkResult found = ik_->find(robot.X_WB.inverse() * X_WG, q_);
  q_ = found.q;
  workbench_.view.preview_ghost(false, q_);
  const auto figures = planning::reach_figures(
      *robot.model, robot.model->find_link(goal.link).value(), ik_->variables(), q_);
  workbench_.view.add_to_note(figures ? reach_words(*figures, found.converged) : QString());
  return found.converged;
}

void GoalPoseTool::drag(const SceneItem& item, const geometric::Pose& X_WG) {
  const geometric::PoseGoal* goal = find_goal_pose(workbench_.editor.state(), item);
  if (!goal) {
    return;
  }
  if (!workbench_.view.gizmo().is_dragging()) {  // put back
    ik_.reset();
    show();
    return;
  }
  const auto index =
      static_cast<std::size_t>(goal - workbench_.document.scene()->goal_poses.data());
  std::vector<PoseReached> reached(index + 1, PoseReached::kUnknown);
  reached[index] = follow(*goal, X_WG) ? PoseReached::kYes : PoseReached::kNo;
  const planning::SceneState tried = with_goal_pose(workbench_.editor.state(), index, [&] {
    geometric::PoseGoal moved = *goal;
    moved.X_WG = X_WG;
    return moved;
  }());
  workbench_.view.set_overlay(Overlay::kGoalPoses, make_goal_poses_node(*tried.scene, reached));
}

}  // namespace handway::gui
