#include "handway/geometric/io/table_times.h"

#include "handway/geometric/io/table_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <utility>

namespace handway::geometric {
namespace {

constexpr double kMinute = 60.0;
constexpr double kHour = 3600.0;
constexpr double kDay = 86400.0;

/// Reads parts of a text from its beginning on.
class TextParts {
 public:
  explicit TextParts(std::string_view text) : text_(text) {}

  /// A whole number of `least` to `most` digits.
  [[nodiscard]] std::optional<int> digits(std::size_t least, std::size_t most) {
    std::size_t count = 0;
    int value = 0;
    while (count < std::min(most, text_.size()) &&
           std::isdigit(static_cast<unsigned char>(text_[count])) != 0) {
      value = 10 * value + (text_[count++] - '0');
    }
    if (count < least) {
      return std::nullopt;
    }
    text_.remove_prefix(count);
    return value;
  }
  [[nodiscard]] std::optional<char> one_of(std::string_view letters) {
    if (text_.empty() || letters.find(text_.front()) == std::string_view::npos) {
      return std::nullopt;
    }
    const char letter = text_.front();
    text_.remove_prefix(1);
    return letter;
  }
  /// Digits behind a point or a comma, as a fraction; 0 without them.
  [[nodiscard]] double fraction() {
    if (!one_of(".,")) {
      return 0.0;
    }
    double unit = 1.0;
    double value = 0.0;
    while (const auto digit = one_of("0123456789")) {
      unit /= 10.0;
      value += unit * (*digit - '0');
    }
    return value;
  }
  void skip_blanks() { text_.remove_prefix(std::min(text_.find_first_not_of(' '), text_.size())); }
  [[nodiscard]] bool empty() const { return text_.empty(); }

 private:
  std::string_view text_;
};

std::optional<double> seconds_of(int year, int month, int day) {
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  return date.ok()
             ? std::optional(kDay * static_cast<double>(
                                        std::chrono::sys_days(date).time_since_epoch().count()))
             : std::nullopt;
}

/// Reads 2024-03-01, 2024/03/01, 01.03.2024 (day first), 03/01/2024 and 03-01-2024 (month first,
/// unless impossible).
std::optional<double> read_date(TextParts& text) {
  const std::optional<int> first = text.digits(1, 4);
  const std::optional<char> separator = first ? text.one_of("-/.") : std::nullopt;
  const std::optional<int> second = separator ? text.digits(1, 2) : std::nullopt;
  if (!second || !text.one_of(std::string_view(&*separator, 1))) {
    return std::nullopt;
  }
  constexpr int kFirstYear = 1000;
  constexpr int kMonths = 12;
  const bool year_first = *first >= kFirstYear;
  const std::optional<int> third = text.digits(year_first ? 1 : 4, year_first ? 2 : 4);
  if (!third) {
    return std::nullopt;
  }
  if (year_first) {
    return seconds_of(*first, *second, *third);
  }
  const bool day_first = *separator == '.' || *first > kMonths;
  return day_first ? seconds_of(*third, *second, *first) : seconds_of(*third, *first, *second);
}

/// Reads 12:00, 12:00:00, 12:00:00.5, 1:00:00 PM.
std::optional<double> read_clock(TextParts& text) {
  const std::optional<int> hour = text.digits(1, 2);
  const std::optional<int> minute = hour && text.one_of(":") ? text.digits(2, 2) : std::nullopt;
  if (!minute || *hour > 24 || *minute > 59) {
    return std::nullopt;
  }
  double seconds = kHour * *hour + kMinute * *minute;
  if (text.one_of(":")) {
    const std::optional<int> second = text.digits(2, 2);
    if (!second || *second > 60) {
      return std::nullopt;
    }
    seconds += *second + text.fraction();
  }
  text.skip_blanks();
  if (const auto half = text.one_of("AaPp")) {
    if (!text.one_of("Mm")) {
      return std::nullopt;
    }
    const bool noon_or_midnight = *hour == 12;
    const bool afternoon = *half == 'P' || *half == 'p';
    seconds += afternoon && !noon_or_midnight ? 12.0 * kHour : 0.0;
    seconds -= !afternoon && noon_or_midnight ? 12.0 * kHour : 0.0;
  }
  return seconds;
}

/// Reads "Z", "+01:00", "+0100", " UTC". @returns the offset to UTC, s.
std::optional<double> read_zone(TextParts& text) {
  text.skip_blanks();
  if (text.empty() || text.one_of("Zz")) {
    return 0.0;
  }
  if (text.one_of("UG")) {  // UTC, GMT
    return text.one_of("TM") && text.one_of("CT") ? std::optional(0.0) : std::nullopt;
  }
  const std::optional<char> sign = text.one_of("+-");
  const std::optional<int> hours = sign ? text.digits(2, 2) : std::nullopt;
  if (!hours) {
    return std::nullopt;
  }
  static_cast<void>(text.one_of(":"));
  const double offset = kHour * *hours + kMinute * text.digits(2, 2).value_or(0);
  return *sign == '+' ? -offset : offset;
}

std::optional<SpelledTime> date_and_clock(std::string_view cell) {
  TextParts text(cell);
  const std::optional<double> date = read_date(text);
  if (!date) {
    return std::nullopt;
  }
  if (text.empty()) {
    return SpelledTime{SpelledTime::Kind::kDate, *date};
  }
  if (!text.one_of("Tt _,")) {
    return std::nullopt;
  }
  text.skip_blanks();
  const std::optional<double> clock = read_clock(text);
  const std::optional<double> zone = clock ? read_zone(text) : std::nullopt;
  if (!zone || !text.empty()) {
    return std::nullopt;
  }
  return SpelledTime{SpelledTime::Kind::kDateAndClock, *date + *clock + *zone};
}

}  // namespace

std::optional<SpelledTime> parse_time(std::string_view cell) {
  cell = trimmed(cell);
  constexpr std::size_t kShortest = 4;  // "1:00"
  if (cell.size() < kShortest || std::isdigit(static_cast<unsigned char>(cell.front())) == 0 ||
      parse_number(cell)) {
    return std::nullopt;
  }
  if (const auto whole = date_and_clock(cell)) {
    return whole;
  }
  TextParts text(cell);
  const std::optional<double> clock = read_clock(text);
  text.skip_blanks();
  const bool is_whole = clock && (text.empty() || (text.one_of("Zz") && text.empty()));
  return is_whole ? std::optional(SpelledTime{SpelledTime::Kind::kClock, *clock}) : std::nullopt;
}

namespace {

bool is_one_of(const std::string& word, std::initializer_list<const char*> words) {
  return std::ranges::find(words, word) != words.end();
}

std::optional<double> unit_called(const std::string& word) {
  if (is_one_of(word, {"s", "sec", "secs", "second", "seconds", "sek", "sekunde", "sekunden"})) {
    return 1.0;
  }
  if (is_one_of(word, {"ms", "msec", "msecs", "millis", "milli", "millisec", "millisecond",
                       "milliseconds", "millisekunden"})) {
    return 1e-3;
  }
  if (is_one_of(word, {"us", "usec", "usecs", "micros", "micro", "microsec", "microsecond",
                       "microseconds", "mikrosekunden", "\u00B5s", "\u03BCs"})) {
    return 1e-6;
  }
  if (is_one_of(word, {"ns", "nsec", "nsecs", "nanos", "nano", "nanosec", "nanosecond",
                       "nanoseconds", "nanosekunden"})) {
    return 1e-9;
  }
  return std::nullopt;
}

bool names_time(const std::string& word) {
  return is_one_of(word, {"time", "times", "timestamp", "timestamps", "stamp", "datetime", "zeit",
                          "zeitstempel", "uhrzeit", "zeitpunkt", "temps", "horodatage", "tiempo",
                          "tempo", "orario", "hora", "tijd"});
}

/// Finds "timems", "timestampns": a word that ends in a unit.
std::optional<double> joined_unit(const std::string& word) {
  for (const char* begin : {"timestamp", "time", "zeit"}) {
    if (word.starts_with(begin) && word.size() > std::string_view(begin).size()) {
      return unit_called(word.substr(std::string_view(begin).size()));
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<TimeName> time_name(std::string_view column) {
  const std::vector<std::string> words = words_of_column(column);
  if (words.empty()) {
    return std::nullopt;
  }
  using Kind = TimeName::Kind;
  const std::string& first = words.front();
  const std::string& last = words.back();
  if (words.size() == 1 || is_one_of(words[words.size() - 2], {"stamp", "time", "start"})) {
    if (is_one_of(last, {"sec", "secs"})) {
      return TimeName{Kind::kSeconds, 1.0};
    }
    if (is_one_of(last, {"nanosec", "nanosecs", "nsec", "nsecs"})) {
      return TimeName{Kind::kNanoseconds, 1e-9};
    }
  }
  std::optional<double> unit;
  for (const std::string& word : words) {
    unit = unit ? unit : unit_called(word);
    unit = unit ? unit : joined_unit(word);
  }
  const auto is_of_time = [](const std::string& word) {
    return names_time(word) || joined_unit(word).has_value();
  };
  const bool is_unit_alone = words.size() == 1 && unit && first.size() > 1;
  if (is_unit_alone || first == "t" || is_one_of(first, {"elapsed", "epoch"}) ||
      std::ranges::any_of(words, is_of_time)) {
    const bool plain = std::ranges::all_of(words, [&](const std::string& word) {
      return is_of_time(word) || unit_called(word) || is_one_of(word, {"t", "elapsed", "epoch"});
    });
    return TimeName{Kind::kTime, unit, plain};
  }
  if (words.size() == 1 && is_one_of(first, {"date", "datum", "fecha", "day", "tag"})) {
    return TimeName{Kind::kDate, std::nullopt};
  }
  return std::nullopt;
}

bool TimeColumns::has(std::size_t column) const {
  return std::ranges::count(parts, column, &Part::column) > 0;
}

CellContent content_of(std::string_view cell) {
  if (parse_cell(cell)) {
    return CellContent::kNumbers;
  }
  const std::optional<SpelledTime> time = parse_time(cell);
  if (!time) {
    return CellContent::kOther;
  }
  return time->kind == SpelledTime::Kind::kDate    ? CellContent::kDates
         : time->kind == SpelledTime::Kind::kClock ? CellContent::kClocks
                                                   : CellContent::kDatesAndClocks;
}

namespace {

/// The column of a kind: a plain one before others, of several the first.
std::optional<std::size_t> column_of(TimeName::Kind kind, const std::vector<std::string>& names,
                                     const std::vector<CellContent>& contents) {
  std::optional<std::size_t> found;
  bool found_plain = false;
  for (std::size_t c = 0; c < names.size(); ++c) {
    const std::optional<TimeName> name =
        contents[c] == CellContent::kOther ? std::nullopt : time_name(names[c]);
    if (name && name->kind == kind && (!found || (name->plain && !found_plain))) {
      found = c;
      found_plain = name->plain;
    }
  }
  return found;
}

}  // namespace

TimeColumns time_columns(const std::vector<std::string>& names,
                         const std::vector<CellContent>& contents) {
  using Kind = TimeName::Kind;
  const auto time = column_of(Kind::kTime, names, contents);
  const auto date = column_of(Kind::kDate, names, contents);
  const auto seconds = column_of(Kind::kSeconds, names, contents);
  const auto nanoseconds = column_of(Kind::kNanoseconds, names, contents);
  TimeColumns columns;
  if (seconds && nanoseconds) {
    columns.parts = {{*seconds, 1.0}, {*nanoseconds, 1e-9}};
    columns.unit = 1.0;
  } else if (time) {
    columns.parts = {{*time, 1.0}};
    columns.unit = time_name(names[*time])->unit;
    if (date && contents[*date] == CellContent::kDates && contents[*time] == CellContent::kClocks) {
      columns.parts.push_back({*date, 1.0});
    }
  } else if (seconds) {
    columns.parts = {{*seconds, 1.0}};
    columns.unit = 1.0;
  } else if (nanoseconds) {
    columns.parts = {{*nanoseconds, 1.0}};
    columns.unit = 1e-9;
  } else if (date && contents[*date] != CellContent::kNumbers) {
    columns.parts = {{*date, 1.0}};
  }
  return columns;
}

namespace {

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
  return unit == 1.0 ? "s" : unit == 1e-3 ? "ms" : unit == 1e-6 ? "\u00B5s" : "ns";
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

std::vector<std::string> settle_times(std::vector<double>& times, std::optional<double> unit,
                                      bool spelled, std::span<const std::size_t> lines) {
  std::vector<std::string> warnings;
  const Sizes sizes = sizes_of(times);
  double taken = unit.value_or(1.0);
  if (!spelled && (!unit || contradicts(*unit, sizes))) {
    taken = unit_by_size(sizes);
    if (unit && taken != *unit) {
      warnings.push_back(
          fmt::format("the header says {} for times, but they are taken for {}: their size and "
                      "their steps fit that",
                      name_of(*unit), name_of(taken)));
    } else if (taken != 1.0) {
      warnings.push_back(fmt::format("times are taken for {}{}, by their size", name_of(taken),
                                     sizes.value * taken > kEarliest ? " since 1970" : ""));
    }
  }
  const auto first = std::ranges::find_if(times, [](double time) { return std::isfinite(time); });
  if (first == times.end()) {
    return warnings;
  }
  const bool since_1970 = spelled || std::abs(*first * taken) > kEarliest;
  const double begin = since_1970 ? *first : 0.0;
  for (double& time : times) {
    time = taken == 1.0 ? time - begin : (time - begin) / std::round(1.0 / taken);
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
    warnings.push_back(fmt::format(
        "{} rows have an earlier time than the row before, by a little: they are kept in their "
        "order",
        breaks.late()));
  }
  return warnings;
}

}  // namespace handway::geometric
