#include "features/glove/curve_view.h"

#include "handway/geometric/math/units.h"
#include "widgets/style/theme.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPolygonF>

#include <algorithm>
#include <cmath>
#include <limits>

namespace handway::gui {
namespace {

using device::CurvePoint;
using geometric::kDegree;

// What human joints and the sensors on them go through.
constexpr double kLeastSensor = -40.0 * kDegree;
constexpr double kMostSensor = 120.0 * kDegree;
constexpr double kBeyondLimits = 0.08;  // of the joint's range
constexpr double kNear = 9.0;           // px
constexpr double kDot = 3.5;            // px
constexpr double kApart = 1.0 * kDegree;

double whole_degrees(double angle) { return std::round(angle / kDegree) * kDegree; }

}  // namespace

CurveView::CurveView(QWidget* parent)
    : QWidget(parent), sensor_(std::numeric_limits<double>::quiet_NaN()) {
  setObjectName(QStringLiteral("wire_curve_view"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setCursor(Qt::CrossCursor);
  setToolTip(
      tr("What the joint makes of its sensor. Click to add a point, drag it, right-click to take "
         "it away"));
}

void CurveView::set_wire(const device::JointWire& wire, double lower, double upper) {
  const bool same = wire.joint == wire_.joint && wire.curve.size() == wire_.curve.size();
  wire_ = wire;
  lower_ = lower;
  upper_ = std::max(upper, lower + kApart);
  if (!same) {
    dragged_.reset();
  }
  update();
}

void CurveView::show_sensor(double angle) {
  sensor_ = angle;
  update();
}

QRectF CurveView::area() const { return QRectF(rect()).adjusted(34, 6, -16, -18); }

QPointF CurveView::place_of(double angle, double joint) const {
  const QRectF box = area();
  const double margin = kBeyondLimits * (upper_ - lower_);
  const double x = (angle - kLeastSensor) / (kMostSensor - kLeastSensor);
  const double y = (joint - lower_ + margin) / (upper_ - lower_ + 2.0 * margin);
  return {box.left() + x * box.width(), box.bottom() - y * box.height()};
}

CurvePoint CurveView::point_at(const QPointF& place) const {
  const QRectF box = area();
  const double margin = kBeyondLimits * (upper_ - lower_);
  const double x = (place.x() - box.left()) / box.width();
  const double y = (box.bottom() - place.y()) / box.height();
  const double joint = lower_ - margin + y * (upper_ - lower_ + 2.0 * margin);
  return {whole_degrees(std::clamp(kLeastSensor + x * (kMostSensor - kLeastSensor), kLeastSensor,
                                   kMostSensor)),
          std::clamp(whole_degrees(joint), lower_, upper_)};
}

double CurveView::joint_at(double angle) const {
  const std::vector<CurvePoint>& curve = wire_.curve;
  if (curve.empty()) {
    return wire_.gain * angle + wire_.offset;
  }
  const auto after = std::ranges::upper_bound(curve, angle, std::less<>{},
                                              [](const CurvePoint& p) { return p.angle; });
  if (after == curve.begin() || after == curve.end()) {
    return after == curve.begin() ? curve.front().joint : curve.back().joint;
  }
  const CurvePoint& before = *(after - 1);
  const double share = (angle - before.angle) / (after->angle - before.angle);
  return before.joint + share * (after->joint - before.joint);
}

std::optional<std::size_t> CurveView::point_near(const QPointF& place) const {
  for (std::size_t i = 0; i < wire_.curve.size(); ++i) {
    const QPointF way = place_of(wire_.curve[i].angle, wire_.curve[i].joint) - place;
    if (std::hypot(way.x(), way.y()) < kNear) {
      return i;
    }
  }
  return std::nullopt;
}

// A straight wire becomes a curve that is the same as far as the joint goes.
std::size_t CurveView::add_point(const CurvePoint& point) {
  std::vector<CurvePoint>& curve = wire_.curve;
  if (curve.empty()) {
    double first = kLeastSensor;
    double last = kMostSensor;
    if (wire_.gain != 0.0) {
      const double at_lower = (lower_ - wire_.offset) / wire_.gain;
      const double at_upper = (upper_ - wire_.offset) / wire_.gain;
      first = std::clamp(std::min(at_lower, at_upper), kLeastSensor, kMostSensor - kApart);
      last = std::clamp(std::max(at_lower, at_upper), first + kApart, kMostSensor);
    }
    const double first_joint = std::clamp(joint_at(first), lower_, upper_);
    const double last_joint = std::clamp(joint_at(last), lower_, upper_);
    curve = {{first, first_joint}, {last, last_joint}};
  }
  const auto after = std::ranges::find_if(
      curve, [&](const CurvePoint& other) { return other.angle > point.angle - kApart; });
  const auto index = static_cast<std::size_t>(after - curve.begin());
  if (after != curve.end() && after->angle < point.angle + kApart) {
    *after = {after->angle, point.joint};
    return index;
  }
  curve.insert(after, point);
  return index;
}

void CurveView::tell() {
  update();
  emit edited(wire_);
}

void CurveView::mousePressEvent(QMouseEvent* event) {
  const QPointF place = event->localPos();
  const std::optional<std::size_t> near = point_near(place);
  if (event->button() == Qt::RightButton && near) {
    if (wire_.curve.size() <= 2) {
      wire_.curve.clear();
    } else {
      wire_.curve.erase(wire_.curve.begin() + static_cast<std::ptrdiff_t>(*near));
    }
    tell();
  } else if (event->button() == Qt::LeftButton) {
    dragged_ = near ? *near : add_point(point_at(place));
    if (!near) {
      tell();
    }
  }
}

void CurveView::mouseMoveEvent(QMouseEvent* event) {
  if (!dragged_ || !(event->buttons() & Qt::LeftButton) || *dragged_ >= wire_.curve.size()) {
    return;
  }
  std::vector<CurvePoint>& curve = wire_.curve;
  CurvePoint point = point_at(event->localPos());
  if (*dragged_ > 0) {
    point.angle = std::max(point.angle, curve[*dragged_ - 1].angle + kApart);
  }
  if (*dragged_ + 1 < curve.size()) {
    point.angle = std::min(point.angle, curve[*dragged_ + 1].angle - kApart);
  }
  curve[*dragged_] = point;
  tell();
}

void CurveView::mouseReleaseEvent(QMouseEvent* /*event*/) { dragged_.reset(); }

void CurveView::paint_axes(QPainter& painter) const {
  const ThemeColors colors = colors_of(current_theme());
  const QRectF box = area();
  painter.fillRect(QRectF(place_of(kLeastSensor, upper_), place_of(kMostSensor, lower_)),
                   faded(colors.accent, 0.06));
  QFont font = painter.font();
  font.setPixelSize(10);
  painter.setFont(font);
  for (double degrees = -30.0; degrees <= 120.0; degrees += 30.0) {
    const double x = place_of(degrees * kDegree, lower_).x();
    painter.setPen(QPen(faded(colors.border, degrees == 0.0 ? 1.0 : 0.6), 1.0));
    painter.drawLine(QPointF(x, box.top()), QPointF(x, box.bottom()));
    painter.setPen(colors.muted);
    painter.drawText(QRectF(x - 20.0, box.bottom() + 2.0, 40.0, 14.0), Qt::AlignCenter,
                     QStringLiteral("%1°").arg(degrees));
  }
  for (const double joint : {lower_, upper_}) {
    const double y = place_of(0.0, joint).y();
    painter.setPen(QPen(faded(colors.border, 0.9), 1.0));
    painter.drawLine(QPointF(box.left(), y), QPointF(box.right(), y));
    painter.setPen(colors.muted);
    painter.drawText(QRectF(0.0, y - 7.0, box.left() - 5.0, 14.0),
                     Qt::AlignRight | Qt::AlignVCenter,
                     QStringLiteral("%1°").arg(joint / kDegree, 0, 'f', 0));
  }
}

void CurveView::paintEvent(QPaintEvent* /*event*/) {
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  paint_axes(painter);
  painter.setClipRect(area().adjusted(-kDot - 1, -kDot - 1, kDot + 1, kDot + 1));
  QPolygonF line;
  line << place_of(kLeastSensor, joint_at(kLeastSensor));
  for (const CurvePoint& point : wire_.curve) {
    line << place_of(point.angle, point.joint);
  }
  line << place_of(kMostSensor, joint_at(kMostSensor));
  painter.setPen(QPen(colors.accent, 1.8));
  painter.setBrush(Qt::NoBrush);
  painter.drawPolyline(line);
  painter.setBrush(colors.surface);
  for (const CurvePoint& point : wire_.curve) {
    painter.drawEllipse(place_of(point.angle, point.joint), kDot, kDot);
  }
  if (std::isfinite(sensor_)) {
    const double joint = std::clamp(joint_at(sensor_), lower_, upper_);
    painter.setPen(Qt::NoPen);
    painter.setBrush(attention_color());
    painter.drawEllipse(place_of(sensor_, joint), kDot, kDot);
  }
}

}  // namespace handway::gui
