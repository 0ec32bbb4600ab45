#include "formats/binary_number.h"
#include "formats/cloud_formats.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/plural.h"
#include "handway/geometric/io/table_text.h"

#include <fmt/format.h>
#include <liblzf/lzf.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// PCD files of the Point Cloud Library, version 0.5 to 0.7.
/// Source: https://pointclouds.org/documentation/tutorials/pcd_file_format.html

namespace handway::geometric {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostFields = 1000;
constexpr std::size_t kLongestHeader = 100;  // lines
constexpr std::size_t kMostBytes = std::size_t{2} << 30;

/// A field of a point; one of several numbers (a histogram) has a larger count.
struct PcdField {
  std::string name;
  BinaryNumber number;
  std::size_t count = 1;
  std::size_t offset = 0;  ///< Bytes in front of it in a point.
  std::size_t column = 0;  ///< Numbers in front of it in a line of text.
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::size_t points = 0;
  std::string data;  ///< ascii, binary or binary_compressed.
  std::string_view body;
  std::size_t point_bytes = 0;
  bool has_viewpoint = false;  ///< Other than the identity.

  [[nodiscard]] const PcdField* find(std::string_view name) const {
    const auto field = std::ranges::find(fields, name, &PcdField::name);
    return field == fields.end() ? nullptr : &*field;
  }
};

class PcdHeaderReader {
 public:
  PcdHeaderReader(std::string_view content, const std::string& source)
      : rest_(content), source_(source) {}

  PcdHeader read() {
    for (std::size_t line = 0; header_.data.empty(); ++line) {
      if (line == kLongestHeader || rest_.empty()) {
        refuse_cloud(source_, "DATA", "no such line", "the header of a PCD file");
      }
      take_line();
    }
    header_.body = rest_;
    check();
    return std::move(header_);
  }

 private:
  using Words = std::vector<std::string_view>;

  void take_line() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (line.empty() || line.front() == '#') {
      return;
    }
    Words words = cells(line, ' ');
    const std::string key(words.front());
    words.erase(words.begin());
    if (key == "FIELDS" || key == "COLUMNS") {
      take_fields(words);
    } else if (key == "SIZE" || key == "COUNT" || key == "TYPE") {
      take_property(key, words);
    } else if (key == "WIDTH" || key == "HEIGHT" || key == "POINTS") {
      take_size(key, words);
    } else if (key == "VIEWPOINT") {
      const std::array<double, 7> none = {0, 0, 0, 1, 0, 0, 0};
      header_.has_viewpoint = !std::ranges::equal(words, none, {}, [](std::string_view word) {
        return parse_number(word).value_or(kMissing);
      });
    } else if (key == "DATA" && words.size() == 1) {
      header_.data = words.front();
    } else if (key != "VERSION") {
      refuse_cloud(source_, "header", fmt::format("\"{:.40}\"", line), "the header of a PCD file");
    }
  }

  void take_fields(const Words& words) {
    if (words.empty() || words.size() > kMostFields) {
      refuse_cloud(source_, "FIELDS", fmt::format("{} fields", words.size()), "x, y, z and others");
    }
    header_.fields.clear();
    for (const std::string_view word : words) {
      header_.fields.emplace_back().name = word;
    }
  }

  std::size_t whole_number(const std::string& key, std::string_view word, double most) const {
    const double value = parse_number(word).value_or(-1.0);
    if (value < 0.0 || value > most || value != std::floor(value)) {
      refuse_cloud(source_, key, fmt::format("\"{:.40}\"", word),
                   fmt::format("a whole number from 0 to {:g}", most));
    }
    return static_cast<std::size_t>(value);
  }

  void take_property(const std::string& key, const Words& words) {
    if (words.size() != header_.fields.size()) {
      refuse_cloud(source_, key, plural(words.size(), "value"),
                   fmt::format("one for each of {} fields", header_.fields.size()));
    }
    for (std::size_t i = 0; i < words.size(); ++i) {
      PcdField& field = header_.fields[i];
      if (key == "SIZE") {
        field.number.bytes = whole_number(key, words[i], 8);
      } else if (key == "COUNT") {
        field.count = whole_number(key, words[i], 1e5);
      } else {
        field.number.kind = static_cast<char>(
            std::tolower(words[i].empty() ? '?' : static_cast<unsigned char>(words[i].front())));
      }
    }
  }

  void take_size(const std::string& key, const Words& words) {
    if (words.size() != 1) {
      refuse_cloud(source_, key, plural(words.size(), "value"), "one");
    }
    const std::size_t value = whole_number(key, words.front(), 1e9);
    (key == "WIDTH" ? width_ : key == "HEIGHT" ? height_ : points_) = value;
  }

  void check() {
    for (PcdField& field : header_.fields) {
      if (!field.number.is_known()) {
        refuse_cloud(source_, "field " + field.name,
                     fmt::format("type {} of {} bytes", field.number.kind, field.number.bytes),
                     "F of 2, 4 or 8 bytes, I or U of 1, 2, 4 or 8");
      }
      field.offset = header_.point_bytes;
      header_.point_bytes += field.number.bytes * field.count;
      field.column = columns_;
      columns_ += field.count;
    }
    for (const char* name : {"x", "y", "z"}) {
      const PcdField* field = header_.find(name);
      if (field == nullptr || field->count != 1) {
        refuse_cloud(source_, "FIELDS", fmt::format("no field {} of one number", name),
                     "x, y and z");
      }
    }
    header_.points = points_.value_or(width_.value_or(0) * height_.value_or(1));
  }

  std::string_view rest_;
  const std::string& source_;
  PcdHeader header_;
  std::optional<std::size_t> width_;
  std::optional<std::size_t> height_;
  std::optional<std::size_t> points_;
  std::size_t columns_ = 0;
};

template <typename Number>
Number number_at(std::string_view bytes) {
  Number number{};
  std::memcpy(&number, bytes.data(), sizeof number);
  return number;
}

std::array<std::uint8_t, 3> color_of_bits(std::uint32_t bits) {
  return {static_cast<std::uint8_t>(bits >> 16U), static_cast<std::uint8_t>(bits >> 8U),
          static_cast<std::uint8_t>(bits)};
}

/// Passes on the points of one file.
class PcdPoints {
 public:
  PcdPoints(const PcdHeader& header, const std::string& source)
      : header_(header), source_(source), points_(source, header.points) {
    color_ = header.find("rgb") != nullptr ? header.find("rgb") : header.find("rgba");
    if (color_ != nullptr &&
        (color_->number.bytes != sizeof(std::uint32_t) || color_->count != 1)) {
      color_ = nullptr;
    }
  }

  PointCloud read() && {
    if (header_.data == "ascii") {
      read_text();
    } else if (header_.data == "binary") {
      // Points one after the other.
      read_binary(header_.body, [&](const PcdField& field, std::size_t i) {
        return i * header_.point_bytes + field.offset;
      });
    } else if (header_.data == "binary_compressed") {
      // Fields one after the other, each of all points.
      read_binary(decompressed(), [&](const PcdField& field, std::size_t i) {
        return header_.points * field.offset + i * field.number.bytes * field.count;
      });
    } else {
      refuse_cloud(source_, "DATA", fmt::format("\"{:.40}\"", header_.data),
                   "ascii, binary or binary_compressed");
    }
    return std::move(points_).take();
  }

 private:
  void add(const Eigen::Vector3d& point, std::uint32_t color_bits) {
    if (color_ == nullptr) {
      points_.add(point);
    } else {
      points_.add(point, color_of_bits(color_bits));
    }
  }

  [[nodiscard]] std::array<const PcdField*, 3> axes() const {
    return {header_.find("x"), header_.find("y"), header_.find("z")};
  }

  void read_text() {
    std::size_t count = 0;
    for (const TextLine& line : text_lines(header_.body)) {
      const std::vector<std::string_view> words = cells(trimmed(line.text), ' ');
      if (words.empty() || words.front().empty() || count == header_.points) {
        continue;
      }
      ++count;
      Eigen::Vector3d point;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        point[static_cast<Eigen::Index>(axis)] = number_in(words, axes().at(axis)->column);
      }
      add(point, color_ != nullptr ? color_in(words) : 0);
    }
    check_count(count);
  }

  [[nodiscard]] double number_in(const std::vector<std::string_view>& words,
                                 std::size_t column) const {
    if (column >= words.size()) {
      refuse_cloud(source_, "point", fmt::format("{} numbers", words.size()), "one for each field");
    }
    return cloud_number(words[column], source_, "point");
  }

  // A colour in a text is a whole number, or that number's bits as a float.
  [[nodiscard]] std::uint32_t color_in(const std::vector<std::string_view>& words) const {
    const double value = number_in(words, color_->column);
    if (color_->number.kind == 'f') {
      return std::bit_cast<std::uint32_t>(static_cast<float>(value));
    }
    return value >= 0.0 && value < 4294967296.0 ? static_cast<std::uint32_t>(value) : 0;
  }

  template <typename PlaceOf>
  void read_binary(std::string_view bytes, const PlaceOf& place_of) {
    check_count(header_.point_bytes == 0
                    ? 0
                    : std::min(header_.points, bytes.size() / header_.point_bytes));
    for (std::size_t i = 0; i < header_.points; ++i) {
      Eigen::Vector3d point;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const PcdField& field = *axes().at(axis);
        point[static_cast<Eigen::Index>(axis)] =
            field.number.value(bytes.data() + place_of(field, i));
      }
      add(point,
          color_ != nullptr ? number_at<std::uint32_t>(bytes.substr(place_of(*color_, i))) : 0);
    }
  }

  void check_count(std::size_t found) const {
    if (found < header_.points) {
      refuse_cloud(source_, "", fmt::format("{} points", found),
                   fmt::format("{} by the header", header_.points),
                   "The file is cut off: copy it again");
    }
  }

  // The sizes before and after compression stand in front of the bytes.
  std::string_view decompressed() {
    constexpr std::size_t kSizes = 2 * sizeof(std::uint32_t);
    const std::string_view body = header_.body;
    if (body.size() < kSizes) {
      check_count(0);
      return {};
    }
    const std::size_t packed = number_at<std::uint32_t>(body);
    const std::size_t whole = number_at<std::uint32_t>(body.substr(sizeof(std::uint32_t)));
    if (packed > body.size() - kSizes || whole > kMostBytes ||
        whole != header_.points * header_.point_bytes) {
      refuse_cloud(source_, "DATA", fmt::format("{} bytes compressed from {}", packed, whole),
                   fmt::format("at most {}, from {}", body.size() - kSizes,
                               header_.points * header_.point_bytes),
                   "The file is cut off or damaged: copy it again");
    }
    // LZF makes at most 264 bytes of three.
    if (whole / 88 > packed) {
      refuse_cloud(source_, "DATA", "damaged bytes", "compressed points");
    }
    decompressed_.resize(whole);
    if (whole > 0 && lzf_decompress(body.data() + kSizes, static_cast<unsigned>(packed),
                                    decompressed_.data(), static_cast<unsigned>(whole)) != whole) {
      refuse_cloud(source_, "DATA", "damaged bytes", "compressed points");
    }
    return decompressed_;
  }

  const PcdHeader& header_;
  const std::string& source_;
  PointCollector points_;
  const PcdField* color_ = nullptr;
  std::string decompressed_;
};

}  // namespace

ReadCloud read_pcd(std::string_view content, const std::string& source) {
  const PcdHeader header = PcdHeaderReader(content, source).read();
  ReadCloud read{PcdPoints(header, source).read(), {}};
  if (header.has_viewpoint) {
    read.warnings.push_back(source +
                            ": VIEWPOINT is not applied to the points; place them by the pose of "
                            "their object");
  }
  return read;
}

}  // namespace handway::geometric
