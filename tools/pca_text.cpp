#include "pca_text.h"

#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/math/units.h"
#include "handway/sampling/postures/principal_angles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace handway::tools {
namespace {

using device::SensorQuality;

constexpr Eigen::Index kMostShares = 8;
constexpr double kLargeEntry = 0.3;

std::string states(const SensorQuality& sensor) {
  return std::string(sensor.dead ? "  dead" : "") + (sensor.noisy ? "  noisy" : "") +
         (sensor.saturated ? "  saturated" : "");
}

}  // namespace

std::string quality_text(const MappedRecording& recording) {
  const device::RecordingQuality& quality = recording.quality;
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(
      out, "{}: {} rows of {}, {:.1f} s at {:.1f} Hz, {} repeated, {} gaps (longest {:.3g} s)\n",
      recording.file.string(), quality.rows, recording.calibrated ? "counts" : "angles",
      quality.duration, quality.rate, quality.duplicates, quality.gaps, quality.largest_gap);
  const bool counts = recording.calibrated;
  const double scale = counts ? 1.0 : 1.0 / geometric::kDegree;
  fmt::format_to(out, "  {:<18}{:>8}{:>8}{:>8}\n", counts ? "sensor, counts" : "sensor, deg",
                 "least", "most", "noise");
  for (const SensorQuality& sensor : quality.sensors) {
    fmt::format_to(out, "  {:<18}{:>8.1f}{:>8.1f}{:>8.2f}{}\n",
                   device::cyberglove_sensors()[static_cast<std::size_t>(sensor.sensor)].name,
                   scale * sensor.least, scale * sensor.most, scale * sensor.noise, states(sensor));
  }
  for (const std::string& warning : recording.recording.warnings) {
    text += "  warning: " + warning + '\n';
  }
  for (const std::string& warning : quality.warnings) {
    text += "  warning: " + warning + '\n';
  }
  return text;
}

std::string clamp_text(const std::vector<MappedRecording>& recordings,
                       const device::HandMapper& mapper) {
  std::vector<Eigen::Index> clamped(mapper.joints().size(), 0);
  Eigen::Index samples = 0;
  for (const MappedRecording& recording : recordings) {
    samples += recording.mapped.postures.rows();
    for (std::size_t j = 0; j < clamped.size(); ++j) {
      clamped[j] += recording.mapped.clamped[j];
    }
  }
  std::string text;
  for (std::size_t j = 0; j < clamped.size(); ++j) {
    if (clamped[j] > 0) {
      text += fmt::format("  {:<18}{:>8}  {:5.1f} %\n", mapper.joints()[j], clamped[j],
                          100.0 * static_cast<double>(clamped[j]) / static_cast<double>(samples));
    }
  }
  return text.empty() ? fmt::format("No sample of {} left the joint limits.\n", samples)
                      : fmt::format("Clamped to joint limits, of {} samples:\n", samples) + text;
}

std::string share_text(
    const std::vector<std::pair<std::string, sampling::PrincipalComponents>>& analyses) {
  std::size_t width = 0;
  Eigen::Index columns = 0;
  for (const auto& [name, components] : analyses) {
    width = std::max(width, name.size());
    columns = std::max(columns, std::min(kMostShares, components.shares.size()));
  }
  std::string text = fmt::format("  {:<{}}", "components", std::max<std::size_t>(width, 10));
  for (Eigen::Index k = 0; k < columns; ++k) {
    text += fmt::format("{:>8}", k + 1);
  }
  text += '\n';
  for (const auto& [name, components] : analyses) {
    text += fmt::format("  {:<{}}", name, std::max<std::size_t>(width, 10));
    double sum = 0.0;
    for (Eigen::Index k = 0; k < std::min(columns, components.shares.size()); ++k) {
      sum += components.shares[k];
      text += fmt::format("{:>8.2f}", 100.0 * sum);
    }
    text += '\n';
  }
  return text;
}

std::string angle_text(
    const std::vector<std::pair<std::string, sampling::PrincipalComponents>>& analyses,
    int components) {
  std::string text;
  for (std::size_t a = 0; a < analyses.size(); ++a) {
    for (std::size_t b = a + 1; b < analyses.size(); ++b) {
      const Eigen::MatrixXd& first = analyses[a].second.directions;
      const Eigen::MatrixXd& second = analyses[b].second.directions;
      const Eigen::Index count = std::min({Eigen::Index{components}, first.cols(), second.cols()});
      text += fmt::format("  {} and {}:", analyses[a].first, analyses[b].first);
      for (const double angle :
           sampling::principal_angles(first.leftCols(count), second.leftCols(count))) {
        text += fmt::format(" {:.1f}", angle / geometric::kDegree);
      }
      text += '\n';
    }
  }
  return text;
}

std::string largest_angle_text(const sampling::PrincipalComponents& a,
                               const sampling::PrincipalComponents& b) {
  constexpr Eigen::Index kMost = 4;
  std::string numbers = fmt::format("  {:<10}", "components");
  std::string angles = fmt::format("  {:<10}", "angle");
  const Eigen::Index count = std::min({kMost, a.directions.cols(), b.directions.cols()});
  for (Eigen::Index k = 1; k <= count; ++k) {
    const double angle =
        sampling::principal_angles(a.directions.leftCols(k), b.directions.leftCols(k)).maxCoeff();
    numbers += fmt::format("{:>8}", k);
    angles += fmt::format("{:>8.1f}", angle / geometric::kDegree);
  }
  return numbers + '\n' + angles + '\n';
}

std::string basis_text(const sampling::PmdBasis& basis) {
  std::string text;
  for (const sampling::FreeJoint& free : basis.free_joints) {
    text += fmt::format("  {:<6} half side {:.4f}  {} alone\n", "free", free.half_side,
                        basis.joints[static_cast<std::size_t>(free.joint)]);
  }
  for (const sampling::PrincipalDirection& direction : basis.directions) {
    text += fmt::format("  {:<6} half side {:.4f}  ", direction.name, direction.half_side);
    for (Eigen::Index j = 0; j < direction.vector.size(); ++j) {
      if (std::abs(direction.vector[j]) >= kLargeEntry) {
        text += fmt::format("{:+.2f} {}  ", direction.vector[j],
                            basis.joints[static_cast<std::size_t>(j)]);
      }
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  return text;
}

}  // namespace handway::tools
