#pragma once

#include <QString>

namespace handway::gui {

enum class LengthUnit { kMillimetre, kCentimetre, kMetre, kInch };
enum class AngleUnit { kDegree, kRadian };

/// The units in which fields show lengths and angles.
struct QuantityUnits {
  LengthUnit length = LengthUnit::kMillimetre;
  AngleUnit angle = AngleUnit::kDegree;

  bool operator==(const QuantityUnits& other) const = default;
};

/// How a unit is written behind a number, and what one of it is in mm or degrees.
struct UnitText {
  QString suffix;
  double size = 1.0;
};
[[nodiscard]] UnitText unit_text(LengthUnit unit);
[[nodiscard]] UnitText unit_text(AngleUnit unit);

}  // namespace handway::gui
