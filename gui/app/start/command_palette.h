#pragma once

#include <QAction>
#include <QFrame>
#include <QList>
#include <QString>

#include <optional>

class QLineEdit;
class QMainWindow;
class QListWidget;

namespace handway::gui {

/// Returns how well `text` matches `typed`: all letters of `typed` must be in it, in order,
/// whatever their case. Letters that begin words or follow each other count more. Returns nothing
/// if it does not match.
[[nodiscard]] std::optional<int> fuzzy_score(const QString& typed, const QString& text);

/// All commands of a window in one list, found by a few letters of their names.
class CommandPalette : public QFrame {
  Q_OBJECT

 public:
  /// @param window whose menus it lists.
  explicit CommandPalette(QMainWindow& window);

  /// Opens the palette over the window.
  void ask();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Command {
    QString path;  ///< "View: Top"
    QAction* action;
  };

  void list(const QString& typed);
  void run_current();

  QMainWindow& window_;
  QLineEdit* field_;
  QListWidget* list_;
  QList<Command> commands_;
};

}  // namespace handway::gui
