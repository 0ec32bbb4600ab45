#pragma once

#include "model/settings/preferences.h"

#include <QDoubleSpinBox>
#include <QString>
#include <QWidget>

namespace handway::gui {

/// A spin box for a length, an angle or a speed of turning. It shows the user's units, parses typed
/// quantities ("35", "3.5 cm", "0.2 m", "90°", "1.57 rad"), and its values are in SI units.
class QuantityField : public QDoubleSpinBox {
  Q_OBJECT

 public:
  enum class Kind { kLength, kAngle, kAngularSpeed };

  /// @param lower, upper in m, rad or rad/s.
  QuantityField(Kind kind, double lower, double upper, QWidget* parent = nullptr);

  /// All fields, those to come as well, show these units.
  static void show_units(const QuantityUnits& units);

  /// m, rad or rad/s.
  [[nodiscard]] double quantity() const;
  /// Shows a value without telling anyone.
  void show_quantity(double value);

  [[nodiscard]] double valueFromText(const QString& text) const override;
  [[nodiscard]] QString textFromValue(double value) const override;
  [[nodiscard]] QValidator::State validate(QString& text, int& position) const override;

 signals:
  /// A person has changed it. @param value m, rad or rad/s.
  void quantity_edited(double value);

 private:
  void use_units();

  Kind kind_;
  UnitText unit_;
};

}  // namespace handway::gui
