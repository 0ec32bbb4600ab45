#include "features/editing/palm_tool.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/edits/arranging.h"
#include "handway/planning/edits/scene_edits.h"
#include "handway/planning/queries/palm_ik.h"
#include "model/document/document.h"
#include "model/document/reach_words.h"
#include "model/document/scene_editor.h"
#include "model/planning/planning_session.h"
#include "model/playback/path_player.h"
#include "view3d/goal_drawings.h"
#include "view3d/overlay.h"
#include "view3d/scene_view.h"

#include <utility>

namespace handway::gui {

using geometric::Configuration;
using Kind = SceneItem::Kind;

PalmTool::PalmTool(Document& document, SceneEditor& editor, Posing& posing,
                   PlanningSession& session, SceneView& view, QObject* parent)
    : QObject(parent),
      document_(document),
      editor_(editor),
      posing_(posing),
      session_(session),
      view_(view) {
  connect(&document_, &Document::opened, this, &PalmTool::use_robot);
  connect(&document_, &Document::hand_changed, this, &PalmTool::use_robot);
  connect(&view_, &SceneView::dragged, this, &PalmTool::drag);
  connect(&view_, &SceneView::drag_wheeled, this, &PalmTool::swing);
  connect(&editor_, &SceneEditor::palm_placed, this, &PalmTool::drop);
}

PalmTool::~PalmTool() = default;

void PalmTool::use_robot() {
  ik_.reset();
  before_.reset();
  const geometric::RobotInstance* robot = document_.robot();
  if (!robot || document_.joints().arm.empty()) {
    return;
  }
  try {
    ik_ = std::make_unique<const planning::PalmIk>(robot->model, document_.palm(),
                                                   document_.joints().arm);
  } catch (const geometric::InputError&) {  // no joint moves it: there is nothing to drag
  }
}

std::optional<planning::PalmMove> PalmTool::moved(const SceneItem& item,
                                                  const geometric::Pose& X_WP) const {
  const std::optional<Configuration> from = before_ ? now_ : editor_.posture(item);
  if (!ik_ || !from) {
    return std::nullopt;
  }
  return ik_->moved(*from, document_.robot()->X_WB.inverse() * X_WP);
}

void PalmTool::drag(const SceneItem& item, const geometric::Pose& X_WP) {
  if (!item.is_posture()) {
    return;
  }
  if (!view_.gizmo().is_dragging()) {  // put back
    view_.set_overlay(Overlay::kReach, nullptr);
    if (before_) {
      show(item, *std::exchange(before_, std::nullopt));
    }
    return;
  }
  const auto move = moved(item, X_WP);
  if (!move) {
    return;
  }
  take(item, move->q);
  show_reach(X_WP, move->reached);
}

void PalmTool::take(const SceneItem& item, const Configuration& q) {
  if (!before_) {
    before_ = editor_.posture(item);
    direction_ = {};
  }
  now_ = q;
  show(item, now_);
}

void PalmTool::show_reach(const geometric::Pose& X_WP, bool reached) {
  const geometric::RobotInstance& robot = *document_.robot();
  const geometric::Pose X_WP_now = robot.X_WB * ik_->pose(now_);
  view_.set_overlay(Overlay::kReach,
                    make_reach_node(X_WP.translation(), X_WP_now.translation(), reached));
  const auto figures =
      planning::reach_figures(*robot.model, document_.palm(), document_.joints().arm, now_);
  view_.add_to_note(figures ? reach_words(*figures, reached) : QString());
}

void PalmTool::swing(const SceneItem& item, double clicks) {
  constexpr double kStep = 0.05;  // rad a click
  const std::optional<Configuration> from = before_ ? now_ : editor_.posture(item);
  if (!item.is_posture() || !ik_ || !from) {
    return;
  }
  const geometric::Pose X_BP = ik_->pose(*from);
  take(item, ik_->swung(*from, X_BP, kStep * clicks, direction_));
  const geometric::Pose X_WP = *view_.gizmo().pose();
  const bool reached = (document_.robot()->X_WB * X_BP).isApprox(X_WP, 1e-3);
  show_reach(X_WP, reached);
}

void PalmTool::show(const SceneItem& item, const Configuration& q) {
  if (item.kind == Kind::kPalm) {
    posing_.set(q);
    return;
  }
  const bool is_start = item.kind == Kind::kStart;
  view_.preview_ghost(is_start, q);
  session_.try_scene(is_start ? with_start(editor_.state(), q) : with_goal(editor_.state(), q));
}

void PalmTool::refuse(const SceneItem& item, const geometric::Pose& X_WP,
                      const planning::PalmMove& nearest) {
  const geometric::Pose X_WN = document_.robot()->X_WB * ik_->pose(nearest.q);
  const double away = (X_WN.translation() - X_WP.translation()).norm();
  const double turned = Eigen::AngleAxisd(X_WN.linear().transpose() * X_WP.linear()).angle();
  emit refused(tr("The pose is out of reach"),
               tr("The arm gets no nearer than %1 mm and %2° to it. The %3 was left as it was.")
                   .arg(geometric::millimetres(away), 0, 'f', 1)
                   .arg(geometric::degrees(turned), 0, 'f', 1)
                   .arg(item.kind == Kind::kStart  ? tr("start")
                        : item.kind == Kind::kGoal ? tr("goal")
                                                   : tr("robot")));
  editor_.select(SceneItem(item));  // its fields show where it is
}

void PalmTool::drop(const SceneItem& item, const geometric::Pose& X_WP) {
  const auto move = moved(item, X_WP);
  const bool was_dragged = before_.has_value();
  before_.reset();
  view_.set_overlay(Overlay::kReach, nullptr);
  if (!move) {
    emit refused(tr("The palm stays where it is"), tr("No arm of the robot moves it."));
    return;
  }
  if (!move->reached && !was_dragged) {  // what is dragged shows how far it gets
    refuse(item, X_WP, *move);
    return;
  }
  const Configuration& q = move->q;
  switch (item.kind) {
    case Kind::kStart:
      editor_.set_start(q);
      break;
    case Kind::kGoal:
      editor_.set_goal(q);
      break;
    default:
      posing_.set(q);
  }
}

}  // namespace handway::gui
