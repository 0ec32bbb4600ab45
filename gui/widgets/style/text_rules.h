#pragma once

#include <QObject>

namespace handway::gui {

/// Breaks the tool tips of all widgets into lines where they are long: Qt shows plain text in one
/// line, however wide.
class WrappedTooltips : public QObject {
  Q_OBJECT

 public:
  /// Wraps tool tips as long as it lives.
  explicit WrappedTooltips(QObject* parent);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace handway::gui
