#include "formats/cloud_formats.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/table_text.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
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

}  // namespace

ReadCloud read_text_points(std::string_view content, const std::string& source) {
  PointCollector points(source, 0);
  std::size_t in_front = 0;
  std::size_t columns = 0;
  for (const TextLine& line : text_lines(content)) {
    const std::string_view text = trimmed(line.text);
    if (text.empty() || text.front() == '#') {
      continue;
    }
    const std::optional<std::vector<double>> row = numbers_of(text);
    if (!row && (columns > 0 || ++in_front > kMostLinesInFront)) {
      refuse_cloud(fmt::format("{}:{}", source, line.number), "", fmt::format("\"{:.40}\"", text),
                   "x, y and z as three numbers");
    }
    if (row) {
      columns = columns == 0 ? row->size() : columns;
      const Eigen::Vector3d place((*row)[0], (*row)[1], (*row)[2]);
      if (columns == 6 && row->size() == 6) {
        points.add(place, color_from({(*row)[3], (*row)[4], (*row)[5]}));
      } else if (columns != 6) {
        points.add(place);
      } else {
        refuse_cloud(fmt::format("{}:{}", source, line.number), "",
                     fmt::format("{} numbers", row->size()), "6 as in the first line");
      }
    }
  }
  return {std::move(points).take(), {}};
}

}  // namespace handway::geometric
