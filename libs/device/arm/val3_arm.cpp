#include "handway/device/arm/val3_arm.h"

#include "core/links.h"
#include "handway/device/arm/simple_message.h"
#include "handway/device/core/device_error.h"
#include "handway/device/core/joint_trajectory.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

namespace handway::device {
namespace {

struct Row {
  const char* name;
  double lower;     ///< degrees
  double upper;     ///< degrees
  double velocity;  ///< degrees a second
};

constexpr std::array<Row, 6> kRows{{{"joint_1", -180.0, 180.0, 400.0},
                                    {"joint_2", -130.0, 147.5, 400.0},
                                    {"joint_3", -145.0, 145.0, 430.0},
                                    {"joint_4", -270.0, 270.0, 540.0},
                                    {"joint_5", -115.0, 140.0, 475.0},
                                    {"joint_6", -270.0, 270.0, 760.0}}};

}  // namespace

JointRanges tx90_joints() {
  JointRanges joints{{}, Eigen::VectorXd(6), Eigen::VectorXd(6), Eigen::VectorXd(6)};
  for (Eigen::Index j = 0; j < 6; ++j) {
    const Row& row = kRows[static_cast<std::size_t>(j)];
    joints.names.emplace_back(row.name);
    joints.lower[j] = geometric::radians(row.lower);
    joints.upper[j] = geometric::radians(row.upper);
    joints.velocity[j] = geometric::radians(row.velocity);
  }
  return joints;
}

namespace {

/// A point for the VAL3 server, with the time to send it.
struct Val3Point {
  double due = 0.0;  ///< Earliest time of sending, s of the motion.
  double end = 0.0;  ///< Time of arrival, s of the motion.
  SimpleMessage message;
};

/// Number of points that are sent ahead of their time: the queue holds ten.
inline constexpr std::size_t kVal3PointsAhead = 8;

// Smallest motion that can be sent to an arm (float32), rad.
constexpr double kNoMove = 1e-6;
// Least share of its velocity that the controller accepts.
constexpr double kLeastVelocity = 1e-4;

// The points of a trajectory without the first, at which the arm is. Points without motion are left
// out; the next ones wait for the end of the pause.
// @pre check_trajectory().
std::vector<Val3Point> val3_points(const JointTrajectory& trajectory, const JointRanges& joints) {
  std::vector<Val3Point> points;
  double wait_until = 0.0;
  Eigen::VectorXd from = trajectory.positions.row(0);
  for (std::size_t i = 1; i < trajectory.times.size(); ++i) {
    const Eigen::VectorXd to = trajectory.positions.row(static_cast<Eigen::Index>(i));
    const double duration = trajectory.times[i] - trajectory.times[i - 1];
    if ((to - from).lpNorm<Eigen::Infinity>() < kNoMove) {
      wait_until = trajectory.times[i];
      continue;
    }
    const double share =
        ((to - from).cwiseAbs().array() / joints.velocity.array()).maxCoeff() / duration;
    Val3Point point;
    const std::size_t ahead = i > kVal3PointsAhead ? i - kVal3PointsAhead : 0;
    point.due = std::max(trajectory.times[ahead], wait_until);
    point.end = trajectory.times[i];
    point.message.type = SimpleMessageType::kJointTrajectoryPoint;
    point.message.kind = SimpleMessageKind::kRequest;
    point.message.sequence = static_cast<std::int32_t>(points.size());
    for (Eigen::Index j = 0; j < to.size(); ++j) {
      point.message.joints[static_cast<std::size_t>(j)] = static_cast<float>(to[j]);
    }
    point.message.velocity = static_cast<float>(std::clamp(share, kLeastVelocity, 1.0));
    point.message.duration = static_cast<float>(duration);
    points.push_back(point);
    from = to;
  }
  return points;
}

using Clock = TrajectoryClient::Clock;
using std::chrono::milliseconds;

constexpr int kStatePortAfterMotion = 2;
constexpr milliseconds kLongestReply{500};
// A full queue has room again when the arm reaches the next point. If it has none after this
// multiple of that time plus this margin, s, the controller refuses for another reason.
constexpr double kFullPoints = 3.0;
constexpr double kFullMargin = 0.05;
constexpr milliseconds kTryAgain{10};
constexpr std::size_t kQueue = 10;

/// Passes pending messages to `take`, one by one. @returns as read_turn().
template <typename Take>
bool read_messages(ByteLink& link, SimpleMessageParser& parser, const Take& take) {
  return read_turn(link, milliseconds(1), [&](std::span<const std::uint8_t> bytes) {
    parser.add(bytes);
    while (const auto message = parser.next()) {
      take(*message);
    }
  });
}

}  // namespace

struct Val3Arm::Wire {
  std::string host;
  std::uint16_t port = 0;
  std::unique_ptr<ByteLink> motion;
  std::unique_ptr<ByteLink> state;
  SimpleMessageParser replies;
  SimpleMessageParser feedback;
  std::optional<RobotStatus> status;

  std::vector<Val3Point> points;
  std::size_t accepted = 0;  ///< Number of points that the controller accepted.
  bool running = false;      ///< A motion is being sent.
  bool asked = false;        ///< A point was sent, and not answered yet.
  Clock::time_point asked_at;
  std::optional<Clock::time_point> refused_since;  ///< Time of the next point's first refusal.
  Clock::time_point try_again;                     ///< After a full queue.
  std::size_t released = 0;  ///< Number of points that may be sent: fewer during a pause.

  void send(const SimpleMessage& message) const {
    motion->write(encode(message), ByteLink::kLongestCommand);
  }
};

Val3Arm::Val3Arm(std::string name, std::string host, std::uint16_t port, JointRanges joints)
    : TrajectoryClient(std::move(name), std::move(joints)), wire_(std::make_unique<Wire>()) {
  if (this->joints().count() > static_cast<Eigen::Index>(kSimpleMessageJoints)) {
    throw std::invalid_argument("an arm of more than ten joints");
  }
  wire_->host = std::move(host);
  wire_->port = port;
}

Val3Arm::~Val3Arm() = default;

void Val3Arm::do_connect(const std::stop_token& stop) {
  wire_->motion.reset();
  wire_->state.reset();
  wire_->motion = open_tcp_link(name(), {wire_->host, wire_->port}, stop);
  const auto state = static_cast<std::uint16_t>(wire_->port + kStatePortAfterMotion);
  wire_->state =
      open_tcp_link(fmt::format("{} (state port {})", name(), state), {wire_->host, state}, stop);
  wire_->replies = {};
  wire_->feedback = {};
  wire_->status.reset();
}

void Val3Arm::do_upload(const JointTrajectory& trajectory, const std::stop_token& /*stop*/) {
  wire_->running = false;  // until do_start()
  wire_->asked = false;
  wire_->points = val3_points(trajectory, joints());
  wire_->accepted = 0;
  wire_->released = 0;
}

void Val3Arm::do_start() {
  const auto begin = Clock::now();
  while (!wire_->status && Clock::now() - begin < kLongestReply) {
    static_cast<void>(do_update(0.0));
  }
  const auto obstacle =
      wire_->status ? obstacle_to_start(*wire_->status)
                    : RobotObstacle{"no status", "Look whether the VAL3 server is running."};
  if (obstacle) {
    refuse(obstacle->found, "an arm that can move", obstacle->advice);
  }
  wire_->running = true;
  wire_->asked = false;
  wire_->released = wire_->points.size();
  wire_->refused_since.reset();
}

// The arm continues through the points already sent up to the first that ends late enough, and
// rests there.
double Val3Arm::do_pause(double time) {
  const auto& points = wire_->points;
  std::size_t last = wire_->accepted + (wire_->asked ? 1 : 0);
  while (last < points.size() && (last == 0 || points[last - 1].end < time)) {
    ++last;
  }
  wire_->released = last;
  return last == 0 ? time : std::max(time, points[last - 1].end);
}

void Val3Arm::do_resume() {
  wire_->released = wire_->points.size();
  wire_->refused_since.reset();
}

void Val3Arm::do_stop() {
  wire_->running = false;
  wire_->asked = false;
  SimpleMessage stop;
  stop.type = SimpleMessageType::kJointTrajectoryPoint;
  stop.kind = SimpleMessageKind::kRequest;
  stop.sequence = kStopSequence;
  wire_->send(stop);
}

bool Val3Arm::do_update(double time) {
  const bool all_feedback = read_feedback();
  const bool all_replies = read_replies();
  if (wire_->running) {
    send_due_point(time);
  }
  return all_feedback && all_replies;
}

void Val3Arm::send_due_point(double time) {
  const auto now = Clock::now();
  if (wire_->asked && now - wire_->asked_at > kLongestReply) {
    refuse(fmt::format("no answer to point {}", wire_->accepted + 1),
           fmt::format("one within {} ms", kLongestReply.count()),
           "Look at the network and at the controller.");
  }
  if (!wire_->asked && now >= wire_->try_again && wire_->accepted < wire_->released &&
      time >= wire_->points[wire_->accepted].due) {
    wire_->send(wire_->points[wire_->accepted].message);
    wire_->asked = true;
    wire_->asked_at = now;
  }
}

bool Val3Arm::read_feedback() {
  bool all = true;
  try {
    all = read_messages(*wire_->state, wire_->feedback, [this](const SimpleMessage& message) {
      if (message.type == SimpleMessageType::kJointPosition) {
        Eigen::VectorXd position(joints().count());
        for (Eigen::Index j = 0; j < position.size(); ++j) {
          position[j] = static_cast<double>(message.joints[static_cast<std::size_t>(j)]);
        }
        add_sample(position);
      } else if (message.type == SimpleMessageType::kStatus) {
        wire_->status = message.status;
      }
    });
  } catch (const SimpleMessageError& error) {
    refuse(error.what(), "a VAL3 server's positions and status", "Look whether the port is right.");
  }
  if (wire_->running && wire_->status) {
    look_at_status();
  }
  return all;
}

void Val3Arm::look_at_status() const {
  if (const auto obstacle = obstacle_under_way(*wire_->status)) {
    refuse(obstacle->found, "none", obstacle->advice);
  }
}

bool Val3Arm::read_replies() {
  try {
    return read_messages(*wire_->motion, wire_->replies, [this](const SimpleMessage& message) {
      if (wire_->asked && message.kind == SimpleMessageKind::kReply &&
          message.sequence == wire_->points[wire_->accepted].message.sequence) {
        take_reply(message.reply == SimpleMessageReply::kSuccess);
      }
    });
  } catch (const SimpleMessageError& error) {
    refuse(error.what(), "a VAL3 server's answer", "Look whether the port is right.");
  }
}

// The server refuses a point out of range and a point for a full queue with the same reply.
void Val3Arm::take_reply(bool taken) {
  wire_->asked = false;
  const auto now = Clock::now();
  if (taken) {
    ++wire_->accepted;
    wire_->refused_since.reset();
    return;
  }
  const double longest =
      kFullPoints * static_cast<double>(wire_->points[wire_->accepted].message.duration) +
      kFullMargin;
  wire_->refused_since = wire_->refused_since.value_or(now);
  if (wire_->accepted < kQueue ||
      now - *wire_->refused_since > std::chrono::duration<double>(longest)) {
    refuse(fmt::format("point {} of {} refused", wire_->accepted + 1, wire_->points.size()),
           "a controller that takes it",
           "It is outside the controller's joint ranges, or the arm stands still: look at the "
           "pendant.");
  }
  wire_->try_again = now + kTryAgain;
}

}  // namespace handway::device
