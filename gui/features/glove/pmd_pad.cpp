#include "features/glove/pmd_pad.h"

#include "widgets/style/theme.h"

#include <QMouseEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace handway::gui {
namespace {

constexpr int kSide = 1;         // px, left and right of the plane
constexpr int kAbove = 2;        // px
constexpr int kBelow = 2;        // px
constexpr double kRoom = 1.18;   // plane over box
constexpr double kHandle = 7.0;  // px, radius
constexpr double kDot = 1.6;     // px, radius

}  // namespace

PmdPad::PmdPad(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("pmd_pad"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setCursor(Qt::CrossCursor);
  setToolTip(tr("Drag to move the hand along both axes; the box is where the planner samples"));
}

void PmdPad::clear(const QString& reason) {
  reason_ = reason;
  x_ = y_ = {};
  dots_.clear();
  update();
}

void PmdPad::set_axes(const Axis& x, const Axis& y) {
  reason_.clear();
  x_ = x;
  y_ = y;
  dots_.clear();
  fit_extent();
}

void PmdPad::set_dots(std::vector<QPointF> dots) {
  dots_ = std::move(dots);
  fit_extent();
}

void PmdPad::set_posture(const QPointF& coordinates) {
  posture_ = coordinates;
  update();
}

void PmdPad::fit_extent() {
  extent_x_ = x_.half_side;
  extent_y_ = y_.half_side;
  for (const QPointF& dot : dots_) {
    extent_x_ = std::max(extent_x_, std::abs(dot.x()));
    extent_y_ = std::max(extent_y_, std::abs(dot.y()));
  }
  extent_x_ = std::max(extent_x_, 1e-6) * kRoom;
  extent_y_ = std::max(extent_y_, 1e-6) * kRoom;
  update();
}

QRectF PmdPad::plane() const { return QRectF(rect()).adjusted(kSide, kAbove, -kSide, -kBelow); }

QPointF PmdPad::to_pixel(const QPointF& coordinates) const {
  const QRectF area = plane();
  return {area.center().x() + coordinates.x() / extent_x_ * area.width() / 2.0,
          area.center().y() - coordinates.y() / extent_y_ * area.height() / 2.0};
}

QPointF PmdPad::from_pixel(const QPointF& pixel) const {
  const QRectF area = plane();
  return {(pixel.x() - area.center().x()) / area.width() * 2.0 * extent_x_,
          -(pixel.y() - area.center().y()) / area.height() * 2.0 * extent_y_};
}

void PmdPad::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) {
    drag_to(event->localPos());
  }
}

void PmdPad::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton) {
    drag_to(event->localPos());
  }
}

void PmdPad::drag_to(const QPointF& pixel) {
  if (!reason_.isEmpty()) {
    return;
  }
  const QPointF point = from_pixel(pixel);
  posture_ = {std::clamp(point.x(), -x_.half_side, x_.half_side),
              std::clamp(point.y(), -y_.half_side, y_.half_side)};
  update();
  emit moved(posture_);
}

void PmdPad::paint_frame(QPainter& painter) const {
  const ThemeColors colors = colors_of(current_theme());
  const QRectF area = plane();
  painter.setPen(QPen(colors.border, 1.0));
  painter.setBrush(faded(colors.window, 0.6));
  painter.drawRoundedRect(area, 5.0, 5.0);
  const QPointF middle = to_pixel({0.0, 0.0});
  painter.setPen(QPen(faded(colors.muted, 0.45), 1.0, Qt::DashLine));
  painter.drawLine(QPointF(area.left(), middle.y()), QPointF(area.right(), middle.y()));
  painter.drawLine(QPointF(middle.x(), area.top()), QPointF(middle.x(), area.bottom()));
}

void PmdPad::paintEvent(QPaintEvent*) {
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  if (!reason_.isEmpty()) {
    const QRectF area = plane();
    painter.setPen(QPen(colors.border, 1.0, Qt::DashLine));
    painter.drawRoundedRect(area, 5.0, 5.0);
    painter.setPen(colors.muted);
    painter.drawText(area.adjusted(20, 20, -20, -20), Qt::AlignCenter | Qt::TextWordWrap, reason_);
    return;
  }
  paint_frame(painter);
  painter.setClipRect(plane());
  const QRectF box(to_pixel({-x_.half_side, y_.half_side}),
                   to_pixel({x_.half_side, -y_.half_side}));
  painter.setPen(QPen(colors.accent, 1.4));
  painter.setBrush(faded(colors.accent, 0.07));
  painter.drawRect(box);
  painter.setPen(Qt::NoPen);
  painter.setBrush(faded(colors.muted, 0.5));
  for (const QPointF& dot : dots_) {
    painter.drawEllipse(to_pixel(dot), kDot, kDot);
  }
  QFont font = painter.font();
  font.setPixelSize(11);
  painter.setFont(font);
  painter.setPen(colors.muted);
  const QRectF area = plane().adjusted(6, 3, -6, -3);
  const QPointF middle = to_pixel({0.0, 0.0});
  painter.drawText(QRectF(area.left(), middle.y() - 16, area.width(), 15),
                   Qt::AlignRight | Qt::AlignVCenter, x_.name);
  painter.drawText(QRectF(middle.x() + 5, area.top(), area.width() / 2, 15),
                   Qt::AlignLeft | Qt::AlignVCenter, y_.name);
  painter.setPen(colors.accent);
  painter.drawText(
      QRectF(box.left() + 5, box.bottom() - 18, box.width() - 10, 16),
      Qt::AlignLeft | Qt::AlignVCenter,
      QStringLiteral("±%1 × ±%2").arg(x_.half_side, 0, 'f', 2).arg(y_.half_side, 0, 'f', 2));
  painter.setPen(QPen(colors.surface, 2.0));
  painter.setBrush(colors.accent);
  painter.drawEllipse(to_pixel(posture_), kHandle, kHandle);
}

}  // namespace handway::gui
