#include "panels/banner.h"

#include "style/icons.h"
#include "style/theme.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVariant>

#include <algorithm>

namespace handway::gui {

Banner::Banner(QWidget* host) : QFrame(host), picture_(new QLabel), text_(new QLabel) {
  setProperty("role", "banner");
  setAttribute(Qt::WA_StyledBackground);
  text_->setWordWrap(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  text_->setObjectName(QStringLiteral("banner_text"));
  auto* close = new QToolButton;
  close->setIcon(icon("close"));
  close->setAutoRaise(true);
  close->setToolTip(tr("Put this message away"));
  connect(close, &QToolButton::clicked, this, &QWidget::hide);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(14, 10, 8, 10);
  layout->setSpacing(12);
  layout->addWidget(picture_, 0, Qt::AlignTop);
  layout->addWidget(text_, 1);
  layout->addWidget(close, 0, Qt::AlignTop);
  host->installEventFilter(this);
  hide();
}

void Banner::show_message(const QString& title, const QString& message) {
  picture_->setPixmap(icon("warning", colors_of(current_theme()).bad).pixmap(24, 24));
  text_->setText(
      QStringLiteral("<b>%1</b><br>%2").arg(title.toHtmlEscaped(), message.toHtmlEscaped()));
  show();
  place();
  raise();
}

QString Banner::message() const { return text_->text(); }

bool Banner::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize && isVisible()) {
    place();
  }
  return QFrame::eventFilter(watched, event);
}

void Banner::place() {
  const int width = std::min(parentWidget()->width() - 32, 760);
  const int height = std::max(heightForWidth(width), sizeHint().height());
  setGeometry((parentWidget()->width() - width) / 2, 16, width, height);
}

}  // namespace handway::gui
