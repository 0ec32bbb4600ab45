#include "features/viewing/measure_tool.h"

#include "features/workbench.h"
#include "handway/geometric/collision/narrow_phase/closest_points.h"
#include "handway/geometric/math/units.h"
#include "view3d/distance_drawings.h"
#include "view3d/overlay.h"
#include "view3d/scene_view.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/actions.h"
#include "widgets/style/theme.h"

#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QToolButton>

#include <cmath>

namespace handway::gui {
namespace {

constexpr int kBeside = 30;  // px, of the card: as much room as it wants
constexpr int kReach = 9;    // px, of corners
constexpr double kBehind =
    0.03;  // of the camera's distance: corners farther from the hit are hidden
constexpr int kStillAClick = 4;      // px
constexpr int kMostCorners = 40000;  // that one can wait for under a moving pointer

using geometric::Pose;
using Points = std::vector<Eigen::Vector3d>;

void add_vertices(Points& points, const geometric::Shape& shape, const Pose& X_WS) {
  if (const auto mesh = geometric::tessellate(shape)) {
    for (const Eigen::Vector3d& vertex : mesh->vertices) {
      points.push_back(X_WS * vertex);
    }
  }
}

/// The vertices of what an object or a link looks like; world, m.
Points corners_of(const geometric::Scene& scene, const geometric::Configuration& q,
                  const SceneItem& item) {
  Points points;
  if (const auto* object = geometric::find_object(scene, item.name);
      object && item.kind == SceneItem::Kind::kObject) {
    add_vertices(points, object->shape, object_pose(scene, q, *object));
  } else if (const auto X_WL = link_pose(scene, q, item.robot, item.name)) {
    const auto& model = *geometric::find_robot(scene, item.robot)->model;
    const geometric::Link& link = model.link(model.find_link(item.name).value());
    for (const auto& geometry : link.visual.empty() ? link.collision : link.visual) {
      add_vertices(points, geometry.shape, *X_WL * geometry.X_LG);
    }
  }
  return points.size() > kMostCorners ? Points{} : points;
}

QString length_text(double metres, const UnitText& unit) {
  const double value = geometric::millimetres(metres) / unit.size;
  const int decimals = unit.size > 100.0 ? 4 : unit.size > 1.0 ? 2 : 1;
  return QString::number(value, 'f', decimals) + unit.suffix;
}

/// "412.3 mm", and along the axes of the world.
QString difference_text(const Eigen::Vector3d& difference, const UnitText& unit, bool rich) {
  const QString axes =
      QObject::tr("X %1   Y %2   Z %3")
          .arg(length_text(difference.x(), unit), length_text(difference.y(), unit),
               length_text(difference.z(), unit));
  const QString length = length_text(difference.norm(), unit);
  return rich ? QStringLiteral("<b>%1</b><br>%2").arg(length, axes) : length;
}

}  // namespace

MeasureCard::MeasureCard(QWidget* host)
    : FloatingCard(host, "measure_card", "legend"), text_(named("measure_text", new QLabel)) {
  text_->setTextFormat(Qt::RichText);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  QToolButton* close = make_close("measure_close", tr("End measuring (Esc)"));
  connect(close, &QToolButton::clicked, this, &MeasureCard::closed);
  lay_out(*this, in_row({{text_, 1}, {close, 0, Qt::AlignTop}}), {12, 8, 8, 8});
}

void MeasureCard::show_text(const QString& text) {
  text_->setText(text);
  appear();
}

// Its lines break only where the view is too narrow for them.
void MeasureCard::place() {
  text_->setWordWrap(false);
  text_->setWordWrap(sizeHint().width() > parentWidget()->width() - scaled(kBeside));
  stand_at_lower_right();
}

MeasureTool::MeasureTool(Workbench& workbench)
    : workbench_(workbench),
      action_(workbench.make_action(QStringLiteral("measure"), tr("&Measure distances"),
                                    QKeySequence(Qt::Key_D),
                                    tr("Measure the distance of two points that you click on"))),
      card_(new MeasureCard(&workbench.view)) {
  action_->setCheckable(true);
  workbench_.add_to_menu(MainMenu::kView, {1, 10}, action_);
  workbench_.add_to_bar(MainBar::kTools, {3, 2}, action_);
  workbench_.view.installEventFilter(this);
  connect(action_, &QAction::toggled, this, &MeasureTool::turn_on);
  connect(card_, &MeasureCard::closed, action_, [this] { action_->setChecked(false); });
  // The measured bodies may not exist any more.
  connect(&workbench_.document, &Document::edited, this, &MeasureTool::clear);
  connect(&workbench_.document, &Document::configuration_changed, this, &MeasureTool::clear);
  const auto follow_scene = [this] {
    action_->setChecked(false);
    allow(*action_, workbench_.document.scene() ? QString() : tr("Open a scene first."));
  };
  connect(&workbench_.document, &Document::opened, this, follow_scene);
  follow_scene();
}

void MeasureTool::turn_on(bool on) {
  emit workbench_.handles_welcome(!on);
  workbench_.view.setCursor(on ? Qt::CrossCursor : Qt::ArrowCursor);
  clear();
  if (!on) {
    card_->hide();
    workbench_.view.set_overlay(Overlay::kMeasure, nullptr);
  }
}

void MeasureTool::clear() {
  from_.reset();
  to_.reset();
  gap_.reset();
  job_.cancel();
  corners_of_ = {};
  if (action_->isChecked()) {
    draw({});
  }
}

bool MeasureTool::eventFilter(QObject* watched, QEvent* event) {
  if (!action_->isChecked()) {
    return QObject::eventFilter(watched, event);
  }
  if (const auto* mouse = dynamic_cast<QMouseEvent*>(event); mouse && take_mouse(*mouse)) {
    return true;
  }
  const auto* key = dynamic_cast<QKeyEvent*>(event);
  if (key && key->key() == Qt::Key_Escape) {
    if (event->type() == QEvent::KeyPress) {
      from_ && !to_ ? clear() : action_->setChecked(false);
    }
    event->accept();
    return true;
  }
  return QObject::eventFilter(watched, event);
}

// Mouse events other than clicks turn and move the view as usual.
bool MeasureTool::take_mouse(const QMouseEvent& event) {
  switch (event.type()) {
    case QEvent::MouseButtonPress:
      pressed_ = event.pos();
      return false;
    case QEvent::MouseMove:
      if (!event.buttons()) {
        hover(event.pos());
      }
      return !event.buttons();
    case QEvent::MouseButtonRelease:
      if (event.button() == Qt::LeftButton &&
          (event.pos() - pressed_).manhattanLength() < kStillAClick) {
        click(event.pos());
        return true;
      }
      return false;
    case QEvent::MouseButtonDblClick:
      return true;
    default:
      return false;
  }
}

std::optional<SceneHit> MeasureTool::hit_at(const QPoint& place) {
  SceneView& view = workbench_.view;
  std::optional<SceneHit> hit = view.pick_at(place);
  if (!hit || !workbench_.document.scene()) {
    return std::nullopt;
  }
  if (hit->item != corners_of_) {
    corners_of_ = hit->item;
    corners_ =
        corners_of(*workbench_.document.scene(), workbench_.document.configuration(), hit->item);
  }
  const double near = kBehind * view.camera().placement().distance;
  double least = kReach;
  const Eigen::Vector3d point = hit->point;
  for (const Eigen::Vector3d& corner : corners_) {
    if ((corner - point).norm() > near) {
      continue;
    }
    const QPointF apart = place_of(view.camera(), view.size(), corner) - QPointF(place);
    if (const double distance = std::hypot(apart.x(), apart.y()); distance < least) {
      least = distance;
      hit->point = corner;
    }
  }
  return hit;
}

void MeasureTool::hover(const QPoint& place) {
  const std::optional<SceneHit> hit = hit_at(place);
  const UnitText unit = unit_text(workbench_.preferences.values().units.length);
  const bool measures = hit && from_ && !to_;
  workbench_.view.set_note(
      measures ? difference_text(hit->point - from_->point, unit, false) : QString(), place);
  draw(hit);
}

void MeasureTool::click(const QPoint& place) {
  const std::optional<SceneHit> hit = hit_at(place);
  if (!hit) {
    return;
  }
  if (!from_ || to_) {
    clear();
    from_ = hit;
  } else {
    to_ = hit;
    workbench_.view.set_note({}, {});
    find_gap();
  }
  draw({});
}

void MeasureTool::draw(const std::optional<SceneHit>& end) {
  Points points;
  for (const std::optional<SceneHit>& hit : {from_, to_, to_ ? std::nullopt : end}) {
    if (hit) {
      points.push_back(hit->point);
    }
  }
  workbench_.view.set_overlay(Overlay::kMeasure,
                              points.empty() ? Drawing() : make_measure_node(points));
  show_card();
}

void MeasureTool::show_card() {
  if (!to_) {
    card_->show_text(from_ ? tr("Click on the second point.")
                           : tr("Click on a point. The pointer snaps to corners."));
    return;
  }
  const UnitText unit = unit_text(workbench_.preferences.values().units.length);
  QString text = difference_text(to_->point - from_->point, unit, true);
  if (gap_) {
    text +=
        tr("<br>Gap between %1 and %2: %3")
            .arg(QString::fromStdString(from_->item.name).toHtmlEscaped(),
                 QString::fromStdString(to_->item.name).toHtmlEscaped(), length_text(*gap_, unit));
  }
  card_->show_text(text);
}

void MeasureTool::find_gap() {
  const auto& problem = workbench_.document.problem();
  // Bodies of other robots have the robot's name in front, in the collision world.
  const auto body = [this](const SceneItem& item) {
    const bool is_other =
        item.kind == SceneItem::Kind::kLink && item.robot != workbench_.document.robot()->name;
    return is_other ? item.robot + "/" + item.name : item.name;
  };
  if (!problem || !workbench_.document.robot()) {
    return;
  }
  job_.run(
      [this, problem, a = body(from_->item), b = body(to_->item),
       q = workbench_.document.configuration()](const std::stop_token& stop) -> LatestJob::Answer {
        const PreparedProblem::Problem prepared = problem->wait(stop);
        if (!prepared || a == b) {
          return nullptr;
        }
        geometric::ClosestPointFinder finder(prepared->checker->clone()->shared_world());
        const auto closest = finder.between(a, b, q);
        return [this, gap = closest ? std::optional((closest->p_WA - closest->p_WB).norm())
                                    : std::nullopt] {
          gap_ = gap;
          show_card();
        };
      });
}

}  // namespace handway::gui
