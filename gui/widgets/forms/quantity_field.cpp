#include "widgets/forms/quantity_field.h"

#include "handway/geometric/math/units.h"
#include "widgets/forms/typed_input.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QRegularExpression>
#include <QSignalBlocker>

#include <array>
#include <cmath>
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

}  // namespace handway::gui
