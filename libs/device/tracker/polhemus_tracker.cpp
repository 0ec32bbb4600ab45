#include "handway/device/tracker/polhemus_tracker.h"

#include "core/links.h"
#include "handway/device/core/byte_link.h"
#include "handway/device/core/device_error.h"
#include "handway/device/tracker/polhemus_parser.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <deque>
#include <memory>
#include <span>
#include <stdexcept>
#include <string_view>
#include <thread>

namespace handway::device {
namespace {

/// Commands and record parser of one model of tracker.
class PolhemusProtocol {
 public:
  virtual ~PolhemusProtocol() = default;
  PolhemusProtocol(const PolhemusProtocol&) = delete;
  PolhemusProtocol& operator=(const PolhemusProtocol&) = delete;

  [[nodiscard]] virtual std::string_view name() const = 0;
  /// Command that ends the present activity.
  [[nodiscard]] virtual std::string stop_command() const = 0;
  /// Command that always gets a reply.
  [[nodiscard]] virtual std::string probe_command() const = 0;
  /// Commands that set it up; with a pause between two of them.
  [[nodiscard]] virtual std::vector<std::string> set_up_commands() const = 0;
  [[nodiscard]] virtual std::string start_command() const = 0;

  virtual std::vector<PolhemusRecord> parse(std::span<const std::uint8_t> bytes) = 0;
  /// Discards the beginning of an incomplete record.
  virtual void reset() = 0;
  /// `doubtful` is left at 0.
  [[nodiscard]] virtual ReceptionFaults faults() const = 0;

 protected:
  PolhemusProtocol() = default;
};

constexpr int kFastrakStations = 4;

FastrakFormat fastrak_format(const PolhemusSettings& settings) {
  FastrakFormat format;
  format.items = settings.ascii ? OutputList{2, 4} : OutputList{2, 11};
  if (settings.button) {
    format.items.push_back(16);
  }
  format.items.push_back(settings.ascii ? 1 : 0);
  format.binary = !settings.ascii;
  return format;
}

LibertyFormat liberty_format(const PolhemusSettings& settings) {
  LibertyFormat format;
  if (settings.button) {
    format.items.push_back(10);
  }
  return format;
}

template <typename Parser>
class ParsedProtocol : public PolhemusProtocol {
 public:
  std::vector<PolhemusRecord> parse(std::span<const std::uint8_t> bytes) override {
    return parser_.push(bytes);
  }
  void reset() override { parser_.reset(); }
  [[nodiscard]] ReceptionFaults faults() const override {
    return {parser_.resynchronisations(), parser_.dropped_bytes(), 0};
  }

 protected:
  explicit ParsedProtocol(Parser parser) : parser_(std::move(parser)) {}

 private:
  Parser parser_;
};

class FastrakProtocol final : public ParsedProtocol<FastrakParser> {
 public:
  explicit FastrakProtocol(const PolhemusSettings& settings)
      : ParsedProtocol(FastrakParser(fastrak_format(settings))),
        format_(fastrak_format(settings)) {}

  [[nodiscard]] std::string_view name() const override {
    return format_.binary ? "Polhemus Fastrak, binary" : "Polhemus Fastrak, ASCII";
  }
  // The return ends a command that another program left unfinished.
  [[nodiscard]] std::string stop_command() const override { return "\rc"; }
  [[nodiscard]] std::string probe_command() const override { return "S"; }
  [[nodiscard]] std::vector<std::string> set_up_commands() const override {
    std::vector<std::string> commands{"U"};
    for (int station = 1; station <= kFastrakStations; ++station) {
      commands.push_back(fmt::format("O{},{}\r", station, fmt::join(format_.items, ",")));
    }
    commands.emplace_back(format_.binary ? "f" : "F");
    return commands;
  }
  [[nodiscard]] std::string start_command() const override { return "C"; }

 private:
  FastrakFormat format_;
};

class LibertyProtocol final : public ParsedProtocol<LibertyParser> {
 public:
  explicit LibertyProtocol(const PolhemusSettings& settings)
      : ParsedProtocol(LibertyParser(liberty_format(settings))),
        format_(liberty_format(settings)) {}

  [[nodiscard]] std::string_view name() const override { return "Polhemus Liberty"; }
  // The return ends a command that another program left unfinished.
  [[nodiscard]] std::string stop_command() const override { return "\rPF1\r"; }
  [[nodiscard]] std::string probe_command() const override {
    return "\x15"
           "0\r";
  }
  [[nodiscard]] std::vector<std::string> set_up_commands() const override {
    return {"U0\r", fmt::format("O*,{}\r", fmt::join(format_.items, ",")), "Q0\r"};
  }
  [[nodiscard]] std::string start_command() const override { return "C\r"; }

 private:
  LibertyFormat format_;
};

std::unique_ptr<PolhemusProtocol> make_polhemus_protocol(const PolhemusSettings& settings) {
  if (settings.model == PolhemusModel::kFastrak) {
    return std::make_unique<FastrakProtocol>(settings);
  }
  if (settings.ascii) {
    throw std::invalid_argument("a Liberty is read in binary only");
  }
  return std::make_unique<LibertyProtocol>(settings);
}

using std::chrono::milliseconds;

constexpr milliseconds kReadSlice{20};
// A Fastrak needs some time after each command.
constexpr milliseconds kCommandPause{20};
// Silence that means the end of the stream.
constexpr milliseconds kQuiet{60};
constexpr int kTries = 3;

}  // namespace

struct PolhemusTracker::Session {
  std::unique_ptr<ByteLink> link;
  std::unique_ptr<PolhemusProtocol> protocol;
  std::deque<TrackerSample> samples;  ///< Arrived and not yet taken.
  std::uint64_t doubtful = 0;
  std::uint64_t replies = 0;
  Clock::time_point last_pose;   ///< Time of the last data record, or of the first expected one.
  Clock::time_point last_reply;  ///< Time of its last answer.
  Clock::time_point last_probe;
  bool unplugged = false;

  void send(const std::string& command) const {
    link->write({reinterpret_cast<const std::uint8_t*>(command.data()), command.size()});
  }

  void drain(milliseconds at_most, const std::stop_token& stop) const {
    std::array<std::uint8_t, 1024> bytes{};
    const auto end = Clock::now() + at_most;
    while (link->read(bytes, kQuiet) > 0 && Clock::now() < end && !stop.stop_requested()) {
    }
    protocol->reset();
  }
};

PolhemusTracker::PolhemusTracker(std::string address, const PolhemusSettings& settings)
    : address_(std::move(address)), settings_(settings) {
  (void)make_polhemus_protocol(settings);  // Refuses what there isn't.
}

PolhemusTracker::~PolhemusTracker() { disconnect(); }

void PolhemusTracker::take_records(milliseconds timeout) {
  // The rest of the bytes waits until these samples are taken.
  static_cast<void>(
      read_turn(*session_->link, timeout, [this](std::span<const std::uint8_t> bytes) {
        const auto arrival = Clock::now();
        for (const PolhemusRecord& record : session_->protocol->parse(bytes)) {
          take(record, arrival);
        }
      }));
}

void PolhemusTracker::take(const PolhemusRecord& record, Clock::time_point arrival) {
  Session& session = *session_;
  switch (record.kind) {
    case PolhemusRecordKind::kPose:
      session.samples.push_back({since_begin(arrival), record.station, record.X_ST, record.button});
      session.last_pose = arrival;
      session.unplugged = false;
      break;
    case PolhemusRecordKind::kDoubtful:
      ++session.doubtful;
      session.last_pose = arrival;
      break;
    case PolhemusRecordKind::kReply:
      ++session.replies;
      session.last_reply = arrival;
      break;
  }
}

void PolhemusTracker::wait_for_answer(const std::stop_token& stop) {
  Session& session = *session_;
  for (int k = 0; k < kTries; ++k) {
    session.send(session.protocol->probe_command());
    const auto end = Clock::now() + settings_.timeout;
    while (Clock::now() < end && !stop.stop_requested()) {
      take_records(kReadSlice);
      if (session.replies > 0) {
        return;
      }
    }
  }
  throw DeviceError({address_, "", "no answer", std::string(session.protocol->name()),
                     "Look whether the unit is switched on, this is its port, and the baud rate is "
                     "that of its switches."});
}

TrackerInfo PolhemusTracker::do_connect(const std::stop_token& stop) {
  session_.reset();  // Its port is needed.
  auto link = open_link(address_, settings_.baud, stop);
  session_ = std::make_unique<Session>();
  session_->link = std::move(link);
  session_->protocol = make_polhemus_protocol(settings_);
  try {
    session_->send(session_->protocol->stop_command());
    session_->drain(settings_.timeout, stop);
    wait_for_answer(stop);
    for (const std::string& command : session_->protocol->set_up_commands()) {
      session_->send(command);
      std::this_thread::sleep_for(kCommandPause);
    }
    session_->drain(settings_.timeout, stop);
    session_->samples.clear();
    session_->send(session_->protocol->start_command());
  } catch (...) {
    session_.reset();
    throw;
  }
  session_->last_pose = session_->last_reply = session_->last_probe = Clock::now();
  return {address_, std::string(session_->protocol->name())};
}

// Called after too long a silence. @returns whether the unit is alive, as far as is known yet.
bool PolhemusTracker::look_for_life(Clock::time_point now) {
  Session& session = *session_;
  if (now - session.last_probe > settings_.timeout / 4) {
    session.last_probe = now;
    session.send(session.protocol->probe_command());
  }
  session.unplugged |= session.last_reply > session.last_pose + settings_.timeout;
  return now - std::max(session.last_reply, session.last_pose) < 2 * settings_.timeout;
}

TrackerReading PolhemusTracker::do_next(milliseconds timeout, const std::stop_token& stop) {
  Session& session = *session_;
  const auto end = Clock::now() + timeout;
  while (session.samples.empty() && !stop.stop_requested()) {
    const auto now = Clock::now();
    const auto left = std::chrono::ceil<milliseconds>(end - now);
    take_records(std::clamp(left, milliseconds(0), kReadSlice));
    if (!session.samples.empty()) {
      break;
    }
    if (now - session.last_pose > settings_.timeout && !look_for_life(now)) {
      throw DeviceError({address_, "", "no answer any more", std::string(session.protocol->name()),
                         "Look whether it is switched on and connected."});
    }
    if (now >= end) {
      return {session.unplugged ? SampleEvent::kUnplugged : SampleEvent::kNothing, {}};
    }
  }
  if (session.samples.empty()) {
    return {};
  }
  const TrackerSample sample = session.samples.front();
  session.samples.pop_front();
  return {SampleEvent::kSample, sample};
}

void PolhemusTracker::do_disconnect() noexcept {
  try {
    session_->send(session_->protocol->stop_command());
  } catch (const std::exception&) {
    // The device is gone already: no stream has to be stopped.
  }
  faults_ = do_faults();
  session_.reset();
}

ReceptionFaults PolhemusTracker::do_faults() const {
  ReceptionFaults faults = faults_;
  if (session_) {
    const ReceptionFaults now = session_->protocol->faults();
    faults.resynchronisations += now.resynchronisations;
    faults.dropped_bytes += now.dropped_bytes;
    faults.doubtful += session_->doubtful;
  }
  return faults;
}

}  // namespace handway::device
