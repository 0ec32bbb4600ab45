#include "features/planning/collision_display.h"

#include "view3d/distance_drawings.h"
#include "view3d/overlay.h"
#include "view3d/scene_view.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QAction>
#include <QKeySequence>
#include <QLabel>
#include <QStringList>

#include <algorithm>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kBesideText = 8;  // px

QString pair_text(const geometric::NamedPair& pair) {
  return QObject::tr("%1 with %2")
      .arg(QString::fromStdString(pair.a), QString::fromStdString(pair.b));
}

}  // namespace

CollisionLabel::CollisionLabel(QWidget* parent) : QLabel(parent) {
  setContentsMargins(kBesideText, 0, kBesideText, 0);
  setTextFormat(Qt::RichText);
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);  // the window is as wide as it is
}

void CollisionLabel::show_words(const QColor& color, const QString& words, const QString& all) {
  color_ = color;
  words_ = words;
  setToolTip(all);
  elide();
}

void CollisionLabel::elide() {
  const int dot = fontMetrics().horizontalAdvance(QStringLiteral("●   "));
  const int room = width() - 2 * kBesideText - dot;
  setText(
      words_.isEmpty()
          ? QString()
          : dotted(fontMetrics().elidedText(words_, Qt::ElideRight, std::max(room, 0)), color_));
}

void CollisionLabel::resizeEvent(QResizeEvent* event) {
  QLabel::resizeEvent(event);
  elide();
}

void CollisionLabel::show_report(const CollisionReport& report) {
  const ThemeColors colors = colors_of(current_theme());
  QStringList all;
  for (const geometric::NamedPair& pair : report.collisions) {
    all << tr("in collision: %1").arg(pair_text(pair));
  }
  for (const std::string& violated : report.violated) {
    all << tr("violates %1").arg(QString::fromStdString(violated));
  }
  if (!all.empty()) {
    const int others = all.size() - 1;
    show_words(
        colors.bad,
        others > 0 ? tr("%1 (and %2 more)").arg(all.front(), QString::number(others)) : all.front(),
        all.join(QLatin1Char('\n')));
    return;
  }
  const QString words =
      report.closest
          ? tr("free, closest: %1 to %2, %3 mm")
                .arg(QString::fromStdString(report.closest->a),
                     QString::fromStdString(report.closest->b))
                .arg(report.closest->distance * 1e3, 0, 'f', 1)
          : tr("free, nothing within %1 mm").arg(CollisionMonitor::kNear * 1e3, 0, 'f', 0);
  show_words(colors.good, words, words);
}

void CollisionLabel::show_pending() {
  const QString words = tr("checking collisions…");
  show_words(colors_of(current_theme()).muted, words, words);
}

void CollisionLabel::show_nothing() { show_words({}, {}, {}); }

CollisionDisplay::CollisionDisplay(CollisionMonitor& monitor, SceneView& view, QObject* parent)
    : QObject(parent),
      view_(view),
      label_(new CollisionLabel),
      closest_shown_(named("closest_points", new QAction(tr("C&losest points"), &view))) {
  closest_shown_->setStatusTip(tr("Show the closest points of robot and obstacles"));
  closest_shown_->setShortcut(QKeySequence(Qt::Key_C));
  closest_shown_->setCheckable(true);
  closest_shown_->setChecked(true);
  connect(closest_shown_, &QAction::toggled, this,
          [this](bool on) { view_.set_overlay_visible(Overlay::kClearance, on); });
  connect(&monitor, &CollisionMonitor::checked, this, [this](const CollisionReport& report) {
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
  connect(&monitor, &CollisionMonitor::outdated, this, [this] {
    label_->show_pending();
    view_.set_overlay(Overlay::kClearance, nullptr);
  });
  connect(&monitor, &CollisionMonitor::failed, this, [this](const QString& message) {
    label_->show_nothing();
    emit failed(tr("Collisions are not checked: %1").arg(message));
  });
}

void CollisionDisplay::show_scene() {
  label_->show_nothing();
  view_.set_overlay(Overlay::kClearance, nullptr);
}

}  // namespace handway::gui
