#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/table_text.h"
#include "handway/geometric/io/table_times.h"

#include <array>
#include <cctype>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

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

}  // namespace handway::geometric
