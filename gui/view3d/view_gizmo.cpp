#include "view3d/view_gizmo.h"

#include "handway/geometric/math/units.h"

#include <QStringList>

#include <algorithm>
#include <array>
#include <cmath>

namespace handway::gui {
namespace {

using geometric::Pose;

constexpr double kPixels = 76.0;  // an arrow's length

constexpr double kFarBack = 12.0;  // m: where parallel rays begin

QString with_sign(double value, int decimals) {
  return (value < 0.0 ? QStringLiteral("−") : QStringLiteral("+")) +
         QString::number(std::abs(value), 'f', decimals);
}

}  // namespace

Ray ray_through(const OrbitCamera& camera, const QSize& size, const QPointF& place) {
  const double unit = camera.seen_height(1.0) / std::max(size.height(), 1);
  const double right = unit * (place.x() - 0.5 * size.width());
  const double up = -unit * (place.y() - 0.5 * size.height());
  const Eigen::Matrix3d R = camera.orientation();
  if (camera.projection() == Projection::kOrthographic) {
    return {camera.placement().target + R * Eigen::Vector3d(right, up, kFarBack), -R.col(2)};
  }
  return {camera.position(), (R * Eigen::Vector3d(right, up, -1.0)).normalized()};
}

QPointF place_of(const OrbitCamera& camera, const QSize& size, const Eigen::Vector3d& p_W) {
  const Eigen::Vector3d p = camera.orientation().transpose() * (p_W - camera.position());
  const double unit = size.height() / camera.seen_height(-p.z());
  return {0.5 * size.width() + unit * p.x(), 0.5 * size.height() - unit * p.y()};
}

void ViewGizmo::set_target(const SceneItem& item, const std::optional<Pose>& X_WO,
                           const Eigen::Vector3d& p_O) {
  if (!drag_) {
    if (!(item == item_)) {
      hot_.reset();
    }
    item_ = item;
    X_WO_ = X_WO;
    p_O_ = p_O;
  }
}

GizmoFrame ViewGizmo::frame(const OrbitCamera& camera, const QSize& size) const {
  GizmoFrame frame;
  if (X_WO_) {
    frame.centre = *X_WO_ * p_O_;
    if (local_) {
      frame.axes = X_WO_->linear();
    }
    const double distance =
        std::max(0.05, camera.orientation().col(2).dot(camera.position() - frame.centre));
    frame.size = kPixels * camera.seen_height(distance) / std::max(size.height(), 1);
  }
  return frame;
}

bool ViewGizmo::hover(const OrbitCamera& camera, const QSize& size, const QPointF& place) {
  const auto now =
      is_shown() ? handle_at(frame(camera, size), ray_through(camera, size, place)) : std::nullopt;
  const bool changed = now != hot_;
  hot_ = now;
  return changed;
}

bool ViewGizmo::press(const OrbitCamera& camera, const QSize& size, const QPointF& place) {
  hover(camera, size, place);
  if (hot_) {
    drag_.emplace(*hot_, frame(camera, size), *X_WO_, ray_through(camera, size, place));
    typed_ = {};
    typed_axis_ = drag_->is_free(0) ? 0 : drag_->is_free(1) ? 1 : 2;
  }
  return drag_.has_value();
}

void ViewGizmo::press_body(const OrbitCamera& camera, const QSize& size, const QPointF& place) {
  GizmoFrame world = frame(camera, size);
  world.axes.setIdentity();
  hot_ = GizmoHandle{GizmoHandle::Kind::kBody, 2};
  drag_.emplace(*hot_, world, *X_WO_, ray_through(camera, size, place));
  typed_ = {};
  typed_axis_ = 0;
}

Pose ViewGizmo::carry(const Eigen::Vector3d& amount, bool snap) {
  X_WO_ = drag_->moved_by(snap ? drag_->snapped(amount) : amount);
  return *X_WO_;
}

Pose ViewGizmo::drag(const OrbitCamera& camera, const QSize& size, const QPointF& place,
                     bool snap) {
  X_WO_ = drag_->moved_to(ray_through(camera, size, place), snap);
  return *X_WO_;
}

Pose ViewGizmo::shift(const Eigen::Vector3d& step) {
  if (!local_ && drag_->handle().kind != GizmoHandle::Kind::kRing) {
    X_WO_ = drag_->moved_by(drag_->amount() + step);
  }
  return *X_WO_;
}

bool ViewGizmo::has_typed() const {
  return std::ranges::any_of(typed_, [](const QString& text) { return !text.isEmpty(); });
}

bool ViewGizmo::type(int key, const QString& text) {
  QString& typed = typed_.at(static_cast<std::size_t>(typed_axis_));
  if (key == Qt::Key_Tab) {
    do {
      typed_axis_ = (typed_axis_ + 1) % 3;
    } while (!drag_->is_free(typed_axis_));
  } else if (key == Qt::Key_Backspace) {
    typed.chop(1);
  } else if (key == Qt::Key_Minus) {
    typed = typed.startsWith('-') ? typed.mid(1) : '-' + typed;
  } else if (text == "." || text == "," || (text.size() == 1 && text[0].isDigit())) {
    typed += text == "," ? QStringLiteral(".") : text;
  } else {
    return false;
  }
  const bool turns = drag_->handle().kind == GizmoHandle::Kind::kRing;
  Eigen::Vector3d amount = Eigen::Vector3d::Zero();
  for (std::size_t axis = 0; axis < typed_.size(); ++axis) {
    const double number = typed_.at(axis).toDouble();  // 0 while it is none yet
    amount[static_cast<Eigen::Index>(axis)] =
        turns ? geometric::radians(number) : geometric::metres(number);
  }
  X_WO_ = drag_->moved_by(amount);
  return true;
}

Pose ViewGizmo::release() {
  const Pose start = drag_->start();
  drag_.reset();
  hot_.reset();
  return start;
}

Pose ViewGizmo::cancel() {
  X_WO_ = release();
  return *X_WO_;
}

QString ViewGizmo::amount() const {
  if (!drag_) {
    return {};
  }
  constexpr std::array kNames{"X", "Y", "Z"};
  const bool turns = drag_->handle().kind == GizmoHandle::Kind::kRing;
  QStringList parts;
  for (int axis = 0; axis < 3; ++axis) {
    if (!drag_->is_free(axis)) {
      continue;
    }
    const double amount = drag_->amount()[axis];
    const auto index = static_cast<std::size_t>(axis);
    const QString number =
        with_sign(turns ? geometric::degrees(amount) : geometric::millimetres(amount), 1);
    parts << QStringLiteral("%1 %2%3").arg(
        QLatin1String(kNames.at(index)),
        has_typed() ? typed_.at(index) + (axis == typed_axis_ ? "_" : "") : number,
        turns ? QStringLiteral("°") : QStringLiteral(" mm"));
  }
  return parts.join(QStringLiteral("   "));
}

}  // namespace handway::gui
