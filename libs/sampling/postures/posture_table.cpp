#include "handway/sampling/postures/posture_table.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/plural.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/table_text.h"
#include "handway/geometric/io/text_file.h"
#include "handway/sampling/postures/quantile.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nanoflann.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace handway::sampling {
namespace {

using geometric::InputError;

constexpr std::size_t kLargestFile = std::size_t{1} << 28;  // some million postures
constexpr std::string_view kFirstLine = "# handway postures 1";
constexpr std::string_view kTimeColumn = "time";
constexpr double kRounding = 1e-6;

class TableReader {
 public:
  explicit TableReader(const std::filesystem::path& file)
      : file_(file),
        text_(geometric::read_text_file(file, "postures of a hand (CSV)", kLargestFile)) {}

  PostureTable read() {
    read_head();
    read_names();
    std::vector<double> values;
    std::vector<double> times;
    Eigen::Index rows = 0;
    for (; next_line(); ++rows) {
      read_row(values, times);
    }
    if (rows == 0) {
      fail("", "no rows", "at least one posture");
    }
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    table_.postures = Eigen::Map<const RowMajor>(values.data(), rows,
                                                 static_cast<Eigen::Index>(table_.joints.size()));
    table_.times = Eigen::Map<const Eigen::VectorXd>(times.data(), std::ssize(times));
    return table_;
  }

 private:
  [[noreturn]] void fail(const std::string& element, const std::string& found,
                         const std::string& expected) const {
    throw InputError({fmt::format("{}:{}", file_.string(), std::max(number_, 1)), element, found,
                      expected, "handway pca --postures writes such files."});
  }

  // The next line that is not empty.
  bool next_line() {
    for (std::string line; std::getline(text_, line);) {
      ++number_;
      line_ = geometric::trimmed(line);
      whole_line_ = std::move(line);
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
      const std::string_view note = geometric::trimmed(std::string_view(line_).substr(1));
      for (const auto& [key, value] :
           {std::pair(std::string_view("hand:"), &table_.hand), {"source:", &table_.source}}) {
        if (note.starts_with(key)) {
          *value = geometric::trimmed(note.substr(key.size()));
        }
      }
    }
    if (table_.hand.empty()) {
      fail("hand", "nothing", "the robot that the joints belong to");
    }
  }

  void read_names() {
    for (const std::string& name : geometric::cell_names(whole_line_, ',')) {
      if (name.empty() || std::ranges::count(table_.joints, name) > 0) {
        fail("", name.empty() ? "a column without a name" : fmt::format("\"{}\" twice", name),
             "every joint's name once");
      }
      table_.joints.push_back(name);
    }
    if (table_.joints.front() == kTimeColumn) {
      has_times_ = true;
      table_.joints.erase(table_.joints.begin());
    }
    if (table_.joints.empty()) {
      fail("", "no joints", "a column for every joint");
    }
  }

  void read_row(std::vector<double>& values, std::vector<double>& times) const {
    const std::vector<std::string_view> cells = geometric::cells(line_, ',');
    const std::size_t first = has_times_ ? 1 : 0;
    if (cells.size() != first + table_.joints.size()) {
      fail("", geometric::plural(cells.size(), "value"),
           fmt::format("{} as in the header", first + table_.joints.size()));
    }
    if (has_times_) {
      times.push_back(time_of(cells.front()));
    }
    for (std::size_t i = 0; i < table_.joints.size(); ++i) {
      values.push_back(value_of(cells[first + i], table_.joints[i]));
    }
  }

  [[nodiscard]] double time_of(std::string_view cell) const {
    const std::optional<double> time = geometric::parse_number(cell);
    if (!time || !std::isfinite(*time)) {
      fail(std::string(kTimeColumn), fmt::format("\"{}\"", cell), "a number of seconds");
    }
    return *time;
  }

  [[nodiscard]] double value_of(std::string_view cell, const std::string& joint) const {
    const std::optional<double> value = geometric::parse_number(cell);
    if (!value || !(*value >= -kRounding && *value <= 1.0 + kRounding)) {
      fail(joint, fmt::format("\"{}\"", cell), "a number from 0 to 1");
    }
    return std::clamp(*value, 0.0, 1.0);
  }

  const std::filesystem::path& file_;
  std::istringstream text_;
  std::string line_;        ///< Without blanks and quotes around it.
  std::string whole_line_;  ///< With them.
  int number_ = 0;
  bool has_times_ = false;
  PostureTable table_;
};

std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

// The table's columns in the basis' order, one posture a column.
Eigen::MatrixXd in_order_of(const PmdBasis& basis, const PostureTable& table,
                            const std::string& name) {
  if (table.hand != basis.hand) {
    throw InputError({name, "hand", '"' + table.hand + '"',
                      fmt::format("\"{}\", the basis' hand", basis.hand),
                      "Choose postures of the same hand."});
  }
  Eigen::MatrixXd postures(static_cast<Eigen::Index>(basis.joints.size()), table.postures.rows());
  for (Eigen::Index joint = 0; joint < postures.rows(); ++joint) {
    const std::string& wanted = basis.joints[static_cast<std::size_t>(joint)];
    const auto column = std::ranges::find(table.joints, wanted);
    if (column == table.joints.end()) {
      throw InputError({name, wanted, "no such column",
                        fmt::format("the basis' joints {}", fmt::join(basis.joints, ", ")), ""});
    }
    postures.row(joint) = table.postures.col(column - table.joints.begin()).transpose();
  }
  return postures;
}

}  // namespace

PostureTable read_postures(const std::filesystem::path& file) { return TableReader(file).read(); }

void write_postures(const PostureTable& table, const std::filesystem::path& file) {
  if (static_cast<Eigen::Index>(table.joints.size()) != table.postures.cols()) {
    throw std::invalid_argument("postures need a name for every column");
  }
  const bool has_times = table.times.size() > 0;
  if (has_times && table.times.size() != table.postures.rows()) {
    throw std::invalid_argument("postures need a time for every row, or none");
  }
  std::vector<std::string> names;
  std::ranges::transform(table.joints, std::back_inserter(names), geometric::csv_cell);
  std::string text =
      fmt::format("{}\n# hand: {}\n# source: {}\n{}{}\n", kFirstLine, one_line(table.hand),
                  one_line(table.source), has_times ? "time," : "", fmt::join(names, ","));
  for (Eigen::Index number = 0; number < table.postures.rows(); ++number) {
    const auto row = table.postures.row(number);
    if (has_times) {
      fmt::format_to(std::back_inserter(text), "{:.3f},", table.times[number]);
    }
    for (Eigen::Index joint = 0; joint < row.size(); ++joint) {
      fmt::format_to(std::back_inserter(text), "{}{:.4f}", joint > 0 ? "," : "", row[joint]);
    }
    text += '\n';
  }
  geometric::replace_file(file, text);
}

/// A kd-tree over postures.
struct RecordedPostures::Tree {
  explicit Tree(Eigen::MatrixXd columns)
      : postures(std::move(columns)), index(static_cast<int>(postures.rows()), postures) {}

  Eigen::MatrixXd postures;  ///< Shape [joints, postures], free joints 0.
  nanoflann::KDTreeEigenMatrixAdaptor<Eigen::MatrixXd, -1, nanoflann::metric_L2, false> index;
};

RecordedPostures::RecordedPostures(const PmdBasis& basis, const PostureTable& table,
                                   const std::string& name)
    : source_(table.source) {
  constexpr double kUsualShare = 0.95;
  Eigen::MatrixXd postures = in_order_of(basis, table, name);
  if (postures.cols() == 0) {
    throw InputError({name, "", "no rows", "at least one posture", ""});
  }
  const PostureSubspace subspace(basis);
  std::vector<double> distances;
  for (const auto& posture : postures.colwise()) {
    distances.push_back(subspace.distance(posture));
  }
  usual_distance_ = quantile_of(std::move(distances), kUsualShare);
  for (const FreeJoint& free : basis.free_joints) {
    free_joints_.push_back(free.joint);
    postures.row(free.joint).setZero();
  }
  find_motions(table.times, postures);
  tree_ = std::make_unique<const Tree>(std::move(postures));
}

RecordedPostures::~RecordedPostures() = default;

void RecordedPostures::find_motions(const Eigen::VectorXd& times, const Eigen::MatrixXd& postures) {
  if (times.size() == 0) {
    motions_fault_ =
        "The recorded postures have no times, so that no motions can be cut from them.";
    return;
  }
  const std::vector<HandMotion> motions = cut_into_motions(times, postures.transpose());
  if (motions.size() < MotionComponents::kFewestMotions) {
    motions_fault_ = fmt::format(
        "The recording has {} motions, which are too few: at least {} are "
        "needed. Record for longer, or with pauses between motions.",
        motions.size(), MotionComponents::kFewestMotions);
    return;
  }
  motions_ = std::make_unique<const MotionComponents>(motions);
}

Eigen::Index RecordedPostures::count() const { return tree_->postures.cols(); }

NearestPosture RecordedPostures::nearest(const Eigen::VectorXd& posture) const {
  Eigen::VectorXd wanted = posture;
  wanted(free_joints_).setZero();
  Eigen::Index found = 0;
  double squared = 0.0;
  tree_->index.query(wanted.data(), 1, &found, &squared);
  NearestPosture result{std::sqrt(squared), tree_->postures.col(found)};
  result.joints(free_joints_) = posture(free_joints_);
  return result;
}

std::shared_ptr<const RecordedPostures> load_recorded_postures(const PmdBasis& basis) {
  return basis.postures.empty() ? nullptr : load_recorded_postures(basis, basis.postures);
}

std::shared_ptr<const RecordedPostures> load_recorded_postures(const PmdBasis& basis,
                                                               const std::filesystem::path& file) {
  return std::make_shared<const RecordedPostures>(basis, read_postures(file), file.string());
}

}  // namespace handway::sampling
