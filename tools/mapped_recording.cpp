#include "mapped_recording.h"

#include "handway/device/glove/recording_filters.h"
#include "handway/geometric/io/input_error.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace handway::tools {
namespace {

constexpr double kStill = 1e-9;  // rad

device::Recording filtered(device::Recording recording, const RecordingSteps& steps) {
  if (steps.from > 0.0 || steps.to) {
    const double begin = recording.times[0];
    const double end = steps.to.value_or(std::numeric_limits<double>::infinity());
    recording = device::trimmed(recording, begin + steps.from, begin + end);
  }
  if (steps.drop_duplicates) {
    recording = device::without_duplicates(recording);
  }
  if (steps.resample > 0.0) {
    recording = device::resampled(recording, steps.resample);
  }
  if (steps.low_pass > 0.0) {
    recording = device::low_passed(recording, steps.low_pass);
  }
  return recording;
}

}  // namespace

MappedRecording mapped_recording(const std::filesystem::path& file, const device::Recording& read,
                                 const device::GloveCalibration& calibration,
                                 const RecordingSteps& steps, const device::PostureSource& mapper) {
  MappedRecording result;
  result.file = file;
  result.quality = device::assess(read);
  result.calibrated = read.header.kind == device::RecordingKind::kCounts;
  result.recording = filtered(device::to_angles(read, calibration), steps);
  result.mapped = mapper.map_recording(result.recording);
  return result;
}

Eigen::MatrixXd normalised_samples(const std::vector<MappedRecording>& recordings,
                                   const device::PostureSource& mapper,
                                   Normalisation normalisation) {
  Eigen::Index rows = 0;
  for (const MappedRecording& recording : recordings) {
    rows += recording.mapped.postures.rows();
  }
  Eigen::MatrixXd samples(rows, mapper.lower().size());
  Eigen::Index next = 0;
  for (const MappedRecording& recording : recordings) {
    const device::MappedPostures& mapped = recording.mapped;
    samples.middleRows(next, mapped.postures.rows()) =
        normalisation == Normalisation::kLimits ? mapped.postures : mapped.unclamped;
    next += mapped.postures.rows();
  }
  Eigen::VectorXd least = mapper.lower();
  Eigen::VectorXd most = mapper.upper();
  if (normalisation == Normalisation::kRange) {
    least = samples.colwise().minCoeff();
    most = samples.colwise().maxCoeff();
  }
  for (Eigen::Index j = 0; j < samples.cols(); ++j) {
    if (most[j] - least[j] > kStill) {
      samples.col(j) = (samples.col(j).array() - least[j]) / (most[j] - least[j]);
    } else {
      samples.col(j).setConstant(0.5);
    }
  }
  return samples;
}

Eigen::MatrixXd joint_values(const Eigen::MatrixXd& samples, const device::PostureSource& mapper) {
  const Eigen::RowVectorXd range = (mapper.upper() - mapper.lower()).transpose();
  return (samples.array().rowwise() * range.array()).rowwise() + mapper.lower().transpose().array();
}

Analysis analyse(const Eigen::MatrixXd& samples, const std::vector<int>& left_out, bool robust) {
  Analysis result;
  result.samples = samples.rows();
  if (!robust) {
    result.components = sampling::principal_components(samples, left_out);
    return result;
  }
  sampling::RobustComponents found = sampling::robust_principal_components(samples, left_out);
  result.components = std::move(found.components);
  result.outliers = found.outliers;
  return result;
}

std::vector<int> joint_indices(const std::vector<std::string>& names,
                               const std::vector<std::string>& joints) {
  std::vector<int> indices;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(joints, name);
    if (found == joints.end()) {
      throw geometric::InputError({"--free " + name, "", "no joint of that name",
                                   "a joint of the hand", geometric::advise_name(name, joints)});
    }
    const auto index = static_cast<int>(found - joints.begin());
    if (std::ranges::count(indices, index) == 0) {
      indices.push_back(index);
    }
  }
  return indices;
}

}  // namespace handway::tools
