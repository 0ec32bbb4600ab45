#pragma once

#include <QObject>
#include <QString>

class QWidget;

namespace handway::gui {

/// Asks for the file to write. A name without an ending gets that of the chosen type before the
/// question whether to replace an existing file.
/// @param name that is proposed, with or without a folder.
/// @param filters as QFileDialog has them. @returns nothing if it was cancelled.
[[nodiscard]] QString ask_where_to_save(QWidget* parent, const QString& title, const QString& name,
                                        const QString& filters);

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
