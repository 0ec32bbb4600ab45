#pragma once

#include <QStringList>

class QWidget;

namespace handway::test {

/// Returns the controls in a widget that have no name for a screen reader, or that the keyboard
/// does not reach: visible and enabled buttons, fields, sliders, lists, tabs.
[[nodiscard]] QStringList faults_for_readers(const QWidget& of);

}  // namespace handway::test
