#include "handway/geometric/formats/cloud_reader.h"

#include "formats/cloud_formats.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/file_contents.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestFile = std::uintmax_t{2} << 30;

/// A kind of file and its reader.
struct CloudFormat {
  std::string_view extension;
  ReadCloud (*read)(std::string_view content, const std::string& source);
};

constexpr auto kFormats = std::to_array<CloudFormat>({
    {".pcd", read_pcd},
    {".ply", read_ply_points},
    {".xyz", read_text_points},
    {".pts", read_text_points},
    {".asc", read_text_points},
    {".txt", read_text_points},
    {".csv", read_text_points},
    {".npy", read_numpy_points},
    {".bt", read_octomap_file},
    {".ot", read_octomap_file},
});

const CloudFormat* format_of(const fs::path& file) {
  const auto format = std::ranges::find_if(
      kFormats, [&](const CloudFormat& each) { return has_extension(file, each.extension); });
  return format == kFormats.end() ? nullptr : &*format;
}

}  // namespace

std::string cloud_file_content(const fs::path& file, const std::string& source) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    refuse_cloud(source, "",
                 fs::exists(file, error) ? "something that is not a file" : "no such file",
                 "a point cloud", "Check the path");
  }
  const std::uintmax_t size = fs::file_size(file, error);
  if (error || size > kLargestFile) {
    refuse_cloud(source, "", error ? error.message() : fmt::format("{} MB", size >> 20U),
                 "a point cloud of at most 2048 MB", "Thin it out");
  }
  std::string content(size, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(content.data(), static_cast<std::streamsize>(size));
  if (!stream) {
    refuse_cloud(source, "", "a file that can't be read", "a point cloud", "Check its permissions");
  }
  if (const std::optional<StandIn> other = stand_in(content.substr(0, 1024))) {
    refuse_cloud(source, "", other->found, "a point cloud", other->advice);
  }
  return content;
}

void refuse_cloud(const std::string& source, const std::string& element, const std::string& found,
                  const std::string& expected, const std::string& advice) {
  throw InputError({source, element, found, expected, advice});
}

double cloud_number(std::string_view word, const std::string& source, const std::string& element) {
  const std::optional<double> number = parse_number(word);
  std::string small(word);
  std::ranges::transform(small, small.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto has = [&](std::string_view part) { return small.find(part) != std::string::npos; };
  if (!number && !has("nan") && !has("inf") && !has("#")) {  // "1.#QNAN" of Windows
    refuse_cloud(source, element, fmt::format("\"{:.40}\"", word), "a number");
  }
  return number.value_or(std::numeric_limits<double>::quiet_NaN());
}

std::array<std::uint8_t, 3> color_from(const Eigen::Vector3d& parts, double most) {
  std::array<std::uint8_t, 3> color{};
  for (std::size_t i = 0; i < color.size(); ++i) {
    const double part = 255.0 / most * parts[static_cast<Eigen::Index>(i)];
    color.at(i) = static_cast<std::uint8_t>(std::isnan(part) ? 0.0 : std::clamp(part, 0.0, 255.0));
  }
  return color;
}

PointCollector::PointCollector(std::string source, std::size_t count) : source_(std::move(source)) {
  constexpr std::size_t kReserved = std::size_t{1} << 20;
  if (count > kMostCloudPoints) {
    refuse_cloud(source_, "", fmt::format("{} points", count),
                 fmt::format("at most {}", kMostCloudPoints), "Thin it out");
  }
  cloud_.points.reserve(std::min(count, kReserved));
}

void PointCollector::add(const Eigen::Vector3d& point) {
  if (!point.allFinite()) {
    return;
  }
  if (point.cwiseAbs().maxCoeff() > static_cast<double>(kLargestCloudCoordinate)) {
    refuse_cloud(source_, fmt::format("point {}", cloud_.size() + 1),
                 fmt::format("a coordinate of {:.6g} m", point.cwiseAbs().maxCoeff()),
                 fmt::format("at most {} m", kLargestCloudCoordinate),
                 "Coordinates are in metres: scale or move the points, and place them by the "
                 "object's pose");
  }
  if (cloud_.size() == kMostCloudPoints) {
    refuse_cloud(source_, "", "more points", fmt::format("at most {}", kMostCloudPoints),
                 "Thin it out");
  }
  cloud_.points.emplace_back(point.cast<float>());
}

void PointCollector::add(const Eigen::Vector3d& point, const std::array<std::uint8_t, 3>& color) {
  const std::size_t before = cloud_.size();
  add(point);
  if (cloud_.size() > before) {
    cloud_.colors.push_back(color);
  }
}

ReadCloud read_cloud(const fs::path& file, const std::string& referenced_by) {
  const std::string source =
      referenced_by.empty() ? file.string() : referenced_by + ": cloud " + file.string();
  const CloudFormat* format = format_of(file);
  if (format == nullptr) {
    refuse_cloud(source, "", fmt::format("the ending \"{}\"", file.extension().string()),
                 "a point cloud: .pcd, .ply, .xyz, .pts, .asc, .txt, .csv, .npy, .bt or .ot");
  }
  const std::string content = cloud_file_content(file, source);
  note_file_read(fs::absolute(file));
  ReadCloud read = format->read(content, source);
  if (read.cloud.points.empty()) {
    refuse_cloud(source, "", "no points that are finite", "points with x, y and z");
  }
  return read;
}

bool is_cloud_file(const fs::path& file) {
  // Any text may end like this, so that such files are read as clouds only where one is asked for.
  constexpr std::array<std::string_view, 2> kAnyText = {".txt", ".csv"};
  const CloudFormat* format = format_of(file);
  if (format == nullptr || std::ranges::count(kAnyText, format->extension) > 0) {
    return false;
  }
  if (format->extension == ".ply") {
    return !has_faces(head_of(file));
  }
  return format->extension != ".npy" || has_numpy_points(head_of(file));
}

CloudCells usual_cells(const PointCloud& cloud) {
  CloudCells cells;
  cells.size = cloud.cell > 0.0 ? cloud.cell : cells.size;
  return cells;
}

Cloud make_cloud(std::shared_ptr<const PointCloud> points, const CloudCells& cells,
                 const std::string& source) {
  if (points->points.empty()) {
    refuse_cloud(source, "", "no points", "a cloud of points", "");
  }
  std::optional<TriangleMesh> surface = cells_around(*points, cells);
  if (!surface) {
    refuse_cloud(
        source, "", fmt::format("too many cells of {:g} mm around the points", 1e3 * cells.size),
        "cells with at most 2 million free sides", "Make the cells larger, or cut the cloud");
  }
  Cloud cloud;
  cloud.cells = cells;
  cloud.points = std::move(points);
  cloud.surface = std::make_shared<const TriangleMesh>(*std::move(surface));
  return cloud;
}

void write_ply(const PointCloud& cloud, const fs::path& file) {
  const bool has_colors = !cloud.colors.empty();
  std::string text = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\n"
      "property float y\nproperty float z\n{}end_header\n",
      cloud.size(),
      has_colors ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "");
  std::array<char, sizeof(Eigen::Vector3f)> place{};
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    std::memcpy(place.data(), cloud.points[i].data(), place.size());
    text.append(place.data(), place.size());
    if (has_colors) {
      for (const std::uint8_t part : cloud.colors[i]) {
        text += static_cast<char>(part);
      }
    }
  }
  replace_file(file, text);
}

}  // namespace handway::geometric
