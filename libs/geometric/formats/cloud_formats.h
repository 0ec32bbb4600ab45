#pragma once

#include "handway/geometric/formats/cloud_reader.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

/// The formats of point clouds. Each reader takes the whole content of a file and its name, for
/// messages, and throws InputError if the content is damaged.
namespace handway::geometric {

[[nodiscard]] ReadCloud read_pcd(std::string_view content, const std::string& source);
[[nodiscard]] ReadCloud read_ply_points(std::string_view content, const std::string& source);
[[nodiscard]] ReadCloud read_text_points(std::string_view content, const std::string& source);
[[nodiscard]] ReadCloud read_numpy_points(std::string_view content, const std::string& source);
[[nodiscard]] ReadCloud read_octomap_file(std::string_view content, const std::string& source);

/// Returns whether the head of a NumPy file is that of points, and not of the 21 landmarks of hands
/// (n×21×3).
[[nodiscard]] bool has_numpy_points(std::string_view head);

/// The whole content of a file.
/// @throws InputError if it is missing, unreadable, larger than 2 GB, or stands in for another one
/// (a pointer of Git LFS, a web page).
[[nodiscard]] std::string cloud_file_content(const std::filesystem::path& file,
                                             const std::string& source);

/// Returns whether the head of a PLY file names faces (`element face` with a count above 0).
[[nodiscard]] bool has_faces(std::string_view head);

/// Returns a colour of three numbers from 0 to `most`; others are clamped.
[[nodiscard]] std::array<std::uint8_t, 3> color_from(const Eigen::Vector3d& parts,
                                                     double most = 255.0);

/// Refuses a damaged file.
[[noreturn]] void refuse_cloud(const std::string& source, const std::string& element,
                               const std::string& found, const std::string& expected,
                               const std::string& advice = "Export the point cloud again");

/// Returns the number of a word in a text; NaN if it stands for none, such as "nan" or "-inf".
/// Refuses other words: a point without its place would be missing in the world.
[[nodiscard]] double cloud_number(std::string_view word, const std::string& source,
                                  const std::string& element);

/// Takes points while a file is read: leaves out those that are not finite, and refuses too many
/// and those that are too far away.
class PointCollector {
 public:
  /// @param count points that the file announces. Memory is taken only for those that come.
  PointCollector(std::string source, std::size_t count);

  void add(const Eigen::Vector3d& point);
  void add(const Eigen::Vector3d& point, const std::array<std::uint8_t, 3>& color);
  [[nodiscard]] PointCloud take() && { return std::move(cloud_); }

 private:
  std::string source_;
  PointCloud cloud_;
};

}  // namespace handway::geometric
