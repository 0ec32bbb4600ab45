#include "forms/quantity_field.h"

#include "handway/geometric/math/units.h"

#include <QRegularExpression>
#include <QSignalBlocker>

#include <array>
#include <cmath>
#include <optional>

namespace handway::gui {
namespace {

struct Unit {
  QLatin1String name;
  double shown;  ///< In millimetres or degrees.
};

constexpr int kDecimals = 7;  // kept; fewer are shown

std::optional<double> shown_per_unit(QuantityField::Kind kind, const QString& name) {
  static const std::array kLengths{
      Unit{QLatin1String(""), 1.0}, Unit{QLatin1String("mm"), 1.0}, Unit{QLatin1String("cm"), 10.0},
      Unit{QLatin1String("m"), 1000.0}, Unit{QLatin1String("in"), 25.4}};
  static const std::array kAngles{Unit{QLatin1String(""), 1.0}, Unit{QLatin1String("°"), 1.0},
                                  Unit{QLatin1String("deg"), 1.0},
                                  Unit{QLatin1String("rad"), geometric::degrees(1.0)}};
  const auto find = [&](const auto& units) -> std::optional<double> {
    for (const Unit& unit : units) {
      if (name == QString::fromUtf8(unit.name.data(), unit.name.size())) {
        return unit.shown;
      }
    }
    return std::nullopt;
  };
  return kind == QuantityField::Kind::kLength ? find(kLengths) : find(kAngles);
}

// In millimetres or degrees.
std::optional<double> parse_number(QuantityField::Kind kind, const QString& text) {
  static const QRegularExpression kPattern(
      QStringLiteral("^\\s*([-+]?(?:\\d+[.,]?\\d*|[.,]\\d+)(?:[eE][-+]?\\d+)?)\\s*([a-z°]*)\\s*$"));
  const QRegularExpressionMatch match = kPattern.match(text);
  if (!match.hasMatch()) {
    return std::nullopt;
  }
  const auto unit = shown_per_unit(kind, match.captured(2));
  const double number = match.captured(1).replace(',', '.').toDouble();
  return unit ? std::optional(number * *unit) : std::nullopt;
}

// The field's own unit may stand behind the one that was typed: "0.5 m mm".
std::optional<double> parse(QuantityField::Kind kind, const QString& text, const QString& suffix) {
  const auto value = parse_number(kind, text);
  return value || !text.endsWith(suffix) ? value : parse_number(kind, text.chopped(suffix.size()));
}

double to_shown(QuantityField::Kind kind, double si) {
  return kind == QuantityField::Kind::kLength ? geometric::millimetres(si) : geometric::degrees(si);
}

}  // namespace

QuantityField::QuantityField(Kind kind, double lower, double upper, QWidget* parent)
    : QDoubleSpinBox(parent), kind_(kind) {
  setDecimals(kDecimals);
  setRange(to_shown(kind, lower), to_shown(kind, upper));
  setSingleStep(kind == Kind::kLength ? 10.0 : 5.0);
  setKeyboardTracking(false);
  setCorrectionMode(QAbstractSpinBox::CorrectToPreviousValue);
  setWrapping(false);
  setSuffix(kind == Kind::kLength ? QStringLiteral(" mm") : QStringLiteral("°"));
  setToolTip(kind == Kind::kLength ? tr("A number of millimetres, or one with its unit: 0.2 m")
                                   : tr("A number of degrees, or one with its unit: 1.57 rad"));
  connect(this, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          [this] { emit quantity_edited(quantity()); });
}

double QuantityField::quantity() const {
  return kind_ == Kind::kLength ? geometric::metres(value()) : geometric::radians(value());
}

void QuantityField::show_quantity(double value) {
  const QSignalBlocker quiet(this);
  setValue(to_shown(kind_, value));
}

double QuantityField::valueFromText(const QString& text) const {
  return parse(kind_, text, suffix()).value_or(value());
}

QString QuantityField::textFromValue(double value) const {
  const double rounded = std::round(value * 1e3) / 1e3 + 0.0;
  return QString::number(rounded, 'g', 12);
}

QValidator::State QuantityField::validate(QString& text, int& /*position*/) const {
  const auto value = parse(kind_, text, suffix());
  return value && *value >= minimum() && *value <= maximum() ? QValidator::Acceptable
                                                             : QValidator::Intermediate;
}

}  // namespace handway::gui
