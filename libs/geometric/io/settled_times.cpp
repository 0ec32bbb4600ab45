#include "handway/geometric/io/plural.h"
#include "handway/geometric/io/table_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

constexpr double kDay = 86400.0;          // s
constexpr double kLongestStep = 5.0;      // s, of rows whose unit is not named
constexpr double kLongestNamed = 1000.0;  // s, of rows whose unit is named
constexpr double kShortestNamed = 2e-4;   // s
constexpr double kLatest = 1e11;          // s since 1970: the year 5138
constexpr double kEarliest = 1e8;         // s: fewer are not since 1970

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Median of the sizes and of the steps above 0; nothing without any.
struct Sizes {
  double value = 0.0;
  std::optional<double> step;
};

Sizes sizes_of(const std::vector<double>& times) {
  std::vector<double> values;
  std::vector<double> steps;
  for (const double time : times) {
    if (std::isfinite(time)) {
      if (!values.empty() && time != values.back()) {
        steps.push_back(std::abs(time - values.back()));
      }
      values.push_back(time);
    }
  }
  Sizes sizes;
  if (!steps.empty()) {
    sizes.step = median(std::move(steps));
  }
  std::ranges::transform(values, values.begin(), [](double value) { return std::abs(value); });
  sizes.value = values.empty() ? 0.0 : median(std::move(values));
  return sizes;
}

double unit_by_size(const Sizes& sizes) {
  constexpr std::array<std::pair<double, double>, 3> kSince1970 = {
      {{1e17, 1e-9}, {1e14, 1e-6}, {1e11, 1e-3}}};
  constexpr double kNow = 6e8;  // s since 1970: postures may be taken minutes apart
  constexpr double kLast = 5e9;
  double unit = 1.0;
  for (const auto& [least, one] : kSince1970) {
    if (sizes.value >= least) {
      unit = one;
      break;
    }
  }
  const bool by_day = unit == 1.0 && sizes.value > kNow && sizes.value < kLast;
  while (sizes.step && *sizes.step * unit >= (by_day ? kLongestNamed : kLongestStep) &&
         unit > 1e-9) {
    unit *= 1e-3;
  }
  return unit > 0.5 ? 1.0 : unit > 0.5e-3 ? 1e-3 : unit > 0.5e-6 ? 1e-6 : 1e-9;
}

bool contradicts(double unit, const Sizes& sizes) {
  const bool bad_step =
      sizes.step && (*sizes.step * unit > kLongestNamed || *sizes.step * unit < kShortestNamed);
  return bad_step || sizes.value * unit > kLatest;
}

const char* name_of(double unit) {
  return unit == 3600.0 ? "h"
         : unit == 60.0 ? "min"
         : unit == 1.0  ? "s"
         : unit == 1e-3 ? "ms"
         : unit == 1e-6 ? "\u00B5s"
                        : "ns";
}

/// Returns a warning about a unit that was inferred; nothing about s where no unit is named.
std::vector<std::string> inference(const TimeUnit& named, double taken, const Sizes& sizes) {
  if (!named.unknown.empty()) {
    return {fmt::format(
        "the header says \"{}\" for times, which is not a known unit (s, ms, \u00B5s, ns, min, h): "
        "they are taken for {}, by their size and their steps",
        named.unknown, name_of(taken))};
  }
  if (named.seconds && taken != *named.seconds) {
    return {
        fmt::format("the header says {} for times, but they are taken for {}: their size and "
                    "their steps fit that",
                    name_of(*named.seconds), name_of(taken))};
  }
  if (!named.seconds && taken != 1.0) {
    return {fmt::format("times are taken for {}{}, by their size", name_of(taken),
                        sizes.value * taken > kEarliest ? " since 1970" : "")};
  }
  return {};
}

/// Clocks restart at midnight.
void run_past_midnight(std::vector<double>& times) {
  double days = 0.0;
  double last = 0.0;
  for (double& time : times) {
    if (std::isfinite(time)) {
      days += time + kDay / 2.0 < last ? kDay : 0.0;
      last = time;
      time += days;
    }
  }
}

class Breaks {
 public:
  Breaks(std::vector<double>& times, std::span<const std::size_t> lines)
      : times_(times), lines_(lines) {}

  /// Makes the times non-decreasing.
  [[nodiscard]] std::vector<std::string> mend() {
    const double step = sizes_of(times_).step.value_or(0.0);
    double offset = 0.0;
    std::optional<double> last;
    for (std::size_t row = 0; row < times_.size(); ++row) {
      if (!std::isfinite(times_[row])) {
        continue;
      }
      const double written = times_[row];
      if (last && written + offset < *last) {
        if (is_late(row, *last - offset)) {
          ++late_;
          times_[row] = *last;
          continue;
        }
        note_break(row, *last - offset - written);
        offset = *last + step - written;
      }
      times_[row] = written + offset;
      last = times_[row];
    }
    return std::move(warnings_);
  }

  [[nodiscard]] std::size_t late() const { return late_; }

 private:
  /// Returns whether later rows soon continue from `last`: then this one only came too late.
  [[nodiscard]] bool is_late(std::size_t row, double last) const {
    constexpr std::size_t kFew = 5;
    for (std::size_t next = row + 1; next < std::min(row + 1 + kFew, times_.size()); ++next) {
      if (times_[next] >= last) {
        return true;
      }
    }
    return false;
  }

  void note_break(std::size_t row, double by) {
    constexpr std::size_t kNamed = 3;
    if (++breaks_ <= kNamed) {
      warnings_.push_back(fmt::format(
          "time runs back by {:.4g} s at {} {}: taken for a clock that was set; the rows from "
          "there on are kept and follow those before",
          by, lines_.empty() ? "row" : "line", lines_.empty() ? row + 1 : lines_[row]));
    } else if (breaks_ == kNamed + 1) {
      warnings_.emplace_back();
    }
    if (breaks_ > kNamed) {
      warnings_.back() = fmt::format("time runs back {} times more", breaks_ - kNamed);
    }
  }

  std::vector<double>& times_;
  std::span<const std::size_t> lines_;
  std::vector<std::string> warnings_;
  std::size_t breaks_ = 0;
  std::size_t late_ = 0;
};

}  // namespace

std::vector<std::string> settle_times(std::vector<double>& times, const TimeUnit& unit,
                                      bool spelled, std::span<const std::size_t> lines) {
  const Sizes sizes = sizes_of(times);
  // "HH:MM:SS.ms" names parts of clock times.
  double taken = spelled ? 1.0 : unit.seconds.value_or(1.0);
  std::vector<std::string> warnings;
  if (!spelled && (!unit.seconds || contradicts(*unit.seconds, sizes))) {
    taken = unit_by_size(sizes);
    warnings = inference(unit, taken, sizes);
  }
  const auto first = std::ranges::find_if(times, [](double time) { return std::isfinite(time); });
  if (first == times.end()) {
    return warnings;
  }
  const bool since_1970 = spelled || std::abs(*first * taken) > kEarliest;
  const double begin = since_1970 ? *first : 0.0;
  for (double& time : times) {
    time = taken >= 1.0 ? (time - begin) * taken : (time - begin) / std::round(1.0 / taken);
    if (since_1970 && std::isfinite(time)) {
      constexpr double kPerSecond = 1e6;  // doubles of that size are not finer
      time = std::round(time * kPerSecond) / kPerSecond;
    }
  }
  if (spelled && std::abs(begin) <= kDay) {
    run_past_midnight(times);
  }
  Breaks breaks(times, lines);
  std::ranges::move(breaks.mend(), std::back_inserter(warnings));
  if (breaks.late() > 0) {
    warnings.push_back(
        plural(breaks.late(), "row") +
        " kept in the file's order, although the time is a little earlier than in the row before");
  }
  return warnings;
}

}  // namespace handway::geometric
