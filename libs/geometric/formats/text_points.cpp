#include "formats/cloud_formats.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/table_text.h"

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

constexpr std::size_t kMostLinesInFront = 100;

std::optional<std::vector<double>> numbers_of(std::string_view line) {
  std::vector<double> numbers;
  for (const std::string_view cell : cells(line, separator_of(line))) {
    const std::optional<double> number = parse_cell(cell);
    if (!number && cell != "nan" && cell != "NaN" && cell != "-nan") {
      return std::nullopt;
    }
    numbers.push_back(number.value_or(std::nan("")));
  }
  return numbers.size() < 3 ? std::nullopt : std::optional(std::move(numbers));
}

using Columns = std::array<std::size_t, 3>;

/// Columns of a point by the names in a line above the points.
struct PointColumns {
  std::size_t count = 0;  ///< Columns of the table.
  Columns places{0, 1, 2};
  Eigen::Vector3d units = Eigen::Vector3d::Ones();  ///< m
  std::optional<Columns> colors;
};

// Returns m for 1 in a column that a name calls `axis`: "x", "X [mm]", "//X". 0: it is another one.
double unit_of(std::string_view name, std::string_view axis) {
  const std::vector<std::string> words = words_of_column(name);
  if (words.empty() || words.size() > 2 || words.front() != axis) {
    return 0.0;
  }
  const std::string& unit = words.back();
  return words.size() == 1 || unit == "m" ? 1.0 : unit == "mm" ? 1e-3 : unit == "cm" ? 1e-2 : 0.0;
}

std::optional<PointColumns> columns_named(std::string_view line) {
  std::vector<std::string_view> names = cells(line, separator_of(line));
  if (!names.empty() && words_of_column(names.front()).empty()) {  // "# x y z"
    names.erase(names.begin());
  }
  PointColumns columns;
  columns.count = names.size();
  const auto find = [&](std::string_view axis) {
    return static_cast<std::size_t>(
        std::ranges::find_if(names, [&](auto name) { return unit_of(name, axis) > 0.0; }) -
        names.begin());
  };
  const auto is_found = [&](std::size_t column) { return column < names.size(); };
  columns.places = {find("x"), find("y"), find("z")};
  if (!std::ranges::all_of(columns.places, is_found)) {
    return std::nullopt;
  }
  columns.units = {unit_of(names[columns.places[0]], "x"), unit_of(names[columns.places[1]], "y"),
                   unit_of(names[columns.places[2]], "z")};
  for (const Columns& colors : {Columns{find("r"), find("g"), find("b")},
                                Columns{find("red"), find("green"), find("blue")}}) {
    if (std::ranges::all_of(colors, is_found)) {
      columns.colors = colors;
    }
  }
  return columns;
}

// Columns without names: colours are behind the places of six.
PointColumns columns_of(std::size_t count) {
  PointColumns columns;
  columns.count = count;
  if (count == 6) {
    columns.colors = {3, 4, 5};
  }
  return columns;
}

Eigen::Vector3d three_of(const std::vector<double>& row, const Columns& columns) {
  return {row[columns[0]], row[columns[1]], row[columns[2]]};
}

}  // namespace

ReadCloud read_text_points(std::string_view content, const std::string& source) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (content.starts_with(kByteOrderMark)) {
    content.remove_prefix(kByteOrderMark.size());
  }
  PointCollector points(source, 0);
  std::size_t in_front = 0;
  std::string_view above;  // the line above the first point
  std::optional<PointColumns> columns;
  bool is_named = false;
  for (const TextLine& line : text_lines(content)) {
    const std::string_view text = trimmed(line.text);
    if (text.empty() || text.front() == '#') {
      above = text.empty() ? above : text;
      continue;
    }
    const std::optional<std::vector<double>> row = numbers_of(text);
    if (!row && (columns || ++in_front > kMostLinesInFront)) {
      refuse_cloud(fmt::format("{}:{}", source, line.number), "", fmt::format("\"{:.40}\"", text),
                   "x, y and z as three numbers");
    }
    if (!row) {
      above = text;
      continue;
    }
    if (!columns) {
      columns = columns_named(above);
      is_named = columns && columns->count == row->size();
      columns = is_named ? columns : columns_of(row->size());
    }
    if (row->size() != columns->count && (is_named || columns->colors)) {
      refuse_cloud(fmt::format("{}:{}", source, line.number), "",
                   fmt::format("{} numbers", row->size()),
                   fmt::format("{} as in the first line", columns->count));
    }
    const Eigen::Vector3d place = columns->units.cwiseProduct(three_of(*row, columns->places));
    if (columns->colors) {
      points.add(place, color_from(three_of(*row, *columns->colors)));
    } else {
      points.add(place);
    }
  }
  return {std::move(points).take(), {}};
}

}  // namespace handway::geometric
