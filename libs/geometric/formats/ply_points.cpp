#include "formats/binary_number.h"
#include "formats/cloud_formats.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/table_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// The vertices of PLY files. Source: G. Turk, The PLY polygon file format, 1994.

namespace handway::geometric {
namespace {

enum class PlyForm { kText, kLittleEndian, kBigEndian };

struct PlyProperty {
  std::string name;
  BinaryNumber type;
  std::size_t offset = 0;  ///< Bytes in front of it in a vertex.
};

struct PlyHeader {
  PlyForm form = PlyForm::kText;
  std::size_t count = 0;  ///< Vertices.
  std::vector<PlyProperty> properties;
  std::size_t vertex_bytes = 0;
  std::string_view body;

  [[nodiscard]] std::optional<std::size_t> find(
      std::initializer_list<std::string_view> names) const {
    for (const std::string_view name : names) {
      const auto property = std::ranges::find(properties, name, &PlyProperty::name);
      if (property != properties.end()) {
        return static_cast<std::size_t>(property - properties.begin());
      }
    }
    return std::nullopt;
  }
};

std::optional<BinaryNumber> ply_type(std::string_view word) {
  static const std::map<std::string_view, BinaryNumber> kTypes{
      {"char", {'i', 1}},  {"int8", {'i', 1}},    {"uchar", {'u', 1}},  {"uint8", {'u', 1}},
      {"short", {'i', 2}}, {"int16", {'i', 2}},   {"ushort", {'u', 2}}, {"uint16", {'u', 2}},
      {"int", {'i', 4}},   {"int32", {'i', 4}},   {"uint", {'u', 4}},   {"uint32", {'u', 4}},
      {"float", {'f', 4}}, {"float32", {'f', 4}}, {"double", {'f', 8}}, {"float64", {'f', 8}}};
  const auto type = kTypes.find(word);
  return type == kTypes.end() ? std::nullopt : std::optional(type->second);
}

/// Lines of a header up to end_header, and what follows.
class PlyHeaderReader {
 public:
  PlyHeaderReader(std::string_view content, const std::string& source)
      : rest_(content), source_(source) {}

  PlyHeader read() {
    if (line() != "ply") {
      refuse_cloud(source_, "", "another beginning", "a PLY file");
    }
    constexpr int kMostLines = 1000;
    for (int i = 0; i < kMostLines && !rest_.empty(); ++i) {
      const std::string_view next = line();
      if (next == "end_header") {
        header_.body = rest_;
        check();
        return std::move(header_);
      }
      take(cells(next, ' '), next);
    }
    refuse_cloud(source_, "header", "no end_header", "the header of a PLY file");
  }

 private:
  std::string_view line() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view text = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return text;
  }

  void take(const std::vector<std::string_view>& words, std::string_view text) {
    const std::string_view key = words.empty() ? "" : words.front();
    if (key == "format" && words.size() == 3) {
      take_form(words[1]);
    } else if (key == "element" && words.size() == 3) {
      take_element(words[1], words[2]);
    } else if (key == "property" && element_ == "vertex") {
      take_property(words, text);
    } else if (!key.empty() && key != "comment" && key != "obj_info" && key != "property") {
      refuse_cloud(source_, "header", fmt::format("\"{:.40}\"", text), "the header of a PLY file");
    }
  }

  void take_form(std::string_view word) {
    if (word == "binary_little_endian") {
      header_.form = PlyForm::kLittleEndian;
    } else if (word == "binary_big_endian") {
      header_.form = PlyForm::kBigEndian;
    } else if (word != "ascii") {
      refuse_cloud(source_, "format", fmt::format("\"{:.40}\"", word),
                   "ascii, binary_little_endian or binary_big_endian");
    }
  }

  void take_element(std::string_view name, std::string_view count) {
    const double value = parse_number(count).value_or(-1.0);
    if (value < 0.0 || value > 1e9 || value != std::floor(value)) {
      refuse_cloud(source_, fmt::format("element {:.40}", name), fmt::format("\"{:.40}\"", count),
                   "a count");
    }
    if (name == "vertex") {
      header_.count = static_cast<std::size_t>(value);
    } else if (header_.properties.empty() && value > 0.0) {
      refuse_cloud(source_, fmt::format("element {:.40}", name),
                   "elements in front of the vertices", "vertices first");
    }
    element_ = name;
  }

  void take_property(const std::vector<std::string_view>& words, std::string_view text) {
    const std::optional<BinaryNumber> type = words.size() == 3 ? ply_type(words[1]) : std::nullopt;
    if (!type) {
      refuse_cloud(source_, "element vertex", fmt::format("\"{:.40}\"", text),
                   "properties of one number");
    }
    header_.properties.push_back({std::string(words[2]), *type, header_.vertex_bytes});
    header_.properties.back().type.big_endian = header_.form == PlyForm::kBigEndian;
    header_.vertex_bytes += type->bytes;
  }

  void check() const {
    for (const char* axis : {"x", "y", "z"}) {
      if (!header_.find({axis})) {
        refuse_cloud(source_, "element vertex", fmt::format("no property {}", axis), "x, y and z");
      }
    }
  }

  std::string_view rest_;
  const std::string& source_;
  std::string_view element_;
  PlyHeader header_;
};

/// The numbers of one vertex after the other.
class PlyVertices {
 public:
  PlyVertices(const PlyHeader& header, const std::string& source)
      : header_(header), source_(source), row_(header.properties.size()) {}

  template <typename Take>
  void each(const Take& take) {
    if (header_.form == PlyForm::kText) {
      each_line(take);
    } else {
      each_record(take);
    }
  }

 private:
  template <typename Take>
  void each_line(const Take& take) {
    std::size_t count = 0;
    for (const TextLine& line : text_lines(header_.body)) {
      if (count == header_.count) {
        return;
      }
      const std::vector<std::string_view> words = cells(trimmed(line.text), ' ');
      if (words.size() < row_.size()) {
        check_count(count);
      }
      for (std::size_t i = 0; i < row_.size(); ++i) {
        row_[i] = cloud_number(words[i], source_, "vertex");
      }
      take(row_);
      ++count;
    }
    check_count(count);
  }

  template <typename Take>
  void each_record(const Take& take) {
    check_count(std::min(header_.count, header_.body.size() / header_.vertex_bytes));
    for (std::size_t i = 0; i < header_.count; ++i) {
      const char* vertex = header_.body.data() + i * header_.vertex_bytes;
      for (std::size_t k = 0; k < row_.size(); ++k) {
        const PlyProperty& property = header_.properties[k];
        row_[k] = property.type.value(vertex + property.offset);
      }
      take(row_);
    }
  }

  void check_count(std::size_t found) const {
    if (found < header_.count) {
      refuse_cloud(source_, "element vertex", fmt::format("{} vertices", found),
                   fmt::format("{} by the header", header_.count),
                   "The file is cut off: copy it again");
    }
  }

  const PlyHeader& header_;
  const std::string& source_;
  std::vector<double> row_;
};

}  // namespace

ReadCloud read_ply_points(std::string_view content, const std::string& source) {
  const PlyHeader header = PlyHeaderReader(content, source).read();
  const std::array<std::size_t, 3> axes = {*header.find({"x"}), *header.find({"y"}),
                                           *header.find({"z"})};
  const std::array<std::optional<std::size_t>, 3> parts = {
      header.find({"red", "r", "diffuse_red"}), header.find({"green", "g", "diffuse_green"}),
      header.find({"blue", "b", "diffuse_blue"})};
  const bool has_colors = parts[0] && parts[1] && parts[2];
  const double most = has_colors && header.properties[*parts[0]].type.kind == 'f' ? 1.0 : 255.0;
  PointCollector points(source, header.count);
  PlyVertices(header, source).each([&](const std::vector<double>& row) {
    const Eigen::Vector3d place(row[axes[0]], row[axes[1]], row[axes[2]]);
    if (!has_colors) {
      points.add(place);
      return;
    }
    points.add(place, color_from({row[*parts[0]], row[*parts[1]], row[*parts[2]]}, most));
  });
  return {std::move(points).take(), {}};
}

bool has_faces(std::string_view head) {
  constexpr std::string_view kFaces = "element face ";
  const std::size_t at =
      head.substr(0, std::min(head.find("end_header"), head.size())).find(kFaces);
  if (at == std::string_view::npos) {
    return false;
  }
  const std::string_view count = head.substr(at + kFaces.size());
  return parse_number(count.substr(0, count.find_first_of("\r\n"))).value_or(0.0) > 0.0;
}

}  // namespace handway::geometric
