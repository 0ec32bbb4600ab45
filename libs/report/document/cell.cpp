#include "handway/report/document/cell.h"

#include <fmt/format.h>

#include <cmath>

namespace handway::report {
namespace {

// Decimals that give about four digits.
int four_digit_decimals(double value) {
  const double size = std::abs(value);
  if (size >= 1000.0 || value == 0.0) {
    return 0;
  }
  if (size >= 100.0) {
    return 1;
  }
  return size >= 10.0 ? 2 : size >= 0.1 ? 3 : 4;
}

std::string rounded(double value, const Number& format) {
  if (std::isnan(value)) {
    return "-";
  }
  if (std::isinf(value)) {
    return value > 0.0 ? "∞" : "-∞";
  }
  std::string text;
  if (format.digits == Digits::kThree) {
    text = std::abs(value) < 100.0 ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value);
  } else {
    const int decimals =
        format.digits == Digits::kFixed ? format.decimals : four_digit_decimals(value);
    text = fmt::format("{:.{}f}", value, decimals);
  }
  return format.has_plus && !text.starts_with('-') ? '+' + text : text;
}

std::string number_field(const Number& number) {
  if (!std::isfinite(number.value)) {
    return "";
  }
  return number.digits == Digits::kFixed ? rounded(number.value, number)
                                         : fmt::format("{}", number.value);
}

struct ForReaders {
  std::string operator()(const std::string& text) const { return text; }
  std::string operator()(std::int64_t count) const { return fmt::format("{}", count); }
  std::string operator()(const Number& number) const { return number_text(number); }
  std::string operator()(const Estimate& estimate) const {
    const std::string mean = number_text(estimate.mean);
    if (std::isnan(estimate.low) || std::isnan(estimate.high)) {
      return mean;
    }
    return fmt::format("{} ({} to {})", mean, rounded(estimate.low, estimate.mean),
                       rounded(estimate.high, estimate.mean));
  }
};

struct ForPrograms {
  std::string operator()(const std::string& text) const { return text; }
  std::string operator()(std::int64_t count) const { return fmt::format("{}", count); }
  std::string operator()(const Number& number) const { return number_field(number); }
  std::string operator()(const Estimate& estimate) const { return number_field(estimate.mean); }
};

}  // namespace

Number fixed(double value, int decimals) {
  return {.value = value, .digits = Digits::kFixed, .decimals = decimals};
}

Number percent(double share) {
  return {.value = 100.0 * share, .digits = Digits::kFixed, .decimals = 1, .unit = "%"};
}

Number seconds(double value) {
  constexpr double kPerSecond = 1e9;
  return {.value = std::round(value * kPerSecond) / kPerSecond};
}

std::string Cell::text() const { return std::visit(ForReaders(), value_); }

std::string Cell::field() const { return std::visit(ForPrograms(), value_); }

std::string number_text(const Number& number) {
  const std::string text = rounded(number.value, number);
  if (!std::isfinite(number.value)) {
    return text;
  }
  return number.unit.empty() ? number.prefix + text
                             : fmt::format("{}{} {}", number.prefix, text, number.unit);
}

std::string time_text(double seconds) {
  if (!std::isfinite(seconds)) {
    return number_text({.value = seconds});
  }
  constexpr double kMilli = 1e-3;
  const bool is_small = seconds < 1.0;
  const double value = is_small ? seconds / kMilli : seconds;
  const int decimals = value < 1.0 || (!is_small && value < 10.0) ? 2 : value < 10.0 ? 1 : 0;
  return fmt::format("{:.{}f} {}", value, decimals, is_small ? "ms" : "s");
}

}  // namespace handway::report
