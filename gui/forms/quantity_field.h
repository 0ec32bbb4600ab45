#pragma once

#include <QDoubleSpinBox>

namespace handway::gui {

/// A spin box for a length or an angle. Shows millimetres or degrees, understands
/// what people type ("35", "3.5 cm", "0.2 m", "90°", "1.57 rad"), and speaks SI.
class QuantityField : public QDoubleSpinBox {
  Q_OBJECT

 public:
  enum class Kind { kLength, kAngle };

  /// @param lower, upper in m or rad.
  QuantityField(Kind kind, double lower, double upper, QWidget* parent = nullptr);

  /// m or rad.
  [[nodiscard]] double quantity() const;
  /// Shows a value without telling anyone.
  void show_quantity(double value);

  [[nodiscard]] double valueFromText(const QString& text) const override;
  [[nodiscard]] QString textFromValue(double value) const override;
  [[nodiscard]] QValidator::State validate(QString& text, int& position) const override;

 signals:
  /// A person has changed it. @param value m or rad.
  void quantity_edited(double value);

 private:
  Kind kind_;
};

}  // namespace handway::gui
