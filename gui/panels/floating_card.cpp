#include "panels/floating_card.h"

#include <QEvent>

namespace handway::gui {

FloatingCard::FloatingCard(QWidget* host) : QFrame(host) {
  setAttribute(Qt::WA_StyledBackground);
  host->installEventFilter(this);
  hide();
}

void FloatingCard::appear() {
  show();
  place();
  raise();
}

bool FloatingCard::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize && !isHidden()) {
    place();
  }
  return QFrame::eventFilter(watched, event);
}

}  // namespace handway::gui
