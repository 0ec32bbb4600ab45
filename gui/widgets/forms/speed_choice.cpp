#include "widgets/forms/speed_choice.h"

#include <QComboBox>

namespace handway::gui {

void offer_speeds(QComboBox& box) {
  for (const double factor : {0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0}) {
    box.addItem(QStringLiteral("%1×").arg(factor), factor);
  }
  box.setCurrentIndex(box.findData(1.0));
}

}  // namespace handway::gui
