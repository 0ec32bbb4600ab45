#include "handway/device/hand/network_hand.h"

#include "core/links.h"
#include "handway/device/core/device_error.h"
#include "handway/device/hand/hand_protocol.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace handway::device {
namespace {

constexpr double kVelocity = 120.0;  // degrees a second

}  // namespace

JointRanges sah_joints() {
  JointRanges joints;
  joints.lower.resize(13);
  joints.upper.resize(13);
  joints.velocity = Eigen::VectorXd::Constant(13, geometric::radians(kVelocity));
  const auto add = [&joints](std::string name, double lower, double upper) {
    const auto j = static_cast<Eigen::Index>(joints.names.size());
    joints.names.push_back(std::move(name));
    joints.lower[j] = geometric::radians(lower);
    joints.upper[j] = geometric::radians(upper);
  };
  add("thumb_base", -90.0, 0.0);
  for (const std::string finger : {"thumb", "index", "middle", "ring"}) {
    add(finger + "_abduction", -15.0, 15.0);
    add(finger + "_proximal", -75.0, 4.0);
    add(finger + "_medial", -75.0, -4.0);
  }
  return joints;
}

namespace {

using Clock = TrajectoryClient::Clock;
using std::chrono::milliseconds;

constexpr milliseconds kLongestAnswer{1000};
// Margin before the hand's timeout.
constexpr std::chrono::duration<double> kAlive{0.5 * kHandAlivePeriod};
// Delay until the hand reacts to a pause, s.
constexpr double kPauseNotice = 0.02;

}  // namespace

struct NetworkHand::Wire {
  std::string host;
  std::uint16_t port = 0;
  std::unique_ptr<ByteLink> link;
  LineBuffer lines;
  std::string answer;  ///< The word of the last "ok".
  std::string phase;
  bool watched = false;  ///< Supervised: it has to run or pause without faults.
  Clock::time_point spoken;

  void send(std::string_view text, milliseconds timeout = ByteLink::kLongestCommand) {
    link->write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, timeout);
    spoken = Clock::now();
  }
};

NetworkHand::NetworkHand(std::string name, std::string host, std::uint16_t port, JointRanges joints)
    : TrajectoryClient(std::move(name), std::move(joints)), wire_(std::make_unique<Wire>()) {
  wire_->host = std::move(host);
  wire_->port = port;
}

NetworkHand::~NetworkHand() = default;

void NetworkHand::do_connect(const std::stop_token& stop) {
  wire_->link.reset();
  wire_->link = open_tcp_link(name(), {wire_->host, wire_->port}, stop);
  wire_->lines = {};
  ask(fmt::format("hello {}\n", kHandProtocolVersion), "hello", stop);
}

// Sends lines and waits for the answer to the last.
void NetworkHand::ask(const std::string& lines, const char* word, const std::stop_token& stop) {
  wire_->answer.clear();
  wire_->send(lines, ByteLink::kLongestWrite);
  const auto begin = Clock::now();
  while (wire_->answer != word) {
    if (Clock::now() - begin > kLongestAnswer || stop.stop_requested()) {
      refuse(fmt::format("no answer to \"{}\"", word), "a hand that speaks Handway's hand protocol",
             "Look whether the port is right.");
    }
    static_cast<void>(do_update(0.0));
  }
}

void NetworkHand::do_upload(const JointTrajectory& trajectory, const std::stop_token& stop) {
  ask(to_lines(trajectory), "trajectory", stop);
  wire_->phase = "ready";
}

void NetworkHand::do_start() {
  if (wire_->phase == "error") {
    refuse("a hand with a fault", "one that is ready", "Look at its controller.");
  }
  wire_->send("start\n");
  wire_->watched = true;
}

double NetworkHand::do_pause(double time) {
  const double hold = std::max(time, motion_time(Clock::now()) + kPauseNotice);
  wire_->send(fmt::format("pause {}\n", hold));
  return hold;
}

void NetworkHand::do_resume() { wire_->send("resume\n"); }

void NetworkHand::do_stop() {
  wire_->watched = false;
  wire_->send("stop\n");
}

bool NetworkHand::do_update(double /*time*/) {
  bool all = true;
  try {
    all = read_turn(*wire_->link, milliseconds(1), [this](std::span<const std::uint8_t> bytes) {
      wire_->lines.add(bytes);
      while (const auto line = wire_->lines.next()) {
        take(*line);
      }
    });
  } catch (const LineProtocolError& error) {
    refuse(error.what(), "a hand that speaks Handway's hand protocol",
           "Look whether the port is right.");
  }
  if (Clock::now() - wire_->spoken > kAlive) {
    wire_->send("alive\n");
  }
  return all;
}

void NetworkHand::take(const std::string& line) {
  const std::vector<std::string_view> words = words_of(line);
  if (words.empty()) {
    return;
  }
  if (words[0] == "state") {
    const HandState state = parse_hand_state(line, joints().count());
    wire_->phase = state.phase;
    add_sample(state.position);
  } else if (words[0] == "fault") {
    if (wire_->watched) {
      refuse(quote(line.substr(std::min(line.size(), words[0].size() + 1))),
             "a hand without a fault", "Look at its controller.");
    }
  } else {
    take_answer(words, line);
  }
}

void NetworkHand::take_answer(const std::vector<std::string_view>& words, const std::string& line) {
  if (words[0] == "hello") {
    if (words.size() != 3 || number_of(words[1]) != kHandProtocolVersion ||
        number_of(words[2]) != static_cast<double>(joints().count())) {
      refuse(quote(line),
             fmt::format("version {} and {} joints", kHandProtocolVersion, joints().count()),
             "It is another hand than the scene's.");
    }
    wire_->answer = "hello";
  } else if (words[0] == "ok" && words.size() == 2) {
    wire_->answer = words[1];
  } else if (words[0] == "error") {
    refuse(quote(line), "a hand that accepts the command", "Look at its controller.");
  } else {
    throw LineProtocolError(fmt::format("the line {}", quote(line)));
  }
}

}  // namespace handway::device
