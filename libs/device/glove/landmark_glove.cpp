#include "handway/device/glove/landmark_glove.h"

#include "core/links.h"
#include "core/ports.h"
#include "glove/finger_bending.h"
#include "glove/hand_json.h"
#include "glove/recording_player.h"
#include "handway/device/core/device_error.h"
#include "handway/device/core/line_protocol.h"
#include "handway/device/core/watchdog.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/hand_message.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <deque>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace handway::device {
namespace {

using std::chrono::milliseconds;

constexpr std::string_view kUdp = "udp://";
constexpr std::string_view kTcp = "landmarks://";
constexpr std::string_view kPipe = "pipe://";
constexpr std::string_view kStandardInput = "-";
constexpr milliseconds kLineSlice{20};
constexpr std::size_t kLongestDatagram = 65507;  // of UDP
constexpr const char* kExpectedMessages = "messages of a hand";
// Step back by which the sender's clock must have been reset, not datagrams overtaken, s.
constexpr double kClockSetBack = 1.0;

bool is_pipe(const std::string& address) {
  return address.starts_with(kPipe) || address == kStandardInput;
}

TcpAddress parse_landmark_address(const std::string& address) {
  if (address.starts_with(kUdp)) {
    return parse_udp_address(address.substr(kUdp.size()));
  }
  if (!address.starts_with(kTcp)) {
    throw geometric::InputError({address, "", "no address of landmarks",
                                 "udp://PORT, landmarks://HOST:PORT, pipe://PATH or -", ""});
  }
  return std::get<TcpAddress>(parse_device_address("tcp://" + address.substr(kTcp.size())));
}

std::string_view text_of(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

bool is_landmark_address(const std::string& address) {
  return address.starts_with(kUdp) || address.starts_with(kTcp) || is_pipe(address);
}

/// Detects the side of the hand from the bending of its fingers, whatever the sender calls it: for
/// the wrong side they would bend backwards.
class SeenSide {
 public:
  /// @param named_left the hand that the sender names. @returns whether it is a left hand.
  bool is_left(const HandLandmarks& landmarks, bool named_left) {
    evidence_ =
        kKept * evidence_ + bending(landmarks, !named_left) - bending(landmarks, named_left);
    if (const bool swapped = is_swapped_ ? evidence_ > -kSure : evidence_ > kSure;
        swapped != is_swapped_) {
      is_swapped_ = swapped;
      spdlog::warn("The hand landmarks are called those of a {} hand, and {}.",
                   named_left ? "left" : "right",
                   swapped ? "bend as the other's: they are taken for that"
                           : "bend as such: they are taken for that again");
    }
    return named_left != is_swapped_;
  }

 private:
  static constexpr double kKept = 0.98;  // of the evidence, from frame to frame
  static constexpr double kSure = 30.0;  // rad, of a few frames with bent fingers

  /// Decaying sum of how much more the fingers bend as the other hand's than as the named one's,
  /// rad.
  double evidence_ = 0.0;
  bool is_swapped_ = false;
};

struct LandmarkGlove::Session {
  std::optional<UdpReceiver> receiver;  ///< Receiver of UDP; TCP uses the link.
  std::unique_ptr<ByteLink> link;
  LineBuffer lines{kLongestHandMessage};
  std::vector<std::uint8_t> datagram = std::vector<std::uint8_t>(kLongestDatagram + 1);
  GloveCalibration typical = typical_calibration();
  std::deque<GloveFrame> frames;  ///< Arrived and not yet taken.
  Watchdog watchdog;
  Clock::duration silence{};
  bool heard = false;                    ///< A good line has arrived.
  bool ended = false;                    ///< The input has ended.
  HandWire wire = HandWire::kLandmarks;  ///< Format of the last good line.
  bool no_hand = false;                  ///< The last line had no hand.
  SeenSide side;
  std::optional<double> sent;  ///< The sender's time of the last frame.
  std::string problem;         ///< Problem of the last bad line.
};

LandmarkGlove::LandmarkGlove(std::string address, const LandmarkGloveSettings& settings)
    : address_(std::move(address)), settings_(settings) {
  if (!is_pipe(address_)) {
    static_cast<void>(parse_landmark_address(address_));  // refuses wrong ones
  }
}

LandmarkGlove::~LandmarkGlove() { disconnect(); }

void LandmarkGlove::take_lines(milliseconds timeout) {
  Session& session = *session_;
  const auto add = [&](std::span<const std::uint8_t> bytes) {
    session.lines.add(bytes);
    try {
      while (const auto line = session.lines.next()) {
        take_line(*line, Clock::now());
      }
    } catch (const LineProtocolError& error) {
      throw DeviceError({address_, "", error.what(), kExpectedMessages,
                         "Look whether the sender ends its lines, and sends a hand."});
    }
  };
  if (session.link) {
    try {
      static_cast<void>(read_turn(*session.link, timeout, add));
    } catch (const EndOfInput&) {
      if (!session.heard) {
        throw;
      }
      session.ended = true;
    }
  } else {
    const std::span<std::uint8_t> bytes(session.datagram);
    const auto length = session.receiver->receive(bytes.first(kLongestDatagram), timeout);
    if (length && is_lz4_frame(text_of(bytes.first(*length)))) {
      take_line(text_of(bytes.first(*length)), Clock::now());
    } else if (length) {
      bytes[*length] = '\n';
      add(bytes.first(*length + 1));
    }
  }
  session.silence = session.watchdog.listened(Clock::now());
}

void LandmarkGlove::take_line(std::string_view line, Clock::time_point arrival) {
  Session& session = *session_;
  if (line.empty()) {
    return;
  }
  HandMessage message;
  try {
    message = read_hand_message(line);
  } catch (const LineProtocolError& error) {
    ++faults_.resynchronisations;
    faults_.dropped_bytes += line.size();
    session.problem = error.what();
    return;
  }
  session.watchdog.heard(arrival);
  session.heard = true;
  session.wire = message.wire;
  for (const HandObservation& hand : message.hands) {
    const bool may_be_followed = !settings_.left || *settings_.left == hand.left;
    if (hand.is_seen() && may_be_followed) {
      settings_.left = hand.left;
      session.no_hand = false;
      take_hand(hand, arrival);
    } else if (!hand.is_seen() && (may_be_followed || message.hands.size() == 1)) {
      session.no_hand = true;
    }
  }
}

void LandmarkGlove::take_hand(const HandObservation& hand, Clock::time_point arrival) {
  Session& session = *session_;
  if (hand.time && session.sent) {
    const double late = *session.sent - *hand.time;
    if (late > 0.0 && late < kClockSetBack) {
      ++faults_.doubtful;
      return;
    }
  }
  session.sent = hand.time;
  GloveAngles angles;
  if (hand.landmarks) {
    const bool left = session.side.is_left(*hand.landmarks, hand.left);
    angles = glove_angles(in_palm_frame(*hand.landmarks, left));
  } else {
    angles.angles = *hand.angles;
  }
  GloveFrame frame = to_counts(angles, session.typical);
  for (std::uint16_t& count : frame.counts) {
    count = count == 0 ? to_count(kMidScale) : count;
  }
  frame.angles = angles.angles;
  if (hand.landmarks) {
    frame.bones = bones_of(*hand.landmarks);
  }
  frame.X_SH = hand.X_SH;
  frame.raw = hand.raw;
  frame.time = since_begin(arrival);
  session.frames.push_back(frame);
}

void LandmarkGlove::check_sender() const {
  if (session_->silence > settings_.timeout) {
    const std::string last =
        session_->problem.empty() ? "" : " (the last line: " + session_->problem + ")";
    throw DeviceError(
        {address_, "",
         fmt::format("no hand landmarks for {} ms{}", settings_.timeout.count(), last),
         kExpectedMessages, "Look whether the sender runs, and sends to this computer and port."});
  }
}

GloveInfo LandmarkGlove::do_connect(const std::stop_token& stop) {
  session_.reset();  // its port is needed
  session_ = std::make_unique<Session>();
  try {
    if (address_ == kStandardInput) {
      session_->link = open_standard_input(address_);
    } else if (is_pipe(address_)) {
      session_->link = open_pipe_link(address_, address_.substr(kPipe.size()));
    } else if (const TcpAddress address = parse_landmark_address(address_);
               address_.starts_with(kUdp)) {
      session_->receiver.emplace(address_, address);
    } else {
      session_->link = open_tcp_link(address_, address, stop);
    }
    session_->watchdog.heard(Clock::now());
    while (!session_->heard && !stop.stop_requested()) {
      take_lines(kLineSlice);
      check_sender();
    }
  } catch (...) {
    session_.reset();
    throw;
  }
  GloveInfo info;
  info.device = address_;
  info.model = name_of(session_->wire);
  info.right_hand = !settings_.left.value_or(false);
  info.angle_sensors = landmark_sensors();
  info.raw = raw_columns_of(session_->wire, settings_.left.value_or(false));
  return info;
}

GloveReading LandmarkGlove::do_next(milliseconds timeout, const std::stop_token& stop) {
  Session& session = *session_;
  const auto end = Clock::now() + timeout;
  while (session.frames.empty() && !stop.stop_requested()) {
    const auto left = std::chrono::ceil<milliseconds>(end - Clock::now());
    if (session.ended) {
      return {SampleEvent::kEnd, {}};
    }
    take_lines(std::clamp(left, milliseconds(0), kLineSlice));
    check_sender();
    if (session.frames.empty() && Clock::now() >= end) {
      return {session.no_hand ? SampleEvent::kUnplugged : SampleEvent::kNothing, {}};
    }
  }
  if (session.frames.empty()) {
    return {};
  }
  const GloveFrame frame = session.frames.front();
  session.frames.pop_front();
  return {SampleEvent::kSample, frame};
}

void LandmarkGlove::do_disconnect() noexcept { session_.reset(); }

}  // namespace handway::device
