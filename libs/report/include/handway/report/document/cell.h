#pragma once

#include "handway/report/export.h"

#include <concepts>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

/// @file
/// Cells of tables: texts, counts, measured numbers and estimates with an interval.
namespace handway::report {

/// Rounding of a number for readers.
enum class Digits {
  kFour,   ///< About four digits, at most four of them after the point.
  kThree,  ///< Three digits, or a whole number.
  kFixed,  ///< A fixed number of decimals, in files for programs, too.
};

/// A measured number. NaN: it is missing. Infinite: it is beyond the measured range.
struct Number {
  double value = std::numeric_limits<double>::quiet_NaN();
  Digits digits = Digits::kFour;
  int decimals = 0;         ///< Of Digits::kFixed.
  std::string unit = {};    ///< Written behind the number, for columns without a unit.
  std::string prefix = {};  ///< Written before the number, such as "< ".
  bool has_plus = false;    ///< Positive numbers have a sign, too.
};

/// Returns a number with a fixed number of decimals.
[[nodiscard]] HANDWAY_REPORT_EXPORT Number fixed(double value, int decimals);

/// Returns a share of 1 as a percentage with one decimal.
[[nodiscard]] HANDWAY_REPORT_EXPORT Number percent(double share);

/// Returns seconds rounded to nanoseconds, finer than clocks measure.
[[nodiscard]] HANDWAY_REPORT_EXPORT Number seconds(double value);

/// A number with its interval, which has the unit and the rounding of the number.
struct Estimate {
  Number mean;
  double low = std::numeric_limits<double>::quiet_NaN();  ///< NaN: there is no interval.
  double high = std::numeric_limits<double>::quiet_NaN();
};

/// Cell of a table.
class HANDWAY_REPORT_EXPORT Cell {
 public:
  Cell() = default;
  // NOLINTBEGIN(google-explicit-constructor): rows are lists of values.
  Cell(std::string text) : value_(std::move(text)) {}
  Cell(std::string_view text) : value_(std::string(text)) {}
  Cell(const char* text) : value_(std::string(text)) {}
  template <std::integral T>
  requires(!std::same_as<T, bool>) Cell(T count) : value_(static_cast<std::int64_t>(count)) {}
  Cell(double value) : value_(Number{.value = value}) {}
  Cell(Number number) : value_(std::move(number)) {}
  Cell(Estimate estimate) : value_(std::move(estimate)) {}
  // NOLINTEND(google-explicit-constructor)

  /// Returns false for texts.
  [[nodiscard]] bool is_number() const { return value_.index() != 0; }
  /// Returns the text for readers: "-" for missing numbers, "∞" for infinite ones, an estimate as
  /// "1.5 (1.2 to 1.8)". It is not escaped.
  [[nodiscard]] std::string text() const;
  /// Returns the text for programs: the shortest one that reads back as the same number, without a
  /// unit; empty for numbers that are not finite. It is not escaped.
  [[nodiscard]] std::string field() const;

 private:
  std::variant<std::string, std::int64_t, Number, Estimate> value_;
};

/// Returns the text of a number for readers, as in a cell.
[[nodiscard]] HANDWAY_REPORT_EXPORT std::string number_text(const Number& number);

/// Returns a time with three digits, in milliseconds below a second: "12.5 ms".
[[nodiscard]] HANDWAY_REPORT_EXPORT std::string time_text(double seconds);

}  // namespace handway::report
