#include "glove_display.h"

#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/math/units.h"

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

/// What a frame has of a sensor: its angle in degrees, or nothing, of a source of angles.
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
  return nlohmann::ordered_json{{"time", frame.time}, {frame.angles ? "angles" : "counts", values}}
      .dump();
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

}  // namespace handway::tools
