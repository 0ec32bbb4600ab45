#include "handway/device/glove/cyberglove.h"

#include "core/links.h"
#include "glove/cyberglove_protocol.h"
#include "handway/device/core/device_error.h"
#include "handway/device/glove/cyberglove3_parser.h"
#include "handway/device/glove/cyberglove_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <span>
#include <stdexcept>
#include <string_view>
#include <thread>

namespace handway::device {
namespace {

// "?G": bit 0 the unit is initialised, bit 1 a glove is plugged in.
constexpr std::uint8_t kReady = 0x03;

// Returns whether the glove is on its unit and ready. Nothing if the unit doesn't answer.
std::optional<bool> glove_is_ready(CyberGloveCommands& commands, const std::stop_token& stop) {
  const auto reply = commands.query('G', 1, stop);
  if (!reply) {
    return std::nullopt;
  }
  return !reply->data.empty() && (reply->data[0] & kReady) == kReady;
}

int ask_sensors(CyberGloveCommands& commands, const std::string& device,
                const std::stop_token& stop) {
  const auto reply = commands.query('S', 1, stop);
  if (!reply || reply->data.empty()) {
    throw DeviceError({device, "number of sensors", "no answer", "18 or 22",
                       "Switch the interface unit off and on again."});
  }
  const int sensors = reply->data[0];
  if (sensors != 18 && sensors != 22) {
    throw DeviceError({device, "number of sensors", std::to_string(sensors), "18 or 22",
                       "Only CyberGloves with 18 or 22 sensors can be used."});
  }
  return sensors;
}

void set_rate(CyberGloveCommands& commands, const std::string& device, double rate,
              const std::stop_token& stop) {
  const auto reply = commands.set('T', sampling_words(rate), stop);
  if (!reply || reply->error != 0) {
    throw DeviceError({device, "sampling rate",
                       reply ? "a unit that refuses it as too high" : "no answer",
                       fmt::format("one that samples at {:g} Hz", rate), "Ask for a lower rate."});
  }
}

// Brings a CyberGlove interface unit from any state to one in which it can be sampled: 22 or 18
// sensors, neither time stamp nor status in its records.
// @returns everything but `device`; nothing if the port is silent.
// @throws DeviceError if another device than a CyberGlove answers, the unit has no glove, or the
// rate is too high for it.
std::optional<GloveInfo> set_up_cyberglove(CyberGloveCommands& commands, const std::string& device,
                                           const CyberGloveSettings& settings,
                                           const std::stop_token& stop) {
  commands.stop_stream(stop);
  const std::optional<bool> ready = glove_is_ready(commands, stop);
  if (!ready) {
    return std::nullopt;
  }
  if (!*ready) {
    throw DeviceError({device, "", "an interface unit without a glove", "one with a glove",
                       "Plug the glove into the interface unit."});
  }
  GloveInfo info;
  info.device = device;
  info.sensors = ask_sensors(commands, device, stop);
  if (const auto hand = commands.query('R', 1, stop); hand && !hand->data.empty()) {
    info.right_hand = hand->data[0] != 0;
  }
  info.model = "CyberGlove";
  if (const auto version = commands.query('V', 4, stop); version && version->data.size() == 4) {
    const auto& v = version->data;
    info.model += fmt::format(", firmware {}.{}", v[0] << 8 | v[1], v[2] << 8 | v[3]);
  }
  // Resets options of other programs: with them records would be longer than the parser expects.
  const std::uint8_t off = 0;
  (void)commands.set('D', {&off, 1}, stop);
  (void)commands.set('U', {&off, 1}, stop);
  const auto all = static_cast<std::uint8_t>(info.sensors);
  (void)commands.set('N', {&all, 1}, stop);
  const std::uint8_t filter = settings.filter ? 1 : 0;
  (void)commands.set('F', {&filter, 1}, stop);
  set_rate(commands, device, settings.rate, stop);
  info.rate = settings.rate;
  info.round_trip = commands.round_trip();
  return info;
}

using std::chrono::milliseconds;

constexpr milliseconds kSlice{20};
// Rate of a CyberGlove III in its native stream, Hz.
constexpr double kNativeRate = 90.0;
// Period of asking the unit whether its glove is back.
constexpr milliseconds kUnpluggedPeriod{250};

CyberGloveFormat format_of(int sensors) {
  CyberGloveFormat format;
  format.sensors = sensors;
  return format;
}

void write_text(ByteLink& link, std::string_view text) {
  link.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

// Starts the native stream of a CyberGlove III. @returns whether one of its records came.
bool start_native_stream(ByteLink& link, milliseconds timeout, const std::stop_token& stop) {
  write_text(link, "1eu");
  write_text(link, "1S");
  CyberGlove3Parser parser;
  bool found = false;
  const auto end = std::chrono::steady_clock::now() + timeout;
  while (!found && std::chrono::steady_clock::now() < end && !stop.stop_requested()) {
    static_cast<void>(read_turn(link, kSlice, [&](std::span<const std::uint8_t> bytes) {
      for (const std::uint8_t byte : bytes) {
        found |= parser.push(byte).has_value();
      }
    }));
  }
  return found;
}

}  // namespace

struct CyberGlove::Session {
  Session(std::unique_ptr<ByteLink> opened, milliseconds timeout)
      : link(std::move(opened)), commands(*link, timeout), parser(CyberGloveFormat{}) {}

  std::unique_ptr<ByteLink> link;
  CyberGloveCommands commands;
  CyberGloveParser parser;
  std::optional<CyberGlove3Parser> native;  ///< Parser of a CyberGlove III's native stream.
  double rate = 0.0;                        ///< Hz.
  std::deque<GloveFrame> frames;            ///< Arrived and not yet taken.
  bool unplugged = false;
  bool too_fast = false;
  Clock::time_point last_sign;  ///< Time of the last record, or start of sampling.
  Clock::time_point next_poll;
  bool awaits_poll = false;
};

CyberGlove::CyberGlove(std::string address, const CyberGloveSettings& settings)
    : address_(std::move(address)), settings_(settings) {
  if (!(settings.rate >= 0.5 && settings.rate <= 480.0)) {
    throw std::invalid_argument("a CyberGlove samples at 0.5 to 480 Hz");
  }
}

CyberGlove::~CyberGlove() { disconnect(); }

GloveInfo CyberGlove::do_connect(const std::stop_token& stop) {
  auto session =
      std::make_unique<Session>(open_link(address_, settings_.baud, stop), settings_.timeout);
  std::optional<GloveInfo> info = set_up_cyberglove(session->commands, address_, settings_, stop);
  if (info) {
    session->parser = CyberGloveParser(format_of(info->sensors));
  } else if (start_native_stream(*session->link, settings_.timeout, stop)) {
    info.emplace();
    info->device = address_;
    info->model = "CyberGlove III";
    info->rate = kNativeRate;
    session->native.emplace();
  } else {
    throw DeviceError({address_, "", "no answer", "a CyberGlove interface unit",
                       "Look whether it is switched on, whether the port is the right one, and "
                       "whether both sides use the same baud rate (115200 as delivered)."});
  }
  session->rate = info->rate;
  session_ = std::move(session);
  start_sampling();
  return *info;
}

void CyberGlove::start_sampling() {
  session_->parser.reset();
  session_->unplugged = false;
  session_->last_sign = Clock::now();
  session_->next_poll = session_->last_sign;
  session_->awaits_poll = false;
  if (!settings_.polled && !session_->native) {
    write_text(*session_->link, "S");
  }
}

GloveReading CyberGlove::do_next(milliseconds timeout, const std::stop_token& stop) {
  if (session_->frames.empty() && session_->unplugged) {
    return look_for_glove(timeout, stop);
  }
  return take_frame(timeout, stop);
}

void CyberGlove::poll_when_due(Clock::time_point latest) {
  Session& session = *session_;
  if (!settings_.polled || session.native || session.awaits_poll || session.next_poll > latest) {
    return;
  }
  std::this_thread::sleep_until(session.next_poll);
  write_text(*session.link, "G");
  session.awaits_poll = true;
  const auto period = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(1.0 / settings_.rate));
  session.next_poll = std::max(session.next_poll + period, Clock::now());
}

GloveReading CyberGlove::take_frame(milliseconds timeout, const std::stop_token& stop) {
  Session& session = *session_;
  const auto end = Clock::now() + timeout;
  const auto patience = settings_.timeout + milliseconds(static_cast<int>(3000.0 / session.rate));
  while (session.frames.empty() && !stop.stop_requested()) {
    const auto now = Clock::now();
    if (now >= end) {
      return {};
    }
    const auto left = std::chrono::ceil<milliseconds>(end - now);
    poll_when_due(now + std::min(left, kSlice));
    // The rest of the bytes waits until these frames are taken.
    static_cast<void>(
        read_turn(*session.link, std::min(left, kSlice),
                  [this](std::span<const std::uint8_t> bytes) { take_bytes(bytes); }));
    if (session.too_fast) {
      throw DeviceError({address_, "sampling rate", "a unit that can't keep up",
                         fmt::format("one that samples at {:g} Hz", settings_.rate),
                         "Ask for a lower rate."});
    }
    if (session.frames.empty() && session.unplugged) {
      return {SampleEvent::kUnplugged, {}};
    }
    if (Clock::now() - session.last_sign > patience) {
      throw DeviceError({address_, "", "no frame for " + std::to_string(patience.count()) + " ms",
                         fmt::format("{:g} frames a second", session.rate),
                         "Look whether the interface unit is switched on and connected."});
    }
  }
  if (session.frames.empty()) {
    return {};
  }
  const GloveFrame frame = session.frames.front();
  session.frames.pop_front();
  return {SampleEvent::kSample, frame};
}

void CyberGlove::take_bytes(std::span<const std::uint8_t> bytes) {
  Session& session = *session_;
  const auto arrival = Clock::now();
  for (const std::uint8_t byte : bytes) {
    const auto record = session.native ? session.native->push(byte) : session.parser.push(byte);
    if (!record) {
      continue;
    }
    session.last_sign = arrival;
    session.awaits_poll = false;
    if (record->kind == CyberGloveRecordKind::kSample) {
      session.frames.push_back({since_begin(arrival), record->counts});
    } else {
      session.unplugged |= record->kind == CyberGloveRecordKind::kUnplugged;
      session.too_fast |= record->kind == CyberGloveRecordKind::kTooFast;
    }
  }
}

GloveReading CyberGlove::look_for_glove(milliseconds timeout, const std::stop_token& stop) {
  const auto until = Clock::now() + std::min(timeout, kUnpluggedPeriod);
  session_->commands.stop_stream(stop);
  const std::optional<bool> ready = glove_is_ready(session_->commands, stop);
  if (stop.stop_requested()) {
    return {};
  }
  if (!ready) {
    throw DeviceError({address_, "", "no answer any more", "a CyberGlove interface unit",
                       "Look whether it is switched on and connected."});
  }
  if (*ready) {
    start_sampling();
    return {};
  }
  while (Clock::now() < until && !stop.stop_requested()) {
    std::this_thread::sleep_for(kSlice);
  }
  return {SampleEvent::kUnplugged, {}};
}

void CyberGlove::do_disconnect() noexcept {
  try {
    write_text(*session_->link, "\x03");
  } catch (const std::exception&) {
    // The device is gone already: no stream has to be stopped.
  }
  faults_ = do_faults();
  session_.reset();
}

ReceptionFaults CyberGlove::do_faults() const {
  ReceptionFaults faults = faults_;
  const auto add = [&faults](const auto& parser) {
    faults.resynchronisations += parser.resynchronisations();
    faults.dropped_bytes += parser.dropped_bytes();
  };
  if (session_ && session_->native) {
    add(*session_->native);
  } else if (session_) {
    add(session_->parser);
  }
  return faults;
}

}  // namespace handway::device
