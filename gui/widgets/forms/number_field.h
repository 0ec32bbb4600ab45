#pragma once

#include <QDoubleSpinBox>

namespace handway::gui {

/// A spin box for numbers of any size: shows as many digits as the value needs
/// (0.005, 1e-06) and steps in proportion to it.
class NumberField : public QDoubleSpinBox {
  Q_OBJECT

 public:
  NumberField(double lower, double upper, QWidget* parent = nullptr);

  [[nodiscard]] QString textFromValue(double value) const override;
};

}  // namespace handway::gui
