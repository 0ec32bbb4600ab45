#include "features/editing/constraint_display.h"

#include "model/document/document.h"
#include "view3d/constraint_node.h"
#include "view3d/scene_view.h"

#include <Inventor/nodes/SoSeparator.h>

namespace handway::gui {

ConstraintDisplay::ConstraintDisplay(Document& document, SceneView& view, QObject* parent)
    : QObject(parent), document_(document), view_(view) {
  connect(&document_, &Document::opened, this, &ConstraintDisplay::show);
  connect(&document_, &Document::edited, this, &ConstraintDisplay::show);
  connect(&document_, &Document::configuration_changed, this, [this] {
    if (document_.scene() && !document_.scene()->constraints.empty()) {
      show();
    }
  });
}

void ConstraintDisplay::show() {
  const auto& scene = document_.scene();
  if (!scene || scene->constraints.empty()) {
    view_.set_overlay(Overlay::kConstraints, nullptr);
    return;
  }
  view_.set_overlay(Overlay::kConstraints,
                    make_constraints_node(*scene, document_.configuration()).get());
}

}  // namespace handway::gui
