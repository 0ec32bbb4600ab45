#include "features/glove/finger_combinations.h"

#include "features/glove/joint_label.h"
#include "handway/device/glove/angle_ranges.h"

#include <QObject>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace handway::gui {
namespace {

using device::Finger;

constexpr int kBent = FingerCombinations::kStates - 1;
constexpr double kHalf = 0.33;  // of a typical joint's flexion, and kMostly: where states end
constexpr double kMostly = 0.67;

// Sensors whose mean says how bent a finger is, indices into cyberglove_sensors().
const std::array<std::vector<int>, device::kFingers>& bending_sensors() {
  static const auto kSensors = [] {
    std::array<std::vector<int>, device::kFingers> sensors;
    const std::array<std::vector<const char*>, device::kFingers> names{
        {{"ThumbRotate", "ThumbIJ"},
         {"IndexMPJ", "IndexPIJ"},
         {"MiddleMPJ", "MiddlePIJ"},
         {"RingMPJ", "RingPIJ"},
         {"PinkieMPJ", "PinkiePIJ"}}};
    for (std::size_t f = 0; f < names.size(); ++f) {
      for (const char* name : names.at(f)) {
        sensors.at(f).push_back(device::find_sensor(name).value());
      }
    }
    return sensors;
  }();
  return kSensors;
}

std::optional<int> state_of(std::size_t finger, const device::GloveAngles& angles,
                            const device::PersonRanges& ranges) {
  double sum = 0.0;
  int count = 0;
  for (const int sensor : bending_sensors().at(finger)) {
    const auto place = static_cast<std::size_t>(sensor);
    if (std::isfinite(angles.angles.at(place))) {
      sum += device::typical_angle(ranges, sensor, angles.angles.at(place)) /
             device::typical_angle_ranges().at(place).second;
      ++count;
    }
  }
  if (count == 0) {
    return std::nullopt;
  }
  const double bent = sum / count;
  return bent > kMostly ? kBent : bent > kHalf ? 1 : 0;
}

}  // namespace

void FingerCombinations::add(const device::GloveAngles& angles,
                             const device::PersonRanges& ranges) {
  std::array<std::optional<int>, device::kFingers> states;
  for (std::size_t f = 0; f < states.size(); ++f) {
    states.at(f) = state_of(f, angles, ranges);
    measured_.at(f) = measured_.at(f) || states.at(f);
  }
  for (std::size_t a = 0; a < states.size(); ++a) {
    for (std::size_t b = a + 1; b < states.size(); ++b) {
      if (states.at(a) && states.at(b)) {
        cells_.at(a).at(b).at(static_cast<std::size_t>(*states.at(a) * kStates + *states.at(b))) =
            true;
      }
    }
  }
}

bool FingerCombinations::visited(Finger a, int state_of_a, Finger b, int state_of_b) const {
  return cells_.at(static_cast<std::size_t>(a))
      .at(static_cast<std::size_t>(b))
      .at(static_cast<std::size_t>(state_of_a * kStates + state_of_b));
}

double FingerCombinations::share() const {
  std::ptrdiff_t filled = 0;
  std::size_t all = 0;
  for (std::size_t a = 0; a < cells_.size(); ++a) {
    for (std::size_t b = a + 1; b < cells_.size(); ++b) {
      if (measured_.at(a) && measured_.at(b)) {
        filled += std::ranges::count(cells_.at(a).at(b), true);
        all += cells_.at(a).at(b).size();
      }
    }
  }
  return all > 0 ? static_cast<double>(filled) / static_cast<double>(all) : 0.0;
}

QString FingerCombinations::missing() const {
  for (std::size_t a = 0; a < cells_.size(); ++a) {
    for (std::size_t b = a + 1; b < cells_.size(); ++b) {
      if (!measured_.at(a) || !measured_.at(b)) {
        continue;
      }
      const auto text = QObject::tr("%1 bent, %2 straight");
      if (!visited(static_cast<Finger>(a), kBent, static_cast<Finger>(b), 0)) {
        return text.arg(finger_label(a), finger_label(b).toLower());
      }
      if (!visited(static_cast<Finger>(a), 0, static_cast<Finger>(b), kBent)) {
        return text.arg(finger_label(b), finger_label(a).toLower());
      }
    }
  }
  return {};
}

}  // namespace handway::gui
