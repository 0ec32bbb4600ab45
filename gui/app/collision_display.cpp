#include "app/collision_display.h"

#include "app/document.h"
#include "panels/collision_label.h"
#include "view3d/scene_view.h"

namespace handway::gui {

CollisionDisplay::CollisionDisplay(Document& document, SceneView& view, QObject* parent)
    : QObject(parent), document_(document), label_(new CollisionLabel) {
  connect(&document_, &Document::configuration_changed, &monitor_, &CollisionMonitor::check);
  connect(&document_, &Document::edited, this, [this](const SceneState& before) {
    if (before.scene != document_.scene()) {
      monitor_.set_problem(document_.problem());
    }
  });
  connect(&monitor_, &CollisionMonitor::checked, this,
          [this, &view](const CollisionReport& report) {
            std::vector<std::string> bodies;
            for (const geometric::NamedPair& pair : report.collisions) {
              bodies.push_back(pair.a);
              bodies.push_back(pair.b);
            }
            view.set_collisions(std::move(bodies));
            label_->show_report(report);
          });
  connect(&monitor_, &CollisionMonitor::failed, this, [this](const QString& message) {
    label_->show_nothing();
    emit failed(tr("Collisions are not checked: %1").arg(message));
  });
}

void CollisionDisplay::show_scene() {
  monitor_.set_problem(document_.problem());
  label_->show_nothing();
}

}  // namespace handway::gui
