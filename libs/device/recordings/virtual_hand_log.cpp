#include "glove/text_files.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/io/input_error.h"
#include "recordings/recorded_rows.h"
#include "recordings/recording_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>

namespace handway::device {
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

/// The cells of a row: date, time, switch, and angles by their sensors, or "slot_N" of others.
RawColumns log_columns() {
  RawColumns columns;
  for (const char* name : {"year", "month", "day", "hour", "minute", "second", "switch"}) {
    columns.add(name, "");
  }
  for (int slot = 0; slot < static_cast<int>(kSlots); ++slot) {
    const auto sensor = std::ranges::find(cyberglove_sensors(), slot, &GloveSensor::slot);
    columns.add(sensor == cyberglove_sensors().end() ? fmt::format("slot_{}", slot + 1)
                                                     : std::string(sensor->name),
                "rad");
  }
  return columns;
}

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
  RecordedRows rows(file, kGloveSensors, log_columns());
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
    rows.add(line, std::round((*time - *begin) * 1e5) / 1e5, angles, {row->begin(), row->end()});
  };
  take_rows(file, lines, recording.warnings, is_virtual_hand_row, take);
  rows.move_to(recording);
  recording.warnings.push_back(
      file.string() +
      ": signs turned to flexion and spreading positive; with a glove of 18 sensors "
      "the distal joints in it are estimates");
  return recording;
}

class VirtualHandLogs final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"VirtualHand log", "Rows of date, time, a switch and 23 angles (text)."};
  }
  [[nodiscard]] bool recognises(const RecordingFile& file) const override {
    const TextLine* first = file.first_line();
    return first != nullptr && is_virtual_hand_row(*first);
  }
  [[nodiscard]] Recording read(const RecordingFile& file) const override {
    return read_virtual_hand_log(file.path(), file.lines());
  }
};

}  // namespace

const RecordingFormat& virtual_hand_log_format() {
  static const VirtualHandLogs kFormat;
  return kFormat;
}

}  // namespace handway::device
