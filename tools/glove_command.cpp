#include "commands.h"
#include "glove_commands.h"
#include "handway/device/glove/cyberglove.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/landmark_glove.h"
#include "handway/geometric/math/units.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace handway::tools {
namespace {

using device::GloveFrame;
using device::StreamStatistics;

// A row fills a terminal of 80 columns.
constexpr int kBarWidth = 20;

std::uint16_t count_of(const GloveFrame& frame, int sensor) {
  return frame.counts[static_cast<std::size_t>(sensor)];
}

/// Returns a sensor's angle in a frame in degrees; nothing unless the source measures angles.
std::optional<double> degrees_of(const GloveFrame& frame, int sensor) {
  const double angle = frame.angles ? frame.angles->at(static_cast<std::size_t>(sensor))
                                    : std::numeric_limits<double>::quiet_NaN();
  return std::isfinite(angle) ? std::optional(angle / geometric::kDegree) : std::nullopt;
}

std::string bar(int count) {
  const int filled = std::clamp(count * kBarWidth / 255, 0, kBarWidth);
  return std::string(static_cast<std::size_t>(filled), '#') +
         std::string(static_cast<std::size_t>(kBarWidth - filled), '.');
}

// Sensors that read the end of their scale most likely are out of range or broken.
const char* remark(int count) { return count <= 1 || count >= 255 ? "saturated" : ""; }

double in_milliseconds(double seconds) { return seconds * 1000.0; }

std::string timing_text(const StreamStatistics& s) {
  return fmt::format("{:.1f} Hz, {} frames, round trip {:.1f} ms, jitter {:.1f} ms", s.rate,
                     s.frames, in_milliseconds(s.latency), in_milliseconds(s.jitter));
}

std::string fault_text(const StreamStatistics& s) {
  return fmt::format("{} dropouts, longest gap {:.0f} ms, {} resyncs, {} reconnects", s.dropouts,
                     in_milliseconds(s.longest_gap), s.resynchronisations, s.reconnects);
}

}  // namespace

std::string glove_table(const GloveFrame& frame, int sensors, device::StreamState state,
                        const StreamStatistics& statistics) {
  std::string text =
      fmt::format("{:<20}{:<18}{:>6}\n", "sensor", "", frame.angles ? "deg" : "counts");
  for (const int sensor : device::cyberglove_wired(sensors)) {
    const device::GloveSensor& which =
        device::cyberglove_sensors()[static_cast<std::size_t>(sensor)];
    const int count = count_of(frame, sensor);
    if (frame.angles) {
      if (const std::optional<double> degrees = degrees_of(frame, sensor)) {
        text += fmt::format("{} {:<18}{:<18}{:>6.1f}  {} {:<9}\n", which.letter, which.label,
                            which.name, *degrees, bar(count), "");
      }
      continue;
    }
    text += fmt::format("{} {:<18}{:<18}{:>6}  {} {:<9}\n", which.letter, which.label, which.name,
                        count, bar(count), remark(count));
  }
  text += fmt::format("{:<10} {}\n{}\n", state_name(state), timing_text(statistics),
                      fault_text(statistics));
  return text;
}

std::string statistics_line(const StreamStatistics& statistics) {
  return timing_text(statistics) + ", " + fault_text(statistics);
}

std::string frame_line(const GloveFrame& frame, int sensors) {
  std::string text = fmt::format("{:9.3f}", frame.time);
  for (const int sensor : device::cyberglove_wired(sensors)) {
    if (!frame.angles) {
      text += fmt::format(" {:3}", count_of(frame, sensor));
    } else if (const std::optional<double> degrees = degrees_of(frame, sensor)) {
      text += fmt::format(" {:6.1f}", *degrees);
    }
  }
  return text;
}

std::string frame_json(const GloveFrame& frame, int sensors) {
  nlohmann::ordered_json values;
  for (const int sensor : device::cyberglove_wired(sensors)) {
    const std::string name(device::cyberglove_sensors()[static_cast<std::size_t>(sensor)].name);
    if (!frame.angles) {
      values[name] = count_of(frame, sensor);
    } else if (degrees_of(frame, sensor)) {
      values[name] = frame.angles->at(static_cast<std::size_t>(sensor));
    }
  }
  nlohmann::ordered_json object{{"time", frame.time}, {frame.angles ? "angles" : "counts", values}};
  if (frame.X_SH) {
    const Eigen::Vector3d p = frame.X_SH->translation();
    const Eigen::Quaterniond q(frame.X_SH->linear());
    object["wrist"] = {{"position", {p.x(), p.y(), p.z()}},
                       {"quaternion", {q.x(), q.y(), q.z(), q.w()}}};
  }
  return object.dump();
}

std::string statistics_json(const StreamStatistics& s) {
  const nlohmann::ordered_json numbers{{"frames", s.frames},
                                       {"rate_hz", s.rate},
                                       {"jitter_s", s.jitter},
                                       {"round_trip_s", s.latency},
                                       {"handling_s", s.handling},
                                       {"dropouts", s.dropouts},
                                       {"longest_gap_s", s.longest_gap},
                                       {"resynchronisations", s.resynchronisations},
                                       {"reconnects", s.reconnects}};
  return nlohmann::ordered_json{{"statistics", numbers}}.dump();
}

void add_glove_device_options(CLI::App& command, GloveDeviceOptions& options) {
  command
      .add_option(
          "--device", options.device,
          "Serial port (/dev/ttyUSB0) or HOST:PORT of a CyberGlove; udp://PORT to receive "
          "hands of a headset, a camera, Rokoko Studio or Manus Core, landmarks://HOST:PORT "
          "to fetch them, pipe://PATH or - (standard input) to read them from a pipe")
      ->required();
  command.add_option("--rate", options.rate_hz, "Frames per second to request")
      ->check(CLI::Range(0.5, 480.0))
      ->capture_default_str();
  command.add_option("--baud", options.baud, "Speed of a serial port, bit/s")
      ->check(CLI::Range(1200, 921600))
      ->capture_default_str();
  command.add_flag("--poll", options.poll,
                   "Request every frame instead of letting the glove stream");
  command
      .add_option("--hand", options.hand,
                  "With hands of other programs: left or right hand (default: the first that is "
                  "detected)")
      ->check(CLI::IsMember({"left", "right"}));
}

std::unique_ptr<device::Glove> make_glove(const GloveDeviceOptions& options) {
  if (device::is_landmark_address(options.device)) {
    return std::make_unique<device::LandmarkGlove>(
        options.device, device::LandmarkGloveSettings{options.hand.empty()
                                                          ? std::nullopt
                                                          : std::optional(options.hand == "left")});
  }
  device::CyberGloveSettings settings;
  settings.rate = options.rate_hz;
  settings.baud = options.baud;
  settings.polled = options.poll;
  return std::make_unique<device::CyberGlove>(options.device, settings);
}

void add_glove_command(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("glove", "Read, record and calibrate sensor gloves, or emulate one");
  command->require_subcommand(1);
  add_glove_calibrate(*command, exit_code);
  add_glove_emulate(*command, exit_code);
  add_glove_generate(*command, exit_code);
  add_glove_live(*command, exit_code);
  add_glove_map(*command, exit_code);
  add_glove_record(*command, exit_code);
  add_glove_replay(*command, exit_code);
}

}  // namespace handway::tools
