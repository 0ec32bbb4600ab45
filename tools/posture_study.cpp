#include "posture_study.h"

#include "basis_figures.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/device/glove/recording_filters.h"
#include "handway/device/retargeting/fingertip_errors.h"
#include "handway/device/retargeting/fingertip_retargeter.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/units.h"
#include "handway/sampling/postures/principal_components.h"
#include "version.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace handway::tools {

namespace {

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

constexpr double kStill = 1e-9;  // rad

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

namespace {

namespace fs = std::filesystem;

constexpr int kComponents = 4;   // as in the paper, section 4.2
constexpr double kSigmas = 1.5;  // half side of the box in standard deviations
constexpr const char* kThumbBase = "thumb_base";

}  // namespace

double PostureStudy::correlation(const std::string& first, const std::string& second) const {
  const std::vector<int> pair = joint_indices({first, second}, basis.joints);
  return tools::correlation(postures.col(pair[0]), postures.col(pair[1]));
}

PostureStudy study_postures(const fs::path& recording, Normalisation normalisation) {
  const fs::path file = geometric::resource_dir() / "mappings" / "table1_sah.yaml";
  const device::HandMapping mapping = device::read_mapping(file);
  const auto hand = geometric::load_robot(geometric::find_resource(
      geometric::ResourceKind::kRobot, mapping.hand, file.parent_path(), file.string()));
  const device::HandMapper mapper(mapping, *hand, true);
  const std::vector<int> free = joint_indices({kThumbBase}, mapper.joints());
  const std::vector<MappedRecording> mapped = {mapped_recording(
      recording, device::read_recording(recording), device::typical_calibration(), {}, mapper)};
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
      study.samples = samples;
      study.basis = sampling::make_pmd_basis(
          mapping.hand,
          fmt::format("{}: {} samples, joints normalised by {}", recording.filename().string(),
                      analysis.samples, limits ? "their limits" : "their recorded range"),
          mapper.joints(), analysis.components, {free, kComponents, kSigmas});
    }
  }
  return study;
}

namespace {

using Json = nlohmann::ordered_json;
using geometric::kDegree;
using geometric::kMillimetre;
using sampling::BasisStudy;

Json interval_json(const sampling::Interval& interval, double unit) {
  return {
      {"mean", interval.mean / unit}, {"low", interval.low / unit}, {"high", interval.high / unit}};
}

}  // namespace

BasisStudy study_recordings(const std::vector<MappedRecording>& recordings,
                            const std::shared_ptr<const geometric::RobotModel>& hand,
                            const device::PostureSource& mapper, Normalisation normalisation,
                            const sampling::BasisStudySettings& settings) {
  device::RetargetingSettings only_kinematics;
  only_kinematics.self_collision = false;
  const auto fingertips = device::normalised_fingertips(
      std::make_shared<const device::FingertipRetargeter>(hand, only_kinematics), mapper);
  // Scaled together: a range is that of all recordings.
  const Eigen::MatrixXd samples = normalised_samples(recordings, mapper, normalisation);
  std::vector<sampling::RecordedHand> hands;
  Eigen::Index first = 0;
  for (const MappedRecording& recording : recordings) {
    const Eigen::Index rows = recording.mapped.postures.rows();
    const double rate = device::assess(recording.recording).rate;
    // Postures without times don't depend on each other.
    hands.push_back({recording.file.filename().string(), samples.middleRows(first, rows),
                     rate > 0.0 ? rate : 1.0 / settings.block});
    first += rows;
  }
  return sampling::study_basis(hands, fingertips, settings);
}

void write_study(const BasisStudy& study, const sampling::BasisStudySettings& settings,
                 const std::vector<MappedRecording>& recordings, const std::string& hand,
                 const device::PostureSource& mapper, const std::filesystem::path& file) {
  Json document{{"hand", hand}, {"joints", mapper.joints()}};
  for (const MappedRecording& recording : recordings) {
    document["recordings"].push_back(
        {{"file", recording.file.filename().string()}, {"rows", recording.mapped.postures.rows()}});
  }
  Json free = Json::array();
  for (const int joint : settings.free_joints) {
    free.push_back(mapper.joints()[static_cast<std::size_t>(joint)]);
  }
  document["parameters"] = {{"free_joints", free},       {"components", settings.directions},
                            {"folds", settings.folds},   {"resamples", settings.resamples},
                            {"block_s", settings.block}, {"confidence", settings.confidence},
                            {"seed", settings.seed}};
  for (const sampling::ReconstructionError& error : study.reconstruction) {
    document["reconstruction"].push_back(
        {{"pmds", error.directions},
         {"fingertip_mm", interval_json(error.fingertip, kMillimetre)},
         {"p95_mm", error.most / kMillimetre},
         {"variance", error.variance}});
  }
  document["enough"] = Json::array();
  for (const double error : sampling::kReportedErrors) {
    const int enough = study.enough_for(error);
    document["enough"].push_back(
        {{"mm", error / kMillimetre}, {"pmds", enough < 0 ? Json(nullptr) : Json(enough)}});
  }
  document["stability"] = Json::array();
  for (const sampling::BasisStability& stability : study.stability) {
    Json angles = Json::array();
    for (const sampling::Interval& angle : stability.angles) {
      angles.push_back(interval_json(angle, kDegree));
    }
    document["stability"].push_back(
        {{"seconds", stability.seconds}, {"largest_angle_deg", angles}});
  }
  document["persons"] = Json::array();
  for (const sampling::PersonFit& person : study.persons) {
    std::vector<double> degrees;
    for (const double angle : person.angles) {
      degrees.push_back(angle / kDegree);
    }
    document["persons"].push_back({{"recording", person.name},
                                   {"own_mm", interval_json(person.own, kMillimetre)},
                                   {"others_mm", interval_json(person.others, kMillimetre)},
                                   {"largest_angle_deg", degrees}});
  }
  if (!study.persons.empty()) {
    document["newcomer_mm"] = interval_json(study.newcomer, kMillimetre);
  }
  document["version"] = kVersion;
  geometric::replace_file(file, document.dump(2) + '\n');
}

}  // namespace handway::tools
