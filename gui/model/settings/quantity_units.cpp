#include "model/settings/quantity_units.h"

#include "handway/geometric/math/units.h"

namespace handway::gui {

UnitText unit_text(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::kMillimetre:
      break;
    case LengthUnit::kCentimetre:
      return {QStringLiteral(" cm"), 10.0};
    case LengthUnit::kMetre:
      return {QStringLiteral(" m"), 1000.0};
    case LengthUnit::kInch:
      return {QStringLiteral(" in"), 25.4};
  }
  return {QStringLiteral(" mm"), 1.0};
}

UnitText unit_text(AngleUnit unit) {
  return unit == AngleUnit::kDegree ? UnitText{QStringLiteral("°"), 1.0}
                                    : UnitText{QStringLiteral(" rad"), geometric::degrees(1.0)};
}

}  // namespace handway::gui
