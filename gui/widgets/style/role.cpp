#include "widgets/style/role.h"

#include <QStyle>
#include <QVariant>
#include <QWidget>

namespace handway::gui {

void set_role(QWidget& widget, const QString& role) {
  widget.setProperty("role", role);
  widget.style()->unpolish(&widget);
  widget.style()->polish(&widget);
}

}  // namespace handway::gui
