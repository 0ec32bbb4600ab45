#pragma once

#include <QStringList>

class QWidget;

namespace handway::test {

/// What a person works with in a widget that a screen reader has no name for, or that the keyboard
/// does not reach: visible and enabled buttons, fields, sliders, lists, tabs.
[[nodiscard]] QStringList faults_for_readers(const QWidget& of);

}  // namespace handway::test
