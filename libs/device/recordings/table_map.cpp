#include "glove/sensor_names.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/math/units.h"
#include "recordings/array_file.h"
#include "recordings/recording_formats.h"
#include "recordings/series_table.h"
#include "recordings/table_layout.h"
#include "recordings/table_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::device {
namespace {

using geometric::YamlElement;

constexpr std::size_t kLargestTable = std::size_t{1} << 30;

/// A column by its number from 1, or by its name.
Eigen::Index column_of(const YamlElement& element, const NumberTable& table) {
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

ColumnUse column_use(const YamlElement& element, const NumberTable& table) {
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

/// Reads the chosen variable of a file with arrays; the only one if none is named.
Series read_variable(const YamlElement& top, const ArrayFile& arrays) {
  const std::optional<YamlElement> variable = top.find("variable");
  if (!variable && arrays.variables().size() == 1) {
    return arrays.series(arrays.variables().front().name);
  }
  const YamlElement named = top.need("variable");
  if (std::ranges::count(arrays.variables(), named.text(), &RecordingVariable::name) == 0) {
    named.refuse(named.found(), "one of " + arrays.listed());
  }
  return arrays.series(named.text());
}

struct MappedTable {
  NumberTable table;
  std::vector<ColumnUse> times;  ///< Times that the file itself has.
  geometric::TimeUnit time_unit;
};

MappedTable read_table(const YamlElement& top, const std::filesystem::path& file) {
  if (const std::unique_ptr<ArrayFile> arrays = open_arrays(RecordingFile(file))) {
    const Series series = read_variable(top, *arrays);
    return {table_of(series), time_columns_of(series), series.time_unit};
  }
  std::string text = geometric::read_text_file(file, "a table of postures", kLargestTable);
  if (text.find('\n') == std::string::npos) {
    std::ranges::replace(text, '\r', '\n');
  }
  const std::optional<YamlElement> skip = top.find("skip");
  const auto separator = choice<std::optional<char>>(
      top, "separator",
      {{"any", std::nullopt}, {",", ','}, {";", ';'}, {"tab", '\t'}, {"blank", ' '}});
  return {
      read_text_table(file, text_lines(text), skip ? whole_number(*skip) : 0, separator), {}, {}};
}

Recording read_mapped_table(const std::filesystem::path& map) {
  enum class Unit { kRad, kDegrees, kCounts };
  enum class Signs { kPositive, kNegative, kVirtualHand };
  const YamlElement top = YamlElement::read(map, "a map of a table of postures");
  top.allow_keys(
      {"table", "variable", "separator", "skip", "unit", "signs", "rate", "time", "columns"});
  const std::filesystem::path file =
      std::filesystem::absolute(map).parent_path() / top.need("table").text();
  const MappedTable source = read_table(top, file);
  const NumberTable& table = source.table;
  const Unit unit = choice<Unit>(
      top, "unit", {{"rad", Unit::kRad}, {"deg", Unit::kDegrees}, {"counts", Unit::kCounts}});
  const Signs signs = choice<Signs>(top, "signs",
                                    {{"positive", Signs::kPositive},
                                     {"negative", Signs::kNegative},
                                     {"virtual_hand", Signs::kVirtualHand}});
  TableLayout layout;
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
    layout.times = {column_use(*time, table)};
    layout.time_unit.seconds = 1.0;
  }
  const std::optional<YamlElement> rate = top.find("rate");
  if (rate) {
    layout.rate = rate->number();
    if (!(layout.rate > 0.0)) {
      rate->refuse(rate->found(), "rows a second, above 0");
    }
  }
  if (layout.times.empty() && !rate) {
    layout.times = source.times;
    layout.time_unit = source.time_unit;
  }
  Recording recording = recording_of(file, table, layout);
  recording.header.device = "table " + file.filename().string();
  return recording;
}

class TableMaps final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"map of a table", "A YAML file that names a table and the use of its columns."};
  }
  [[nodiscard]] bool recognises(const RecordingFile& file) const override {
    return geometric::has_extension(file.path(), ".yaml") ||
           geometric::has_extension(file.path(), ".yml");
  }
  [[nodiscard]] Recording read(const RecordingFile& file) const override {
    return read_mapped_table(file.path());
  }
};

}  // namespace

const RecordingFormat& table_map_format() {
  static const TableMaps kFormat;
  return kFormat;
}

}  // namespace handway::device
