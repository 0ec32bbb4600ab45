#include "features/planning/collision_display.h"

#include "features/planning/collision_label.h"
#include "model/document/document.h"
#include "view3d/path_node.h"
#include "view3d/scene_view.h"

#include <Inventor/nodes/SoSeparator.h>
#include <QAction>
#include <QKeySequence>

namespace handway::gui {

CollisionDisplay::CollisionDisplay(Document& document, SceneView& view, QObject* parent)
    : QObject(parent),
      document_(document),
      view_(view),
      label_(new CollisionLabel),
      closest_shown_(new QAction(tr("C&losest points"), &view)) {
  closest_shown_->setObjectName(QStringLiteral("closest_points"));
  closest_shown_->setStatusTip(tr("Show where the robot is closest to something"));
  closest_shown_->setShortcut(QKeySequence(Qt::Key_C));
  closest_shown_->setCheckable(true);
  closest_shown_->setChecked(true);
  connect(closest_shown_, &QAction::toggled, this,
          [this](bool on) { view_.set_overlay_visible(Overlay::kClearance, on); });
  connect(&document_, &Document::configuration_changed, &monitor_, &CollisionMonitor::check);
  connect(&document_, &Document::edited, this, [this](const SceneState& before) {
    if (before.scene != document_.scene()) {
      monitor_.set_problem(document_.problem());
    }
  });
  connect(&monitor_, &CollisionMonitor::checked, this, [this](const CollisionReport& report) {
    std::vector<std::string> bodies;
    for (const geometric::NamedPair& pair : report.collisions) {
      bodies.push_back(pair.a);
      bodies.push_back(pair.b);
    }
    view_.set_collisions(std::move(bodies));
    if (report.points) {
      view_.set_overlay(Overlay::kClearance,
                        make_clearance_node(report.points->p_WA, report.points->p_WB).get());
    } else {
      view_.set_overlay(Overlay::kClearance, nullptr);
    }
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
  view_.set_overlay(Overlay::kClearance, nullptr);
}

}  // namespace handway::gui
