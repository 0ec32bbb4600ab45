#include "handway/device/glove/angle_ranges.h"

#include "handway/device/glove/recording_quality.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"

#include <algorithm>

namespace handway::device {
namespace {

using geometric::InputError;
constexpr double kLeastRange = 5.0 * geometric::kDegree;

}  // namespace

const AngleRanges& typical_angle_ranges() {
  static const AngleRanges kRanges = [] {
    // Degrees; KINE-ADL BE-UJI medians and textbook limits, rounded.
    constexpr std::array<std::pair<double, double>, kGloveSensors> kDegrees{
        {{0, 90},  {-20, 35}, {-30, 75}, {0, 35},   {-15, 75}, {0, 105}, {0, 70},   {-20, 80},
         {0, 102}, {0, 70},   {-15, 15}, {-20, 75}, {0, 105},  {0, 70},  {-15, 15}, {-25, 70},
         {0, 98},  {0, 65},   {-15, 20}, {0, 35},   {-70, 50}, {-15, 30}}};
    AngleRanges radians;
    std::ranges::transform(kDegrees, radians.begin(), [](const auto& range) {
      return std::pair(range.first * geometric::kDegree, range.second * geometric::kDegree);
    });
    return radians;
  }();
  return kRanges;
}

PersonRanges measured_ranges(const Recording& angles) {
  if (angles.header.kind != RecordingKind::kAngles) {
    throw InputError({"calibration", "", "a recording of raw counts", "one of angles", ""});
  }
  PersonRanges ranges;
  for (const SensorQuality& quality : assess(angles).sensors) {
    if (quality.last_percentile - quality.first_percentile >= kLeastRange) {
      ranges.at(static_cast<std::size_t>(quality.sensor)) =
          std::pair(quality.first_percentile, quality.last_percentile);
    }
  }
  return ranges;
}

double typical_angle(const PersonRanges& ranges, int sensor, double angle) {
  const auto& own = ranges.at(static_cast<std::size_t>(sensor));
  if (!own) {
    return angle;
  }
  const auto& typical = typical_angle_ranges().at(static_cast<std::size_t>(sensor));
  const double own_side = angle < 0.0 ? -own->first : own->second;
  const double typical_side = angle < 0.0 ? -typical.first : typical.second;
  return own_side < kLeastRange || typical_side < kLeastRange ? angle
                                                              : angle * typical_side / own_side;
}

}  // namespace handway::device
