#include "handway/device/emulators/hand_emulator.h"

#include "emulators/emulator_thread.h"
#include "handway/device/hand/hand_protocol.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace handway::device {
HandController::HandController(const HandControllerSettings& settings)
    : EmulatedRobot(settings), longest_(settings.longest) {}

void HandController::end(const char* how) {
  if (under_way() || phase_ == "ready") {
    phase_ = how;
  }
  brake();
}

void HandController::fail(std::string why) {
  phase_ = "error";
  fault_text_ = std::move(why);
  brake();
}

void HandController::do_fail() {
  if (active_fault() == FaultKind::kEstop) {
    fail("emergency stop");
  } else if (active_fault() == FaultKind::kRefused) {
    fail("motion refused by the drives");
  } else if (active_fault() == FaultKind::kJointLimit) {
    // Fails at a limit of the joint that has farthest to go.
    Eigen::Index joint = 0;
    (trajectory_.at(trajectory_.duration()) - commanded()).cwiseAbs().maxCoeff(&joint);
    fail(fmt::format("joint {} at its limit", joints().names[static_cast<std::size_t>(joint)]));
  }
}

void HandController::follow() {
  time_ += active_fault() == FaultKind::kSlow ? 0.5 * kStep : kStep;
  if (hold_ && time_ >= *hold_) {
    time_ = *hold_;
    phase_ = "paused";
    hold_.reset();
  } else if (time_ >= trajectory_.duration()) {
    phase_ = "done";
  }
  const Eigen::VectorXd before = commanded();
  const Eigen::VectorXd at = trajectory_.at(time_);
  command(at, phase_ == "running" ? (at - before) / kStep
                                  : Eigen::VectorXd(Eigen::VectorXd::Zero(at.size())));
}

bool HandController::do_step() {
  if (under_way() && now() - heard_ > kHandLongestSilence) {
    fail("nothing heard of the host");
  }
  const bool runs = phase_ == "running";
  if (runs) {
    follow();
  }
  return runs;
}

std::string HandController::begin_trajectory(const Words& words) {
  const double count = words.size() == 2 ? number_of(words[1]) : 0.0;
  if (under_way()) {
    return "error trajectory a motion is under way\n";
  }
  if (!(count >= 2.0 && count <= static_cast<double>(longest_))) {
    return fmt::format("error trajectory it has to have 2 to {} points\n", longest_);
  }
  expected_ = static_cast<std::size_t>(count);
  trajectory_ = {};
  trajectory_.positions.resize(static_cast<Eigen::Index>(expected_), joints().count());
  phase_ = "idle";
  return "";
}

std::string HandController::take_point(const Words& words) {
  if (trajectory_.times.size() >= expected_ ||
      words.size() != 2 + static_cast<std::size_t>(joints().count())) {
    throw LineProtocolError("a point that does not belong here");
  }
  const auto row = static_cast<Eigen::Index>(trajectory_.times.size());
  trajectory_.times.push_back(number_of(words[1]));
  for (Eigen::Index j = 0; j < joints().count(); ++j) {
    trajectory_.positions(row, j) = number_of(words[2 + static_cast<std::size_t>(j)]);
  }
  if (trajectory_.times.size() < expected_) {
    return "";
  }
  expected_ = 0;
  try {
    check_trajectory(trajectory_, joints());
  } catch (const geometric::InputError& error) {
    return fmt::format("error trajectory {}\n", error.what());
  }
  phase_ = "ready";
  return "ok trajectory\n";
}

std::string HandController::obey(const Words& words) {
  const std::string word(words.empty() ? std::string_view() : words.front());
  if (word == "hello") {
    if (words.size() != 2 || number_of(words[1]) != kHandProtocolVersion) {
      return fmt::format("error hello this hand speaks version {}\n", kHandProtocolVersion);
    }
    greeted_ = true;
    return fmt::format("hello {} {}\n", kHandProtocolVersion, joints().count());
  }
  if (word == "trajectory") {
    return begin_trajectory(words);
  }
  if (word == "point") {
    return take_point(words);
  }
  if (word == "alive") {
    return "";
  }
  if (word == "start") {
    if (phase_ != "ready") {
      return fmt::format("error start the hand is {}, not ready\n", phase_);
    }
    time_ = 0.0;
    hold_.reset();
    release();
    phase_ = "running";
  } else if (word == "pause") {
    if (phase_ == "running") {
      hold_ = std::max(time_, words.size() == 2 ? number_of(words[1]) : 0.0);
    }
  } else if (word == "resume") {
    hold_.reset();
    phase_ = phase_ == "paused" ? "running" : phase_;
  } else if (word == "stop") {
    count_stop();
    end("stopped");
  } else {
    throw LineProtocolError(fmt::format("unknown word \"{}\"", word));
  }
  return "ok " + word + "\n";
}

std::string HandController::receive(const std::string& line, double now) {
  advance(now);
  heard_ = now;
  try {
    return obey(words_of(line));
  } catch (const LineProtocolError& error) {
    return fmt::format("error line {}\n", error.what());
  }
}

std::string HandController::feedback() const {
  if (!greeted_) {
    return "";
  }
  std::string lines = to_line({time_, phase_, position()});
  if (phase_ == "error") {
    lines += "fault " + fault_text_ + "\n";
  }
  return lines;
}

void HandController::connection_lost() {
  end("stopped");
  greeted_ = false;
}

HandEmulator::HandEmulator(const HandControllerSettings& settings, std::uint16_t port)
    : RobotEmulator(std::make_unique<RunningRobot<HandController, LinePort>>(
          kHandStatePeriod, settings, std::string("hand"), port)) {}

}  // namespace handway::device
