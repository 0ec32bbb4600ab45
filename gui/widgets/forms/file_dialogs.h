#pragma once

#include <QObject>

namespace handway::gui {

/// Qt's file dialogs have choices of folder and of type that are narrower than what they hold:
/// their tooltips show all of it, in every file dialog of the program.
class FileDialogTooltips : public QObject {
  Q_OBJECT

 public:
  /// Watches all file dialogs that open for as long as it lives.
  explicit FileDialogTooltips(QObject* parent);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace handway::gui
