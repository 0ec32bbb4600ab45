#include "widgets/forms/number_field.h"

#include <QLocale>

namespace handway::gui {

NumberField::NumberField(double lower, double upper, QWidget* parent) : QDoubleSpinBox(parent) {
  setDecimals(9);
  setRange(lower, upper);
  setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  setKeyboardTracking(false);
}

QString NumberField::textFromValue(double value) const { return locale().toString(value, 'g', 6); }

}  // namespace handway::gui
