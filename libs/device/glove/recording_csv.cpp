#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/io/input_error.h"
#include "number_text.h"
#include "recording_readers.h"
#include "recording_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace handway::device {
namespace {

using geometric::InputError;

constexpr double kMostCounts = 255.0;
constexpr double kWidestAngle = 2 * M_PI;  // rad

// The separator that the header uses most.
char separator_of(std::string_view header) {
  constexpr std::string_view kSeparators = ",;\t";
  return *std::ranges::max_element(kSeparators, {},
                                   [&](char c) { return std::ranges::count(header, c); });
}

class CsvReader {
 public:
  CsvReader(const std::filesystem::path& file, const std::vector<TextLine>& lines)
      : file_(file), lines_(lines), own_(trimmed(lines.front().text) == kRecordingMark) {}

  Recording read() {
    std::size_t next = 0;
    for (; next < lines_.size() && is_remark(lines_[next]); ++next) {
      read_field(lines_[next]);
    }
    if (next == lines_.size()) {
      throw InputError({file_.string(), "", "no header", "time and names of sensors", ""});
    }
    read_columns(lines_[next]);
    RecordedRows rows(file_, recording_.header.sensors.size());
    for (++next; next < lines_.size(); ++next) {
      read_row(lines_[next], rows);
    }
    rows.move_to(recording_);
    settle_kind();
    return std::move(recording_);
  }

 private:
  static bool is_remark(const TextLine& line) {
    const std::string_view text = trimmed(line.text);
    return text.empty() || text.starts_with('#');
  }

  void read_field(const TextLine& line) {
    std::string_view text = trimmed(line.text);
    const std::size_t colon = text.find(':');
    if (!own_ || colon == std::string_view::npos) {
      return;
    }
    const std::string_view key = trimmed(text.substr(1, colon - 1));
    const std::string value(trimmed(text.substr(colon + 1)));
    RecordingHeader& header = recording_.header;
    if (key == "kind") {
      if (value != "counts" && value != "angles") {
        throw InputError({at_line(file_, line), "kind", '"' + value + '"', "counts or angles", ""});
      }
      kind_ = value == "counts" ? RecordingKind::kCounts : RecordingKind::kAngles;
    } else if (key == "device") {
      header.device = value;
    } else if (key == "date") {
      header.date = value;
    } else if (key == "origin") {
      header.origin = value;
    }
  }

  void read_columns(const TextLine& line) {
    separator_ = separator_of(line.text);
    const std::vector<std::string_view> names = cells(line.text, separator_);
    if (std::ranges::count(names, "time") != 1) {
      throw InputError({at_line(file_, line), "",
                        fmt::format("{} columns \"time\"", std::ranges::count(names, "time")),
                        "a header with one, in seconds, and names of sensors",
                        "Is this a recording of a glove?"});
    }
    for (std::size_t c = 0; c < names.size(); ++c) {
      if (names[c] == "time") {
        time_column_ = c;
      } else {
        recording_.header.sensors.push_back(sensor(line, names[c]));
      }
    }
    if (recording_.header.sensors.empty()) {
      throw InputError({at_line(file_, line), "", "no column of a sensor", "at least one", ""});
    }
  }

  [[nodiscard]] int sensor(const TextLine& line, std::string_view name) const {
    const std::optional<int> found = find_sensor(name);
    const std::vector<int>& before = recording_.header.sensors;
    if (!found) {
      std::vector<std::string> known;
      for (const GloveSensor& each : cyberglove_sensors()) {
        known.emplace_back(each.name);
      }
      throw InputError({at_line(file_, line), fmt::format("column \"{}\"", name),
                        "no sensor of the glove", "a sensor's name or letter",
                        geometric::advise_name(name, known)});
    }
    if (std::ranges::count(before, *found) > 0) {
      throw InputError({at_line(file_, line), fmt::format("column \"{}\"", name),
                        "a sensor for the second time", "every sensor once", ""});
    }
    return *found;
  }

  void read_row(const TextLine& line, RecordedRows& rows) {
    if (is_remark(line)) {
      return;
    }
    // A number that is cut may look whole: only the end of the line shows.
    const std::vector<std::string_view> parts = cells(line.text, separator_);
    const std::size_t columns = recording_.header.sensors.size() + 1;
    if (!line.ended && (own_ || parts.size() < columns)) {
      recording_.warnings.push_back(at_line(file_, line) + ": left out, the row is cut off");
      return;
    }
    if (parts.size() != columns) {
      throw InputError({at_line(file_, line), "", fmt::format("{} values", parts.size()),
                        fmt::format("{} as in the header", columns), ""});
    }
    double time = 0.0;
    std::vector<double> values;
    for (std::size_t c = 0; c < columns; ++c) {
      const std::optional<double> value = finite_number(parts[c]);
      if (!value) {
        throw InputError({at_line(file_, line), column_name(c), fmt::format("\"{:.40}\"", parts[c]),
                          "a finite number", ""});
      }
      if (c == time_column_) {
        time = *value;
        continue;
      }
      check_value(line, c, *value);
      values.push_back(*value);
    }
    rows.add(line, time, values);
  }

  void check_value(const TextLine& line, std::size_t column, double value) const {
    const bool counts = value >= 0.0 && value <= kMostCounts;
    const bool angle = std::abs(value) <= kWidestAngle;
    const bool fits = kind_ ? (*kind_ == RecordingKind::kCounts ? counts : angle) : counts || angle;
    if (!fits) {
      throw InputError({at_line(file_, line), column_name(column), fmt::format("{}", value),
                        kind_ == RecordingKind::kAngles ? "an angle in rad"
                        : kind_                         ? "counts from 0 to 255"
                                                        : "counts from 0 to 255, or rad",
                        ""});
    }
  }

  [[nodiscard]] std::string column_name(std::size_t column) const {
    if (column == time_column_) {
      return "column time";
    }
    const std::size_t i = column < time_column_ ? column : column - 1;
    const auto sensor = static_cast<std::size_t>(recording_.header.sensors[i]);
    return fmt::format("column {}", cyberglove_sensors()[sensor].name);
  }

  // What a file that doesn't say holds: whole numbers are counts.
  void settle_kind() {
    const Eigen::MatrixXd& values = recording_.values;
    if (!kind_) {
      const bool whole = (values.array() == values.array().round()).all();
      kind_ = whole && values.minCoeff() >= 0.0 ? RecordingKind::kCounts : RecordingKind::kAngles;
      recording_.warnings.push_back(file_.string() + ": taken for " + to_string(*kind_) +
                                    " by its numbers");
      if (!whole && values.cwiseAbs().maxCoeff() > kWidestAngle) {
        throw InputError({file_.string(), "", fmt::format("values up to {}", values.maxCoeff()),
                          "whole counts, or angles in rad", "Are these degrees?"});
      }
    }
    recording_.header.kind = *kind_;
  }

  const std::filesystem::path& file_;
  const std::vector<TextLine>& lines_;
  bool own_;
  Recording recording_;
  std::optional<RecordingKind> kind_;
  char separator_ = ',';
  std::size_t time_column_ = 0;
};

}  // namespace

Recording read_csv_recording(const std::filesystem::path& file,
                             const std::vector<TextLine>& lines) {
  return CsvReader(file, lines).read();
}

}  // namespace handway::device
