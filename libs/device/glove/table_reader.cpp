#include "glove/table_reader.h"

#include "glove/landmark_dump.h"
#include "glove/matlab_file.h"
#include "glove/recording_readers.h"
#include "glove/sensor_names.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace handway::device {
namespace {

using geometric::InputError;
using geometric::YamlElement;

constexpr std::size_t kLargestTable = std::size_t{1} << 30;
constexpr double kUsualRate = 100.0;  // Hz, of gloves

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
constexpr double kWord = std::numeric_limits<double>::infinity();

/// Numbers in rows; kGap where nothing was measured, kWord where a cell is text, as labels.
struct Table {
  std::vector<std::string> names;  ///< Of columns; empty without a header.
  Eigen::MatrixXd values;
  std::vector<std::size_t> lines;  ///< In the file, of each row; empty: the row's own number.
  std::vector<std::string> warnings;
};

/// What a column is.
struct ColumnUse {
  int sensor = -1;
  Eigen::Index column = 0;
  double gain = 1.0;  ///< value · gain + offset is counts, or rad with flexion positive.
  double offset = 0.0;
};

struct Layout {
  RecordingKind kind = RecordingKind::kAngles;
  std::vector<ColumnUse> columns;
  std::optional<ColumnUse> time;  ///< In s.
  double rate = 1.0;              ///< Hz, without times.
  std::string order;              ///< Whose order columns without names are in; may be empty.
};

/// The cell of a column that isn't all gaps.
double cell_of(const Table& table, Eigen::Index row, const ColumnUse& use) {
  return use.gain * table.values(row, use.column) + use.offset;
}

std::string row_name(const std::filesystem::path& file, const Table& table, Eigen::Index row) {
  const auto index = static_cast<std::size_t>(row);
  return table.lines.empty() ? fmt::format("{}, row {}", file.string(), row + 1)
                             : fmt::format("{}:{}", file.string(), table.lines[index]);
}

/// Those in which all that is used was measured; a warning says how many were not.
/// @throws InputError if a used cell is text, or if there are none.
std::vector<Eigen::Index> rows_without_gaps(const std::filesystem::path& file, const Table& table,
                                            const Layout& layout,
                                            std::vector<std::string>& warnings) {
  std::vector<ColumnUse> used = layout.columns;
  if (layout.time) {
    used.push_back(*layout.time);
  }
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = 0; row < table.values.rows(); ++row) {
    for (const ColumnUse& use : used) {
      if (std::isinf(table.values(row, use.column))) {
        throw InputError({row_name(file, table, row), fmt::format("column {}", use.column + 1),
                          "no number", "a number", "Leave columns of labels out of the map."});
      }
    }
    if (std::ranges::none_of(used, [&](const ColumnUse& use) {
          return std::isnan(table.values(row, use.column));
        })) {
      rows.push_back(row);
    }
  }
  const auto left_out = static_cast<std::size_t>(table.values.rows()) - rows.size();
  if (rows.empty()) {
    throw InputError({file.string(), "", "a gap in each row", "rows of numbers",
                      "Leave columns that were not measured out of the map."});
  }
  if (left_out > 0) {
    warnings.push_back(fmt::format("{}: {} of {} rows left out, they have gaps", file.string(),
                                   left_out, table.values.rows()));
  }
  return rows;
}

Recording recording_of(const std::filesystem::path& file, const Table& table,
                       const Layout& layout) {
  Recording recording;
  recording.header.kind = layout.kind;
  recording.header.origin = file.filename().string();
  for (const ColumnUse& use : layout.columns) {
    recording.header.sensors.push_back(use.sensor);
  }
  recording.warnings = table.warnings;
  const std::vector<Eigen::Index> rows = rows_without_gaps(file, table, layout, recording.warnings);
  recording.times.resize(static_cast<Eigen::Index>(rows.size()));
  recording.values.resize(recording.times.size(), static_cast<Eigen::Index>(layout.columns.size()));
  for (Eigen::Index to = 0; to < recording.times.size(); ++to) {
    const Eigen::Index row = rows[static_cast<std::size_t>(to)];
    recording.times[to] =
        layout.time ? cell_of(table, row, *layout.time) : static_cast<double>(row) / layout.rate;
    if (to > 0 && recording.times[to] < recording.times[to - 1]) {
      throw InputError({row_name(file, table, row), "time",
                        fmt::format("{} after {}", recording.times[to], recording.times[to - 1]),
                        "time that doesn't run backwards", "Split the file there."});
    }
    for (std::size_t c = 0; c < layout.columns.size(); ++c) {
      const ColumnUse& use = layout.columns[c];
      const double value = cell_of(table, row, use);
      const bool counts = layout.kind == RecordingKind::kCounts;
      if (counts ? value < 0.0 || value > kHighestCounts : std::abs(value) > kWidestAngle) {
        throw InputError(
            {row_name(file, table, row),
             std::string(cyberglove_sensors()[static_cast<std::size_t>(use.sensor)].name),
             fmt::format("{:.4g}", value), counts ? "counts from 0 to 255" : "an angle in rad",
             counts ? "" : "If these are degrees, map them with \"unit: deg\"."});
      }
      recording.values(to, static_cast<Eigen::Index>(c)) = value;
    }
  }
  return recording;
}

bool is_header(const std::vector<std::string_view>& parts, char separator) {
  return std::ranges::none_of(parts, [separator](std::string_view part) {
    return parse_cell(part, separator).has_value();
  });
}

bool is_remark(const TextLine& line) {
  const std::string_view text = trimmed(line.text);
  return text.empty() || text.starts_with('#') || text.starts_with('%');
}

/// The cells of a line with so many (0: as it has), but for an empty one behind the last separator.
std::vector<std::string_view> cells_of(const TextLine& line, char separator, std::size_t columns) {
  std::vector<std::string_view> parts = cells(line.text, separator);
  if (parts.size() == columns + 1 && columns > 0 && parts.back().empty()) {
    parts.pop_back();
  }
  return parts;
}

/// Whether a line is words of less than half as many cells as the one below it.
bool is_title(const TextLine& line, const TextLine& below, char separator) {
  const auto filled = [separator](const TextLine& of) {
    return std::ranges::count_if(cells(of.text, separator),
                                 [](std::string_view cell) { return !cell.empty(); });
  };
  return is_header(cells(line.text, separator), separator) && 2 * filled(line) < filled(below);
}

double number_or_mark(std::string_view cell, char separator) {
  constexpr std::array<std::string_view, 10> kGaps{"",  "nan", "na",   "n/a",  "null",
                                                   "-", "inf", "+inf", "-inf", "none"};
  std::string small(cell);
  std::ranges::transform(small, small.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return parse_cell(cell, separator)
      .value_or(std::ranges::find(kGaps, small) == kGaps.end() ? kWord : kGap);
}

/// @param skip lines before the table. @param separator nothing: that of its last whole line.
Table read_text_table(const std::filesystem::path& file, std::span<const TextLine> all, int skip,
                      std::optional<char> separator) {
  std::vector<TextLine> lines;
  for (const TextLine& line : all) {
    if (line.number > static_cast<std::size_t>(skip) && !is_remark(line)) {
      lines.push_back(line);
    }
  }
  if (!separator && !lines.empty()) {
    separator = separator_of(lines[lines.size() > 1 ? lines.size() - 2 : 0].text);
  }
  // Titles above the table are no line of it.
  while (lines.size() > 2 && is_title(lines[0], lines[1], *separator)) {
    lines.erase(lines.begin());
  }
  Table table;
  std::vector<std::vector<double>> rows;
  std::size_t columns = 0;
  for (const TextLine& line : lines) {
    const std::vector<std::string_view> parts = cells_of(line, *separator, columns);
    if (columns == 0) {
      columns = parts.size();
      if (is_header(parts, *separator)) {
        table.names.assign(parts.begin(), parts.end());
        continue;
      }
    }
    if (parts.size() < columns && !line.ended) {
      table.warnings.push_back(at_line(file, line) + ": left out, the row is cut off");
      continue;
    }
    if (parts.size() != columns) {
      throw InputError({at_line(file, line), "", fmt::format("{} cells", parts.size()),
                        fmt::format("{} as in the first row", columns), ""});
    }
    std::vector<double>& row = rows.emplace_back();
    for (const std::string_view part : parts) {
      row.push_back(number_or_mark(part, *separator));
    }
    table.lines.push_back(line.number);
  }
  if (rows.empty()) {
    throw InputError({file.string(), "", "no rows", "at least one", ""});
  }
  table.values.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns));
  for (std::size_t row = 0; row < rows.size(); ++row) {
    table.values.row(static_cast<Eigen::Index>(row)) =
        Eigen::Map<const Eigen::RowVectorXd>(rows[row].data(), table.values.cols());
  }
  return table;
}

constexpr Eigen::Index kAngles = 23;           // of VirtualHand, without the last, unwired slot
constexpr Eigen::Index kAnglesWithLabel = 22;  // and without the wrist's abduction

/// Columns in the order of a glove's records, from column `first` on.
std::vector<ColumnUse> glove_columns(int sensors, Eigen::Index first) {
  std::vector<ColumnUse> columns;
  for (const int sensor : cyberglove_wired(sensors)) {
    columns.push_back({sensor, first + static_cast<Eigen::Index>(columns.size())});
  }
  return columns;
}

/// VirtualHand's angles in so many columns from column `first` on.
std::vector<ColumnUse> virtual_hand_columns(Eigen::Index first, Eigen::Index count) {
  std::vector<ColumnUse> columns;
  for (int sensor = 0; sensor < kGloveSensors; ++sensor) {
    const int slot = cyberglove_sensors()[static_cast<std::size_t>(sensor)].slot;
    if (slot < count) {
      columns.push_back({sensor, first + slot, virtual_hand_sign(sensor)});
    }
  }
  return columns;
}

/// In s, if a column of that name is times.
std::optional<double> time_unit(const std::string& name) {
  const std::vector<std::string> words = words_of_name(name);
  if (words.empty() ||
      !(has_word({words.front()}, {"t", "times", "seconds", "sec", "timems", "ms"}) ||
        has_word(words, {"time", "timestamp"}))) {
    return std::nullopt;
  }
  return has_word(words, {"ms", "msec", "milliseconds", "timems"}) ? 1e-3 : 1.0;
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Columns by the names of their header.
/// @throws InputError if none is a sensor's, or two are the same one's.
Layout named_layout(const std::filesystem::path& file, const Table& table,
                    std::vector<std::string>& passed_over) {
  Layout layout;
  layout.rate = kUsualRate;
  for (std::size_t c = 0; c < table.names.size(); ++c) {
    ColumnUse use{-1, static_cast<Eigen::Index>(c)};
    const auto column = table.values.col(use.column).array();
    const std::optional<double> unit = time_unit(table.names[c]);
    if (unit && !layout.time && column.isFinite().any()) {
      use.gain = *unit;
      layout.time = use;
      continue;
    }
    const std::optional<int> sensor = sensor_by_any_name(table.names[c]);
    if (!sensor || !column.isFinite().any()) {
      if (!table.names[c].empty()) {
        passed_over.push_back(table.names[c]);
      }
      continue;
    }
    use.sensor = *sensor;
    if (std::ranges::count(layout.columns, *sensor, &ColumnUse::sensor) > 0) {
      throw InputError({file.string(), fmt::format("column \"{}\"", table.names[c]),
                        "a sensor for the second time", "every sensor once",
                        "Say which by a map of the table (YAML)."});
    }
    layout.columns.push_back(use);
  }
  if (layout.columns.empty()) {
    std::string advice;
    for (const std::string& name : passed_over) {
      advice += advice.empty() ? geometric::advise_name(name, sensor_names()) : "";
    }
    throw InputError({file.string(), "", joined(table.names),
                      "columns named as the glove's sensors",
                      advice + (advice.empty() ? "Write" : " Or write") +
                          " a map of the table's columns (YAML)."});
  }
  return layout;
}

bool rises(const Eigen::MatrixXd& values, Eigen::Index column) {
  constexpr Eigen::Index kEnough = 5;
  const Eigen::Index last = values.rows() - 1;
  return last + 1 >= kEnough &&
         (values.col(column).tail(last).array() > values.col(column).head(last).array()).all();
}

/// The columns between labels on either side, and whether the first of them is times.
struct MeasuredColumns {
  Eigen::Index first = 0;
  Eigen::Index end = 0;
  bool timed = false;
};

MeasuredColumns measured_columns(const Table& table) {
  const auto is_label = [&](Eigen::Index column) {
    return table.values.col(column).array().isInf().any();
  };
  MeasuredColumns columns{0, table.values.cols(), false};
  while (columns.end > 0 && is_label(columns.end - 1)) {
    --columns.end;
  }
  while (columns.first < columns.end && is_label(columns.first)) {
    ++columns.first;
  }
  columns.timed = columns.first < columns.end && rises(table.values, columns.first);
  return columns;
}

/// Columns without names: 18 or 22 in the order of a glove's records, or VirtualHand's 23 angles,
/// or its 22 and a label; times before them, if the first column rises all along. Labels may stand
/// on either side.
Layout layout_by_number(const std::filesystem::path& file, const Table& table) {
  const auto [first, end, timed] = measured_columns(table);
  const Eigen::Index measured = end - first - (timed ? 1 : 0);
  const bool labelled = end < table.values.cols();
  Layout layout;
  layout.rate = kUsualRate;
  if (measured == kAngles || (measured == kAnglesWithLabel && labelled)) {
    layout.columns = virtual_hand_columns(first + (timed ? 1 : 0), measured);
    layout.rate = 1.0;  // postures, rather than a motion
    layout.order = "VirtualHand, whose signs were turned";
  } else if (measured == 18 || measured == kGloveSensors) {
    layout.columns = glove_columns(static_cast<int>(measured), first + (timed ? 1 : 0));
    layout.order = fmt::format("a glove of {} sensors", measured);
  } else {
    throw InputError(
        {file.string(), "",
         fmt::format("{} columns {}", end - first,
                     table.names.empty() ? "without names" : "of which none is called as a sensor"),
         "names of sensors above them; or 18 or 22, in the order of a glove's "
         "records, or 23, VirtualHand's; or 63, x, y and z of 21 landmarks",
         "Write a map of the table's columns (YAML); handway pca --joints-of ROBOT reads "
         "tables of a robot hand's joints"});
  }
  if (timed) {
    layout.time = ColumnUse{-1, first};
  }
  return layout;
}

bool bends(int sensor) {
  const std::string_view name = cyberglove_sensors()[static_cast<std::size_t>(sensor)].name;
  return name.ends_with("MPJ") || name.ends_with("PIJ") || name.ends_with("DIJ");
}

/// Counts, rad or degrees, and where bending counts negative, by the numbers.
/// @returns what it was taken for.
std::string settle_numbers(const std::filesystem::path& file, const Table& table, Layout& layout) {
  double least = 0.0;
  double most = 0.0;
  bool whole = true;
  bool in_degrees = false;
  int bending = 0;
  int negative = 0;
  for (const ColumnUse& use : layout.columns) {
    double sum = 0.0;
    for (const double value : table.values.col(use.column)) {
      if (std::isfinite(value)) {
        least = std::min(least, value);
        most = std::max(most, value);
        whole &= value == std::round(value);
        sum += use.gain * value;
      }
    }
    bending += bends(use.sensor) ? 1 : 0;
    negative += bends(use.sensor) && sum < 0.0 ? 1 : 0;
    if (const auto column = static_cast<std::size_t>(use.column); column < table.names.size()) {
      in_degrees |= has_word(words_of_name(table.names[column]), {"deg", "degree", "degrees"}) ||
                    table.names[column].find("\u00B0") != std::string::npos;
    }
  }
  constexpr double kMostDegrees = 360.0;
  const double widest = std::max(-least, most);
  if (whole && least >= 0.0 && most <= kHighestCounts && !in_degrees) {
    layout.kind = RecordingKind::kCounts;
    return "counts";
  }
  if (widest > kMostDegrees) {
    throw InputError({file.string(), "", fmt::format("values up to {:.6g}", widest),
                      "counts from 0 to 255, or angles in rad or degrees",
                      "Write a map of the table's columns (YAML), with gains."});
  }
  in_degrees |= widest > kWidestAngle;
  constexpr int kEnough = 4;
  const bool turned = bending >= kEnough && 4 * negative >= 3 * bending;
  for (ColumnUse& use : layout.columns) {
    use.gain *=
        (in_degrees ? geometric::kDegree : 1.0) * (turned ? virtual_hand_sign(use.sensor) : 1.0);
  }
  return std::string(in_degrees ? "degrees" : "rad") +
         (turned ? ", bent fingers negative (turned)" : "");
}

Recording recording_by_numbers(const std::filesystem::path& file, const Table& table, Layout layout,
                               const std::vector<std::string>& passed_over) {
  std::string taken = settle_numbers(file, table, layout) + " by its numbers";
  if (!layout.order.empty()) {
    taken += ", in the order of " + layout.order;
  }
  if (!layout.time) {
    taken += fmt::format(", {:g} rows a second", layout.rate);
  }
  if (!passed_over.empty()) {
    taken += "; passed over: " + joined(passed_over);
  }
  Recording recording = recording_of(file, table, layout);
  recording.warnings.push_back(fmt::format("{}: taken for {}", file.string(), taken));
  return recording;
}

/// The landmarks of a table that has them: by their names, or 63 columns without names.
std::vector<SeenHand> hands_in(const Table& table) {
  std::optional<LandmarkColumns> columns = landmark_columns(table.names);
  std::optional<ColumnUse> time;
  constexpr auto kCoordinates = static_cast<Eigen::Index>(std::tuple_size_v<LandmarkColumns>);
  const MeasuredColumns measured = measured_columns(table);
  const bool timed = measured.timed && measured.end - measured.first == kCoordinates + 1;
  const Eigen::Index first = measured.first + (timed ? 1 : 0);
  if (!columns && table.names.empty() && measured.end - first == kCoordinates) {
    columns.emplace();
    std::iota(columns->begin(), columns->end(), static_cast<std::size_t>(first));
    time = timed ? std::optional(ColumnUse{-1, measured.first}) : std::nullopt;
  }
  for (std::size_t c = 0; c < table.names.size() && !time; ++c) {
    const std::optional<double> unit = time_unit(table.names[c]);
    const auto column = static_cast<Eigen::Index>(c);
    if (unit && table.values.col(column).allFinite()) {
      time = ColumnUse{-1, column, *unit};
    }
  }
  std::vector<SeenHand> hands;
  for (Eigen::Index row = 0; columns && row < table.values.rows(); ++row) {
    SeenHand& hand = hands.emplace_back();
    for (std::size_t i = 0; i < columns->size(); ++i) {
      hand.points(static_cast<Eigen::Index>(i % 3), static_cast<Eigen::Index>(i / 3)) =
          table.values(row, static_cast<Eigen::Index>(columns->at(i)));
    }
    if (time) {
      hand.time = cell_of(table, row, *time);
    }
  }
  return hands;
}

}  // namespace

Recording read_other_table(const std::filesystem::path& file, const std::vector<TextLine>& lines) {
  const Table table = read_text_table(file, lines, 0, {});
  if (const std::vector<SeenHand> hands = hands_in(table); !hands.empty()) {
    return recording_of_hands(file, hands);
  }
  const auto known = std::ranges::count_if(
      table.names, [](const std::string& name) { return sensor_by_any_name(name).has_value(); });
  std::vector<std::string> passed_over;
  const bool by_number =
      table.names.empty() || (known == 0 && table.values.cols() >= kAnglesWithLabel);
  const Layout layout =
      by_number ? layout_by_number(file, table) : named_layout(file, table, passed_over);
  return recording_by_numbers(file, table, layout, passed_over);
}

namespace {

std::string names_of(const std::map<std::string, Eigen::MatrixXd>& matrices) {
  std::string text;
  for (const auto& [name, matrix] : matrices) {
    text +=
        fmt::format("{}{} ({} x {})", text.empty() ? "" : ", ", name, matrix.rows(), matrix.cols());
  }
  return text.empty() ? "no matrix" : text;
}

bool is_of_glove(Eigen::Index columns) { return columns == 18 || columns == kGloveSensors; }

/// The matrices that a glove may have measured, by name, with its sensors as columns. Where several
/// are, those called as in Ninapro's files: "angles", which are calibrated, before "glove".
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
    throw InputError(
        {file.string(), "", names_of(matrices),
         "\"angles\" (degrees) or \"glove\" (counts), or one matrix, of 18 or 22 columns",
         "Name the variable and its columns in a map of the table (YAML)."});
  }
  const auto& [name, matrix] = *fitting.begin();
  const Table table{
      {}, matrix.unaryExpr([](double v) { return std::isfinite(v) ? v : kGap; }), {}, {}};
  Layout layout;
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
  return recording_by_numbers(file, table, layout, {});
}

namespace {

/// A column by its number from 1, or by its name.
Eigen::Index column_of(const YamlElement& element, const Table& table) {
  const std::string text = element.text();
  const auto named = std::ranges::find(table.names, text);
  if (named != table.names.end()) {
    return named - table.names.begin();
  }
  const std::optional<double> number = parse_number(text);
  if (!number || *number != std::floor(*number) || *number < 1.0 ||
      *number > static_cast<double>(table.values.cols())) {
    element.refuse(element.found(),
                   fmt::format("a column's name, or its number from 1 to {}", table.values.cols()),
                   geometric::advise_name(text, table.names));
  }
  return static_cast<Eigen::Index>(*number) - 1;
}

ColumnUse column_use(const YamlElement& element, const Table& table) {
  ColumnUse use;
  if (!element.is_map()) {
    use.column = column_of(element, table);
    return use;
  }
  element.allow_keys({"column", "gain", "offset"});
  use.column = column_of(element.need("column"), table);
  use.gain = element.number_or("gain", 1.0);
  use.offset = element.number_or("offset", 0.0);
  return use;
}

template <typename Value>
Value choice(const YamlElement& top, const std::string& key,
             const std::vector<std::pair<std::string, Value>>& choices) {
  const std::optional<YamlElement> element = top.find(key);
  if (!element) {
    return choices.front().second;
  }
  std::string known;
  for (const auto& [name, value] : choices) {
    if (element->text() == name) {
      return value;
    }
    known += (known.empty() ? "" : ", ") + name;
  }
  element->refuse(element->found(), "one of " + known);
}

int whole_number(const YamlElement& element) {
  const double value = element.number();
  if (value < 0.0 || value > 1e6 || value != std::floor(value)) {
    element.refuse(element.found(), "a number of lines");
  }
  return static_cast<int>(value);
}

Table read_table(const YamlElement& top, const std::filesystem::path& file) {
  if (is_matlab_file(file)) {
    const YamlElement variable = top.need("variable");
    const auto matrices = read_matlab_file(file);
    if (const auto found = matrices.find(variable.text()); found != matrices.end()) {
      return {{}, found->second, {}, {}};
    }
    variable.refuse(variable.found(), "one of " + names_of(matrices));
  }
  std::string text = geometric::read_text_file(file, "a table of postures", kLargestTable);
  if (text.find('\n') == std::string::npos) {
    std::ranges::replace(text, '\r', '\n');
  }
  const std::optional<YamlElement> skip = top.find("skip");
  const auto separator = choice<std::optional<char>>(
      top, "separator",
      {{"any", std::nullopt}, {",", ','}, {";", ';'}, {"tab", '\t'}, {"blank", ' '}});
  return read_text_table(file, text_lines(text), skip ? whole_number(*skip) : 0, separator);
}

}  // namespace

Recording read_mapped_table(const std::filesystem::path& map) {
  enum class Unit { kRad, kDegrees, kCounts };
  enum class Signs { kPositive, kNegative, kVirtualHand };
  const YamlElement top = YamlElement::read(map, "a map of a table of postures");
  top.allow_keys(
      {"table", "variable", "separator", "skip", "unit", "signs", "rate", "time", "columns"});
  const std::filesystem::path file =
      std::filesystem::absolute(map).parent_path() / top.need("table").text();
  const Table table = read_table(top, file);
  const Unit unit = choice<Unit>(
      top, "unit", {{"rad", Unit::kRad}, {"deg", Unit::kDegrees}, {"counts", Unit::kCounts}});
  const Signs signs = choice<Signs>(top, "signs",
                                    {{"positive", Signs::kPositive},
                                     {"negative", Signs::kNegative},
                                     {"virtual_hand", Signs::kVirtualHand}});
  Layout layout;
  layout.kind = unit == Unit::kCounts ? RecordingKind::kCounts : RecordingKind::kAngles;
  const double scale = unit == Unit::kDegrees ? geometric::kDegree : 1.0;
  for (const auto& [name, element] : top.need("columns").entries()) {
    ColumnUse use = column_use(element, table);
    const int sensor = named_sensor(element, name);
    if (std::ranges::count(layout.columns, sensor, &ColumnUse::sensor) > 0) {
      element.refuse("sensor " + name + " for the second time", "every sensor once");
    }
    use.sensor = sensor;
    const double sign = signs == Signs::kVirtualHand ? virtual_hand_sign(sensor)
                        : signs == Signs::kNegative  ? -1.0
                                                     : 1.0;
    use.gain *= sign * scale;
    use.offset *= sign * scale;
    layout.columns.push_back(use);
  }
  if (layout.columns.empty()) {
    top.need("columns").refuse("no columns", "those of sensors");
  }
  if (const std::optional<YamlElement> time = top.find("time")) {
    layout.time = column_use(*time, table);
  }
  if (const std::optional<YamlElement> rate = top.find("rate")) {
    layout.rate = rate->number();
    if (!(layout.rate > 0.0)) {
      rate->refuse(rate->found(), "rows a second, above 0");
    }
  }
  Recording recording = recording_of(file, table, layout);
  recording.header.device = "table " + file.filename().string();
  return recording;
}

}  // namespace handway::device
