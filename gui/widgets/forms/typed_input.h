#pragma once

#include <QObject>
#include <QString>
#include <QVariant>

#include <optional>
#include <utility>
#include <vector>

class QAbstractSpinBox;
class QComboBox;
class QDoubleSpinBox;
class QLineEdit;
class QSlider;
class QSpinBox;
class QWidget;

namespace handway::gui {

// The functions below show values that come from the program in fields that a person can edit.
// They emit no signal of the field. A field that is being edited keeps what the person typed, and
// shows the latest value of the program if the person leaves it without entering another.
//
// Every panel shows its values through them: a robot that moves, a document that changes or a
// device that streams never overwrites what is being typed.

/// Returns whether the user is editing the field: text is typed and not entered yet, the list is
/// open, or the handle of the slider is held.
[[nodiscard]] bool is_being_edited(const QWidget& field);

/// Shows a number.
void show_value(QDoubleSpinBox& field, double value);
void show_value(QSpinBox& field, int value);
void show_value(QSlider& slider, int value);
/// Shows a text.
void show_text(QLineEdit& field, const QString& text);

/// An entry of a list: its text, and data by role, Qt::UserRole first.
struct ShownChoice {
  QString text;
  QVariant data = {};
  QVariant more_data = {};  ///< For Qt::UserRole + 1.
};
/// Shows a list of choices. An open list stays as it is until it is closed.
/// @param current row; negative: none.
void show_choices(QComboBox& box, const std::vector<ShownChoice>& choices, int current);

/// Enters the typed text, as the key Return does. Text that is no valid value stays in the
/// field.
void enter_typed(QWidget& field);
/// Forgets what is typed in the widget and in all fields inside: they are about something else from
/// now on.
void forget_typed(QWidget& widget);

/// Returns the displayed reason why the field's text can't be entered, a sentence; nothing if it
/// can.
[[nodiscard]] std::optional<QString> invalid_text_reason(const QAbstractSpinBox& field);

/// Watches the fields of the program, for as long as it lives.
///
/// - Number fields take any text, mark one that is no value or beyond the limits, say what is
///   expected when it is entered, and return to the value before when they are left. Qt's own
///   drop characters instead ("1e9" becomes 19).
/// - Escape returns to the value that the program has.
/// - Typed text is entered before a shortcut or a click elsewhere acts.
class TypingGuard : public QObject {
  Q_OBJECT

 public:
  explicit TypingGuard(QObject* parent);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace handway::gui
