#include "handway/device/hand/hand_emulator.h"

#include "core/emulated_joints.h"
#include "core/line_emulator.h"
#include "handway/device/hand/hand_protocol.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>

namespace handway::device {
namespace {

HandControllerSettings checked(HandControllerSettings settings) {
  if (settings.joints.count() == 0 || settings.position.size() != settings.joints.count() ||
      !(settings.braking_time > 0.0)) {
    throw std::invalid_argument("a hand controller needs joints and brakes");
  }
  return settings;
}

}  // namespace

struct HandController::Hand {
  explicit Hand(HandControllerSettings given)
      : settings(checked(std::move(given))),
        joints(settings.position, settings.joints.velocity / settings.braking_time, settings.lag) {}

  HandControllerSettings settings;
  EmulatedJoints joints;
  bool greeted = false;
  std::string phase = "idle";
  std::string fault_text;
  JointTrajectory trajectory;
  std::size_t expected = 0;  ///< Points of the trajectory that is coming in.
  double now = 0.0;
  double heard = 0.0;  ///< When the host spoke last.
  double time = 0.0;   ///< Of the motion.
  std::optional<double> hold;
  double moved = 0.0;  ///< s since the first motion began.
  bool has_moved = false;
  bool fault_active = false;
  int stops = 0;  ///< Commands.

  void step();
  void end(const char* how);
  void fail(std::string why);
  void begin_fault();
  void follow();
  [[nodiscard]] bool fault(FaultKind kind) const {
    return fault_active && settings.fault.kind == kind;
  }
  [[nodiscard]] bool under_way() const { return phase == "running" || phase == "paused"; }
  /// @returns an answer. @throws LineProtocolError for a line that is none.
  std::string obey(const std::vector<std::string_view>& words);
  std::string begin_trajectory(const std::vector<std::string_view>& words);
  std::string take_point(const std::vector<std::string_view>& words);
};

void HandController::Hand::end(const char* how) {
  if (under_way() || phase == "ready") {
    phase = how;
  }
  joints.brake();
}

void HandController::Hand::fail(std::string why) {
  phase = "error";
  fault_text = std::move(why);
  joints.brake();
}

void HandController::Hand::begin_fault() {
  fault_active = true;
  if (settings.fault.kind == FaultKind::kEstop) {
    fail("emergency stop");
  } else if (settings.fault.kind == FaultKind::kRefused) {
    fail("motion refused by the drives");
  } else if (settings.fault.kind == FaultKind::kJointLimit) {
    // Of the joint that has farthest to go.
    Eigen::Index joint = 0;
    (trajectory.at(trajectory.duration()) - joints.commanded()).cwiseAbs().maxCoeff(&joint);
    fail(fmt::format("joint {} at its limit",
                     settings.joints.names[static_cast<std::size_t>(joint)]));
  }
}

void HandController::Hand::follow() {
  time += fault(FaultKind::kSlow) ? 0.5 * kEmulationStep : kEmulationStep;
  if (hold && time >= *hold) {
    time = *hold;
    phase = "paused";
    hold.reset();
  } else if (time >= trajectory.duration()) {
    phase = "done";
  }
  const Eigen::VectorXd before = joints.commanded();
  const Eigen::VectorXd at = trajectory.at(time);
  joints.command(at, phase == "running" ? (at - before) / kEmulationStep
                                        : Eigen::VectorXd(Eigen::VectorXd::Zero(at.size())));
}

void HandController::Hand::step() {
  now += kEmulationStep;
  if (phase == "running") {
    has_moved = true;
    follow();
  }
  joints.step(kEmulationStep);
  if (under_way() && now - heard > kHandLongestSilence) {
    fail("nothing heard of the host");
  }
  if (has_moved) {
    moved += kEmulationStep;
    if (!fault_active && settings.fault.kind != FaultKind::kNone && moved >= settings.fault.after) {
      begin_fault();
    }
  }
}

std::string HandController::Hand::begin_trajectory(const std::vector<std::string_view>& words) {
  const double count = words.size() == 2 ? number_of(words[1]) : 0.0;
  if (under_way()) {
    return "error trajectory a motion is under way\n";
  }
  if (!(count >= 2.0 && count <= static_cast<double>(settings.longest))) {
    return fmt::format("error trajectory it has to have 2 to {} points\n", settings.longest);
  }
  expected = static_cast<std::size_t>(count);
  trajectory = {};
  trajectory.positions.resize(static_cast<Eigen::Index>(expected), settings.joints.count());
  phase = "idle";
  return "";
}

std::string HandController::Hand::take_point(const std::vector<std::string_view>& words) {
  if (trajectory.times.size() >= expected ||
      words.size() != 2 + static_cast<std::size_t>(settings.joints.count())) {
    throw LineProtocolError("a point that does not belong here");
  }
  const auto row = static_cast<Eigen::Index>(trajectory.times.size());
  trajectory.times.push_back(number_of(words[1]));
  for (Eigen::Index j = 0; j < settings.joints.count(); ++j) {
    trajectory.positions(row, j) = number_of(words[2 + static_cast<std::size_t>(j)]);
  }
  if (trajectory.times.size() < expected) {
    return "";
  }
  expected = 0;
  try {
    check_trajectory(trajectory, settings.joints);
  } catch (const geometric::InputError& error) {
    return fmt::format("error trajectory {}\n", error.what());
  }
  phase = "ready";
  return "ok trajectory\n";
}

std::string HandController::Hand::obey(const std::vector<std::string_view>& words) {
  const std::string word(words.empty() ? std::string_view() : words.front());
  if (word == "hello") {
    if (words.size() != 2 || number_of(words[1]) != kHandProtocolVersion) {
      return fmt::format("error hello this hand speaks version {}\n", kHandProtocolVersion);
    }
    greeted = true;
    return fmt::format("hello {} {}\n", kHandProtocolVersion, settings.joints.count());
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
    if (phase != "ready") {
      return fmt::format("error start the hand is {}, not ready\n", phase);
    }
    time = 0.0;
    hold.reset();
    joints.release();
    phase = "running";
  } else if (word == "pause") {
    if (phase == "running") {
      hold = std::max(time, words.size() == 2 ? number_of(words[1]) : 0.0);
    }
  } else if (word == "resume") {
    hold.reset();
    phase = phase == "paused" ? "running" : phase;
  } else if (word == "stop") {
    ++stops;
    end("stopped");
  } else {
    throw LineProtocolError(fmt::format("unknown word \"{}\"", word));
  }
  return "ok " + word + "\n";
}

HandController::HandController(HandControllerSettings settings)
    : hand_(std::make_unique<Hand>(std::move(settings))) {}

HandController::~HandController() = default;

std::string HandController::receive(const std::string& line, double now) {
  advance(now);
  hand_->heard = now;
  try {
    return hand_->obey(words_of(line));
  } catch (const LineProtocolError& error) {
    return fmt::format("error line {}\n", error.what());
  }
}

void HandController::advance(double now) {
  while (hand_->now + kEmulationStep <= now) {
    hand_->step();
  }
}

std::string HandController::feedback() {
  if (!hand_->greeted) {
    return "";
  }
  std::string lines = to_line({hand_->time, hand_->phase, hand_->joints.position()});
  if (hand_->phase == "error") {
    lines += "fault " + hand_->fault_text + "\n";
  }
  return lines;
}

void HandController::connection_lost() {
  hand_->end("stopped");
  hand_->greeted = false;
}

const Eigen::VectorXd& HandController::position() const { return hand_->joints.position(); }

bool HandController::moving() const { return hand_->joints.moving(); }

int HandController::stops() const { return hand_->stops; }

FaultKind HandController::active_fault() const {
  return hand_->fault_active ? hand_->settings.fault.kind : FaultKind::kNone;
}

struct HandEmulator::Running : LineEmulator<HandController> {
  using LineEmulator::LineEmulator;
};

HandEmulator::HandEmulator(const HandControllerSettings& settings, std::uint16_t port)
    : running_(std::make_unique<Running>("hand", port, kHandStatePeriod, settings)) {}

HandEmulator::~HandEmulator() = default;

const std::string& HandEmulator::address() const { return running_->address(); }

Eigen::VectorXd HandEmulator::position() const {
  return running_->ask([](const HandController& hand) { return Eigen::VectorXd(hand.position()); });
}

bool HandEmulator::moving() const {
  return running_->ask([](const HandController& hand) { return hand.moving(); });
}

int HandEmulator::stops() const {
  return running_->ask([](const HandController& hand) { return hand.stops(); });
}

}  // namespace handway::device
