#include "handway/device/retargeting/mapping_fit.h"

#include "handway/device/glove/angle_ranges.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/hand_mapper.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/retargeting/fingertip_errors.h"
#include "handway/device/retargeting/fingertip_retargeter.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/composed_robot.h"

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string_view>
#include <utility>

namespace handway::device {
namespace {

using geometric::RobotModel;

constexpr double kLeastSpan = 5.0 * geometric::kDegree;
constexpr double kReversed = -0.5;          // correlation with the other fingers' flexion
constexpr std::size_t kMostLookedAt = 400;  // rows while mappings are tried
constexpr std::array<double, 4> kFitShares{0.25, 0.5, 0.75, 1.0};  // shares of the fit to try
constexpr std::size_t kLeastFlexions = 3;  // to know which of them is reversed

enum class SensorKind { kFlexion, kAbduction, kSpanning };

SensorKind kind_of(int sensor) {
  const std::string_view name = cyberglove_sensors()[static_cast<std::size_t>(sensor)].name;
  if (name.ends_with("MPJ") || name.ends_with("IJ")) {
    return SensorKind::kFlexion;
  }
  return name.ends_with("Abduct") && name != "ThumbAbduct" ? SensorKind::kAbduction
                                                           : SensorKind::kSpanning;
}

/// The 2nd, 50th and 98th percentile of a sensor's angles, rad.
struct Span {
  double least;
  double middle;
  double most;
};

Span span_of(const Eigen::VectorXd& values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  const auto at = [&](double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  };
  return {at(0.02), at(0.5), at(0.98)};
}

Eigen::VectorXd standardised(const Eigen::VectorXd& values) {
  const Eigen::VectorXd centred = values.array() - values.mean();
  const double length = centred.norm();
  return length > 0.0 ? Eigen::VectorXd(centred / length) : centred;
}

bool is_finger_flexion(int sensor) {
  return kind_of(sensor) == SensorKind::kFlexion &&
         !cyberglove_sensors()[static_cast<std::size_t>(sensor)].name.starts_with("Thumb");
}

/// Returns whether a finger's sensor falls while the others' rise.
bool is_reversed(const Recording& recording, int sensor) {
  Eigen::VectorXd others = Eigen::VectorXd::Zero(recording.values.rows());
  std::size_t count = 0;
  for (std::size_t c = 0; c < recording.header.sensors.size(); ++c) {
    if (recording.header.sensors[c] != sensor && is_finger_flexion(recording.header.sensors[c])) {
      others += standardised(recording.values.col(static_cast<Eigen::Index>(c)));
      ++count;
    }
  }
  const auto own = static_cast<Eigen::Index>(column_of(recording.header, sensor));
  return is_finger_flexion(sensor) && count >= kLeastFlexions &&
         standardised(others).dot(standardised(recording.values.col(own))) < kReversed;
}

void lay(double from_angle, double to_angle, double from, double to, JointMapping& mapped) {
  mapped.gain = (to - from) / (to_angle - from_angle);
  mapped.offset = from - mapped.gain * from_angle;
}

void fit_joint_mapping(const Span& span, bool reversed, double lower, double upper,
                       JointMapping& mapped) {
  const bool rises = mapped.gain >= 0.0;
  const double zero = std::clamp(mapped.offset, lower, upper);
  switch (kind_of(mapped.sensor)) {
    case SensorKind::kFlexion:
      lay(reversed ? span.most : span.least, reversed ? span.least : span.most, zero,
          rises ? upper : lower, mapped);
      break;
    case SensorKind::kAbduction: {
      const double above = (rises ? upper - zero : zero - lower) / (span.most - span.middle);
      const double below = (rises ? zero - lower : upper - zero) / (span.middle - span.least);
      mapped.gain = (rises ? 1.0 : -1.0) * std::min(above, below);
      mapped.offset = zero - mapped.gain * span.middle;
      break;
    }
    case SensorKind::kSpanning:
      lay(span.least, span.most, rises ? lower : upper, rises ? upper : lower, mapped);
      break;
  }
}

/// Distance of a mapped hand's fingertips from the human hand's, over a recording.
class FingertipMeasure {
 public:
  /// @param recording the input of the mapping. @param truth the person's motion: with reversed
  /// sensors corrected.
  FingertipMeasure(const RobotModel& model, const Recording& recording, const Recording& truth,
                   const GloveCalibration& person)
      : model_(model),
        ranges_(person.ranges),
        hand_(std::shared_ptr<const RobotModel>(&model, [](const RobotModel*) {}),
              only_kinematics(person)) {
    for (Eigen::Index row = 0; row < recording.values.rows(); ++row) {
      rows_.push_back(angles_of_row(recording, row));
      truth_.push_back(angles_of_row(truth, row));
    }
  }

  /// Mean error, m. @param most rows that are used, evenly spread; 0: all.
  [[nodiscard]] double mean_error(const HandMapping& mapping, std::size_t most = 0) const {
    const HandMapper mapper(mapping, model_, false, ranges_);
    const std::size_t stride = most == 0 ? 1 : rows_.size() / most + 1;
    std::vector<GloveAngles> looked_at;
    Eigen::MatrixXd postures(static_cast<Eigen::Index>((rows_.size() + stride - 1) / stride),
                             mapper.lower().size());
    for (std::size_t row = 0; row < rows_.size(); row += stride) {
      postures.row(static_cast<Eigen::Index>(looked_at.size())) =
          mapper.posture(rows_[row]).transpose();
      looked_at.push_back(truth_[row]);
    }
    return fingertip_errors(looked_at, mapper.joints(), postures, hand_).mean;
  }

 private:
  static RetargetingSettings only_kinematics(const GloveCalibration& person) {
    RetargetingSettings settings;
    settings.self_collision = false;
    settings.bones = person.bones.value_or(typical_bones());
    return settings;
  }

  const RobotModel& model_;
  PersonRanges ranges_;
  FingertipRetargeter hand_;
  std::vector<GloveAngles> rows_;
  std::vector<GloveAngles> truth_;
};

/// Interpolates from one mapping towards another.
JointMapping between(const JointMapping& from, const JointMapping& to, double share) {
  JointMapping mapped = from;
  mapped.gain = std::lerp(from.gain, to.gain, share);
  mapped.offset = std::lerp(from.offset, to.offset, share);
  return mapped;
}

}  // namespace

MappingFit fit_mapping(const HandMapping& mapping, const RobotModel& model,
                       const Recording& recording, const GloveCalibration& person) {
  if (recording.header.kind != RecordingKind::kAngles) {
    throw geometric::InputError(
        {"recording", "", "raw counts", "angles", "Give a calibration of the glove"});
  }
  const HandMapper checked(mapping, model);
  MappingFit fit{mapping, {}};
  Recording truth = recording;
  std::vector<std::pair<std::size_t, JointMapping>> proposed;
  for (std::size_t w = 0; w < mapping.joints.size(); ++w) {
    JointMapping mapped = mapping.joints[w];
    if (mapped.sensor < 0 || mapped.left_to_arm || !mapped.curve.empty()) {
      continue;
    }
    const auto name = cyberglove_sensors()[static_cast<std::size_t>(mapped.sensor)].name;
    const int column = column_of(recording.header, mapped.sensor);
    if (column < 0 || recording.values.rows() == 0) {
      fit.warnings.push_back(
          fmt::format("{} was not recorded: {} stays as it was", name, mapped.joint));
      continue;
    }
    const Span span = span_of(recording.values.col(column).unaryExpr(
        [&](double angle) { return typical_angle(person.ranges, mapped.sensor, angle); }));
    if (span.most - span.least < kLeastSpan || span.most <= span.middle ||
        span.middle <= span.least) {
      fit.warnings.push_back(
          fmt::format("{} hardly moved: {} stays as it was", name, mapped.joint));
      continue;
    }
    const bool reversed = is_reversed(recording, mapped.sensor);
    if (reversed) {
      fit.warnings.push_back(fmt::format("{} is reversed: turned for {}", name, mapped.joint));
      truth.values.col(column) = -recording.values.col(column);
      fit.mapping.joints[w].gain *= -1.0;
    }
    const int variable = geometric::find_variable_of_part(model, mapped.joint).value();
    fit_joint_mapping(span, reversed, model.lower()[variable], model.upper()[variable], mapped);
    proposed.emplace_back(w, mapped);
  }
  if (proposed.empty()) {
    return fit;
  }
  const FingertipMeasure measure(model, recording, truth, person);
  const HandMapping unfitted = fit.mapping;
  double error = measure.mean_error(fit.mapping, kMostLookedAt);
  for (const auto& [w, mapped] : proposed) {
    const JointMapping before = fit.mapping.joints[w];
    JointMapping best = before;
    for (const double share : kFitShares) {
      fit.mapping.joints[w] = between(before, mapped, share);
      if (const double tried = measure.mean_error(fit.mapping, kMostLookedAt); tried < error) {
        error = tried;
        best = fit.mapping.joints[w];
      }
    }
    fit.mapping.joints[w] = best;
  }
  if (measure.mean_error(fit.mapping) > measure.mean_error(unfitted)) {
    fit.mapping = unfitted;  // what was looked at was not like the rest
  }
  return fit;
}

}  // namespace handway::device
