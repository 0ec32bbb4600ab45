#include "app/start/picture_card.h"

#include "handway/geometric/io/resources.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

#include <QPainter>
#include <QPainterPath>

namespace handway::gui {
namespace {

constexpr int kNameHeight = 38;    // px
constexpr int kTextEdge = 8;       // px
constexpr double kShape = 1.6;     // width of a picture by its height
constexpr double kCorner = 7.0;    // px
constexpr double kEmptyIcon = 45;  // px, where there is no picture

}  // namespace

PictureCard::PictureCard(const QString& title, const QString& picture, int width, QWidget* parent)
    : QAbstractButton(parent), file_(picture), width_(width) {
  setText(title);
  setToolTip(title);  // a long one is elided
  setCursor(Qt::PointingHandCursor);
  setFocusPolicy(Qt::TabFocus);
  setFixedSize(sizeHint());
}

int PictureCard::picture_height() const { return qRound(width_ / kShape); }

QSize PictureCard::sizeHint() const { return {width_, picture_height() + scaled(kNameHeight)}; }

// Pictures are kept while they are seen: QPixmap::load() would leave them in Qt's cache.
void PictureCard::showEvent(QShowEvent* event) {
  picture_ = QPixmap::fromImage(QImage(file_));
  QAbstractButton::showEvent(event);
}

void PictureCard::hideEvent(QHideEvent* event) {
  QAbstractButton::hideEvent(event);
  picture_ = {};
}

void PictureCard::enterEvent(QEvent* event) {
  QAbstractButton::enterEvent(event);
  update();
}

void PictureCard::leaveEvent(QEvent* event) {
  QAbstractButton::leaveEvent(event);
  update();
}

void PictureCard::paintEvent(QPaintEvent* /*event*/) {
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  const QRectF frame = QRectF(rect()).adjusted(0.75, 0.75, -0.75, -0.75);
  QPainterPath outline;
  outline.addRoundedRect(frame, kCorner, kCorner);
  painter.setClipPath(outline);
  painter.fillRect(rect(), isDown() ? colors.window : colors.surface);
  const QRect place(0, 0, width(), picture_height());
  if (picture_.isNull()) {
    painter.fillRect(place, colors.window);
    QRectF middle(0.0, 0.0, kEmptyIcon, kEmptyIcon);
    middle.moveCenter(QRectF(place).center());
    gui::icon(QStringLiteral("objects")).paint(&painter, middle.toRect());
  } else {
    painter.setOpacity(isEnabled() ? 1.0 : 0.35);
    painter.drawPixmap(place, picture_);
    painter.setOpacity(1.0);
  }
  painter.setPen(isEnabled() ? colors.text : colors.muted);
  painter.drawText(QRect(kTextEdge, place.height(), width() - 2 * kTextEdge, scaled(kNameHeight)),
                   Qt::AlignLeft | Qt::AlignVCenter,
                   fontMetrics().elidedText(text(), Qt::ElideRight, width() - 2 * kTextEdge));
  painter.setClipping(false);
  const bool hot = underMouse() || hasFocus();
  painter.setPen(QPen(hot || isChecked() ? colors.accent : colors.border, isChecked() ? 4.0
                                                                          : hot       ? 2.0
                                                                                      : 1.0));
  painter.drawPath(outline);
}

QString robot_picture(const std::string& robot) {
  return QString::fromStdString(
      (geometric::resource_dir() / "thumbnails" / "robots" / (robot + ".jpg")).string());
}

}  // namespace handway::gui
