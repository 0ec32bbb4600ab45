#pragma once

#include "handway/planning/paths/path_file.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <string>

namespace handway::tools {

/// Refuses anything but a number above 0, "nan" included (which CLI::PositiveNumber accepts).
[[nodiscard]] inline CLI::Validator positive_number() {
  return {[](const std::string& text) {
            double value = 0.0;
            const bool good = CLI::detail::lexical_cast(text, value) && value > 0.0;
            return good ? std::string() : "\"" + text + "\" is no number above 0";
          },
          "POSITIVE"};
}

/// Refuses anything but a number from `least` to `most`, "nan" included (which CLI::Range
/// accepts).
[[nodiscard]] inline CLI::Validator number_in(double least, double most) {
  return {[least, most](const std::string& text) {
            double value = 0.0;
            const bool good =
                CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
            return good ? std::string() : "\"" + text + "\" is not in the range";
          },
          CLI::Range(least, most).get_description()};
}

/// Refuses numbers below 0, which would wrap around to huge ones.
[[nodiscard]] inline CLI::Validator not_negative() {
  return {[](const std::string& text) {
            return text.starts_with('-') ? "\"" + text + "\" is below 0" : std::string();
          },
          "NONNEGATIVE"};
}

/// A measured number for display, to about four digits; "-" if it is missing, "∞" if it is beyond
/// the measured range.
[[nodiscard]] inline std::string number_text(double value) {
  if (std::isnan(value)) {
    return "-";
  }
  if (std::isinf(value)) {
    return "∞";
  }
  const double size = std::abs(value);
  if (size >= 1000.0 || value == 0.0) {
    return fmt::format("{:.0f}", value);
  }
  if (size >= 100.0) {
    return fmt::format("{:.1f}", value);
  }
  return fmt::format("{:.{}f}", value, size >= 10.0 ? 2 : size >= 0.1 ? 3 : 4);
}

/// Writes a number for programs: the shortest text that reads back; empty if it is not finite.
[[nodiscard]] inline std::string number_field(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "";
}

/// Writes seconds for programs: rounded to nanoseconds, finer than clocks measure.
[[nodiscard]] inline std::string seconds_field(double seconds) {
  return std::isfinite(seconds) ? planning::csv_time(seconds) : "";
}

/// A share of 1 as a percentage.
[[nodiscard]] inline std::string percent_text(double share) {
  return fmt::format("{:.1f} %", 100.0 * share);
}

}  // namespace handway::tools
