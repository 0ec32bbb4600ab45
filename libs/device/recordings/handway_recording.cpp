#include "glove/recording_mark.h"
#include "glove/sensor_names.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/plural.h"
#include "recordings/recorded_rows.h"
#include "recordings/recording_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>

namespace handway::device {
namespace {

using geometric::InputError;

class CsvReader {
 public:
  CsvReader(const std::filesystem::path& file, const std::vector<TextLine>& lines)
      : file_(file), lines_(lines) {}

  Recording read() {
    std::size_t next = 0;
    for (; next < lines_.size() && is_remark(lines_[next]); ++next) {
      read_field(lines_[next]);
    }
    if (next == lines_.size()) {
      throw InputError({file_.string(), "", "no header", "time and names of sensors", ""});
    }
    read_columns(lines_[next]);
    RecordedRows rows(file_, recording_.header.sensors.size(), raw_columns_of_labels(raw_labels_));
    for (++next; next < lines_.size(); ++next) {
      read_row(lines_[next], rows);
    }
    rows.move_to(recording_);
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
    if (colon == std::string_view::npos) {
      return;
    }
    const std::string_view key = trimmed(text.substr(1, colon - 1));
    const std::string value(trimmed(text.substr(colon + 1)));
    RecordingHeader& header = recording_.header;
    if (key == "kind") {
      if (value != "counts" && value != "angles") {
        throw InputError({at_line(file_, line), "kind", '"' + value + '"', "counts or angles", ""});
      }
      header.kind = value == "counts" ? RecordingKind::kCounts : RecordingKind::kAngles;
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
      } else if (names[c].starts_with(kRawMark)) {
        raw_labels_.emplace_back(names[c].substr(kRawMark.size()));
        raw_columns_.push_back(c);
      } else if (!raw_columns_.empty()) {
        throw InputError({at_line(file_, line), fmt::format("column \"{}\"", names[c]),
                          "a sensor behind raw columns", "raw columns last", ""});
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
    const SensorIndices& before = recording_.header.sensors;
    if (!found) {
      throw InputError({at_line(file_, line), fmt::format("column \"{}\"", name),
                        "no sensor of the glove", "a sensor's name or letter",
                        geometric::advise_name(name, sensor_names())});
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
    // A number that is cut off may look complete: only the end of the line tells.
    const std::vector<std::string_view> parts = cells(line.text, separator_);
    const std::size_t columns = recording_.header.sensors.size() + raw_columns_.size() + 1;
    if (!line.ended) {
      recording_.warnings.push_back(at_line(file_, line) + ": left out, the row is cut off");
      return;
    }
    if (parts.size() != columns) {
      throw InputError({at_line(file_, line), "", geometric::plural(parts.size(), "value"),
                        fmt::format("{} as in the header", columns), ""});
    }
    double time = 0.0;
    std::vector<double> values;
    std::vector<double> raw;
    for (std::size_t c = 0; c < columns; ++c) {
      const bool is_raw = !raw_columns_.empty() && c >= raw_columns_.front() && c != time_column_;
      if (is_raw && trimmed(parts[c]).empty()) {
        raw.push_back(std::numeric_limits<double>::quiet_NaN());
        continue;
      }
      const std::optional<double> value = parse_number(parts[c]);
      if (!value) {
        throw InputError({at_line(file_, line), column_name(c), fmt::format("\"{:.40}\"", parts[c]),
                          "a finite number", ""});
      }
      if (c == time_column_) {
        time = *value;
        continue;
      }
      if (is_raw) {
        raw.push_back(*value);
        continue;
      }
      check_value(line, c, *value);
      values.push_back(*value);
    }
    rows.add(line, time, values, raw);
  }

  void check_value(const TextLine& line, std::size_t column, double value) const {
    const bool counts = recording_.header.kind == RecordingKind::kCounts;
    if (counts ? value < 0.0 || value > kHighestCounts : std::abs(value) > kWidestAngle) {
      throw InputError({at_line(file_, line), column_name(column), fmt::format("{}", value),
                        counts ? "counts from 0 to 255" : "an angle in rad", ""});
    }
  }

  [[nodiscard]] std::string column_name(std::size_t column) const {
    if (column == time_column_) {
      return "column time";
    }
    if (const auto raw = std::ranges::find(raw_columns_, column); raw != raw_columns_.end()) {
      return fmt::format("column {}{}", kRawMark,
                         raw_labels_[static_cast<std::size_t>(raw - raw_columns_.begin())]);
    }
    const std::size_t i = column < time_column_ ? column : column - 1;
    const auto sensor = static_cast<std::size_t>(recording_.header.sensors[i]);
    return fmt::format("column {}", cyberglove_sensors()[sensor].name);
  }

  const std::filesystem::path& file_;
  const std::vector<TextLine>& lines_;
  Recording recording_;
  char separator_ = ',';
  std::size_t time_column_ = 0;
  std::vector<std::string> raw_labels_;
  std::vector<std::size_t> raw_columns_;
};

class HandwayRecordings final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"Handway recording", "A recording of a glove by Handway (CSV)."};
  }
  [[nodiscard]] bool recognises(const RecordingFile& file) const override {
    const TextLine* first = file.first_line();
    return first != nullptr && trimmed(first->text) == kRecordingMark;
  }
  [[nodiscard]] Recording read(const RecordingFile& file) const override {
    return CsvReader(file.path(), file.lines()).read();
  }
};

}  // namespace

const RecordingFormat& handway_recording_format() {
  static const HandwayRecordings kFormat;
  return kFormat;
}

}  // namespace handway::device
