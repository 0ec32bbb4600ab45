#pragma once

#include <CLI/CLI.hpp>

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

}  // namespace handway::tools
