#include "view3d/view_overlay.h"

#include <QPainter>

#include <algorithm>
#include <array>

namespace handway::gui {

ViewOverlay::ViewOverlay(QWidget* view) : QWidget(view) {
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setAttribute(Qt::WA_NoSystemBackground);
}

void ViewOverlay::set_color(const geometric::Color& color) {
  color_ = QColor::fromRgbF(color.red, color.green, color.blue, color.alpha);
  update();
}

void ViewOverlay::set_note(const QString& note, const QPoint& place) {
  note_ = note;
  note_place_ = place;
  update();
}

void ViewOverlay::set_axes(const Eigen::Matrix3d& R_WC) {
  if (R_WC != R_WC_) {
    R_WC_ = R_WC;
    update();
  }
}

void ViewOverlay::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setPen(color_);
  QFont font = painter.font();
  font.setPixelSize(11);
  font.setBold(true);
  painter.setFont(font);
  const QPointF middle(kAxesSize / 2.0, height() - kAxesSize / 2.0);
  constexpr double kReach = 1.24 * kAxesSize / kAxesHeight;
  constexpr std::array kNames{"X", "Y", "Z"};
  for (int axis = 0; axis < 3; ++axis) {
    const QPointF place = middle + kReach * QPointF(R_WC_(axis, 0), -R_WC_(axis, 1));
    painter.drawText(QRectF(place - QPointF(8.0, 8.0), QSizeF(16.0, 16.0)), Qt::AlignCenter,
                     QLatin1String(kNames.at(static_cast<std::size_t>(axis))));
  }
  if (!note_.isEmpty()) {
    font.setPixelSize(13);
    font.setBold(false);
    painter.setFont(font);
    painter.setRenderHint(QPainter::Antialiasing);
    QRectF card = painter.fontMetrics().boundingRect(note_).adjusted(-9, -6, 9, 6);
    card.moveTopLeft(note_place_ + QPoint(18, 18));
    card.moveRight(std::min(card.right(), width() - 6.0));
    card.moveBottom(std::min(card.bottom(), height() - 6.0));
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(24, 28, 34, 215));
    painter.drawRoundedRect(card, 5.0, 5.0);
    painter.setPen(Qt::white);
    painter.drawText(card, Qt::AlignCenter, note_);
    painter.setPen(color_);
  }
}

}  // namespace handway::gui
