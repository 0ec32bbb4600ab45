#include "app/start/scene_card.h"

#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

#include <QPainter>
#include <QPainterPath>

namespace handway::gui {
namespace {

constexpr int kNameHeight = 38;
constexpr double kCorner = 7.0;

}  // namespace

SceneCard::SceneCard(const QString& title, const QString& picture, QWidget* parent)
    : QAbstractButton(parent), picture_(picture) {
  setText(title);
  setCursor(Qt::PointingHandCursor);
  setFocusPolicy(Qt::TabFocus);
  setFixedSize(sizeHint());
}

QSize SceneCard::sizeHint() const { return {kWidth, kPictureHeight + kNameHeight}; }

void SceneCard::enterEvent(QEvent* event) {
  QAbstractButton::enterEvent(event);
  update();
}

void SceneCard::leaveEvent(QEvent* event) {
  QAbstractButton::leaveEvent(event);
  update();
}

void SceneCard::paintEvent(QPaintEvent* /*event*/) {
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  const QRectF frame = QRectF(rect()).adjusted(0.75, 0.75, -0.75, -0.75);
  QPainterPath outline;
  outline.addRoundedRect(frame, kCorner, kCorner);
  painter.setClipPath(outline);
  painter.fillRect(rect(), isDown() ? colors.window : colors.surface);
  const QRect place(0, 0, width(), kPictureHeight);
  if (picture_.isNull()) {
    painter.fillRect(place, colors.window);
    gui::icon(QStringLiteral("objects")).paint(&painter, place.adjusted(90, 50, -90, -50));
  } else {
    painter.drawPixmap(place, picture_);
  }
  painter.setPen(colors.text);
  painter.drawText(QRect(12, kPictureHeight, width() - 24, kNameHeight),
                   Qt::AlignLeft | Qt::AlignVCenter, text());
  painter.setClipping(false);
  const bool hot = underMouse() || hasFocus();
  painter.setPen(QPen(hot ? colors.accent : colors.border, hot ? 2.0 : 1.0));
  painter.drawPath(outline);
}

}  // namespace handway::gui
