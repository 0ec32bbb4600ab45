#include "glove/table_reader.h"

#include "glove/landmark_dump.h"
#include "glove/matlab_file.h"
#include "glove/recording_readers.h"
#include "glove/table_layout.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <map>
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

}  // namespace

Recording read_other_table(const std::filesystem::path& file, const std::vector<TextLine>& lines) {
  const NumberTable table = read_text_table(file, lines);
  std::vector<std::string> warnings;
  if (const std::vector<SeenHand> hands = hands_in(file, table, warnings); !hands.empty()) {
    Recording recording = recording_of_hands(file, hands);
    recording.warnings.insert(recording.warnings.begin(), warnings.begin(), warnings.end());
    return recording;
  }
  return recording_by_numbers(file, table, layout_of(file, table));
}

namespace {

bool is_of_glove(Eigen::Index columns) { return columns == 18 || columns == kGloveSensors; }

/// The matrices that may come from a glove, by name, with its sensors as columns. If there are
/// several, those with the names of Ninapro's files: "angles", which are calibrated, before
/// "glove".
std::map<std::string, Eigen::MatrixXd> glove_matrices(
    const std::map<std::string, Eigen::MatrixXd>& all) {
  std::map<std::string, Eigen::MatrixXd> fitting;
  for (const auto& [name, matrix] : all) {
    if (matrix.rows() > 1 && is_of_glove(matrix.cols())) {
      fitting[name] = matrix;
    } else if (is_of_glove(matrix.rows()) && matrix.cols() > kGloveSensors) {
      fitting[name] = matrix.transpose();
    }
  }
  for (const char* known : {"angles", "glove"}) {
    for (const auto& [name, matrix] : fitting) {
      if (name == known || name.ends_with(std::string(".") + known)) {
        return {{name, matrix}};
      }
    }
  }
  return fitting;
}

}  // namespace

Recording read_matlab_recording(const std::filesystem::path& file) {
  const std::map<std::string, Eigen::MatrixXd> matrices = read_matlab_file(file);
  const std::map<std::string, Eigen::MatrixXd> fitting = glove_matrices(matrices);
  if (fitting.size() != 1) {
    throw geometric::InputError(
        {file.string(), "", names_of(matrices),
         "\"angles\" (degrees) or \"glove\" (counts), or one matrix, of 18 or 22 columns",
         "Name the variable and its columns in a map of the table (YAML)."});
  }
  const auto& [name, matrix] = *fitting.begin();
  const NumberTable table{
      {}, matrix.unaryExpr([](double v) { return std::isfinite(v) ? v : kGap; }), {}, {}};
  TableLayout layout;
  layout.columns = glove_columns(static_cast<int>(matrix.cols()), 0);
  const auto rate = matrices.find("frequency");
  const bool has_rate = rate != matrices.end() && rate->second.size() == 1 && rate->second(0) > 0.0;
  layout.rate = has_rate ? rate->second(0) : kUsualRate;
  if (name == "angles") {
    for (ColumnUse& use : layout.columns) {
      use.gain = geometric::kDegree;
    }
    Recording recording = recording_of(file, table, layout);
    recording.warnings.push_back(
        fmt::format("{}: variable \"angles\" taken for degrees", file.string()));
    return recording;
  }
  return recording_by_numbers(file, table, layout);
}

}  // namespace handway::device
