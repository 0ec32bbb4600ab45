#include "basis_quality.h"

#include "handway/device/glove/recording_quality.h"
#include "handway/device/retargeting/fingertip_errors.h"
#include "handway/device/retargeting/fingertip_retargeter.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/math/units.h"
#include "version.h"

#include <nlohmann/json.hpp>

namespace handway::tools {
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
