#include "app/body_display_tool.h"

#include "model/document/document.h"
#include "view3d/body_meshes.h"
#include "view3d/scene_view.h"

namespace handway::gui {

BodyDisplayTool::BodyDisplayTool(Document& document, SceneView& view, QObject* parent)
    : QObject(parent), document_(document), view_(view) {
  const auto refresh_unless_visual = [this] {
    if (display_ != BodyDisplay::kVisual) {
      refresh();
    }
  };
  connect(&document_, &Document::opened, this, refresh_unless_visual);
  connect(&document_, &Document::edited, this, refresh_unless_visual);
}

void BodyDisplayTool::show(BodyDisplay display) {
  if (display != display_) {
    display_ = display;
    refresh();
  }
}

void BodyDisplayTool::refresh() {
  if (display_ == BodyDisplay::kVisual || !document_.scene()) {
    job_.cancel();
    view_.stand_in({});
    return;
  }
  job_.run([this, scene = document_.scene(),
            display = display_](const std::stop_token& stop) -> LatestJob::Answer {
    return [this, meshes = body_meshes(*scene, display, stop)] { view_.stand_in(meshes); };
  });
}

}  // namespace handway::gui
