#include "handway/geometric/formats/numpy_array.h"

#include "formats/binary_number.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>

namespace handway::geometric {
namespace {

constexpr std::string_view kNumpyMagic = "\x93NUMPY";
constexpr std::size_t kLongestHeader = std::size_t{1} << 20;
constexpr std::size_t kMostDimensions = 32;
constexpr std::size_t kLongestText = 4096;  // bytes of an element

[[noreturn]] void refuse_numpy(const std::string& source, const std::string& element,
                               const std::string& found, const std::string& expected) {
  throw InputError({source, element, found, expected, "Save the array again by numpy.save()."});
}

/// Reads the dictionary in a header, which is a literal of Python.
class HeaderText {
 public:
  HeaderText(std::string_view text, const std::string& source) : rest_(text), source_(source) {}

  NumpyHeader read() {
    NumpyHeader header;
    expect('{');
    while (!take('}')) {
      const std::string key = quoted();
      expect(':');
      if (key == "descr") {
        read_type(header);
      } else if (key == "fortran_order") {
        header.fortran_order = truth();
      } else if (key == "shape") {
        header.shape = shape();
      } else {
        refuse_numpy(source_, "header", "the key \"" + key + '"', "descr, fortran_order and shape");
      }
      seen_.push_back(key);
      static_cast<void>(take(','));
    }
    for (const char* key : {"descr", "fortran_order", "shape"}) {
      if (std::ranges::count(seen_, key) != 1) {
        refuse_numpy(source_, "header",
                     fmt::format("{} keys \"{}\"", std::ranges::count(seen_, key), key), "one");
      }
    }
    return header;
  }

 private:
  void skip_blanks() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size()));
  }
  bool take(char expected) {
    skip_blanks();
    if (rest_.empty() || rest_.front() != expected) {
      return false;
    }
    rest_.remove_prefix(1);
    return true;
  }
  void expect(char expected) {
    if (!take(expected)) {
      refuse_numpy(source_, "header", rest_.empty() ? "its end" : fmt::format("\"{:.20}\"", rest_),
                   fmt::format("'{}'", expected));
    }
  }
  std::string quoted() {
    skip_blanks();
    const char quote = rest_.empty() ? '\0' : rest_.front();
    const std::size_t end = quote == '\'' || quote == '"' ? rest_.find(quote, 1) : rest_.npos;
    if (end == std::string_view::npos) {
      refuse_numpy(source_, "header", fmt::format("\"{:.20}\"", rest_), "a word in quotes");
    }
    const std::string word(rest_.substr(1, end - 1));
    rest_.remove_prefix(end + 1);
    return word;
  }
  bool truth() {
    skip_blanks();
    for (const auto& [word, value] : {std::pair("True", true), std::pair("False", false)}) {
      if (rest_.starts_with(word)) {
        rest_.remove_prefix(std::string_view(word).size());
        return value;
      }
    }
    refuse_numpy(source_, "fortran_order", fmt::format("\"{:.20}\"", rest_), "True or False");
  }
  std::vector<std::size_t> shape() {
    std::vector<std::size_t> sides;
    expect('(');
    while (!take(')')) {
      skip_blanks();
      std::size_t side = 0;
      const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), side);
      if (error != std::errc() || sides.size() == kMostDimensions) {
        refuse_numpy(source_, "shape", fmt::format("\"{:.20}\"", rest_), "up to 32 whole numbers");
      }
      rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
      static_cast<void>(take('L'));  // of Python 2
      sides.push_back(side);
      static_cast<void>(take(','));
    }
    return sides;
  }

  void read_type(NumpyHeader& header) {
    skip_blanks();
    if (rest_.starts_with('[')) {
      header.problem = "records with several fields";
      skip_list();
      return;
    }
    const std::string descr = quoted();
    header.big_endian = descr.starts_with('>');
    std::string_view type = descr;
    if (!type.empty() && std::string_view("<>|=").find(type.front()) != std::string_view::npos) {
      type.remove_prefix(1);
    }
    header.kind = type.empty() ? '?' : type.front();
    type.remove_prefix(std::min<std::size_t>(1, type.size()));
    const auto [end, error] =
        std::from_chars(type.data(), type.data() + type.size(), header.item_bytes);
    const bool whole = error == std::errc() && end == type.data() + type.size();
    if (header.kind == 'O') {
      header.problem = "objects of Python (pickle), which may run any program when they are read";
    } else if (!whole || !is_known(header)) {
      header.problem = fmt::format("elements of the type \"{:.20}\"", descr);
    }
  }
  static bool is_known(NumpyHeader& header) {
    const std::size_t size = header.item_bytes;
    switch (header.kind) {
      case 'f':
      case 'i':
      case 'u':
        return BinaryNumber{header.kind, size}.is_known();
      case 'b':
        return size == 1;
      case 'U':
        header.item_bytes = size <= kLongestText ? 4 * size : 0;
        return size <= kLongestText;
      case 'S':
        return size <= kLongestText;
      default:
        return false;
    }
  }
  void skip_list() {
    int depth = 0;
    while (!rest_.empty()) {
      const char c = rest_.front();
      depth += c == '[' || c == '(' ? 1 : c == ']' || c == ')' ? -1 : 0;
      rest_.remove_prefix(1);
      if (depth == 0) {
        return;
      }
    }
  }

  std::string_view rest_;
  const std::string& source_;
  std::vector<std::string> seen_;
};

/// Number of elements; nothing if it overflows.
std::optional<std::size_t> product(const std::vector<std::size_t>& sides) {
  std::size_t count = 1;
  for (const std::size_t side : sides) {
    if (side != 0 && count > std::numeric_limits<std::size_t>::max() / side) {
      return std::nullopt;
    }
    count *= side;
  }
  return count;
}

/// Place of the element of a row and a column of the flattened array.
class Places {
 public:
  explicit Places(const NumpyHeader& header) : header_(header) {
    const std::vector<std::size_t>& sides = header.shape;
    for (std::size_t i = 1; i < sides.size(); ++i) {
      columns_ *= sides[i];
    }
    for (std::size_t column = 0; column < columns_ && header.fortran_order; ++column) {
      offsets_.push_back(fortran_offset(column));
    }
  }

  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] std::size_t at(std::size_t row, std::size_t column) const {
    return header_.fortran_order ? row + offsets_[column] : row * columns_ + column;
  }

 private:
  [[nodiscard]] std::size_t fortran_offset(std::size_t column) const {
    const std::vector<std::size_t>& sides = header_.shape;
    std::size_t stride = 1;
    std::vector<std::size_t> strides;
    for (const std::size_t side : sides) {
      strides.push_back(stride);
      stride *= side;
    }
    std::size_t offset = 0;
    for (std::size_t i = sides.size(); i-- > 1;) {
      offset += column % sides[i] * strides[i];
      column /= sides[i];
    }
    return offset;
  }

  const NumpyHeader& header_;
  std::size_t columns_ = 1;
  std::vector<std::size_t> offsets_;
};

void append_utf8(std::string& text, std::uint32_t code) {
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xC0 | (code >> 6));
    text += static_cast<char>(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    text += static_cast<char>(0xE0 | (code >> 12));
    text += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
    text += static_cast<char>(0x80 | (code & 0x3F));
  } else if (code < 0x110000) {
    text += static_cast<char>(0xF0 | (code >> 18));
    text += static_cast<char>(0x80 | ((code >> 12) & 0x3F));
    text += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
    text += static_cast<char>(0x80 | (code & 0x3F));
  }
}

}  // namespace

std::string NumpyHeader::type_name() const {
  static const std::map<char, const char*> kNames{{'f', "float"}, {'i', "int"}, {'u', "uint"}};
  if (is_text()) {
    return "text";
  }
  const auto name = kNames.find(kind);
  return name == kNames.end() ? (kind == 'b' ? "bool" : "other")
                              : fmt::format("{}{}", name->second, 8 * item_bytes);
}

std::size_t NumpyHeader::bytes() const { return product(shape).value_or(0) * item_bytes; }

bool is_numpy(std::string_view head) { return head.starts_with(kNumpyMagic); }

std::size_t numpy_header_bytes(std::string_view head, const std::string& source) {
  constexpr std::size_t kShortPreamble = 10;
  if (!is_numpy(head) || head.size() < kShortPreamble) {
    refuse_numpy(source, "", "another beginning", "an array of NumPy");
  }
  const auto byte = [&](std::size_t i) {
    return i < head.size() ? static_cast<std::size_t>(static_cast<unsigned char>(head[i])) : 0;
  };
  const std::size_t version = byte(6);
  if (version < 1 || version > 3) {
    refuse_numpy(source, "", fmt::format("version {}", version), "version 1, 2 or 3");
  }
  std::size_t length = byte(8) | byte(9) << 8;
  if (version > 1) {
    length |= byte(10) << 16 | byte(11) << 24;
  }
  if (length > kLongestHeader) {
    refuse_numpy(source, "header", fmt::format("{} bytes", length), "1 MB at most");
  }
  return (version > 1 ? kNumpyPreamble : kShortPreamble) + length;
}

NumpyHeader parse_numpy_header(std::string_view header, const std::string& source) {
  const std::size_t size = numpy_header_bytes(header, source);
  if (header.size() < size) {
    refuse_numpy(source, "header", fmt::format("{} bytes", header.size()), fmt::format("{}", size));
  }
  const std::size_t preamble = header[6] > 1 ? kNumpyPreamble : kNumpyPreamble - 2;
  NumpyHeader parsed = HeaderText(header.substr(preamble, size - preamble), source).read();
  const std::optional<std::size_t> count = product(parsed.shape);
  if (parsed.problem.empty() && (!count || *count > kMostNumpyElements)) {
    parsed.problem = "more numbers than can be read";
  }
  return parsed;
}

NumpyContent split_numpy(std::string_view content, const std::string& source) {
  const std::size_t size = numpy_header_bytes(content, source);
  NumpyContent parts{parse_numpy_header(content.substr(0, std::min(content.size(), size)), source),
                     {}};
  if (parts.header.problem.empty()) {
    parts.elements = content.substr(size);
    if (parts.elements.size() < parts.header.bytes()) {
      throw InputError({source, "array", fmt::format("{} bytes of elements", parts.elements.size()),
                        fmt::format("{} by the shape in the header", parts.header.bytes()),
                        "The file is cut off: copy it again"});
    }
  }
  return parts;
}

Eigen::MatrixXd numpy_numbers(const NumpyHeader& header, std::string_view elements) {
  const Places places(header);
  // A Boolean is a byte.
  const BinaryNumber type{header.kind == 'b' ? 'u' : header.kind, header.item_bytes,
                          header.big_endian};
  const std::size_t rows = header.shape.empty() ? 1 : header.shape.front();
  Eigen::MatrixXd numbers(static_cast<Eigen::Index>(rows),
                          static_cast<Eigen::Index>(places.columns()));
  for (std::size_t column = 0; column < places.columns(); ++column) {
    for (std::size_t row = 0; row < rows; ++row) {
      numbers(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
          type.value(elements.data() + places.at(row, column) * header.item_bytes);
    }
  }
  return numbers;
}

std::vector<std::string> numpy_words(const NumpyHeader& header, std::string_view elements) {
  const BinaryNumber letter{'u', 4, header.big_endian};
  std::vector<std::string> words;
  for (std::size_t at = 0; header.item_bytes > 0 && at < header.bytes(); at += header.item_bytes) {
    const std::string_view cell = elements.substr(at, header.item_bytes);
    std::string word;
    if (header.kind == 'S') {
      word = cell.substr(0, cell.find('\0'));
    } else {
      for (std::size_t i = 0; i + 4 <= cell.size(); i += 4) {
        const auto code = static_cast<std::uint32_t>(letter.value(cell.data() + i));
        if (code == 0) {
          break;
        }
        append_utf8(word, code);
      }
    }
    words.push_back(std::move(word));
  }
  return words;
}

}  // namespace handway::geometric
