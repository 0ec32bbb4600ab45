#include "tracker_live.h"

#include "exit_codes.h"
#include "handway/device/core/device_error.h"
#include "handway/device/tracker/polhemus_tracker.h"
#include "handway/device/tracker/pose_datagram.h"
#include "handway/device/tracker/udp_tracker.h"
#include "handway/geometric/io/input_error.h"
#include "interrupt.h"
#include "terminal_table.h"
#include "tracker_display.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <map>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>

namespace handway::tools {
namespace {

using device::Tracker;
using device::TrackerEvent;
using device::TrackerReading;
using device::TrackerSample;
using std::chrono::milliseconds;

constexpr milliseconds kWait{50};
constexpr milliseconds kReconnect{500};
constexpr double kRefresh = 0.1;  // s

struct LiveOptions {
  std::string device;
  std::string protocol = "fastrak";
  int baud = 115200;
  bool ascii = false;
  bool button = false;
  std::uint64_t samples = 0;  ///< 0: until Ctrl+C.
  bool json = false;
};

std::unique_ptr<Tracker> make_tracker(const LiveOptions& options) {
  if (options.protocol == "udp") {
    return std::make_unique<device::UdpTracker>(options.device);
  }
  device::PolhemusSettings settings;
  settings.model = options.protocol == "liberty" ? device::PolhemusModel::kLiberty
                                                 : device::PolhemusModel::kFastrak;
  settings.baud = options.baud;
  settings.ascii = options.ascii;
  settings.button = options.button;
  if (settings.ascii && settings.model == device::PolhemusModel::kLiberty) {
    throw geometric::InputError({"--ascii", "", "a Liberty", "a Fastrak",
                                 "A Liberty is read in binary: leave --ascii out."});
  }
  return std::make_unique<device::PolhemusTracker>(options.device, settings);
}

/// Shows samples as they come.
class Live {
 public:
  explicit Live(const LiveOptions& options)
      : options_(options),
        table_(!options.json && ::isatty(STDOUT_FILENO) != 0),
        tracker_(make_tracker(options)) {}

  /// @throws DeviceError if there is no tracker at the start.
  void run(const std::stop_token& stop) {
    connect(stop);
    while (!stop.stop_requested() && !complete()) {
      try {
        if (!tracker_->connected()) {
          connect(stop);
        }
        take(tracker_->next(kWait, stop));
      } catch (const device::DeviceError&) {
        enter("lost");
        tracker_->disconnect();
        std::this_thread::sleep_for(kReconnect);
      }
      refresh();
    }
    const device::StreamStatistics statistics = counter_.at(tracker_->now());
    if (options_.json) {
      print_line(tracker_statistics_json(statistics, tracker_->faults()));
    } else {
      fmt::print(stderr, "{}\n", tracker_statistics_line(statistics, tracker_->faults()));
    }
  }

 private:
  [[nodiscard]] bool complete() const { return options_.samples > 0 && count_ == options_.samples; }

  void connect(const std::stop_token& stop) {
    const device::TrackerInfo info = tracker_->connect(stop);
    counter_.connected(0.0, 0.0);
    fmt::print(stderr, "{}: {}\n", info.device, info.model);
  }

  void enter(const char* state) {
    if (!table_ && std::string(state) != state_ && std::string(state) != "streaming") {
      fmt::print(stderr, "{}\n", state);
    }
    state_ = state;
  }

  void take(const TrackerReading& reading) {
    if (reading.event == TrackerEvent::kUnplugged) {
      enter("unplugged");
    }
    if (reading.event != TrackerEvent::kSample) {
      return;
    }
    enter("streaming");
    ++count_;
    sensors_[reading.sample.sensor] = reading.sample;
    if (!table_) {
      print_line(options_.json ? write_pose_datagram(reading.sample) : sample_line(reading.sample));
    }
    counter_.frame(reading.sample.time, tracker_->now());
  }

  void refresh() {
    const double now = tracker_->now();
    if (!table_ || sensors_.empty() || now < next_refresh_) {
      return;
    }
    next_refresh_ = now + kRefresh;
    print_table(tracker_table(sensors_, state_.c_str(), counter_.at(now), tracker_->faults()),
                shown_ != sensors_.size());
    shown_ = sensors_.size();
  }

  const LiveOptions& options_;
  bool table_;
  std::unique_ptr<Tracker> tracker_;
  device::StreamStatisticsCounter counter_;
  std::map<int, TrackerSample> sensors_;  ///< Last sample of each.
  std::size_t shown_ = 0;                 ///< Sensors of the table printed last.
  std::uint64_t count_ = 0;
  std::string state_;
  double next_refresh_ = 0.0;
};

int show(const LiveOptions& options) {
  std::stop_source stop;
  const StopsOnInterrupt guard(stop);
  Live(options).run(stop.get_token());
  return kDone;
}

}  // namespace

void add_tracker_live(CLI::App& tracker, int& exit_code) {
  auto options = std::make_shared<LiveOptions>();
  CLI::App* command = tracker.add_subcommand("live", "Show what a tracker measures");
  command
      ->add_option(
          "--device", options->device,
          "Serial port (/dev/ttyUSB0) or HOST:PORT; with udp PORT or HOST:PORT to listen on")
      ->required();
  command->add_option("--protocol", options->protocol, "fastrak, liberty or udp")
      ->check(CLI::IsMember({"fastrak", "liberty", "udp"}))
      ->capture_default_str();
  command->add_option("--baud", options->baud, "Speed of a serial port, bit/s")
      ->check(CLI::Range(1200, 921600))
      ->capture_default_str();
  command->add_flag("--ascii", options->ascii, "Text records instead of binary ones (fastrak)");
  command->add_flag("--button", options->button, "Ask for the switch of a stylus, too");
  command->add_option("--samples", options->samples, "Stop after so many samples")
      ->check(CLI::PositiveNumber);
  command->add_flag("--json", options->json, "One JSON object a line instead of a table");
  command->callback([options, &exit_code] { exit_code = show(*options); });
}

}  // namespace handway::tools
