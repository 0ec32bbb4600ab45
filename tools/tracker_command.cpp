#include "commands.h"
#include "emulated_device.h"
#include "handway/device/core/device_error.h"
#include "handway/device/core/device_stream.h"
#include "handway/device/emulators/tracker_signals.h"
#include "handway/device/emulators/tracker_units.h"
#include "handway/device/tracker/polhemus_tracker.h"
#include "handway/device/tracker/tracker.h"
#include "handway/device/tracker/udp_tracker.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "numbers.h"
#include "printing.h"
#include "terminal.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <chrono>
#include <map>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>

namespace handway::tools {
namespace {

using device::ReceptionFaults;
using device::StreamStatistics;
using device::TrackerSample;

char button_sign(const TrackerSample& sample) {
  if (!sample.button) {
    return '-';
  }
  return *sample.button ? '1' : '0';
}

/// "120.0 Hz, 1234 samples, …".
std::string tracker_statistics_line(const StreamStatistics& s, const ReceptionFaults& faults) {
  return fmt::format(
      "{:.1f} Hz, {} samples, jitter {:.1f} ms, longest gap {:.0f} ms, {} resyncs, {} doubtful, "
      "{} reconnects",
      s.rate, s.frames, s.jitter * 1000.0, s.longest_gap * 1000.0, faults.resynchronisations,
      faults.doubtful, s.reconnects);
}

/// Every sensor's last pose (mm, deg) and button; below them the state of the stream.
std::string tracker_table(const std::map<int, TrackerSample>& sensors, const char* state,
                          const StreamStatistics& statistics, const ReceptionFaults& faults) {
  std::string text = fmt::format("{:<7}{:>9}{:>9}{:>9}{:>10}{:>11}{:>8}{:>8}\n", "sensor", "x mm",
                                 "y mm", "z mm", "azimuth", "elevation", "roll", "button");
  for (const auto& [number, sample] : sensors) {
    const Eigen::Vector3d p = sample.X_ST.translation() / geometric::kMillimetre;
    const Eigen::Vector3d rpy =
        geometric::rpy_from_rotation(sample.X_ST.linear()) / geometric::kDegree;
    text += fmt::format("{:<7}{:>9.1f}{:>9.1f}{:>9.1f}{:>10.1f}{:>11.1f}{:>8.1f}{:>8}\n", number,
                        p.x(), p.y(), p.z(), rpy[2], rpy[1], rpy[0], button_sign(sample));
  }
  return text + fmt::format("{}: {}\n", state, tracker_statistics_line(statistics, faults));
}

/// Time, sensor, position (m), quaternion (x y z w) and button (0, 1 or -) of a sample.
std::string sample_line(const TrackerSample& sample) {
  const Eigen::Vector3d p = sample.X_ST.translation();
  const Eigen::Quaterniond q(sample.X_ST.linear());
  return fmt::format("{:9.3f} {:2} {:8.4f} {:8.4f} {:8.4f} {:8.5f} {:8.5f} {:8.5f} {:8.5f} {}",
                     sample.time, sample.sensor, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w(),
                     button_sign(sample));
}

/// {"statistics": {…}} on one line.
std::string tracker_statistics_json(const StreamStatistics& s, const ReceptionFaults& faults) {
  const nlohmann::ordered_json numbers{{"samples", s.frames},
                                       {"rate_hz", s.rate},
                                       {"jitter_s", s.jitter},
                                       {"longest_gap_s", s.longest_gap},
                                       {"resynchronisations", faults.resynchronisations},
                                       {"doubtful", faults.doubtful},
                                       {"reconnects", s.reconnects}};
  return nlohmann::ordered_json{{"statistics", numbers}}.dump();
}

struct EmulateOptions {
  ServeOptions serve;
  std::string protocol = "fastrak";
  std::string receiver;
  device::TrackerUnitSettings unit;
  std::uint64_t seed = 1;
  double position_noise_mm = 0.2;
  double angle_noise_deg = 0.03;
  LineFaultOptions faults;
};

std::unique_ptr<device::DeviceUnit> make_unit(const EmulateOptions& options) {
  const device::TrackerNoise noise{options.position_noise_mm * geometric::kMillimetre,
                                   options.angle_noise_deg * geometric::kDegree};
  const device::TrackerSignal signal = wrist_motion_signal(options.seed, noise);
  try {
    if (options.protocol == "udp") {
      return make_datagram_unit(options.unit, signal);
    }
    return options.protocol == "liberty" ? make_liberty_unit(options.unit, signal)
                                         : make_fastrak_unit(options.unit, signal);
  } catch (const std::invalid_argument& problem) {
    throw geometric::InputError({"--sensors", "", std::to_string(options.unit.sensors),
                                 problem.what(), "Use fewer, or another --protocol."});
  }
}

int emulate(const EmulateOptions& options) {
  device::DeviceEmulatorSettings settings = emulator_settings(options.faults, options.seed);
  if (options.protocol == "udp") {
    if (options.receiver.empty()) {
      throw geometric::InputError({"--to", "", "nothing", "HOST:PORT or PORT to send poses to",
                                   "Write, for example, --to 5005."});
    }
    settings.udp_receiver = options.receiver;
  }
  return serve_device(settings, make_unit(options), options.serve);
}

/// handway tracker emulate: an emulated tracker on a pseudo-terminal, a TCP port or by UDP.
void add_tracker_emulate(CLI::App& tracker, int& exit_code) {
  auto options = std::make_shared<EmulateOptions>();
  CLI::App* command = tracker.add_subcommand(
      "emulate", "Emulate a wrist tracker; the first line of output is its address");
  CLI::Option* tcp = add_serve_options(*command, options->serve);
  command->add_option("--protocol", options->protocol, "fastrak, liberty or udp")
      ->check(CLI::IsMember({"fastrak", "liberty", "udp"}))
      ->capture_default_str();
  command
      ->add_option("--to", options->receiver,
                   "With udp: destination HOST:PORT, or PORT of this computer")
      ->excludes(tcp);
  command->add_option("--sensors", options->unit.sensors, "Number of sensors")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_option("--rate", options->unit.rate, "Poses per second")
      ->check(CLI::Range(0.5, 1000.0))
      ->capture_default_str();
  command->add_flag("--button", options->unit.button,
                    "Add a button to the first sensor; it is pressed every other second");
  command->add_option("--seed", options->seed, "Seed of the wrist's motion and of all faults")
      ->check(not_negative())
      ->capture_default_str();
  command->add_option("--position-noise", options->position_noise_mm, "Noise of positions, mm")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command->add_option("--angle-noise", options->angle_noise_deg, "Noise of orientations, deg")
      ->check(CLI::Range(0.0, 30.0))
      ->capture_default_str();
  add_line_fault_options(*command, options->faults);
  command->callback([options, &exit_code] { exit_code = emulate(*options); });
}

using device::SampleEvent;
using device::Tracker;
using device::TrackerReading;
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
    throw geometric::InputError(
        {"--ascii", "", "a Liberty", "a Fastrak", "A Liberty is read in binary: omit --ascii."});
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

  /// @throws DeviceError if the tracker is missing at the start.
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
      print_error("{}\n", tracker_statistics_line(statistics, tracker_->faults()));
    }
  }

 private:
  [[nodiscard]] bool complete() const { return options_.samples > 0 && count_ == options_.samples; }

  void connect(const std::stop_token& stop) {
    const device::TrackerInfo info = tracker_->connect(stop);
    counter_.connected(0.0, 0.0);
    print_error("{}: {}\n", info.device, info.model);
  }

  void enter(const char* state) {
    if (!table_ && std::string(state) != state_ && std::string(state) != "streaming") {
      print_error("{}\n", state);
    }
    state_ = state;
  }

  void take(const TrackerReading& reading) {
    if (reading.event == SampleEvent::kUnplugged) {
      enter("unplugged");
    }
    if (reading.event != SampleEvent::kSample) {
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

/// handway tracker live: a tracker's measurements as they come.
void add_tracker_live(CLI::App& tracker, int& exit_code) {
  auto options = std::make_shared<LiveOptions>();
  CLI::App* command = tracker.add_subcommand("live", "Show the measurements of a tracker");
  command
      ->add_option(
          "--device", options->device,
          "Serial port (/dev/ttyUSB0) or HOST:PORT; with udp the PORT or HOST:PORT to listen on")
      ->required();
  command->add_option("--protocol", options->protocol, "fastrak, liberty or udp")
      ->check(CLI::IsMember({"fastrak", "liberty", "udp"}))
      ->capture_default_str();
  command->add_option("--baud", options->baud, "Speed of a serial port, bit/s")
      ->check(CLI::Range(1200, 921600))
      ->capture_default_str();
  command->add_flag("--ascii", options->ascii,
                    "Text records instead of binary ones (fastrak only)");
  command->add_flag("--button", options->button, "Request the switch of a stylus, too");
  command->add_option("--samples", options->samples, "Stop after this number of samples")
      ->check(CLI::PositiveNumber);
  command->add_flag("--json", options->json, "Print one JSON object per line instead of a table");
  command->callback([options, &exit_code] { exit_code = show(*options); });
}

}  // namespace

void add_tracker_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("tracker", "Read a wrist tracker, or emulate one");
  command->require_subcommand(1);
  add_tracker_emulate(*command, exit_code);
  add_tracker_live(*command, exit_code);
}

}  // namespace handway::tools
