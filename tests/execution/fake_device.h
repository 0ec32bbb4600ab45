#pragma once

#include "handway/device/core/trajectory_client.h"
#include "handway/execution/motion/motion_run.h"

#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace handway::execution {

/// Returns a motion from `start` to `end` at a constant speed within a second and a half.
inline device::JointTrajectory line(const Eigen::VectorXd& start, const Eigen::VectorXd& end) {
  constexpr Eigen::Index kSteps = 75;
  device::JointTrajectory line;
  line.positions.resize(kSteps + 1, start.size());
  for (Eigen::Index i = 0; i <= kSteps; ++i) {
    line.times.push_back(0.02 * static_cast<double>(i));
    line.positions.row(i) = start + static_cast<double>(i) / kSteps * (end - start);
  }
  return line;
}

/// Calls a test's function whenever a motion has progressed.
class Watcher final : public MotionObserver {
 public:
  std::function<void(double time)> progress = [](double) {};
  std::function<void(std::size_t part)> part = [](std::size_t) {};
  std::vector<MotionSample> samples;
  std::vector<std::size_t> parts;  ///< In the order of their begin.

  void on_sample(const MotionSample& sample) override { samples.push_back(sample); }
  void on_part(std::size_t index) override {
    parts.push_back(index);
    part(index);
  }
  void on_progress(double time, const std::vector<FollowingError>& /*errors*/) override {
    progress(time);
  }
};

/// A device without wires: it is where its motion has it, until it is stopped.
class FakeDevice final : public device::TrajectoryClient {
 public:
  explicit FakeDevice(const std::string& name)
      : TrajectoryClient(name, {{name},
                                Eigen::VectorXd::Constant(1, -9.0),
                                Eigen::VectorXd::Constant(1, 9.0),
                                Eigen::VectorXd::Constant(1, 1.0)}) {}

  std::string throws_in;    ///< One of start, update, pause, resume, stop.
  double blocked_at = 9.0;  ///< Something keeps it from going further, rad.
  std::chrono::milliseconds stop_takes{0};
  int stops = 0;
  Clock::time_point stopped_at;
  [[nodiscard]] bool moves() const { return moves_; }

 private:
  void throw_in(const std::string& call) const {
    if (throws_in == call) {
      throw std::runtime_error(call + " went wrong");
    }
  }
  void do_connect(const std::stop_token& /*stop*/) override {}
  void do_upload(const device::JointTrajectory& /*trajectory*/,
                 const std::stop_token& /*stop*/) override {}
  void do_start() override {
    moves_ = true;
    throw_in("start");
  }
  [[nodiscard]] double do_pause(double time) override {
    throw_in("pause");
    moves_ = false;
    return time;
  }
  void do_resume() override {
    throw_in("resume");
    moves_ = true;
  }
  void do_stop() override {
    throw_in("stop");
    ++stops;
    stopped_at = Clock::now();
    std::this_thread::sleep_for(stop_takes);
    moves_ = false;
  }
  [[nodiscard]] bool do_update(double time) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    if (moves_) {
      position_ = trajectory().at(time).cwiseMin(blocked_at);
    }
    add_sample(position_);
    if (moves_ && time > 0.2) {
      throw_in("update");
    }
    return true;
  }

  bool moves_ = false;
  Eigen::VectorXd position_ = Eigen::VectorXd::Zero(1);
};

}  // namespace handway::execution
