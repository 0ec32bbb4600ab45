#include "features/planning/collision_display.h"

#include "model/document/document.h"
#include "view3d/path_node.h"
#include "view3d/scene_view.h"
#include "widgets/style/theme.h"

#include <QAction>
#include <QKeySequence>
#include <QStringList>

namespace handway::gui {
namespace {

QString dotted(const QColor& color, const QString& text) {
  return QStringLiteral("<span style=\"color:%1\">●</span>&nbsp; %2").arg(html(color), text);
}

QString pair_text(const geometric::NamedPair& pair) {
  return QObject::tr("%1 with %2")
      .arg(QString::fromStdString(pair.a).toHtmlEscaped(),
           QString::fromStdString(pair.b).toHtmlEscaped());
}

}  // namespace

CollisionLabel::CollisionLabel(QWidget* parent) : QLabel(parent) {
  setContentsMargins(8, 0, 8, 0);
  setTextFormat(Qt::RichText);
}

void CollisionLabel::show_report(const CollisionReport& report) {
  const ThemeColors colors = colors_of(current_theme());
  QStringList all;
  for (const geometric::NamedPair& pair : report.collisions) {
    all << tr("in collision: %1").arg(pair_text(pair));
  }
  for (const std::string& violated : report.violated) {
    all << tr("violates %1").arg(QString::fromStdString(violated).toHtmlEscaped());
  }
  if (!all.empty()) {
    const int others = all.size() - 1;
    setText(dotted(colors.bad,
                   others > 0 ? tr("%1 (and %2 more)").arg(all.front()).arg(others) : all.front()));
    setToolTip(all.join(QStringLiteral("<br>")));
    return;
  }
  setToolTip({});
  setText(
      dotted(colors.good,
             report.closest
                 ? tr("free, closest: %1 to %2, %3 mm")
                       .arg(QString::fromStdString(report.closest->a).toHtmlEscaped(),
                            QString::fromStdString(report.closest->b).toHtmlEscaped())
                       .arg(report.closest->distance * 1e3, 0, 'f', 1)
                 : tr("free, nothing within %1 mm").arg(CollisionMonitor::kNear * 1e3, 0, 'f', 0)));
}

void CollisionLabel::show_nothing() {
  clear();
  setToolTip({});
}

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
                        make_clearance_node(report.points->p_WA, report.points->p_WB));
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
