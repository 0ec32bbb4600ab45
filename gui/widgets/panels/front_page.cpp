#include "widgets/panels/front_page.h"

#include <QDockWidget>
#include <QTabWidget>

namespace handway::gui {

void bring_to_front(const QWidget& widget) {
  for (QWidget* part = widget.parentWidget(); part; part = part->parentWidget()) {
    auto* tabs = qobject_cast<QTabWidget*>(part);
    for (int page = 0; tabs && page < tabs->count(); ++page) {
      if (tabs->widget(page) == &widget || tabs->widget(page)->isAncestorOf(&widget)) {
        tabs->setCurrentIndex(page);
      }
    }
    if (auto* dock = qobject_cast<QDockWidget*>(part)) {
      dock->show();
      dock->raise();
    }
  }
}

}  // namespace handway::gui
