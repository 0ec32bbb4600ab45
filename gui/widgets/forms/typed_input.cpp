#include "widgets/forms/typed_input.h"

#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QEvent>
#include <QFocusEvent>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPointer>
#include <QSignalBlocker>
#include <QSlider>
#include <QSpinBox>
#include <QStyle>
#include <QTimer>
#include <QToolTip>
#include <QValidator>

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace handway::gui {
namespace {

constexpr int kAfterClick = 300;  // ms; a click hides tooltips

/// Opens what is protected in Qt's spin boxes: their line edit.
QLineEdit* line_of(const QAbstractSpinBox& field) {
  return field.findChild<QLineEdit*>(QStringLiteral("qt_spinbox_lineedit"),
                                     Qt::FindDirectChildrenOnly);
}

/// The number in the field's text, of any number of digits and with either decimal point, if it is
/// within the limits.
std::optional<double> number_in(const QDoubleSpinBox& field, QString text) {
  text = text.trimmed();
  if (!field.prefix().isEmpty() && text.startsWith(field.prefix())) {
    text.remove(0, field.prefix().size());
  }
  if (!field.suffix().isEmpty() && text.endsWith(field.suffix())) {
    text.chop(field.suffix().size());
  }
  bool is_number = false;
  const double value = text.trimmed().replace(',', '.').toDouble(&is_number);
  return is_number && value >= field.minimum() && value <= field.maximum() ? std::optional(value)
                                                                           : std::nullopt;
}

/// The text of the field as Qt takes it: "2.55" in a field of one decimal is rounded. Nothing if
/// it is no valid value.
std::optional<QString> valid_text(const QAbstractSpinBox& field) {
  QString text = line_of(field)->text();
  int position = 0;
  if (!field.isGroupSeparatorShown()) {  // else "3,5" is 35
    text.replace(QLatin1Char(','), QLatin1Char('.'));
  }
  if (field.validate(text, position) == QValidator::Acceptable) {
    return text;
  }
  const auto* number = qobject_cast<const QDoubleSpinBox*>(&field);
  const auto value = number ? number_in(*number, text) : std::nullopt;
  return value ? std::optional(number->prefix() +
                               field.locale().toString(*value, 'f', number->decimals()) +
                               number->suffix())
               : std::nullopt;
}

/// The limits of a number field, as it shows them.
std::pair<QString, QString> shown_limits(const QAbstractSpinBox& field) {
  if (const auto* number = qobject_cast<const QDoubleSpinBox*>(&field)) {
    return {number->textFromValue(number->minimum()) + number->suffix(),
            number->textFromValue(number->maximum()) + number->suffix()};
  }
  const auto& count = *qobject_cast<const QSpinBox*>(&field);
  return {field.locale().toString(count.minimum()) + count.suffix(),
          field.locale().toString(count.maximum()) + count.suffix()};
}

/// Lets any text be typed: the spin box judges it when it is entered.
class AnyText : public QValidator {
 public:
  using QValidator::QValidator;
  State validate(QString& /*text*/, int& /*position*/) const override { return Acceptable; }
};

/// The field that a person has typed in last.
QPointer<QWidget> field_with_typing;

/// Tracks the editing of one field, and the value that the program wanted to show meanwhile.
class TypedInput : public QObject {
 public:
  using Show = std::function<void()>;

  static TypedInput* find(const QWidget& field) {
    for (QObject* child : field.children()) {
      if (auto* input = dynamic_cast<TypedInput*>(child)) {
        return input;
      }
    }
    return nullptr;
  }

  static TypedInput& of(QWidget& field) {
    TypedInput* known = find(field);
    return known ? *known : *new TypedInput(field);
  }

  [[nodiscard]] bool is_being_edited() const {
    return typed_ || (slider_ && slider_->isSliderDown()) || is_open();
  }

  /// Shows a value at once, or when the field is no longer edited.
  void show(Show show) {
    if (is_being_edited()) {
      pending_ = std::move(show);
    } else {
      pending_ = nullptr;
      show();
    }
  }

  /// Enters what is typed; text that is no valid value stays.
  void enter() {
    if (!typed_) {
      return;
    }
    if (spin_) {
      if (invalid_text_reason(*spin_)) {
        return;
      }
      begin_entering();
      spin_->interpretText();
      emit spin_->editingFinished();
    } else if (line_) {
      begin_entering();
      emit line_->editingFinished();
    }
  }

  void forget() {
    mark(true);
    if (std::exchange(typed_, false)) {
      restore();
    }
  }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (is_going()) {
      return false;
    }
    switch (event->type()) {
      case QEvent::ShortcutOverride:
      case QEvent::KeyPress:
        return take_key(*static_cast<QKeyEvent*>(event), event->type() == QEvent::KeyPress);
      case QEvent::FocusIn:
        mark(true);
        if (!spin_ && line_ && !typed_) {
          before_ = line_->text();
        }
        break;
      case QEvent::FocusOut:
        leave(static_cast<QFocusEvent*>(event)->reason());
        break;
      case QEvent::Hide:
        if (watched != parent()) {  // the list of a combo box has been closed
          QMetaObject::invokeMethod(
              this, [this] { show_pending(); }, Qt::QueuedConnection);
        }
        break;
      default:
        break;
    }
    return QObject::eventFilter(watched, event);
  }

 private:
  explicit TypedInput(QWidget& field)
      : QObject(&field),
        spin_(qobject_cast<QAbstractSpinBox*>(&field)),
        line_(spin_ ? line_of(*spin_) : qobject_cast<QLineEdit*>(&field)),
        slider_(qobject_cast<QSlider*>(&field)),
        box_(qobject_cast<QComboBox*>(&field)) {
    if (line_) {
      connect(line_, &QLineEdit::textEdited, this, [this] {
        if (!std::exchange(typed_, true) && spin_) {
          before_ = value_before();
        }
        field_with_typing = static_cast<QWidget*>(this->parent());
        mark(!spin_ || !invalid_text_reason(*spin_));
      });
      field.installEventFilter(this);
    }
    if (spin_ && line_) {
      spin_->setKeyboardTracking(false);  // half a number is none
      line_->setValidator(new AnyText(line_));
    }
    if (slider_) {
      connect(slider_, &QSlider::sliderReleased, this, [this] {
        QMetaObject::invokeMethod(
            this, [this] { show_pending(); }, Qt::QueuedConnection);
      });
    }
  }

  /// Returns whether the field is being destroyed: it loses the focus meanwhile, and is no field
  /// any more.
  [[nodiscard]] bool is_going() const {
    return (spin_ && !qobject_cast<QAbstractSpinBox*>(parent())) ||
           (line_ && !spin_ && !qobject_cast<QLineEdit*>(parent()));
  }

  [[nodiscard]] bool is_open() const {
    const auto* view = box_ ? box_->findChild<QAbstractItemView*>() : nullptr;
    if (view && view->isVisible()) {
      auto* list = const_cast<QAbstractItemView*>(view);
      list->installEventFilter(const_cast<TypedInput*>(this));  // once, however often
      return true;
    }
    return false;
  }

  /// Before Qt takes what was typed: it compares with the value that the program has now, and what
  /// follows may be shown.
  void begin_entering() {
    const Show late = std::exchange(pending_, nullptr);
    typed_ = false;
    mark(true);
    if (!spin_) {
      return;  // what the panel makes of the text is shown then
    }
    const QString text = valid_text(*spin_).value_or(line_->text());
    if (late) {
      late();
    }
    line_->setText(text);
  }

  bool take_key(QKeyEvent& key, bool pressed) {
    if (!typed_) {
      return false;
    }
    switch (key.key()) {
      case Qt::Key_Escape:
        if (pressed) {
          forget();
        } else {
          key.accept();
        }
        return true;
      case Qt::Key_Return:
      case Qt::Key_Enter:
        return pressed && take_return();
      case Qt::Key_Up:
      case Qt::Key_Down:
      case Qt::Key_PageUp:
      case Qt::Key_PageDown:
        if (pressed && spin_ && !invalid_text_reason(*spin_)) {
          begin_entering();
        }
        return false;
      default:
        return false;
    }
  }

  bool take_return() {
    if (const auto reason = spin_ ? invalid_text_reason(*spin_) : std::nullopt) {
      notify(*reason);
      return true;
    }
    begin_entering();
    return false;
  }

  void leave(Qt::FocusReason reason) {
    const bool stays = !spin_ && (reason == Qt::ActiveWindowFocusReason ||
                                  reason == Qt::PopupFocusReason);  // QLineEdit goes on then
    if (!typed_ || stays) {
      return;
    }
    if (const auto why = spin_ ? invalid_text_reason(*spin_) : std::nullopt) {
      forget();
      mark(false);  // until the field is entered again
      QTimer::singleShot(
          kAfterClick, this,
          [this, text = tr("%1 It stays %2.").arg(*why, line_->text())] { notify(text); });
      return;
    }
    begin_entering();
  }

  /// Returns the value of a number field at the beginning of typing.
  [[nodiscard]] QVariant value_before() const {
    if (const auto* number = qobject_cast<const QDoubleSpinBox*>(spin_)) {
      return number->value();
    }
    const auto* count = qobject_cast<const QSpinBox*>(spin_);
    return count ? QVariant(count->value()) : QVariant();
  }

  void restore() {
    if (const Show late = std::exchange(pending_, nullptr)) {
      late();
    } else if (auto* number = qobject_cast<QDoubleSpinBox*>(spin_)) {
      number->setValue(before_.toDouble());
    } else if (auto* count = qobject_cast<QSpinBox*>(spin_)) {
      count->setValue(before_.toInt());
    } else if (line_) {
      line_->setText(before_.toString());
    }
  }

  void show_pending() {
    if (pending_ && !is_being_edited()) {
      std::exchange(pending_, nullptr)();
    }
  }

  void mark(bool valid) {
    if (spin_ && spin_->property("invalid").toBool() == valid) {
      spin_->setProperty("invalid", !valid);
      spin_->style()->unpolish(spin_);
      spin_->style()->polish(spin_);
    }
  }

  void notify(const QString& text) const {
    auto* field = static_cast<QWidget*>(parent());
    QToolTip::showText(field->mapToGlobal(QPoint(0, field->height())), text, field);
  }

  QAbstractSpinBox* spin_;
  QLineEdit* line_;
  QSlider* slider_;
  QComboBox* box_;
  bool typed_ = false;
  QVariant before_;
  Show pending_;
};

}  // namespace

bool is_being_edited(const QWidget& field) {
  const TypedInput* input = TypedInput::find(field);
  return input && input->is_being_edited();
}

void show_value(QDoubleSpinBox& field, double value) {
  TypedInput::of(field).show([&field, value] {
    const QSignalBlocker quiet(field);
    field.setValue(value);
  });
}

void show_value(QSpinBox& field, int value) {
  TypedInput::of(field).show([&field, value] {
    const QSignalBlocker quiet(field);
    field.setValue(value);
  });
}

void show_value(QSlider& slider, int value) {
  TypedInput::of(slider).show([&slider, value] {
    const QSignalBlocker quiet(slider);
    slider.setValue(value);
  });
}

void show_text(QLineEdit& field, const QString& text) {
  TypedInput::of(field).show([&field, text] {
    const QSignalBlocker quiet(field);
    field.setText(text);
  });
}

namespace {

bool shows(const QComboBox& box, const std::vector<ShownChoice>& choices) {
  int row = 0;
  return box.count() == static_cast<int>(choices.size()) &&
         std::ranges::all_of(choices, [&](const ShownChoice& choice) {
           const int i = row++;
           return box.itemText(i) == choice.text && box.itemData(i) == choice.data &&
                  box.itemData(i, Qt::UserRole + 1) == choice.more_data;
         });
}

}  // namespace

void show_choices(QComboBox& box, const std::vector<ShownChoice>& choices, int current) {
  TypedInput::of(box).show([&box, choices, current] {
    const QSignalBlocker quiet(box);
    if (!shows(box, choices)) {
      box.clear();
      for (const ShownChoice& choice : choices) {
        box.addItem(choice.text, choice.data);
        box.setItemData(box.count() - 1, choice.more_data, Qt::UserRole + 1);
      }
    }
    box.setCurrentIndex(current);
  });
}

void enter_typed(QWidget& field) {
  if (TypedInput* input = TypedInput::find(field)) {
    input->enter();
  }
}

void forget_typed(QWidget& widget) {
  QList<QWidget*> fields = widget.findChildren<QWidget*>();
  fields.push_back(&widget);
  for (QWidget* field : fields) {
    if (TypedInput* input = TypedInput::find(*field)) {
      input->forget();
    }
  }
}

std::optional<QString> invalid_text_reason(const QAbstractSpinBox& field) {
  if (!line_of(field) || valid_text(field)) {
    return std::nullopt;
  }
  const auto [lower, upper] = shown_limits(field);
  const QString typed = field.property("cleanText").toString();
  return QObject::tr("\"%1\" is no value from %2 to %3.").arg(typed, lower, upper);
}

TypingGuard::TypingGuard(QObject* parent) : QObject(parent) { qApp->installEventFilter(this); }

bool TypingGuard::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Polish) {
    if (auto* field = qobject_cast<QAbstractSpinBox*>(watched)) {
      TypedInput::of(*field);
    }
  } else if (event->type() == QEvent::Shortcut || event->type() == QEvent::MouseButtonPress) {
    const auto* pressed = qobject_cast<QWidget*>(watched);
    QWidget* field = field_with_typing;
    const bool is_elsewhere = event->type() == QEvent::Shortcut || pressed;
    if (field && is_elsewhere && pressed != field && !field->isAncestorOf(pressed)) {
      enter_typed(*field);
    }
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace handway::gui
