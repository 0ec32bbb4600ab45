#pragma once

#include "handway/device/core/joint_trajectory.h"

#include <Eigen/Core>

#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace handway::device {

/// What measured joints do that the motion does not, in words.
struct WitnessFault {
  std::string found;
  std::string expected;
  std::string advice;
};

/// Follows measured joints along a motion, and notices a device that accepts it and does something
/// else: a joint that stands still while it has to move, or that runs back and forth. Devices that
/// follow late by up to 0.3 s are believed.
class MotionWitness {
 public:
  /// Begins anew, as at the start of a motion or after a pause.
  void begin(std::vector<std::string> names);

  /// @param time of the motion at which `position` was measured, s; it rises.
  /// @param position rad, shape [joints].
  [[nodiscard]] std::optional<WitnessFault> add(const JointTrajectory& motion, double time,
                                                const Eigen::VectorXd& position);

 private:
  struct Sample {
    double time = 0.0;
    Eigen::VectorXd planned;
    Eigen::VectorXd measured;
  };
  /// Where a joint has been since it moved last, and how far the motion went meanwhile.
  struct Rest {
    double time = 0.0;
    double position = 0.0;
    double least = 0.0;
    double most = 0.0;
  };

  [[nodiscard]] std::optional<WitnessFault> stand_still(const JointTrajectory& motion, double time,
                                                        const Eigen::VectorXd& position);
  [[nodiscard]] std::optional<WitnessFault> run_back() const;

  std::vector<std::string> names_;
  std::deque<Sample> samples_;
  std::vector<Rest> rests_;
};

/// Compares the clock of a device with this computer's, from message to message.
class DeviceClock {
 public:
  using Clock = std::chrono::steady_clock;

  void reset() { last_.reset(); }
  /// @param time that the device says, s. @param received when.
  /// @param backward s that it may go back by, as where messages overtake each other.
  /// @returns what is wrong with it, in words.
  [[nodiscard]] std::optional<std::string> note(double time, Clock::time_point received,
                                                double backward);

 private:
  struct Tick {
    double time = 0.0;
    Clock::time_point received;
  };
  std::optional<Tick> last_;
};

}  // namespace handway::device
