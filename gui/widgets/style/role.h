#pragma once

#include <QString>

class QWidget;

namespace handway::gui {

/// Gives a widget that is shown already another role in the style sheet; empty: none.
void set_role(QWidget& widget, const QString& role);

}  // namespace handway::gui
