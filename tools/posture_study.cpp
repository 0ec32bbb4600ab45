#include "posture_study.h"

#include "basis_figures.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/hand_mapper.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/resources.h"

#include <fmt/format.h>

#include <vector>

namespace handway::tools {
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

}  // namespace handway::tools
