#include "posture_study.h"

#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/device/glove/recording_filters.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/sampling/postures/principal_components.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace handway::tools {
MappedRecording map_file(const std::filesystem::path& file,
                         const device::GloveCalibration& calibration, const RecordingSteps& steps,
                         const device::PostureSource& mapper) {
  MappedRecording result;
  result.file = file;
  device::Recording recording = device::read_recording(file);
  result.quality = device::assess(recording);
  result.calibrated = recording.header.kind == device::RecordingKind::kCounts;
  recording = device::to_angles(recording, calibration);
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
  result.mapped = mapper.map_recording(recording);
  result.recording = std::move(recording);
  return result;
}

namespace {

constexpr double kStill = 1e-9;  // rad

}  // namespace

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

namespace {

namespace fs = std::filesystem;

constexpr int kComponents = 4;   // as in the paper, section 4.2
constexpr double kSigmas = 1.5;  // half side of the box in standard deviations
constexpr const char* kThumbBase = "thumb_base";

}  // namespace

double PostureStudy::correlation(const std::string& first, const std::string& second) const {
  const std::vector<int> pair = joint_indices({first, second}, basis.joints);
  const Eigen::VectorXd x = postures.col(pair[0]).array() - postures.col(pair[0]).mean();
  const Eigen::VectorXd y = postures.col(pair[1]).array() - postures.col(pair[1]).mean();
  const double scale = x.norm() * y.norm();
  return scale > 0.0 ? x.dot(y) / scale : 0.0;
}

PostureStudy study_postures(const fs::path& recording, Normalisation normalisation) {
  const fs::path file = geometric::resource_dir() / "mappings" / "table1_sah.yaml";
  const device::HandMapping mapping = device::read_mapping(file);
  const auto hand = geometric::load_robot(geometric::find_resource(
      geometric::ResourceKind::kRobot, mapping.hand, file.parent_path(), file.string()));
  const device::HandMapper mapper(mapping, *hand, true);
  const std::vector<int> free = joint_indices({kThumbBase}, mapper.joints());
  const std::vector<MappedRecording> mapped = {
      map_file(recording, device::typical_calibration(), {}, mapper)};
  PostureStudy study;
  study.recording = recording;
  study.normalisation = normalisation;
  for (const Normalisation scaling : {Normalisation::kLimits, Normalisation::kRange}) {
    const Eigen::MatrixXd samples = normalised_samples(mapped, mapper, scaling);
    const Analysis analysis = analyse(samples, free, false);
    const bool limits = scaling == Normalisation::kLimits;
    (limits ? study.limits_shares : study.range_shares) = analysis.components.shares;
    if (scaling == normalisation) {
      study.shares = analysis.components.shares;
      study.postures = joint_values(samples, mapper);
      study.basis = sampling::make_pmd_basis(
          mapping.hand,
          fmt::format("{}: {} samples, joints normalised by {}", recording.filename().string(),
                      analysis.samples, limits ? "their limits" : "the range they went through"),
          mapper.joints(), analysis.components, {free, kComponents, kSigmas});
    }
  }
  return study;
}

}  // namespace handway::tools
