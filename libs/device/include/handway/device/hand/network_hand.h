#pragma once

#include "handway/device/core/joint_trajectory.h"
#include "handway/device/core/trajectory_client.h"
#include "handway/device/export.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace handway::device {

/// Ranges and velocities of the 13 independent joints of the Schunk Anthropomorphic Hand (SAH), in
/// the order of its drives: thumb base; then abduction, proximal and medial joint of thumb, index,
/// middle and ring finger. A medial joint also moves the distal one. Flexion is negative. The
/// velocities, 120 degrees a second, are those that users of the related DLR/HIT hand set: the
/// SAH's maker publishes none.
[[nodiscard]] HANDWAY_DEVICE_EXPORT JointRanges sah_joints();

/// A hand behind a TCP port with the protocol of hand_protocol.h. It stores the whole motion and
/// keeps its time itself.
class HANDWAY_DEVICE_EXPORT NetworkHand final : public TrajectoryClient {
 public:
  /// @param name for messages. @param joints in the hand's order.
  NetworkHand(std::string name, std::string host, std::uint16_t port, JointRanges joints);
  ~NetworkHand() override;

 private:
  void do_connect(const std::stop_token& stop) override;
  void do_upload(const JointTrajectory& trajectory, const std::stop_token& stop) override;
  void do_start() override;
  [[nodiscard]] double do_pause(double time) override;
  void do_resume() override;
  void do_stop() override;
  [[nodiscard]] bool do_update(double time) override;

  void take(const std::string& line);
  void take_answer(const std::vector<std::string_view>& words, const std::string& line);
  void ask(const std::string& lines, const char* word, const std::stop_token& stop);

  struct Wire;
  std::unique_ptr<Wire> wire_;
};

}  // namespace handway::device
