#include "handway/geometric/io/table_text.h"
#include "handway/geometric/io/table_times.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace handway::geometric {
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
  if (is_one_of(word, {"min", "mins", "minute", "minutes", "minuten"})) {
    return 60.0;
  }
  if (is_one_of(word, {"h", "hrs", "hour", "hours", "stunden"})) {
    return 3600.0;
  }
  return std::nullopt;
}

bool names_time(const std::string& word) {
  return is_one_of(word, {"time", "times", "timestamp", "timestamps", "stamp", "stamps", "datetime",
                          "zeit", "zeitstempel", "uhrzeit", "zeitpunkt", "temps", "horodatage",
                          "tiempo", "tempo", "orario", "hora", "tijd"});
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

/// Returns the unit in a column's name that is no unit of time, or a multiple of one: "ticks" of
/// "time [ticks]" and "time_ticks", "10 ms" of "t [10 ms]". Empty for words that are no units.
std::string unknown_unit(std::string_view column, const std::vector<std::string>& words,
                         bool has_unit) {
  const std::string in_brackets = unit_in_brackets(column);
  if (has_unit) {
    const bool is_multiple = in_brackets.find_first_of("0123456789") < 2;  // "10 ms", "x10 ms"
    return is_multiple ? in_brackets : "";
  }
  constexpr std::array<std::string_view, 14> kCounted = {
      "tick",   "ticks", "count", "counts", "cycle",   "cycles", "frame",
      "frames", "step",  "steps", "sample", "samples", "day",    "days"};
  if (std::ranges::count(kCounted, words.back()) > 0) {
    return words.back();
  }
  constexpr std::array<std::string_view, 12> kNoUnits = {
      "utc",     "gmt",      "local",    "unix",  "posix",    "epoch",
      "elapsed", "relative", "absolute", "stamp", "iso 8601", "iso8601"};
  const bool has_letter = std::ranges::any_of(
      in_brackets, [](unsigned char c) { return std::isalpha(c) != 0 || c >= 0x80U; });
  return has_letter && std::ranges::count(kNoUnits, in_brackets) == 0 ? in_brackets : "";
}

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
      return TimeName{Kind::kSeconds, {1.0}};
    }
    if (is_one_of(last, {"nanosec", "nanosecs", "nsec", "nsecs"})) {
      return TimeName{Kind::kNanoseconds, {1e-9}};
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
  // "min" alone is the least value.
  const bool is_unit_alone = words.size() == 1 && unit && first.size() > (*unit > 1.0 ? 4U : 1U);
  if (is_unit_alone || first == "t" || is_one_of(first, {"elapsed", "epoch"}) ||
      std::ranges::any_of(words, is_of_time)) {
    const bool plain = std::ranges::all_of(words, [&](const std::string& word) {
      return is_of_time(word) || unit_called(word) || is_one_of(word, {"t", "elapsed", "epoch"});
    });
    const std::string unknown = unknown_unit(column, words, unit.has_value());
    return TimeName{Kind::kTime, {unknown.empty() ? unit : std::nullopt, unknown}, plain};
  }
  if (words.size() == 1 && is_one_of(first, {"date", "datum", "fecha", "day", "tag"})) {
    return TimeName{Kind::kDate};
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
    columns.unit = {1.0};
  } else if (time) {
    columns.parts = {{*time, 1.0}};
    columns.unit = time_name(names[*time])->unit;
    if (date && contents[*date] == CellContent::kDates && contents[*time] == CellContent::kClocks) {
      columns.parts.push_back({*date, 1.0});
    }
  } else if (seconds) {
    columns.parts = {{*seconds, 1.0}};
    columns.unit = {1.0};
  } else if (nanoseconds) {
    columns.parts = {{*nanoseconds, 1.0}};
    columns.unit = {1e-9};
  } else if (date && contents[*date] != CellContent::kNumbers) {
    columns.parts = {{*date, 1.0}};
  }
  return columns;
}

}  // namespace handway::geometric
