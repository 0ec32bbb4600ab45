#include "tracker_display.h"

#include "handway/geometric/math/units.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace handway::tools {
namespace {

using device::StreamStatistics;
using device::TrackerFaults;
using device::TrackerSample;

char button_sign(const TrackerSample& sample) {
  if (!sample.button) {
    return '-';
  }
  return *sample.button ? '1' : '0';
}

}  // namespace

std::string tracker_table(const std::map<int, TrackerSample>& sensors, const char* state,
                          const StreamStatistics& statistics, const TrackerFaults& faults) {
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

std::string tracker_statistics_line(const StreamStatistics& s, const TrackerFaults& faults) {
  return fmt::format(
      "{:.1f} Hz, {} samples, jitter {:.1f} ms, longest gap {:.0f} ms, {} resyncs, {} doubtful, "
      "{} reconnects",
      s.rate, s.frames, s.jitter * 1000.0, s.longest_gap * 1000.0, faults.resynchronisations,
      faults.doubtful, s.reconnects);
}

std::string sample_line(const TrackerSample& sample) {
  const Eigen::Vector3d p = sample.X_ST.translation();
  const Eigen::Quaterniond q(sample.X_ST.linear());
  return fmt::format("{:9.3f} {:2} {:8.4f} {:8.4f} {:8.4f} {:8.5f} {:8.5f} {:8.5f} {:8.5f} {}",
                     sample.time, sample.sensor, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w(),
                     button_sign(sample));
}

std::string tracker_statistics_json(const StreamStatistics& s, const TrackerFaults& faults) {
  const nlohmann::ordered_json numbers{{"samples", s.frames},
                                       {"rate_hz", s.rate},
                                       {"jitter_s", s.jitter},
                                       {"longest_gap_s", s.longest_gap},
                                       {"resynchronisations", faults.resynchronisations},
                                       {"doubtful", faults.doubtful},
                                       {"reconnects", s.reconnects}};
  return nlohmann::ordered_json{{"statistics", numbers}}.dump();
}

}  // namespace handway::tools
