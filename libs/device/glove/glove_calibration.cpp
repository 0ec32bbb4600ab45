#include "handway/device/glove/glove_calibration.h"

#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/io/resources.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace handway::device {
namespace {

constexpr double kLeastCounts = 1.0;
constexpr double kMostCounts = 255.0;

}  // namespace

GloveCalibration typical_calibration() {
  return read_calibration(geometric::resource_dir() / "calibrations" / "typical_right_hand.yaml");
}

GloveAngles to_angles(const GloveFrame& frame, const GloveCalibration& calibration) {
  GloveAngles result;
  result.time = frame.time;
  for (std::size_t i = 0; i < kGloveSensors; ++i) {
    const std::optional<SensorCalibration>& sensor = calibration.sensors.at(i);
    result.angles.at(i) = sensor && frame.counts.at(i) > 0
                              ? sensor->gain * (frame.counts.at(i) - sensor->zero)
                              : std::numeric_limits<double>::quiet_NaN();
  }
  return result;
}

GloveFrame to_counts(const GloveAngles& angles, const GloveCalibration& calibration) {
  GloveFrame result;
  result.time = angles.time;
  for (std::size_t i = 0; i < kGloveSensors; ++i) {
    const std::optional<SensorCalibration>& sensor = calibration.sensors.at(i);
    if (sensor && std::isfinite(angles.angles.at(i))) {
      const double counts = std::round(sensor->zero + angles.angles.at(i) / sensor->gain);
      result.counts.at(i) =
          static_cast<std::uint16_t>(std::clamp(counts, kLeastCounts, kMostCounts));
    }
  }
  return result;
}

Recording to_angles(const Recording& recording, const GloveCalibration& calibration) {
  if (recording.header.kind == RecordingKind::kAngles) {
    return recording;
  }
  Recording result = recording;
  result.header.kind = RecordingKind::kAngles;
  result.header.sensors.clear();
  std::vector<Eigen::Index> columns;
  for (std::size_t column = 0; column < recording.header.sensors.size(); ++column) {
    const auto sensor = static_cast<std::size_t>(recording.header.sensors[column]);
    if (!calibration.sensors.at(sensor)) {
      result.warnings.push_back("sensor " + std::string(cyberglove_sensors()[sensor].name) +
                                " is left out: it is not calibrated");
      continue;
    }
    result.header.sensors.push_back(static_cast<int>(sensor));
    columns.push_back(static_cast<Eigen::Index>(column));
  }
  result.values.resize(recording.values.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto sensor = static_cast<std::size_t>(result.header.sensors[i]);
    const SensorCalibration& line = calibration.sensors.at(sensor).value();
    result.values.col(static_cast<Eigen::Index>(i)) =
        line.gain * (recording.values.col(columns[i]).array() - line.zero);
  }
  return result;
}

}  // namespace handway::device
