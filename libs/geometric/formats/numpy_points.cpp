#include "formats/cloud_formats.h"
#include "handway/geometric/formats/numpy_array.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <string>

namespace handway::geometric {
namespace {

std::string words_for(const NumpyHeader& header) {
  std::string shape;
  for (const std::size_t side : header.shape) {
    shape += (shape.empty() ? "" : "×") + std::to_string(side);
  }
  return header.problem.empty() ? fmt::format("{} of shape {}", header.type_name(), shape)
                                : header.problem;
}

/// Returns the numbers of a point, 3 or 6; 0 for an array that is no list or image of points.
std::size_t width_of(const NumpyHeader& header) {
  const std::size_t dimensions = header.shape.size();
  const std::size_t width = header.shape.empty() ? 0 : header.shape.back();
  const bool has_points = header.problem.empty() && !header.is_text() && dimensions >= 2 &&
                          dimensions <= 3 && (width == 3 || width == 6);
  return has_points ? width : 0;
}

}  // namespace

bool has_numpy_points(std::string_view head) {
  constexpr std::size_t kLandmarks = 21;
  try {
    const NumpyHeader header = parse_numpy_header(head, "");
    return width_of(header) > 0 && (header.shape.size() == 2 || header.shape[1] != kLandmarks);
  } catch (const InputError&) {
    return false;
  }
}

ReadCloud read_numpy_points(std::string_view content, const std::string& source) {
  const auto [header, elements] = split_numpy(content, source);
  const auto width = static_cast<Eigen::Index>(width_of(header));
  if (width == 0) {
    refuse_cloud(source, "array", words_for(header),
                 "numbers of shape n×3, n×6 (with colours) or h×w×3",
                 "A depth image becomes points by its camera: see handway cloud --help");
  }
  const Eigen::MatrixXd numbers = numpy_numbers(header, elements);
  PointCollector points(source, static_cast<std::size_t>(numbers.size() / width));
  const bool has_shares = header.kind == 'f' && width == 6 && numbers.size() > 0 &&
                          numbers.rightCols(3).maxCoeff() <= 1.0;
  for (Eigen::Index row = 0; row < numbers.rows(); ++row) {
    for (Eigen::Index at = 0; at < numbers.cols(); at += width) {
      const Eigen::Vector3d place = numbers.row(row).segment<3>(at);
      if (width == 3) {
        points.add(place);
      } else {
        points.add(place,
                   color_from(numbers.row(row).segment<3>(at + 3), has_shares ? 1.0 : 255.0));
      }
    }
  }
  return {std::move(points).take(), {}};
}

}  // namespace handway::geometric
