#include "glove/table_reader.h"

#include "glove/recording_readers.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>
#include <matio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace handway::device {
namespace {

constexpr std::size_t kMostEntries = std::size_t{1} << 27;  // 1 GB of numbers

using File = std::unique_ptr<mat_t, int (*)(mat_t*)>;
using Variable = std::unique_ptr<matvar_t, void (*)(matvar_t*)>;

bool is_matrix(const matvar_t& variable) {
  return variable.rank == 2 && variable.isComplex == 0 && variable.class_type >= MAT_C_DOUBLE &&
         variable.class_type <= MAT_C_UINT64 && variable.dims[0] > 0 && variable.dims[1] > 0 &&
         variable.dims[1] <= kMostEntries / variable.dims[0];
}

template <typename Number>
Eigen::MatrixXd numbers(const matvar_t& variable) {
  using Matrix = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;
  return Eigen::Map<const Matrix>(static_cast<const Number*>(variable.data),
                                  static_cast<Eigen::Index>(variable.dims[0]),
                                  static_cast<Eigen::Index>(variable.dims[1]))
      .template cast<double>();
}

// Numbers are kept as their class says, however few bytes they took in the file.
Eigen::MatrixXd matrix(const matvar_t& variable) {
  switch (variable.class_type) {
    case MAT_C_SINGLE:
      return numbers<float>(variable);
    case MAT_C_INT8:
      return numbers<std::int8_t>(variable);
    case MAT_C_UINT8:
      return numbers<std::uint8_t>(variable);
    case MAT_C_INT16:
      return numbers<std::int16_t>(variable);
    case MAT_C_UINT16:
      return numbers<std::uint16_t>(variable);
    case MAT_C_INT32:
      return numbers<std::int32_t>(variable);
    case MAT_C_UINT32:
      return numbers<std::uint32_t>(variable);
    case MAT_C_INT64:
      return numbers<std::int64_t>(variable);
    case MAT_C_UINT64:
      return numbers<std::uint64_t>(variable);
    default:
      return numbers<double>(variable);
  }
}

}  // namespace

bool is_matlab_file(const std::filesystem::path& file) {
  std::string begin(std::string_view("MATLAB 5.0 MAT-file").size(), ' ');
  std::ifstream(file, std::ios::binary)
      .read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin == "MATLAB 5.0 MAT-file" || begin == "MATLAB 7.3 MAT-file";
}

std::map<std::string, Eigen::MatrixXd> read_matlab_file(const std::filesystem::path& file) {
  const File opened(Mat_Open(file.c_str(), MAT_ACC_RDONLY), Mat_Close);
  if (!opened) {
    throw geometric::InputError({file.string(), "", "a file that can't be opened",
                                 "a MATLAB file of version 5 or 7.3",
                                 "Save it again, by save('FILE.mat', '-v7')."});
  }
  std::map<std::string, Eigen::MatrixXd> matrices;
  while (const auto variable = Variable(Mat_VarReadNextInfo(opened.get()), Mat_VarFree)) {
    if (variable->name == nullptr || !is_matrix(*variable)) {
      continue;
    }
    if (Mat_VarReadDataAll(opened.get(), variable.get()) != 0 || variable->data == nullptr) {
      throw geometric::InputError({file.string(), std::string("variable ") + variable->name,
                                   "one that is cut off or damaged", "a matrix",
                                   "Copy the file again."});
    }
    matrices[variable->name] = matrix(*variable);
  }
  return matrices;
}

namespace {

using geometric::InputError;
using geometric::YamlElement;

constexpr std::size_t kLargestTable = std::size_t{1} << 30;
constexpr double kUsualRate = 100.0;  // Hz, of gloves

/// Numbers in rows; NaN where a cell is none, as labels.
struct Table {
  std::vector<std::string> names;  ///< Of columns; empty without a header.
  Eigen::MatrixXd values;
  std::vector<std::size_t> lines;  ///< In the file, of each row; empty: the row's own number.
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
};

std::string row_name(const std::filesystem::path& file, const Table& table, Eigen::Index row) {
  const auto index = static_cast<std::size_t>(row);
  return table.lines.empty() ? fmt::format("{}, row {}", file.string(), row + 1)
                             : fmt::format("{}:{}", file.string(), table.lines[index]);
}

Recording recording_of(const std::filesystem::path& file, const Table& table,
                       const Layout& layout) {
  Recording recording;
  recording.header.kind = layout.kind;
  recording.header.origin = file.filename().string();
  for (const ColumnUse& use : layout.columns) {
    recording.header.sensors.push_back(use.sensor);
  }
  const Eigen::Index rows = table.values.rows();
  recording.times.resize(rows);
  recording.values.resize(rows, static_cast<Eigen::Index>(layout.columns.size()));
  const auto value_of = [&](Eigen::Index row, const ColumnUse& use) {
    const double value = use.gain * table.values(row, use.column) + use.offset;
    if (!std::isfinite(value)) {
      throw InputError({row_name(file, table, row), fmt::format("column {}", use.column + 1),
                        "no number", "a number", "Leave columns of labels out of the map."});
    }
    return value;
  };
  for (Eigen::Index row = 0; row < rows; ++row) {
    recording.times[row] =
        layout.time ? value_of(row, *layout.time) : static_cast<double>(row) / layout.rate;
    if (row > 0 && recording.times[row] < recording.times[row - 1]) {
      throw InputError({row_name(file, table, row), "time",
                        fmt::format("{} after {}", recording.times[row], recording.times[row - 1]),
                        "time that doesn't run backwards", "Split the file there."});
    }
    for (std::size_t c = 0; c < layout.columns.size(); ++c) {
      const ColumnUse& use = layout.columns[c];
      const double value = value_of(row, use);
      const bool counts = layout.kind == RecordingKind::kCounts;
      if (counts ? value < 0.0 || value > kHighestCounts : std::abs(value) > kWidestAngle) {
        throw InputError(
            {row_name(file, table, row),
             std::string(cyberglove_sensors()[static_cast<std::size_t>(use.sensor)].name),
             fmt::format("{:.4g}", value), counts ? "counts from 0 to 255" : "an angle in rad",
             counts ? "" : "If these are degrees, map them with \"unit: deg\"."});
      }
      recording.values(row, static_cast<Eigen::Index>(c)) = value;
    }
  }
  return recording;
}

bool is_header(const std::vector<std::string_view>& parts) {
  return std::ranges::none_of(parts,
                              [](std::string_view part) { return parse_number(part).has_value(); });
}

/// @param skip lines before the table. @param separator nothing: that of its first line.
Table read_text_table(const std::filesystem::path& file, std::span<const TextLine> lines, int skip,
                      std::optional<char> separator) {
  Table table;
  std::vector<std::vector<double>> rows;
  std::size_t columns = 0;
  for (const TextLine& line : lines) {
    if (line.number <= static_cast<std::size_t>(skip) || trimmed(line.text).empty()) {
      continue;
    }
    separator = separator ? separator : std::optional(separator_of(line.text));
    const std::vector<std::string_view> parts = cells(line.text, *separator);
    if (columns == 0) {
      columns = parts.size();
      if (is_header(parts)) {
        table.names.assign(parts.begin(), parts.end());
        continue;
      }
    }
    if (parts.size() != columns) {
      throw InputError({at_line(file, line), "", fmt::format("{} cells", parts.size()),
                        fmt::format("{} as in the first row", columns), ""});
    }
    std::vector<double>& row = rows.emplace_back();
    for (const std::string_view part : parts) {
      row.push_back(parse_number(part).value_or(std::numeric_limits<double>::quiet_NaN()));
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

constexpr std::size_t kAngles = 23;           // of VirtualHand, without the last, unwired slot
constexpr std::size_t kAnglesWithLabel = 22;  // and without the wrist's abduction

}  // namespace

bool is_posture_table(const std::vector<TextLine>& lines) {
  int looked_at = 0;
  for (const TextLine& line : lines) {
    if (trimmed(line.text).empty()) {
      continue;
    }
    const std::vector<std::string_view> parts = cells(line.text, separator_of(line.text));
    if (looked_at++ == 0 && parts.size() == kAngles && is_header(parts)) {
      continue;
    }
    const auto numbers = std::ranges::count_if(
        parts, [](std::string_view part) { return parse_number(part).has_value(); });
    return parts.size() == kAngles && (numbers == static_cast<std::ptrdiff_t>(kAngles) ||
                                       (numbers == static_cast<std::ptrdiff_t>(kAnglesWithLabel) &&
                                        !parse_number(parts.back())));
  }
  return false;
}

Recording read_posture_table(const std::filesystem::path& file,
                             const std::vector<TextLine>& lines) {
  const Table table = read_text_table(file, lines, 0, {});
  const bool labelled = !std::isfinite(table.values(0, table.values.cols() - 1));
  Layout layout;
  for (int sensor = 0; sensor < kGloveSensors; ++sensor) {
    const int slot = cyberglove_sensors()[static_cast<std::size_t>(sensor)].slot;
    if (!labelled || slot < static_cast<int>(kAnglesWithLabel)) {
      layout.columns.push_back({sensor, slot, virtual_hand_sign(sensor), 0.0});
    }
  }
  Recording recording = recording_of(file, table, layout);
  recording.header.device = "CyberGlove by VirtualHand";
  recording.warnings.push_back(file.string() +
                               ": angles of VirtualHand, turned to flexion and spreading positive; "
                               "postures without times are taken for a second apart");
  return recording;
}

namespace {

/// Columns in the order of a glove's records.
std::vector<ColumnUse> glove_columns(int sensors, double gain) {
  std::vector<ColumnUse> columns;
  for (const int sensor : cyberglove_wired(sensors)) {
    columns.push_back({sensor, static_cast<Eigen::Index>(columns.size()), gain, 0.0});
  }
  return columns;
}

bool is_of_glove(const Eigen::MatrixXd& matrix) {
  return matrix.rows() > 1 && (matrix.cols() == 18 || matrix.cols() == kGloveSensors);
}

std::string names_of(const std::map<std::string, Eigen::MatrixXd>& matrices) {
  std::string text;
  for (const auto& [name, matrix] : matrices) {
    text +=
        fmt::format("{}{} ({} x {})", text.empty() ? "" : ", ", name, matrix.rows(), matrix.cols());
  }
  return text.empty() ? "no matrix" : text;
}

}  // namespace

// Ninapro's names: "angles" (degrees) where it was calibrated, else "glove" (counts).
Recording read_matlab_recording(const std::filesystem::path& file) {
  const std::map<std::string, Eigen::MatrixXd> matrices = read_matlab_file(file);
  for (const auto& [name, kind, gain] :
       {std::tuple("angles", RecordingKind::kAngles, geometric::kDegree),
        std::tuple("glove", RecordingKind::kCounts, 1.0)}) {
    const auto found = matrices.find(name);
    if (found == matrices.end() || !is_of_glove(found->second)) {
      continue;
    }
    const auto rate = matrices.find("frequency");
    const bool timed = rate != matrices.end() && rate->second.size() == 1 && rate->second(0) > 0.0;
    Layout layout{kind,
                  glove_columns(static_cast<int>(found->second.cols()), gain),
                  {},
                  timed ? rate->second(0) : kUsualRate};
    Recording recording = recording_of(file, {{}, found->second, {}}, layout);
    recording.header.device = "CyberGlove";
    recording.warnings.push_back(
        fmt::format("{}: variable \"{}\" taken for {}{}", file.string(), name,
                    kind == RecordingKind::kAngles ? "degrees" : "counts",
                    timed ? "" : fmt::format(", {:g} rows a second", layout.rate)));
    return recording;
  }
  throw InputError({file.string(), "", names_of(matrices),
                    "\"angles\" (degrees) or \"glove\" (counts) of 18 or 22 columns",
                    "Name the variable and its columns in a map of the table (YAML)."});
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
  const std::optional<YamlElement> gain = element.find("gain");
  const std::optional<YamlElement> offset = element.find("offset");
  use.gain = gain ? gain->number() : 1.0;
  use.offset = offset ? offset->number() : 0.0;
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
      return {{}, found->second, {}};
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
    const std::optional<int> sensor = find_sensor(name);
    if (!sensor) {
      element.refuse('"' + name + '"', "a sensor's name or letter",
                     geometric::advise_name(name, sensor_names()));
    }
    if (std::ranges::count(layout.columns, *sensor, &ColumnUse::sensor) > 0) {
      element.refuse("sensor " + name + " for the second time", "every sensor once");
    }
    use.sensor = *sensor;
    const double sign = signs == Signs::kVirtualHand ? virtual_hand_sign(*sensor)
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
