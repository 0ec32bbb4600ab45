#include "widgets/forms/quantity_field.h"

#include "handway/geometric/math/units.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/typed_input.h"
#include "widgets/style/theme.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QRegularExpression>
#include <QSignalBlocker>
#include <QSlider>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace handway::gui {
namespace {

const QLatin1String kPerSecond("/s");
constexpr int kDecimals = 7;  // kept; fewer are shown

QuantityUnits shown_units;

// One of the unit of that name, in millimetres or degrees.
std::optional<double> shown_per_unit(QuantityField::Kind kind, const QString& name) {
  const auto find = [&](const auto& units) -> std::optional<double> {
    for (const auto unit : units) {
      if (const UnitText text = unit_text(unit); text.suffix.trimmed() == name) {
        return text.size;
      }
    }
    return std::nullopt;
  };
  if (kind == QuantityField::Kind::kLength) {
    return find(std::array{LengthUnit::kMillimetre, LengthUnit::kCentimetre, LengthUnit::kMetre,
                           LengthUnit::kInch});
  }
  return find(std::array{AngleUnit::kDegree, AngleUnit::kRadian});
}

// In millimetres or degrees; a number alone is in units of `own`.
std::optional<double> parse_number(QuantityField::Kind kind, const QString& text, double own) {
  static const QRegularExpression kPattern(
      QStringLiteral("^\\s*([-+]?(?:\\d+[.,]?\\d*|[.,]\\d+)(?:[eE][-+]?\\d+)?)\\s*([a-z°]*)\\s*$"));
  const bool is_speed = kind == QuantityField::Kind::kAngularSpeed;
  const QString quantity =
      is_speed && text.endsWith(kPerSecond) ? text.chopped(kPerSecond.size()) : text;
  const QRegularExpressionMatch match = kPattern.match(quantity);
  if (!match.hasMatch()) {
    return std::nullopt;
  }
  const QString word = match.captured(2);
  const QString name = word == QLatin1String("deg") ? QStringLiteral("°") : word;
  const auto unit = name.isEmpty() ? std::optional(own) : shown_per_unit(kind, name);
  const double number = match.captured(1).replace(',', '.').toDouble();
  return unit ? std::optional(number * *unit) : std::nullopt;
}

// The field's own unit may stand behind the one that was typed: "0.5 m mm".
std::optional<double> parse(QuantityField::Kind kind, const QString& text, const UnitText& own) {
  const auto value = parse_number(kind, text, own.size);
  return value || !text.endsWith(own.suffix)
             ? value
             : parse_number(kind, text.chopped(own.suffix.size()), own.size);
}

double to_shown(QuantityField::Kind kind, double si) {
  return kind == QuantityField::Kind::kLength ? geometric::millimetres(si) : geometric::degrees(si);
}

}  // namespace

QuantityField::QuantityField(Kind kind, double lower, double upper, QWidget* parent)
    : QDoubleSpinBox(parent), kind_(kind) {
  setDecimals(kDecimals);
  setRange(to_shown(kind, lower), to_shown(kind, upper));
  setKeyboardTracking(false);
  setCorrectionMode(QAbstractSpinBox::CorrectToPreviousValue);
  setWrapping(false);
  setSingleStep(kind == Kind::kLength ? 10.0 : 5.0);
  setToolTip(kind == Kind::kLength  ? tr("A number, or one with its unit: 20 cm, 0.2 m")
             : kind == Kind::kAngle ? tr("A number, or one with its unit: 90°, 1.57 rad")
                                    : tr("A number, or one with its unit: 90°/s, 1.57 rad/s"));
  use_units();
  connect(this, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          [this] { emit quantity_edited(quantity()); });
}

void QuantityField::use_units() {
  unit_ = kind_ == Kind::kLength ? unit_text(shown_units.length) : unit_text(shown_units.angle);
  if (kind_ == Kind::kAngularSpeed) {
    unit_.suffix += kPerSecond;
  }
  setSuffix(unit_.suffix);
}

void QuantityField::show_units(const QuantityUnits& units) {
  shown_units = units;
  for (QWidget* widget : QApplication::allWidgets()) {
    if (auto* field = qobject_cast<QuantityField*>(widget)) {
      const QSignalBlocker quiet(field);
      field->use_units();
    }
  }
}

double QuantityField::quantity() const {
  return kind_ == Kind::kLength ? geometric::metres(value()) : geometric::radians(value());
}

void QuantityField::show_quantity(double value) { show_value(*this, to_shown(kind_, value)); }

double QuantityField::valueFromText(const QString& text) const {
  // The shown text has fewer digits than the value.
  return text == textFromValue(value()) + suffix() ? value()
                                                   : parse(kind_, text, unit_).value_or(value());
}

QString QuantityField::textFromValue(double value) const {
  const double decimals = unit_.size > 20.0 ? 1e5 : 1e3;  // as fine as 0.001 mm, at least nearly
  const double rounded = std::round(value / unit_.size * decimals) / decimals + 0.0;
  return QString::number(rounded, 'g', 12);
}

QValidator::State QuantityField::validate(QString& text, int& /*position*/) const {
  const auto value = parse(kind_, text, unit_);
  return value && *value >= minimum() && *value <= maximum() ? QValidator::Acceptable
                                                             : QValidator::Intermediate;
}

namespace {

constexpr double kFarthest = 100.0;                   // m
constexpr double kFullTurn = 2.0 * std::numbers::pi;  // rad

constexpr int kAroundText = 18;  // px

QString longest_text(QuantityField::Kind kind) {
  return kind == QuantityField::Kind::kLength ? QStringLiteral("−1000.000 mm")
                                              : QStringLiteral("−180.000°");
}

QuantityField* make_field(QuantityField::Kind kind, double most, const char* name) {
  auto* field = new QuantityField(kind, -most, most);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  field->setObjectName(QLatin1String(name));
  field->setMinimumWidth(field->fontMetrics().horizontalAdvance(longest_text(kind)) + kAroundText);
  return field;
}

}  // namespace

PoseForm::PoseForm(QWidget* parent) : QWidget(parent) {
  constexpr std::array kPositions{"X", "Y", "Z"};
  constexpr std::array kPositionNames{"position_x", "position_y", "position_z"};
  constexpr std::array kRotationNames{"roll", "pitch", "yaw"};
  const std::array<QString, 3> rotations{tr("Roll"), tr("Pitch"), tr("Yaw")};
  auto* layout = new QGridLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setHorizontalSpacing(6);
  layout->setVerticalSpacing(5);
  for (std::size_t i = 0; i < 3; ++i) {
    const int row = static_cast<int>(i);
    position_.at(i) = make_field(QuantityField::Kind::kLength, kFarthest, kPositionNames.at(i));
    rotation_.at(i) = make_field(QuantityField::Kind::kAngle, kFullTurn, kRotationNames.at(i));
    labels_.at(i) = note(QLatin1String(kPositions.at(i)));
    labels_.at(i + 3) = note(rotations.at(i));
    connect(position_.at(i), &QuantityField::quantity_edited, this, [this, row](double value) {
      geometric::Pose X = X_;
      X.translation()[row] = value;
      emit pose_edited(X);
    });
    connect(rotation_.at(i), &QuantityField::quantity_edited, this, [this] {
      const geometric::Pose turned =
          geometric::pose_from_rpy(X_.translation(), rotation_[0]->quantity(),
                                   rotation_[1]->quantity(), rotation_[2]->quantity());
      emit pose_edited(turned);
    });
  }
  for (const auto& fields : {position_, rotation_}) {  // in the order of the Tab key
    std::ranges::for_each(fields, [this](QWidget* field) { field->setParent(this); });
  }
  arrange(true);
}

void PoseForm::arrange(bool narrow) {
  auto* grid = qobject_cast<QGridLayout*>(layout());
  for (std::size_t i = 0; i < 3; ++i) {
    const int row = static_cast<int>(i);
    const int below = narrow ? row + 3 : row;
    const int beside = narrow ? 0 : 2;
    grid->addWidget(labels_.at(i), row, 0);
    grid->addWidget(position_.at(i), row, 1);
    grid->addWidget(labels_.at(i + 3), below, beside);
    grid->addWidget(rotation_.at(i), below, beside + 1);
  }
  grid->setColumnStretch(1, 5);
  grid->setColumnStretch(3, narrow ? 0 : 4);
  is_narrow_ = narrow;
  // The layout around may be at work just now.
  QMetaObject::invokeMethod(this, &QWidget::updateGeometry, Qt::QueuedConnection);
}

int PoseForm::width_of_columns() const {
  const int space = layout()->contentsMargins().left() +
                    3 * qobject_cast<QGridLayout*>(layout())->horizontalSpacing();
  return labels_[0]->sizeHint().width() + position_[0]->minimumWidth() +
         labels_[4]->sizeHint().width() + rotation_[0]->minimumWidth() + space;
}

// With all fields below each other.
QSize PoseForm::minimumSizeHint() const {
  const int label = labels_[4]->sizeHint().width();
  const int space = qobject_cast<QGridLayout*>(layout())->horizontalSpacing();
  return {label + space + position_[0]->minimumWidth(), layout()->minimumSize().height()};
}

void PoseForm::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  const bool narrow = width() < width_of_columns();
  if (narrow != is_narrow_) {
    arrange(narrow);
  }
}

void PoseForm::show_pose(const geometric::Pose& X) {
  X_ = X;
  const Eigen::Vector3d rpy = geometric::rpy_from_rotation(X.linear());
  for (std::size_t i = 0; i < 3; ++i) {
    position_.at(i)->show_quantity(X.translation()[static_cast<Eigen::Index>(i)]);
    rotation_.at(i)->show_quantity(rpy[static_cast<Eigen::Index>(i)]);
  }
}

void PoseForm::set_editable(bool editable) {
  for (QuantityField* field :
       {position_[0], position_[1], position_[2], rotation_[0], rotation_[1], rotation_[2]}) {
    if (field->isReadOnly() == editable) {
      field->setReadOnly(!editable);
      field->setFocusPolicy(editable ? Qt::StrongFocus : Qt::ClickFocus);
      set_role(*field, editable ? QString() : QStringLiteral("shown"));
    }
  }
}

namespace {

constexpr int kSteps = 2000;

/// A number of which fewer digits are shown than it has: 12.345 is typed, kept, and shown as 12.3.
class PreciseField : public QDoubleSpinBox {
 public:
  explicit PreciseField(int shown) : shown_(shown) { setDecimals(kDecimals); }

  [[nodiscard]] QString textFromValue(double value) const override {
    const double unit = std::pow(10.0, shown_);
    return locale().toString(std::round(value * unit) / unit + 0.0, 'f', shown_);
  }
  [[nodiscard]] double valueFromText(const QString& text) const override {
    return text == textFromValue(value()) + suffix() ? value()
                                                     : QDoubleSpinBox::valueFromText(text);
  }

 private:
  int shown_;
};

}  // namespace

SliderRow::SliderRow(const QString& label, const Range& range, QWidget* parent)
    : QWidget(parent),
      range_(range),
      label_(new QLabel(label)),
      slider_(named("slider", new QSlider(Qt::Horizontal))),
      field_(new PreciseField(range.decimals)) {
  label_->setToolTip(label);
  slider_->setAccessibleName(label);
  field_->setAccessibleName(label);
  slider_->setRange(0, kSteps);
  slider_->setPageStep(kSteps / 20);
  slider_->setFocusPolicy(Qt::StrongFocus);
  field_->setRange(range.lower * range.scale, range.upper * range.scale);
  field_->setSingleStep(
      std::max(std::pow(10.0, -range.decimals), (range.upper - range.lower) * range.scale / 100.0));
  field_->setSuffix(range.unit);
  field_->setAlignment(Qt::AlignRight);
  field_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field_->setKeyboardTracking(false);
  field_->setFixedWidth(scaled(68));
  auto* layout = new QGridLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setHorizontalSpacing(8);
  layout->setVerticalSpacing(0);
  layout->setColumnStretch(1, 1);
  layout->addWidget(label_, 0, 0);
  layout->addWidget(slider_, 0, 1);
  layout->addWidget(field_, 0, 2);
  setToolTip(QStringLiteral("%1: %2%4 to %3%4")
                 .arg(label)
                 .arg(range.lower * range.scale, 0, 'f', range.decimals)
                 .arg(range.upper * range.scale, 0, 'f', range.decimals)
                 .arg(range.unit));

  connect(slider_, &QSlider::valueChanged, this, [this](int step) {
    edit(range_.lower + (range_.upper - range_.lower) * step / kSteps);
    show_value(false, true);
  });
  connect(field_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this](double shown) {
    edit(std::clamp(shown / range_.scale, range_.lower, range_.upper));
    show_value(true, false);
  });
  set_value(std::clamp(0.0, range.lower, range.upper));
}

void SliderRow::edit(double value) {
  value_ = value;
  emit value_edited(value);
}

void SliderRow::set_value(double value) {
  value_ = std::clamp(value, range_.lower, range_.upper);
  show_value(true, true);
}

void SliderRow::show_value(bool slider, bool field) {
  const double range = range_.upper - range_.lower;
  if (slider) {
    gui::show_value(
        *slider_,
        range > 0.0 ? static_cast<int>(std::lround((value_ - range_.lower) / range * kSteps)) : 0);
  }
  if (field) {
    gui::show_value(*field_, value_ * range_.scale);
  }
}

void SliderRow::set_read_only() {
  slider_->setEnabled(false);
  field_->setReadOnly(true);
  field_->setEnabled(false);
  label_->setEnabled(false);
}

void SliderRow::set_chosen(bool chosen) {
  set_role(*label_, chosen ? QStringLiteral("chosen") : QString());
}

void SliderRow::use_two_lines() {
  auto* grid = qobject_cast<QGridLayout*>(layout());
  grid->addWidget(slider_, 1, 0, 1, 3);
}

void SliderRow::set_label_width(int width) {
  label_->setFixedWidth(width);
  const QString text = label_->toolTip();
  label_->setText(label_->fontMetrics().elidedText(text, Qt::ElideMiddle, width));
}

namespace {

QWidget* changed_by_wheel(QObject* object) {
  const bool is_one = qobject_cast<QAbstractSpinBox*>(object) || qobject_cast<QSlider*>(object) ||
                      qobject_cast<QComboBox*>(object);
  return is_one ? static_cast<QWidget*>(object) : nullptr;
}

}  // namespace

WheelGuard::WheelGuard(QObject* parent) : QObject(parent) { qApp->installEventFilter(this); }

bool WheelGuard::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Polish) {
    if (QWidget* widget = changed_by_wheel(watched);
        widget && widget->focusPolicy() == Qt::WheelFocus) {
      widget->setFocusPolicy(Qt::StrongFocus);  // else the wheel gives the focus first
    }
  } else if (event->type() == QEvent::Wheel) {
    if (const QWidget* widget = changed_by_wheel(watched); widget && !widget->hasFocus()) {
      event->ignore();  // the parent scrolls
      return true;
    }
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace handway::gui
