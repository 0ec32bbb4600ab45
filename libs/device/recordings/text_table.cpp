#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/io/input_error.h"
#include "recordings/landmark_columns.h"
#include "recordings/landmark_recording.h"
#include "recordings/raw_table.h"
#include "recordings/recording_formats.h"
#include "recordings/table_layout.h"
#include "recordings/table_recording.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>

namespace handway::device {
namespace {

/// The landmarks of a table: by their names, or 63 columns without names.
std::vector<SeenHand> hands_in(const std::filesystem::path& file, const NumberTable& table,
                               std::vector<std::string>& warnings) {
  std::optional<LandmarkColumns> columns = landmark_columns(table.names);
  constexpr auto kCoordinates = static_cast<Eigen::Index>(std::tuple_size_v<LandmarkColumns>);
  MeasuredColumns measured = measured_columns(table);
  if (measured.end - measured.first == kCoordinates - 1 && measured.times.size() == 1 &&
      !table.is_spelled(measured.times.front().column)) {
    measured.first = measured.times.front().column;  // a coordinate that happens to rise
    measured.times.clear();
  }
  TableLayout layout;
  if (!columns && table.names.empty() && measured.end - measured.first == kCoordinates) {
    columns.emplace();
    std::iota(columns->begin(), columns->end(), static_cast<std::size_t>(measured.first));
    layout.times = measured.times;
  }
  if (!columns) {
    return {};
  }
  find_times(table, layout);
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(table.values.rows()));
  std::iota(rows.begin(), rows.end(), Eigen::Index{0});
  const std::vector<double> times = times_of(file, table, layout, rows, warnings);
  std::vector<SeenHand> hands;
  for (const Eigen::Index row : rows) {
    SeenHand& hand = hands.emplace_back();
    hand.row = row;
    for (std::size_t i = 0; i < columns->size(); ++i) {
      hand.points(static_cast<Eigen::Index>(i % 3), static_cast<Eigen::Index>(i / 3)) =
          table.values(row, static_cast<Eigen::Index>(columns->at(i)));
    }
    if (const double time = times[static_cast<std::size_t>(row)];
        !layout.times.empty() && std::isfinite(time)) {
      hand.time = time;
    }
  }
  return hands;
}

/// Reads text of other programs: columns by the names of their header, as sensors are called by
/// Handway or others; without names, those of a glove's records or of VirtualHand. Unit and signs
/// are inferred from the numbers; warnings report the inference, and the columns and rows left out.
Recording read_other_table(const std::filesystem::path& file, const std::vector<TextLine>& lines) {
  const NumberTable table = read_text_table(file, lines);
  std::vector<std::string> warnings;
  if (const std::vector<SeenHand> hands = hands_in(file, table, warnings); !hands.empty()) {
    Recording recording = recording_of_hands(file, hands, {1.0}, raw_columns_of_table(table, {}));
    recording.warnings.insert(recording.warnings.begin(), warnings.begin(), warnings.end());
    return recording;
  }
  return recording_by_numbers(file, table, layout_of(file, table));
}

class TextTables final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"table", "A table of text with or without a header, of any program."};
  }
  [[nodiscard]] bool recognises(const RecordingFile& /*file*/) const override { return true; }
  [[nodiscard]] Recording read(const RecordingFile& file) const override {
    return read_other_table(file.path(), file.lines());
  }
};

}  // namespace

const RecordingFormat& text_table_format() {
  static const TextTables kFormat;
  return kFormat;
}

}  // namespace handway::device
