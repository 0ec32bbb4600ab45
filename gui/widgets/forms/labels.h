#pragma once

#include <QString>

class QLabel;

namespace handway::gui {

/// What stands above a part of a panel.
[[nodiscard]] QLabel* heading(const QString& text = {});
/// Words that are read after all others: what explains, counts or names.
[[nodiscard]] QLabel* note(const QString& text = {});

}  // namespace handway::gui
