#include "handway/device/glove/calibration_fit.h"

#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/recording_quality.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

namespace handway::device {
namespace {

using geometric::InputError;

constexpr double kLeastSpan = 10.0;      // counts
constexpr double kBadResidual = 0.1;     // rad
constexpr double kDifferentAngle = 0.1;  // rad

std::string_view name_of(int sensor) {
  return cyberglove_sensors()[static_cast<std::size_t>(sensor)].name;
}

void need_counts(const Recording& recording) {
  if (recording.header.kind != RecordingKind::kCounts) {
    throw InputError({"calibration", "", "a recording of angles", "one of raw counts", ""});
  }
}

void warn_of_sensors(const Recording& recording, const std::string& what, bool of_dead,
                     std::vector<std::string>& warnings) {
  for (const SensorQuality& quality : assess(recording).sensors) {
    if (quality.noisy) {
      warnings.push_back(fmt::format("{}: sensor {} is noisy ({:.2g} counts)", what,
                                     name_of(quality.sensor), quality.noise));
    }
    if (quality.saturated) {
      warnings.push_back(
          fmt::format("{}: sensor {} is at an end of its range", what, name_of(quality.sensor)));
    }
    if (of_dead && quality.dead) {
      warnings.push_back(
          fmt::format("{}: sensor {} is dead or was not moved", what, name_of(quality.sensor)));
    }
  }
}

struct Points {
  std::vector<double> counts;
  std::vector<double> angles;
};

Points points_of(const std::vector<GuidedPose>& poses, int sensor) {
  Points points;
  for (const GuidedPose& pose : poses) {
    const int column = column_of(pose.counts.header, sensor);
    const double angle = pose.angles.at(static_cast<std::size_t>(sensor));
    if (column >= 0 && std::isfinite(angle)) {
      points.counts.push_back(pose.counts.values.col(column).mean());
      points.angles.push_back(angle);
    }
  }
  return points;
}

SensorCalibration fitted(const Points& points) {
  const auto count = static_cast<Eigen::Index>(points.counts.size());
  const Eigen::Map<const Eigen::ArrayXd> x(points.counts.data(), count);
  const Eigen::Map<const Eigen::ArrayXd> y(points.angles.data(), count);
  const Eigen::ArrayXd across = x - x.mean();
  SensorCalibration line;
  line.gain = (across * (y - y.mean())).sum() / across.square().sum();
  line.zero = x.mean() - y.mean() / line.gain;
  line.residual = std::sqrt((line.gain * (x - line.zero) - y).square().mean());
  return line;
}

double span(const std::vector<double>& values) {
  const auto [least, most] = std::ranges::minmax(values);
  return most - least;
}

}  // namespace

CalibrationFit calibrate_from_poses(const std::vector<GuidedPose>& poses, const std::string& person,
                                    const std::string& date) {
  if (poses.empty()) {
    throw InputError({"calibration", "", "no poses", "two or more", ""});
  }
  CalibrationFit fit;
  fit.calibration.person = person;
  fit.calibration.date = date;
  fit.calibration.source = fmt::format("least squares over {} poses", poses.size());
  for (const GuidedPose& pose : poses) {
    need_counts(pose.counts);
    warn_of_sensors(pose.counts, pose.name, false, fit.warnings);
  }
  for (int sensor = 0; sensor < kGloveSensors; ++sensor) {
    const Points points = points_of(poses, sensor);
    if (points.counts.size() < 2 || span(points.angles) < kDifferentAngle) {
      continue;
    }
    if (span(points.counts) < kLeastSpan) {
      fit.warnings.push_back(fmt::format("sensor {} is dead: its poses differ by {:.1f} counts",
                                         name_of(sensor), span(points.counts)));
      continue;
    }
    const SensorCalibration line = fitted(points);
    if (line.gain == 0.0) {
      fit.warnings.push_back(fmt::format("sensor {} does not follow its poses", name_of(sensor)));
      continue;
    }
    if (line.residual.value_or(0.0) > kBadResidual) {
      fit.warnings.push_back(fmt::format("sensor {} is off by {:.2f} rad: repeat its poses",
                                         name_of(sensor), *line.residual));
    }
    fit.calibration.sensors.at(static_cast<std::size_t>(sensor)) = line;
  }
  return fit;
}

CalibrationFit calibrate_from_range(const Recording& counts, const AngleRanges& ranges,
                                    const GloveCalibration& signs, const std::string& person,
                                    const std::string& date) {
  need_counts(counts);
  CalibrationFit fit;
  fit.calibration.person = person;
  fit.calibration.date = date;
  fit.calibration.source = "1st and 99th percentiles of a free motion laid on typical ranges";
  warn_of_sensors(counts, "free motion", true, fit.warnings);
  for (const SensorQuality& quality : assess(counts).sensors) {
    const auto sensor = static_cast<std::size_t>(quality.sensor);
    const std::optional<SensorCalibration>& before = signs.sensors.at(sensor);
    const double moved = quality.last_percentile - quality.first_percentile;
    if (moved < kLeastSpan) {
      fit.warnings.push_back(
          fmt::format("sensor {} went through {:.0f} counts only: its calibration stays",
                      name_of(quality.sensor), moved));
      fit.calibration.sensors.at(sensor) = before;
      continue;
    }
    const auto [least, most] = ranges.at(sensor);
    const bool falling = before && before->gain < 0.0;
    SensorCalibration line;
    line.gain = (falling ? -1.0 : 1.0) * (most - least) / moved;
    line.zero = quality.first_percentile - (falling ? most : least) / line.gain;
    fit.calibration.sensors.at(sensor) = line;
  }
  return fit;
}

}  // namespace handway::device
