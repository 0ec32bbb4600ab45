#include "handway/device/glove/cyberglove.h"

#include "core/bounded_read.h"
#include "cyberglove_setup.h"
#include "handway/device/core/device_error.h"
#include "handway/device/glove/cyberglove_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <span>
#include <stdexcept>
#include <thread>

namespace handway::device {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kSlice{20};
// How often the unit is asked whether its glove is back.
constexpr milliseconds kUnpluggedPeriod{250};

CyberGloveFormat format_of(int sensors) {
  CyberGloveFormat format;
  format.sensors = sensors;
  return format;
}

}  // namespace

struct CyberGlove::Session {
  Session(std::unique_ptr<ByteLink> opened, milliseconds timeout)
      : link(std::move(opened)), commands(*link, timeout), parser(CyberGloveFormat{}) {}

  std::unique_ptr<ByteLink> link;
  CyberGloveCommands commands;
  CyberGloveParser parser;
  std::deque<GloveFrame> frames;  ///< Arrived and not yet taken.
  bool unplugged = false;
  bool too_fast = false;
  Clock::time_point last_sign;  ///< When the last record came, or sampling began.
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
  GloveInfo info = set_up_cyberglove(session->commands, address_, settings_, stop);
  session->parser = CyberGloveParser(format_of(info.sensors));
  session_ = std::move(session);
  start_sampling();
  return info;
}

void CyberGlove::start_sampling() {
  session_->parser.reset();
  session_->unplugged = false;
  session_->last_sign = Clock::now();
  session_->next_poll = session_->last_sign;
  session_->awaits_poll = false;
  if (!settings_.polled) {
    const std::uint8_t stream = 'S';
    session_->link->write({&stream, 1});
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
  if (!settings_.polled || session.awaits_poll || session.next_poll > latest) {
    return;
  }
  std::this_thread::sleep_until(session.next_poll);
  const std::uint8_t poll = 'G';
  session.link->write({&poll, 1});
  session.awaits_poll = true;
  const auto period = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(1.0 / settings_.rate));
  session.next_poll = std::max(session.next_poll + period, Clock::now());
}

GloveReading CyberGlove::take_frame(milliseconds timeout, const std::stop_token& stop) {
  Session& session = *session_;
  const auto end = Clock::now() + timeout;
  const auto patience = settings_.timeout + milliseconds(static_cast<int>(3000.0 / settings_.rate));
  while (session.frames.empty() && !stop.stop_requested()) {
    const auto now = Clock::now();
    if (now >= end) {
      return {};
    }
    const auto left = std::chrono::ceil<milliseconds>(end - now);
    poll_when_due(now + std::min(left, kSlice));
    // What is left for the next turn waits until these frames are taken.
    static_cast<void>(
        read_turn(*session.link, std::min(left, kSlice),
                  [this](std::span<const std::uint8_t> bytes) { take_bytes(bytes); }));
    if (session.too_fast) {
      throw DeviceError({address_, "sampling rate", "a unit that can't keep up",
                         fmt::format("one that samples at {:g} Hz", settings_.rate),
                         "Ask for a lower rate."});
    }
    if (session.frames.empty() && session.unplugged) {
      return {GloveEvent::kUnplugged, {}};
    }
    if (Clock::now() - session.last_sign > patience) {
      throw DeviceError({address_, "", "no frame for " + std::to_string(patience.count()) + " ms",
                         fmt::format("{:g} frames a second", settings_.rate),
                         "Look whether the interface unit is switched on and connected."});
    }
  }
  if (session.frames.empty()) {
    return {};
  }
  const GloveFrame frame = session.frames.front();
  session.frames.pop_front();
  return {GloveEvent::kFrame, frame};
}

void CyberGlove::take_bytes(std::span<const std::uint8_t> bytes) {
  Session& session = *session_;
  const auto arrival = Clock::now();
  for (const std::uint8_t byte : bytes) {
    const auto record = session.parser.push(byte);
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
  return {GloveEvent::kUnplugged, {}};
}

void CyberGlove::add_faults() noexcept {
  faults_.resynchronisations += session_->parser.resynchronisations();
  faults_.dropped_bytes += session_->parser.dropped_bytes();
}

void CyberGlove::do_disconnect() noexcept {
  try {
    const std::uint8_t control_c = 0x03;
    session_->link->write({&control_c, 1});
  } catch (const std::exception&) {
    // The device is gone already: there is no stream to be stopped.
  }
  add_faults();
  session_.reset();
}

GloveLineFaults CyberGlove::do_line_faults() const {
  GloveLineFaults faults = faults_;
  if (session_) {
    faults.resynchronisations += session_->parser.resynchronisations();
    faults.dropped_bytes += session_->parser.dropped_bytes();
  }
  return faults;
}

}  // namespace handway::device
