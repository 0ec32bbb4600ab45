#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/posture_source.h"
#include "handway/device/retargeting/robot_fingers.h"
#include "handway/geometric/collision/collision_checker.h"

#include <Eigen/Core>

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

/// Retargeting of a human hand to a robot hand by fingertips, as YAML; all but `hand` may be left
/// out:
///
///     hand: allegro_hand_right.urdf
///     retargeting:
///       scale: 1
///       pinch: 4
///       smoothness: 0.02
///       self_collision: true
///       fingertips: {thumb: link_15.0_tip, index: link_3.0_tip}

namespace handway::device {

/// Settings of retargeting by fingertips, as in a settings file.
struct RetargetingSettings {
  std::string hand;    ///< Robot: a name in the library, or a file relative to the settings'.
  double scale = 1.0;  ///< Multiplies the ratio of robot's and person's finger length; > 0.
  /// Weight of the gap between thumb and finger where they come together, against a fingertip's
  /// place; ≥ 0.
  double pinch = 4.0;
  /// Weight of a joint's move since the last posture, as a share of its range, against a
  /// fingertip's distance as a share of the finger's length; ≥ 0.
  double smoothness = 0.02;
  bool self_collision = true;                ///< Avoid it.
  std::map<Finger, std::string> fingertips;  ///< Links; empty: found by find_fingers().
  HandBones bones = typical_bones();         ///< The person's; in no file of retargeting.
};

/// Returns whether a YAML file is a retargeting rather than a mapping: it has the key.
[[nodiscard]] HANDWAY_DEVICE_EXPORT bool is_retargeting(const std::filesystem::path& file);
/// @throws geometric::InputError with file, line and key.
[[nodiscard]] HANDWAY_DEVICE_EXPORT RetargetingSettings
read_retargeting(const std::filesystem::path& file);

/// Postures of a robot's hand whose fingertips follow a person's.
///
/// The target of each fingertip is the person's fingertip relative to the finger's base, scaled by
/// the ratio of both fingers' lengths. The target of the thumb is relative to the base of the
/// finger beside it, with the mean scale of the others, for robots' thumbs begin in other places
/// than a person's. Where thumb and finger come together, the gap between them counts too. The
/// joints minimise the weighted squares of the errors and of the move since the last posture,
/// within their limits (sequential quadratic programming, NLopt's SLSQP). If that posture is in
/// self-collision, fingers go towards it one by one, each as far as it can. For any thread.
///
/// Source: in the manner of A. Handa et al., "DexPilot: vision-based teleoperation of dexterous
/// robotic hand-arm system", ICRA 2020, and Y. Qin et al., "AnyTeleop", RSS 2023.
class HANDWAY_DEVICE_EXPORT FingertipRetargeter : public PostureSource {
 public:
  /// @param hand the robot; joints that move no finger stay in the middle.
  /// @throws geometric::InputError as find_fingers().
  explicit FingertipRetargeter(std::shared_ptr<const geometric::RobotModel> hand,
                               const RetargetingSettings& settings = {});
  ~FingertipRetargeter() override;

  [[nodiscard]] const RobotFingers& fingers() const { return fingers_; }
  /// Landmarks of the person's hand, whose bones the settings have.
  [[nodiscard]] HandLandmarks landmarks(const GloveAngles& angles) const {
    return hand_landmarks(angles, settings_.bones);
  }

  /// Target fingertips for landmarks of a right hand in its palm's frame (see in_palm_frame()); in
  /// the frame of the robot's palm, m, a column for each of fingers().
  [[nodiscard]] Eigen::Matrix3Xd wanted(const HandLandmarks& landmarks) const;
  /// Actual fingertips at `posture`, in the format of wanted().
  [[nodiscard]] Eigen::Matrix3Xd fingertips(const Eigen::VectorXd& posture) const;

  /// @param last the previous posture, shape [joints]; middle() at first.
  [[nodiscard]] Eigen::VectorXd posture(const HandLandmarks& landmarks,
                                        const Eigen::VectorXd& last) const;
  [[nodiscard]] Eigen::VectorXd middle() const;

  [[nodiscard]] std::vector<bool> driven() const override;
  using PostureSource::map_recording;
  /// Solves one posture after the other.
  /// @throws geometric::InputError if the recording holds counts.
  [[nodiscard]] MappedPostures map_recording(const Recording& recording,
                                             const std::stop_token& stop) const override;

 private:
  struct Problem;

  /// The finger relative to whose base a fingertip is measured.
  [[nodiscard]] const RobotFinger& seen_from(const RobotFinger& finger) const;
  /// A vector of a person's palm in the frame of the robot's.
  [[nodiscard]] Eigen::Vector3d turned(const Eigen::Vector3d& v_H) const;
  [[nodiscard]] Eigen::VectorXd out_of_collision(const Eigen::VectorXd& posture,
                                                 const Eigen::VectorXd& last) const;
  /// Returns the advanced posture; nothing if `from` is in self-collision.
  [[nodiscard]] std::optional<Eigen::VectorXd> advanced(const Eigen::VectorXd& from,
                                                        const Eigen::VectorXd& to) const;

  std::shared_ptr<const geometric::RobotModel> hand_;
  RetargetingSettings settings_;
  RobotFingers fingers_;
  std::vector<double> scales_;         ///< From a person's finger to the robot's, as fingers_.
  geometric::JointIndices variables_;  ///< Variables of the fingers; the others stay.
  std::unique_ptr<geometric::CollisionChecker> checker_;  ///< Null: self-collision is allowed.
  mutable std::mutex checking_;                           ///< Guards checker_ (one thread).
};

}  // namespace handway::device
