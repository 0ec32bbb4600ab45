#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <system_error>

namespace handway::tools {

/// Refuses anything but a number above 0 and up to 1e9, "nan" included (which CLI::PositiveNumber
/// accepts).
[[nodiscard]] inline CLI::Validator positive_number() {
  return {[](const std::string& text) {
            constexpr double kMost = 1e9;  // Times in ns have to fit into 64 bits.
            double value = 0.0;
            const bool good =
                CLI::detail::lexical_cast(text, value) && value > 0.0 && value <= kMost;
            return good ? std::string()
                        : fmt::format("\"{}\" is no number above 0 and up to {:g}", text, kMost);
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
            return good ? std::string()
                        : fmt::format("\"{}\" is no number from {:g} to {:g}", text, least, most);
          },
          CLI::Range(least, most).get_description()};
}

/// Refuses numbers below 0, which would wrap around to huge ones, whole numbers beyond 64 bits,
/// which would become the largest one, and "nan".
[[nodiscard]] inline CLI::Validator not_negative() {
  return {[](const std::string& text) {
            if (text.starts_with('-')) {
              return fmt::format("\"{}\" is below 0", text);
            }
            std::uint64_t whole = 0;
            if (std::from_chars(text.data(), text.data() + text.size(), whole).ec ==
                std::errc::result_out_of_range) {
              return fmt::format("\"{}\" is too large", text);
            }
            double value = 0.0;
            const bool is_nan = CLI::detail::lexical_cast(text, value) && std::isnan(value);
            return is_nan ? fmt::format("\"{}\" is no number", text) : std::string();
          },
          "NONNEGATIVE"};
}

}  // namespace handway::tools
