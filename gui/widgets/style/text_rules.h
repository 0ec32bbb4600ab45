#pragma once

#include <QObject>

namespace handway::gui {

/// Decides how texts are shown by all widgets of the program, those of Qt's own dialogs too.
///
/// - A label shows plain text unless its format is set to Qt::RichText. Qt guesses by default, and
///   a name from a file that looks like HTML would be taken for it. Who sets Qt::RichText quotes
///   with toHtmlEscaped() what comes from outside.
/// - A tool tip shows plain text, always. A long one is broken into lines: Qt shows plain text in
///   one line, however wide.
/// - The choices of folder and of type in file dialogs are narrower than what they hold: their tool
///   tips show all of it.
class TextRules : public QObject {
  Q_OBJECT

 public:
  /// Applies to all widgets as long as it lives, from when they are shown.
  explicit TextRules(QObject* parent);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace handway::gui
