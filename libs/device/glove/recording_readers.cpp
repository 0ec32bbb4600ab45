#include "glove/recording_readers.h"

#include "glove/landmark_dump.h"
#include "glove/sensor_names.h"
#include "glove/text_files.h"
#include "handway/device/core/line_protocol.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/glove/landmark_line.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/table_times.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>

namespace handway::device {
std::string at_line(const std::filesystem::path& file, const TextLine& line) {
  return fmt::format("{}:{}", file.string(), line.number);
}

void take_rows(const std::filesystem::path& file, const std::vector<TextLine>& lines,
               std::vector<std::string>& warnings,
               const std::function<bool(const TextLine&)>& is_row,
               const std::function<void(const TextLine&)>& take) {
  for (const TextLine& line : lines) {
    if (trimmed(line.text).empty()) {
      continue;
    }
    if (!line.ended && !is_row(line)) {
      warnings.push_back(at_line(file, line) + ": left out, the row is cut off");
      return;
    }
    take(line);
  }
}

RecordedRows::RecordedRows(const std::filesystem::path& file, std::size_t columns)
    : file_(file), columns_(columns) {}

void RecordedRows::add(const TextLine& line, double time, const std::vector<double>& values) {
  times_.push_back(time);
  lines_.push_back(line.number);
  values_.insert(values_.end(), values.begin(), values.end());
}

void RecordedRows::move_to(Recording& recording) {
  if (times_.empty()) {
    throw geometric::InputError({file_.string(), "", "no rows", "at least one", ""});
  }
  for (const std::string& warning : geometric::settle_times(times_, 1.0, false, lines_)) {
    recording.warnings.push_back(fmt::format("{}: {}", file_.string(), warning));
  }
  const auto rows = static_cast<Eigen::Index>(times_.size());
  const auto columns = static_cast<Eigen::Index>(columns_);
  recording.times = Eigen::Map<const Eigen::VectorXd>(times_.data(), rows);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  recording.values = Eigen::Map<const RowMajor>(values_.data(), rows, columns);
}

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
    RecordedRows rows(file_, recording_.header.sensors.size());
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
    const std::size_t columns = recording_.header.sensors.size() + 1;
    if (!line.ended) {
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
      const std::optional<double> value = parse_number(parts[c]);
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
    const std::size_t i = column < time_column_ ? column : column - 1;
    const auto sensor = static_cast<std::size_t>(recording_.header.sensors[i]);
    return fmt::format("column {}", cyberglove_sensors()[sensor].name);
  }

  const std::filesystem::path& file_;
  const std::vector<TextLine>& lines_;
  Recording recording_;
  char separator_ = ',';
  std::size_t time_column_ = 0;
};

}  // namespace

Recording read_csv_recording(const std::filesystem::path& file,
                             const std::vector<TextLine>& lines) {
  return CsvReader(file, lines).read();
}

namespace {

constexpr std::size_t kDateCells = 6;
constexpr std::size_t kSlots = 23;  // the VirtualHand order without its last, unwired one
constexpr std::size_t kCells = kDateCells + 1 + kSlots;

using Row = std::array<double, kCells>;

// Seconds since 1970 from the first six cells; nothing if they are not a date and time.
std::optional<double> seconds(const Row& row) {
  const auto whole = [](double value) { return value == std::floor(value); };
  for (std::size_t i = 0; i + 1 < kDateCells; ++i) {
    if (!whole(row[i]) || row[i] < 0 || row[i] > 9999) {
      return std::nullopt;
    }
  }
  const std::chrono::year_month_day day{std::chrono::year(static_cast<int>(row[0])),
                                        std::chrono::month(static_cast<unsigned>(row[1])),
                                        std::chrono::day(static_cast<unsigned>(row[2]))};
  if (!day.ok() || row[3] > 23 || row[4] > 59 || row[5] < 0.0 || row[5] > 61.0) {
    return std::nullopt;
  }
  const auto days = std::chrono::sys_days(day).time_since_epoch().count();
  return 86400.0 * static_cast<double>(days) + 3600.0 * row[3] + 60.0 * row[4] + row[5];
}

std::optional<Row> numbers(const TextLine& line) {
  const char separator = separator_of(line.text);
  const std::vector<std::string_view> parts = cells(line.text, separator);
  if (parts.size() != kCells) {
    return std::nullopt;
  }
  Row row{};
  for (std::size_t i = 0; i < kCells; ++i) {
    const std::optional<double> number = parse_cell(parts[i]);
    if (!number) {
      return std::nullopt;
    }
    row.at(i) = *number;
  }
  return row;
}

void check_angle(const std::filesystem::path& file, const TextLine& line, std::size_t sensor,
                 double angle) {
  if (std::abs(angle) > kWidestAngle) {
    throw geometric::InputError({at_line(file, line),
                                 std::string(cyberglove_sensors()[sensor].name),
                                 fmt::format("{}", angle), "an angle in rad", ""});
  }
}

std::string iso_date(const Row& row) {
  return fmt::format("{:04.0f}-{:02.0f}-{:02.0f}T{:02.0f}:{:02.0f}:{:06.3f}", row[0], row[1],
                     row[2], row[3], row[4], row[5]);
}

}  // namespace

bool is_virtual_hand_row(const TextLine& line) {
  const std::optional<Row> row = numbers(line);
  return row && seconds(*row);
}

Recording read_virtual_hand_log(const std::filesystem::path& file,
                                const std::vector<TextLine>& lines) {
  Recording recording;
  recording.header.kind = RecordingKind::kAngles;
  recording.header.device = "CyberGlove by VirtualHand";
  recording.header.origin = file.filename().string();
  recording.header.sensors.resize(kGloveSensors);
  std::iota(recording.header.sensors.begin(), recording.header.sensors.end(), 0);
  RecordedRows rows(file, kGloveSensors);
  std::optional<double> begin;
  const auto take = [&](const TextLine& line) {
    const std::optional<Row> row = numbers(line);
    const std::optional<double> time = row ? seconds(*row) : std::nullopt;
    if (!time) {
      throw geometric::InputError(
          {at_line(file, line), "", fmt::format("\"{:.40}\"", trimmed(line.text)),
           "year, month, day, hour, minute, second, switch and 23 angles (rad)", ""});
    }
    if (!begin) {
      begin = time;
      recording.header.date = iso_date(*row);
    }
    std::vector<double> angles;
    for (std::size_t sensor = 0; sensor < kGloveSensors; ++sensor) {
      const auto slot = static_cast<std::size_t>(cyberglove_sensors()[sensor].slot);
      angles.push_back(virtual_hand_sign(static_cast<int>(sensor)) *
                       row->at(kDateCells + 1 + slot));
      check_angle(file, line, sensor, angles.back());
    }
    // Times in such files have a resolution of 10 µs; their differences have the rounding of large
    // numbers.
    rows.add(line, std::round((*time - *begin) * 1e5) / 1e5, angles);
  };
  take_rows(file, lines, recording.warnings, is_virtual_hand_row, take);
  rows.move_to(recording);
  recording.warnings.push_back(
      file.string() +
      ": signs turned to flexion and spreading positive; with a glove of 18 sensors "
      "the distal joints in it are estimates");
  return recording;
}

namespace {

LandmarkLine read_row(const std::filesystem::path& file, const TextLine& line) {
  try {
    LandmarkLine row = read_landmark_line(trimmed(line.text));
    if (!row.time) {
      throw LineProtocolError("no key \"time\"");
    }
    return row;
  } catch (const LineProtocolError& error) {
    throw geometric::InputError(
        {at_line(file, line), "", error.what(), "a row of landmarks",
         "A row is {\"time\": s, \"hand\": \"right\", \"landmarks\": 21 points in m}."});
  }
}

}  // namespace

RecordingHeader landmark_header(const std::filesystem::path& file) {
  RecordingHeader header;
  header.kind = RecordingKind::kAngles;
  header.device = "landmarks of a hand";
  header.origin = file.filename().string();
  header.sensors = landmark_sensors();
  return header;
}

std::vector<double> landmark_row(const RecordingHeader& header, const HandLandmarks& points,
                                 bool left) {
  const GloveAngles angles = glove_angles(in_palm_frame(points, left));
  std::vector<double> row;
  for (const int sensor : header.sensors) {
    row.push_back(angles.angles.at(static_cast<std::size_t>(sensor)));
  }
  return row;
}

bool is_landmark_row(const TextLine& line) { return trimmed(line.text).starts_with('{'); }

Recording read_landmark_recording(const std::filesystem::path& file,
                                  const std::vector<TextLine>& lines) {
  Recording recording;
  recording.header = landmark_header(file);
  struct Seen {
    TextLine line;
    double time;
    HandLandmarks points;
  };
  std::vector<Seen> seen;
  std::optional<bool> left;
  int others = 0;
  const auto take = [&](const TextLine& line) {
    const LandmarkLine row = read_row(file, line);
    if (!row.landmarks) {
      return;
    }
    left = left.value_or(row.left);
    if (row.left != *left) {
      ++others;
      return;
    }
    seen.push_back({line, *row.time, *row.landmarks});
  };
  const auto is_row = [](const TextLine& line) { return nlohmann::json::accept(line.text); };
  take_rows(file, lines, recording.warnings, is_row, take);
  if (others > 0) {
    recording.warnings.push_back(
        fmt::format("{}: {} rows of the {} hand left out, the first is of "
                    "the {} one",
                    file.string(), others, *left ? "right" : "left", *left ? "left" : "right"));
  }
  double as_labelled = 0.0;
  double as_other = 0.0;
  for (const Seen& row : seen) {
    as_labelled += bending(row.points, *left);
    as_other += bending(row.points, !*left);
  }
  constexpr double kClearly = 0.3;  // rad, of all fingers together
  if (as_other - as_labelled > kClearly * static_cast<double>(seen.size())) {
    left = !*left;
    recording.warnings.push_back(fmt::format(
        "{}: labelled as a {} hand, but taken for a {} one: its fingers would bend backwards",
        file.string(), *left ? "right" : "left", *left ? "left" : "right"));
  }
  RecordedRows rows(file, recording.header.sensors.size());
  std::vector<HandBones> bones;
  for (const Seen& row : seen) {
    bones.push_back(bones_of(row.points));
    rows.add(row.line, row.time, landmark_row(recording.header, row.points, *left));
  }
  rows.move_to(recording);
  recording.bones = median_bones(bones);
  return recording;
}

}  // namespace handway::device
