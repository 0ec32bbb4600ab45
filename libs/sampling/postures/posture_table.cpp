#include "handway/sampling/postures/posture_table.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/text_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <stdexcept>
#include <string_view>

namespace handway::sampling {
namespace {

using geometric::InputError;

constexpr std::size_t kLargestFile = std::size_t{1} << 28;  // some million postures
constexpr std::string_view kFirstLine = "# handway postures 1";
constexpr double kRounding = 1e-6;

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r");
  return begin == std::string_view::npos
             ? std::string_view()
             : text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

// Takes a text apart at a character.
class Pieces {
 public:
  Pieces(std::string_view text, char end) : rest_(text), end_(end) {}

  bool next(std::string_view& piece) {
    if (done_) {
      return false;
    }
    const auto at = rest_.find(end_);
    piece = trimmed(rest_.substr(0, at));
    done_ = at == std::string_view::npos;
    rest_.remove_prefix(done_ ? rest_.size() : at + 1);
    return true;
  }

 private:
  std::string_view rest_;
  char end_;
  bool done_ = false;
};

class TableReader {
 public:
  explicit TableReader(const std::filesystem::path& file)
      : file_(file),
        text_(geometric::read_text_file(file, "postures of a hand (CSV)", kLargestFile)),
        lines_(text_, '\n') {}

  PostureTable read() {
    read_head();
    read_names();
    std::vector<double> values;
    Eigen::Index rows = 0;
    for (; next_line(); ++rows) {
      read_row(values);
    }
    if (rows == 0) {
      fail("", "no rows", "at least one posture");
    }
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    table_.postures = Eigen::Map<const RowMajor>(values.data(), rows,
                                                 static_cast<Eigen::Index>(table_.joints.size()));
    return table_;
  }

 private:
  [[noreturn]] void fail(const std::string& element, const std::string& found,
                         const std::string& expected) const {
    throw InputError({fmt::format("{}:{}", file_.string(), std::max(number_, 1)), element, found,
                      expected, "handway pca --postures writes such files."});
  }

  // The next line with something on it.
  bool next_line() {
    while (lines_.next(line_)) {
      ++number_;
      if (!line_.empty()) {
        return true;
      }
    }
    return false;
  }

  void read_head() {
    if (!next_line() || line_ != kFirstLine) {
      fail("", "another first line", fmt::format("\"{}\"", kFirstLine));
    }
    while (next_line() && line_.front() == '#') {
      const std::string_view note = trimmed(line_.substr(1));
      for (const auto& [key, value] :
           {std::pair(std::string_view("hand:"), &table_.hand), {"source:", &table_.source}}) {
        if (note.starts_with(key)) {
          *value = trimmed(note.substr(key.size()));
        }
      }
    }
    if (table_.hand.empty()) {
      fail("hand", "nothing", "the robot that the joints belong to");
    }
  }

  void read_names() {
    Pieces names(line_, ',');
    for (std::string_view name; names.next(name);) {
      if (name.empty() || std::ranges::count(table_.joints, name) > 0) {
        fail("", name.empty() ? "a column without a name" : fmt::format("\"{}\" twice", name),
             "every joint's name once");
      }
      table_.joints.emplace_back(name);
    }
  }

  void read_row(std::vector<double>& values) const {
    Pieces cells(line_, ',');
    std::size_t count = 0;
    for (std::string_view cell; cells.next(cell); ++count) {
      if (count < table_.joints.size()) {
        values.push_back(value_of(cell, table_.joints[count]));
      }
    }
    if (count != table_.joints.size()) {
      fail("", fmt::format("{} values", count),
           fmt::format("{} as in the header", table_.joints.size()));
    }
  }

  [[nodiscard]] double value_of(std::string_view cell, const std::string& joint) const {
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    const bool is_number = error == std::errc() && end == cell.data() + cell.size();
    if (!is_number || !(value >= -kRounding && value <= 1.0 + kRounding)) {
      fail(joint, fmt::format("\"{}\"", cell), "a number from 0 to 1");
    }
    return std::clamp(value, 0.0, 1.0);
  }

  const std::filesystem::path& file_;
  std::string text_;
  Pieces lines_;
  std::string_view line_;
  int number_ = 0;
  PostureTable table_;
};

std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

}  // namespace

PostureTable read_postures(const std::filesystem::path& file) { return TableReader(file).read(); }

void write_postures(const PostureTable& table, const std::filesystem::path& file) {
  if (static_cast<Eigen::Index>(table.joints.size()) != table.postures.cols()) {
    throw std::invalid_argument("postures need a name for every column");
  }
  std::string text =
      fmt::format("{}\n# hand: {}\n# source: {}\n{}\n", kFirstLine, one_line(table.hand),
                  one_line(table.source), fmt::join(table.joints, ","));
  for (const auto& row : table.postures.rowwise()) {
    for (Eigen::Index joint = 0; joint < row.size(); ++joint) {
      fmt::format_to(std::back_inserter(text), "{}{:.4f}", joint > 0 ? "," : "", row[joint]);
    }
    text += '\n';
  }
  geometric::replace_file(file, text);
}

}  // namespace handway::sampling
