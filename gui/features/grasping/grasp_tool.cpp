#include "features/grasping/grasp_tool.h"

#include "features/editing/scene_editing.h"
#include "features/grasping/grasp_card.h"
#include "model/document/document.h"
#include "model/planning/planning_session.h"
#include "view3d/scene_view.h"

#include <exception>
#include <utility>

namespace handway::gui {

GraspTool::GraspTool(Document& document, SceneEditing& editing, PlanningSession& session,
                     SceneView& view, QObject* parent)
    : QObject(parent),
      document_(document),
      editing_(editing),
      editor_(editing.editor()),
      session_(session),
      view_(view),
      card_(new GraspCard(&view)) {
  connect(editing.actions().grasp, &QAction::triggered, this, &GraspTool::begin);
  connect(&document_, &Document::opened, this, &GraspTool::end);
  connect(&document_, &Document::edited, this, [this](const SceneState& before) {
    if (before.scene != document_.scene()) {
      end();  // what was found is of another scene
    }
  });
  connect(card_, &GraspCard::looked_at, this, [this](int index) {
    view_.preview_ghost(false, grasps_.value[static_cast<std::size_t>(index)].q);
  });
  connect(card_, &GraspCard::chosen, this, &GraspTool::choose);
  connect(card_, &GraspCard::closed, this, &GraspTool::end);
}

void GraspTool::begin() {
  const geometric::SceneObject* object = editor_.selected_object();
  if (!object || !document_.problem()) {
    return;
  }
  editing_.show_handles(false);  // they would hide the fingers
  card_->show_search(QString::fromStdString(object->name));
  job_.run([this, name = object->name,
            problem = document_.problem()](const std::stop_token& stop) -> LatestJob::Answer {
    const QString title = QString::fromStdString(name);
    try {
      const PreparedProblem::Problem prepared = problem->wait(stop);
      if (!prepared) {
        return nullptr;
      }
      return [this, title, revision = problem->revision(),
              found = planning::find_pregrasps(*prepared, name, {}, stop)] {
        grasps_ = {found, revision};
        card_->show_grasps(title, grasps_.value);
      };
    } catch (const std::exception& error) {
      return [this, title, reason = QString::fromUtf8(error.what())] {
        card_->show_failure(title, reason);
      };
    }
  });
}

void GraspTool::end() {
  job_.cancel();
  card_->hide();
  editing_.show_handles(true);
  if (!std::exchange(grasps_, {}).value.empty() && document_.robot()) {
    view_.preview_ghost(false, document_.scene()->goal);
  }
}

void GraspTool::choose(int index) {
  if (grasps_.made_from != document_.revision()) {
    end();
    return;
  }
  const geometric::Configuration q = grasps_.value[static_cast<std::size_t>(index)].q;
  editor_.set_goal(q);
  if (!document_.scene()->start) {
    editor_.set_start(document_.configuration());
  }
  session_.start();
}

}  // namespace handway::gui
