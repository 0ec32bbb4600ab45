#include "recordings/table_bytes.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace handway::device {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they are");

/// Magic, version 1.0 and a header, padded so that the elements begin at a multiple of 64.
std::string array_header(std::string_view type, const std::string& shape) {
  constexpr std::size_t kAlignment = 64;
  constexpr std::size_t kPreamble = 10;
  std::string text =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type, shape);
  const std::size_t size = kPreamble + text.size() + 1;
  text += std::string((kAlignment - size % kAlignment) % kAlignment, ' ') + '\n';
  std::string header = "\x93NUMPY";
  header += '\x01';
  header += '\x00';
  header += static_cast<char>(text.size() & 0xFF);
  header += static_cast<char>(text.size() >> 8);
  return header + text;
}

std::string number_array(const Eigen::MatrixXd& values, const std::string& shape) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const RowMajor rows = values;
  return array_header("<f8", shape)
      .append(reinterpret_cast<const char*>(rows.data()),
              static_cast<std::size_t>(rows.size()) * sizeof(double));
}

/// Code points of UTF-8; bytes of other encodings one by one.
std::u32string code_points(std::string_view text) {
  std::u32string points;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t more = byte >= 0xF0 ? 3 : byte >= 0xE0 ? 2 : byte >= 0xC0 ? 1 : 0;
    if (more == 0 || i + more >= text.size()) {
      points += byte;
      ++i;
      continue;
    }
    char32_t point = byte & (0x3FU >> more);
    for (std::size_t k = 1; k <= more; ++k) {
      point = (point << 6U) | (static_cast<unsigned char>(text[i + k]) & 0x3FU);
    }
    points += point;
    i += more + 1;
  }
  return points;
}

std::string text_array(const std::vector<std::string>& texts) {
  std::size_t longest = 1;
  std::vector<std::u32string> all;
  for (const std::string& text : texts) {
    longest = std::max(longest, all.emplace_back(code_points(text)).size());
  }
  std::string bytes =
      array_header(fmt::format("<U{}", longest), fmt::format("({},)", texts.size()));
  for (std::u32string& text : all) {
    text.resize(longest, U'\0');
    bytes.append(reinterpret_cast<const char*>(text.data()), text.size() * sizeof(char32_t));
  }
  return bytes;
}

/// An archive in memory.
class ZipWriter {
 public:
  ZipWriter() : content_(zip_source_buffer_create(nullptr, 0, 0, nullptr)) {
    zip_source_keep(content_);
    archive_ = zip_open_from_source(content_, ZIP_TRUNCATE, nullptr);
    if (archive_ == nullptr) {
      zip_source_free(content_);
      zip_source_free(content_);
      throw std::runtime_error("no archive can be made");
    }
  }
  ~ZipWriter() {
    if (archive_ != nullptr) {
      zip_discard(archive_);
    }
    zip_source_free(content_);
  }
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;

  /// @param bytes outlive the writer.
  void add(const char* name, const std::string& bytes) {
    constexpr std::time_t kFixedTime = 946684800;  // equal tables give equal bytes
    zip_source_t* source = zip_source_buffer(archive_, bytes.data(), bytes.size(), 0);
    const zip_int64_t index = zip_file_add(archive_, name, source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
      zip_source_free(source);
      throw std::runtime_error(zip_strerror(archive_));
    }
    zip_file_set_mtime(archive_, static_cast<zip_uint64_t>(index), kFixedTime, 0);
  }

  std::string finish() {
    if (zip_close(archive_) != 0) {
      throw std::runtime_error(zip_strerror(archive_));
    }
    archive_ = nullptr;
    std::string bytes;
    std::array<char, std::size_t{1} << 16> piece{};
    if (zip_source_open(content_) != 0) {
      throw std::runtime_error("an archive can't be read back");
    }
    for (zip_int64_t size = 0;
         (size = zip_source_read(content_, piece.data(), piece.size())) > 0;) {
      bytes.append(piece.data(), static_cast<std::size_t>(size));
    }
    zip_source_close(content_);
    return bytes;
  }

 private:
  zip_source_t* content_;
  zip_t* archive_ = nullptr;
};

}  // namespace

std::string npz_bytes(const RecordedTable& table) {
  const std::string time = number_array(table.times, fmt::format("({},)", table.times.size()));
  const std::string values =
      number_array(table.values, fmt::format("({}, {})", table.values.rows(), table.values.cols()));
  const std::string names = text_array(table.names);
  std::string raw;
  std::string raw_names;
  if (table.raw) {
    raw = number_array(table.raw->values,
                       fmt::format("({}, {})", table.raw->values.rows(), table.raw->values.cols()));
    raw_names = text_array(labels_of(*table.raw));
  }
  ZipWriter archive;
  archive.add("time.npy", time);
  archive.add("values.npy", values);
  archive.add("names.npy", names);
  if (table.raw) {
    archive.add("raw.npy", raw);
    archive.add("raw_names.npy", raw_names);
  }
  return archive.finish();
}

}  // namespace handway::device
