#include "handway/geometric/formats/depth_image.h"

#include "formats/cloud_formats.h"
#include "handway/geometric/formats/numpy_array.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/text_file.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace handway::geometric {
namespace {

constexpr std::size_t kLargestSide = 16384;  // pixels

/// The values of an image, row by row.
struct DepthValues {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<float> values;
};

/// Bytes of a PNG that libpng reads.
struct PngBytes {
  std::string_view rest;

  static void read(png_structp png, png_bytep to, std::size_t count) {
    auto& bytes = *static_cast<PngBytes*>(png_get_io_ptr(png));
    if (bytes.rest.size() < count) {
      png_error(png, "the file is cut off");
    }
    std::memcpy(to, bytes.rest.data(), count);
    bytes.rest.remove_prefix(count);
  }
};

/// Owns what libpng needs to read a file.
class PngReader {
 public:
  explicit PngReader(std::string_view content)
      : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, &keep, &ignore)),
        info_(png_create_info_struct(png_)),
        bytes_{content} {
    png_set_read_fn(png_, &bytes_, &PngBytes::read);
    png_set_user_limits(png_, kLargestSide, kLargestSide);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  /// Reads the image. No destructor may be passed by the jumps of libpng: everything that is
  /// allocated is a member.
  /// @returns false for damaged files and images that are not grey; see problem().
  [[nodiscard]] bool read() {
    if (setjmp(png_jmpbuf(png_)) != 0) {  // NOLINT(cert-err52-cpp): libpng reports errors thus
      problem_ = "damaged contents";
      return false;
    }
    png_read_info(png_, info_);
    if (png_get_color_type(png_, info_) != PNG_COLOR_TYPE_GRAY ||
        png_get_bit_depth(png_, info_) < 8) {
      problem_ = "an image with colours";
      return false;
    }
    if (std::size_t{png_get_image_width(png_, info_)} * png_get_image_height(png_, info_) >
        kMostCloudPoints) {
      problem_ = "an image with more than 20 million pixels";
      return false;
    }
    if (png_get_bit_depth(png_, info_) == 16) {
      png_set_swap(png_);
    }
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    pixels_.resize(png_get_rowbytes(png_, info_) * png_get_image_height(png_, info_));
    for (std::size_t row = 0; row < png_get_image_height(png_, info_); ++row) {
      rows_.push_back(pixels_.data() + row * png_get_rowbytes(png_, info_));
    }
    png_read_image(png_, rows_.data());
    return true;
  }

  [[nodiscard]] const char* problem() const { return problem_; }

  /// @pre read() has succeeded.
  [[nodiscard]] DepthValues values() const {
    DepthValues image{png_get_image_width(png_, info_), png_get_image_height(png_, info_), {}};
    const bool is_wide = png_get_bit_depth(png_, info_) == 16;
    image.values.resize(image.width * image.height);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
      std::uint16_t wide = 0;
      if (is_wide) {
        std::memcpy(&wide, pixels_.data() + 2 * i, sizeof wide);
      }
      image.values[i] = static_cast<float>(is_wide ? wide : pixels_[i]);
    }
    return image;
  }

 private:
  // Messages of libpng are not shown: the file's name and what to do are.
  [[noreturn]] static void keep(png_structp png, png_const_charp /*message*/) {
    png_longjmp(png, 1);
  }
  static void ignore(png_structp /*png*/, png_const_charp /*message*/) {}

  png_structp png_;
  png_infop info_;
  PngBytes bytes_;
  std::vector<png_byte> pixels_;
  std::vector<png_bytep> rows_;
  const char* problem_ = "";
};

DepthValues png_values(std::string_view content, const std::string& source) {
  PngReader reader(content);
  if (!reader.read()) {
    refuse_cloud(source, "", reader.problem(), "a grey PNG of 8 or 16 bits", "Save it again");
  }
  return reader.values();
}

DepthValues numpy_values(std::string_view content, const std::string& source) {
  const auto [header, elements] = split_numpy(content, source);
  if (!header.problem.empty() || header.is_text() || header.shape.size() != 2 ||
      std::ranges::max(header.shape) > kLargestSide) {
    refuse_cloud(source, "array",
                 header.problem.empty()
                     ? fmt::format("{} in {} dimensions", header.type_name(), header.shape.size())
                     : header.problem,
                 fmt::format("numbers of shape height×width, at most {} each", kLargestSide));
  }
  const Eigen::MatrixXd numbers = numpy_numbers(header, elements);
  DepthValues image{header.shape[1], header.shape[0], {}};
  image.values.resize(image.width * image.height);
  Eigen::Map<Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      image.values.data(), numbers.rows(), numbers.cols()) = numbers.cast<float>();
  return image;
}

}  // namespace

PointCloud read_depth_image(const std::filesystem::path& file, const DepthCamera& camera) {
  const std::string source = file.string();
  if (camera.focal.minCoeff() <= 0.0 || camera.unit <= 0.0) {
    refuse_cloud(source, "camera", "a focal length or unit of 0", "fx, fy and a unit above 0",
                 "They are K[0] and K[4] of ROS's CameraInfo");
  }
  const std::string content = cloud_file_content(file, source);
  const DepthValues image =
      is_image_file(file) ? png_values(content, source) : numpy_values(content, source);
  PointCollector points(source, image.values.size());
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const double depth = camera.unit * static_cast<double>(image.values[i]);
    if (std::isfinite(depth) && depth > 0.0 && depth <= camera.farthest) {
      const Eigen::Vector2d pixel(static_cast<double>(i % image.width),
                                  static_cast<double>(i / image.width));
      const Eigen::Vector2d slope = (pixel - camera.centre).cwiseQuotient(camera.focal);
      points.add({depth * slope.x(), depth * slope.y(), depth});
    }
  }
  PointCloud cloud = std::move(points).take();
  if (cloud.points.empty()) {
    refuse_cloud(source, "", "no measured pixel", "depths above 0", "Check the unit");
  }
  return cloud;
}

Eigen::Matrix3d optical_frame() {
  Eigen::Matrix3d R_BodyOptical;
  R_BodyOptical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return R_BodyOptical;
}

bool is_image_file(const std::filesystem::path& file) { return has_extension(file, ".png"); }

}  // namespace handway::geometric
