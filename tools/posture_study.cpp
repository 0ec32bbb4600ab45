#include "posture_study.h"

#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/hand_mapper.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/io/robot_loader.h"
#include "mapped_recording.h"

#include <fmt/format.h>

#include <utility>

namespace handway::tools {
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
  const device::HandMapping mapping =
      device::read_mapping(geometric::resource_dir() / "mappings" / "table1_sah.yaml");
  const auto hand = geometric::load_robot(geometric::find_resource(
      geometric::ResourceKind::kRobot, mapping.hand, fs::current_path(), ""));
  const device::HandMapper mapper(mapping, *hand);
  const std::vector<int> free = joint_indices({kThumbBase}, mapper.joints());
  const std::vector<MappedRecording> mapped = {
      map_file(recording, device::typical_calibration(), {}, mapper)};
  PostureStudy study;
  study.recording = recording;
  study.normalisation = normalisation;
  for (const Normalisation way : {Normalisation::kLimits, Normalisation::kRange}) {
    const Eigen::MatrixXd samples = normalised_samples(mapped, mapper, way);
    const Analysis analysis = analyse(samples, free, false);
    const bool limits = way == Normalisation::kLimits;
    (limits ? study.limits_shares : study.range_shares) = analysis.components.shares;
    if (way == normalisation) {
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
