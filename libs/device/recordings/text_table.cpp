#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/io/input_error.h"
#include "recordings/landmark_columns.h"
#include "recordings/landmark_recording.h"
#include "recordings/mano_recording.h"
#include "recordings/raw_table.h"
#include "recordings/recording_formats.h"
#include "recordings/table_layout.h"
#include "recordings/table_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

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

/// Columns of a posture of MANO.
struct ManoColumns {
  std::vector<Eigen::Index> columns;
  ManoSide side = ManoSide::kUnnamed;
};

// Columns "hand_pose_0" to "hand_pose_44" (or 47, or from 1 on), by their names; of several hands
// those of the first.
ManoColumns named_mano_columns(const std::vector<std::string>& names) {
  std::vector<std::pair<std::string, ManoColumns>> hands;
  for (std::size_t column = 0; column < names.size(); ++column) {
    const std::size_t letters = names[column].find_last_not_of("0123456789") + 1;
    const std::string prefix = names[column].substr(0, letters);
    if (letters == 0 || letters == names[column].size() || !is_mano_name(prefix)) {
      continue;
    }
    auto hand = std::ranges::find(hands, prefix, &std::pair<std::string, ManoColumns>::first);
    if (hand == hands.end()) {
      hand = hands.insert(hand, {prefix, {{}, side_in_name(prefix)}});
    }
    hand->second.columns.push_back(static_cast<Eigen::Index>(column));
  }
  const auto whole = std::ranges::find_if(
      hands, [](const auto& hand) { return is_mano_count(hand.second.columns.size()); });
  return whole == hands.end() ? ManoColumns{} : whole->second;
}

// The columns of postures of MANO: by their names, or 45 or 48 columns without names.
ManoColumns mano_columns(const NumberTable& table, TableLayout& layout) {
  ManoColumns found = named_mano_columns(table.names);
  const MeasuredColumns measured = measured_columns(table);
  if (found.columns.empty() && table.names.empty() &&
      is_mano_count(static_cast<std::size_t>(measured.end - measured.first))) {
    found.columns.resize(static_cast<std::size_t>(measured.end - measured.first));
    std::iota(found.columns.begin(), found.columns.end(), measured.first);
    layout.times = measured.times;
  }
  return found;
}

/// A recording of the postures of MANO in a table; nothing if it has none.
std::optional<Recording> read_mano_table(const std::filesystem::path& file,
                                         const NumberTable& table) {
  TableLayout layout;
  const ManoColumns mano = mano_columns(table, layout);
  if (mano.columns.empty()) {
    return std::nullopt;
  }
  find_times(table, layout);
  std::vector<std::string> warnings;
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(table.values.rows()));
  std::iota(rows.begin(), rows.end(), Eigen::Index{0});
  const std::vector<double> times = times_of(file, table, layout, rows, warnings);
  std::vector<ManoFrame> frames;
  for (const Eigen::Index row : rows) {
    const Eigen::VectorXd numbers = table.values.row(row)(mano.columns).transpose();
    ManoFrame& frame = frames.emplace_back();
    frame.pose = mano_pose({numbers.data(), static_cast<std::size_t>(numbers.size())});
    if (const double time = times[static_cast<std::size_t>(row)];
        !layout.times.empty() && std::isfinite(time)) {
      frame.time = time;
    }
  }
  Recording recording = recording_of_mano(file, frames, mano.side, {}, {1.0});
  recording.warnings.insert(recording.warnings.begin(), warnings.begin(), warnings.end());
  return recording;
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
  if (std::optional<Recording> mano = read_mano_table(file, table)) {
    return std::move(*mano);
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
