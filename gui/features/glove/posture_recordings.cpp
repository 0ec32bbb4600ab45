#include "features/glove/posture_recordings.h"

#include "handway/device/glove/recording.h"
#include "handway/device/glove/recording_quality.h"
#include "handway/device/hand/joint_recording.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace handway::gui {
namespace {

constexpr std::size_t kMostMeasured = 4000;

// Returns the postures of some joints, in their order. Joints that the hand lacks are in the
// middle.
Eigen::MatrixXd postures_of(const device::PostureSource& joints,
                            const device::MappedPostures& mapped) {
  Eigen::MatrixXd postures(mapped.postures.rows(), joints.lower().size());
  for (Eigen::Index j = 0; j < postures.cols(); ++j) {
    const auto found =
        std::ranges::find(mapped.joints, joints.joints()[static_cast<std::size_t>(j)]);
    if (found == mapped.joints.end()) {
      postures.col(j).setConstant(0.5 * (joints.lower()[j] + joints.upper()[j]));
    } else {
      postures.col(j) = mapped.postures.col(found - mapped.joints.begin());
    }
  }
  return postures;
}

}  // namespace

Eigen::VectorXd normalised(const device::PostureSource& source, const Eigen::VectorXd& posture) {
  const Eigen::VectorXd range = source.upper() - source.lower();
  return (range.array() > 0.0)
      .select((posture - source.lower()).cwiseQuotient(range), 0.5)
      .cwiseMax(0.0)
      .cwiseMin(1.0);
}

PostureRecordings read_postures(const std::vector<std::filesystem::path>& files,
                                const device::GloveCalibration& calibration,
                                const device::PostureSource& source,
                                const std::vector<int>& left_out, const geometric::RobotModel& hand,
                                const std::stop_token& stop) {
  PostureRecordings result{CapturedPostures(source.joints(), left_out), {}};
  std::vector<device::GloveAngles> measured;
  double begin = 0.0;
  for (const std::filesystem::path& file : files) {
    const bool has_joints = device::is_joint_recording(file, hand);
    const device::Recording angles =
        has_joints ? device::read_joint_recording(file, hand)
                   : device::to_angles(device::read_recording(file), calibration);
    if (has_joints) {
      result.warnings.push_back(file.string() + ": taken for the robot hand's own joints");
    }
    result.warnings.insert(result.warnings.end(), angles.warnings.begin(), angles.warnings.end());
    const Eigen::MatrixXd postures =
        has_joints ? postures_of(source, device::OwnJoints(hand).map_recording(angles))
                   : source.map_recording(angles, stop).postures;
    Eigen::MatrixXd samples(postures.rows(), postures.cols());
    for (Eigen::Index row = 0; row < samples.rows(); ++row) {
      samples.row(row) = normalised(source, postures.row(row).transpose()).transpose();
      result.postures.add(begin + angles.times[row] - angles.times[0],
                          samples.row(row).transpose());
      if (!has_joints) {
        measured.push_back(device::angles_of_row(angles, row));
      }
    }
    begin = result.postures.duration();
    const double rate = device::assess(angles).rate;
    // Postures without times don't depend on each other.
    const double no_rate = 1.0 / sampling::BasisStudySettings().block;
    result.each.push_back(
        {file.filename().string(), std::move(samples), rate > 0.0 ? rate : no_rate});
  }
  const std::size_t stride = measured.size() / kMostMeasured + 1;
  for (std::size_t row = 0; row < measured.size(); row += stride) {
    result.measured.push_back(measured[row]);
  }
  return result;
}

}  // namespace handway::gui
