#include "widgets/panels/floating_card.h"

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

QList<FloatingCard*> FloatingCard::others() const {
  QList<FloatingCard*> others;
  for (QObject* child : parentWidget()->children()) {
    if (auto* card = qobject_cast<FloatingCard*>(child);
        card && card != this && !card->isHidden()) {
      others.append(card);
    }
  }
  return others;
}

void FloatingCard::place_others() const {
  for (FloatingCard* card : others()) {
    card->place();
  }
}

void FloatingCard::showEvent(QShowEvent* event) {
  QFrame::showEvent(event);
  place_others();
}

void FloatingCard::hideEvent(QHideEvent* event) {
  QFrame::hideEvent(event);
  place_others();
}

void FloatingCard::resizeEvent(QResizeEvent* event) {
  QFrame::resizeEvent(event);
  place_others();
}

bool FloatingCard::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize && !isHidden()) {
    place();
  }
  return QFrame::eventFilter(watched, event);
}

}  // namespace handway::gui
