#include "features/editing/frame_tool.h"

#include "features/workbench.h"
#include "model/document/document.h"
#include "model/document/scene_editor.h"
#include "view3d/frame_drawings.h"
#include "view3d/overlay.h"
#include "view3d/scene_view.h"
#include "widgets/style/actions.h"

#include <QAction>

#include <algorithm>

namespace handway::gui {

FrameTool::FrameTool(Workbench& workbench) : workbench_(workbench) {
  add_command();
  connect(&workbench_, &Workbench::scene_shown, this, &FrameTool::show);
  connect(&workbench_.document, &Document::edited, this, &FrameTool::show);
  connect(&workbench_.document, &Document::configuration_changed, this, &FrameTool::show);
  connect(&workbench_.view, &SceneView::dragged, this, &FrameTool::drag);
}

void FrameTool::add_command() {
  QAction* add = workbench_.make_action(
      "local_axes", tr("&Frame"), {},
      tr("A named frame on the selected object or link, to place things on and to move to"));
  add->setObjectName(QStringLiteral("add_frame"));
  workbench_.add_to_menu(MainMenu::kAdd, {4, 0}, add);
  const auto update_enabled = [this, add] {
    allow(*add, workbench_.document.robot() ? QString() : tr("The scene has no robot."));
  };
  connect(add, &QAction::triggered, this,
          [this] { workbench_.editor.add_frame(workbench_.view.place_for_new()); });
  connect(&workbench_.document, &Document::opened, add, update_enabled);
  connect(&workbench_.document, &Document::edited, add, update_enabled);
  update_enabled();
}

void FrameTool::show() {
  const auto& scene = workbench_.document.scene();
  const bool has_any = scene && !scene->frames.empty() && workbench_.document.robot();
  if (has_any || has_shown_) {  // a robot that moves shall not cost a drawing of nothing
    workbench_.view.set_overlay(
        Overlay::kFrames,
        has_any ? make_frames_node(*scene, workbench_.document.configuration()) : Drawing());
  }
  has_shown_ = has_any;
}

void FrameTool::drag(const SceneItem& item, const geometric::Pose& X_WF) {
  const geometric::NamedFrame* frame = find_frame(workbench_.editor.state(), item);
  if (!frame) {
    return;
  }
  geometric::Scene scene = *workbench_.document.scene();
  const auto dragged = std::ranges::find(scene.frames, frame->name, &geometric::NamedFrame::name);
  dragged->parent.clear();
  dragged->X_PF = X_WF;
  workbench_.view.set_overlay(Overlay::kFrames,
                              make_frames_node(scene, workbench_.document.configuration()));
}

}  // namespace handway::gui
