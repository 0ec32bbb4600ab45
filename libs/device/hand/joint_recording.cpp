#include "handway/device/hand/joint_recording.h"

#include "glove/text_files.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace handway::device {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;
using geometric::RobotModel;
using geometric::YamlElement;

constexpr std::size_t kLargestFile = std::size_t{256} << 20;
constexpr double kRate = 100.0;  // Hz, of rows without times
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kWhat = "a recording of a hand's joints";

/// Rows of a file as they come, with gaps.
struct Rows {
  std::vector<double> times;            ///< As the file has them; NaN: not there.
  std::vector<Eigen::VectorXd> values;  ///< NaN: not there; shape [variables].
  std::set<std::string> others;         ///< Columns and joints that are none of the hand's.
  bool holds = false;                   ///< What a row lacks stays where it was.
  bool is_cut_off = false;              ///< The last message was no whole one.
};

std::vector<std::string_view> parts(std::string_view name, std::string_view separators) {
  std::vector<std::string_view> list;
  while (!name.empty()) {
    const std::size_t end = std::min(name.find_first_of(separators), name.size());
    if (end > 0) {
      list.push_back(name.substr(0, end));
    }
    name.remove_prefix(std::min(end + 1, name.size()));
  }
  return list;
}

// "/joint_states/index_joint_1/velocity"
bool is_no_position(std::string_view column) {
  constexpr std::array<std::string_view, 7> kOthers = {"velocity", "acceleration", "effort", "vel",
                                                       "acc",      "torque",       "current"};
  return std::ranges::any_of(parts(column, "/.[]"), [&](std::string_view part) {
    return std::ranges::count(kOthers, part) > 0;
  });
}

// A joint's name, alone or with what says that positions are meant.
std::optional<int> variable_called(const RobotModel& hand, std::string_view name) {
  constexpr std::array<std::string_view, 7> kEndings = {"_position", ".position", "_pos", ".pos",
                                                        "_rad",      "_deg",      "_q"};
  std::optional<int> found = hand.find_variable(name);
  for (const std::string_view ending : kEndings) {
    if (!found && name.ends_with(ending)) {
      found = hand.find_variable(name.substr(0, name.size() - ending.size()));
    }
  }
  return found;
}

// The variable whose positions a column of this name holds. Joints' names may have dots.
std::optional<int> variable_of(const RobotModel& hand, std::string_view column) {
  std::optional<int> found = hand.find_variable(column);
  if (found || is_no_position(column)) {
    return found;
  }
  for (const std::string_view separators : {"", "/", "/.[]"}) {
    for (const std::string_view part : parts(column, separators)) {
      found = found ? found : variable_called(hand, part);
    }
  }
  return found;
}

// Since 1970 in s, or in parts of it that make numbers as large.
double seconds(double time) {
  constexpr std::array<std::pair<double, double>, 3> kUnits = {
      {{1e17, 1e-9}, {1e14, 1e-6}, {1e11, 1e-3}}};
  for (const auto& [least, unit] : kUnits) {
    if (time >= least) {
      return time * unit;
    }
  }
  return time;
}

bool is_time(std::string_view column) {
  constexpr std::array<std::string_view, 9> kNames = {
      "time", "t", "timestamp", "%time", "__time", "stamp", "time_s", "seconds", "sec"};
  return std::ranges::count(kNames, column) > 0;
}

// What `rostopic echo -p` writes: "field.name0" and "field.position0" belong together.
std::map<std::string, std::string> names_in_rows(const std::vector<std::string>& header,
                                                 const std::vector<std::string_view>& row) {
  constexpr std::string_view kName = "field.name";
  std::map<std::string, std::string> joints;
  for (std::size_t c = 0; c < std::min(header.size(), row.size()); ++c) {
    if (header[c].starts_with(kName)) {
      joints["field.position" + header[c].substr(kName.size())] = row[c];
    }
  }
  return joints;
}

class TableOfJoints {
 public:
  TableOfJoints(const fs::path& file, const RobotModel& hand) : file_(file), hand_(hand) {}

  Rows read(const std::string& text) {
    for (const TextLine& line : text_lines(text)) {
      const std::string_view content = trimmed(line.text);
      if (content.empty() || content.front() == '#') {
        take_comment(content);
        continue;
      }
      if (header_.empty()) {
        read_header(content);
        continue;
      }
      const std::vector<std::string_view> row = cells(line.text, separator_);
      if (columns_.empty()) {
        find_columns(row);
      }
      if (row.size() != header_.size() && line.ended) {
        throw InputError({fmt::format("{}:{}", file_.string(), line.number), "",
                          fmt::format("{} values", row.size()),
                          fmt::format("{} as in the header", header_.size()), ""});
      }
      if (row.size() == header_.size()) {
        append(row);
      }
    }
    return std::move(rows_);
  }

 private:
  // NumPy writes a header as a comment.
  void take_comment(std::string_view line) {
    if (line.starts_with("# handway postures")) {
      throw InputError({file_.string() + ":1", "", "normalised postures", "joints in rad",
                        "Give what they were made from"});
    }
    line.remove_prefix(std::min<std::size_t>(1, line.size()));
    if (header_.empty() && std::ranges::any_of(cells(line, separator_of(line)), [&](auto cell) {
          return variable_of(hand_, cell).has_value();
        })) {
      read_header(line);
    }
  }

  void read_header(std::string_view line) {
    separator_ = separator_of(line);
    for (const std::string_view name : cells(line, separator_)) {
      header_.emplace_back(name);
    }
  }

  void find_columns(const std::vector<std::string_view>& first_row) {
    const std::map<std::string, std::string> named = names_in_rows(header_, first_row);
    for (const std::string& column : header_) {
      const auto name = named.find(column);
      columns_.push_back(variable_of(hand_, name == named.end() ? column : name->second));
      if (!columns_.back() && named.empty() && !is_time(column) && !is_no_position(column)) {
        rows_.others.insert(column);
      }
    }
  }

  void append(const std::vector<std::string_view>& row) {
    rows_.times.push_back(kUnknown);
    rows_.values.emplace_back(Eigen::VectorXd::Constant(hand_.variable_count(), kUnknown));
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::optional<double> value = parse_cell(row[c], separator_);
      if (columns_[c]) {
        rows_.values.back()[*columns_[c]] = value.value_or(kUnknown);
      } else if (is_time(header_[c])) {
        rows_.times.back() = seconds(value.value_or(kUnknown));
      }
    }
  }

  const fs::path& file_;
  const RobotModel& hand_;
  char separator_ = ',';
  std::vector<std::string> header_;
  std::vector<std::optional<int>> columns_;  ///< The variable of each.
  Rows rows_;
};

// {sec, nanosec} of ROS 2, {secs, nsecs} of ROS 1, or s.
double time_of(const YamlElement& stamp) {
  const auto part = [&](const char* key) {
    const auto found = stamp.find(key);
    return found ? parse_number(found->text()) : std::nullopt;
  };
  if (!stamp.is_map()) {
    return seconds(parse_number(stamp.text()).value_or(kUnknown));
  }
  const auto whole = part("sec") ? part("sec") : part("secs");
  const auto nanoseconds = part("nanosec") ? part("nanosec") : part("nsecs");
  return whole ? *whole + 1e-9 * nanoseconds.value_or(0.0) : kUnknown;
}

class Messages {
 public:
  Messages(const fs::path& file, const RobotModel& hand) : file_(file), hand_(hand) {
    rows_.holds = true;
  }

  // Messages are parsed one by one: what was recorded for an hour would be too much for a document.
  Rows read(const std::string& text) {
    std::string document;
    for (const TextLine& line : text_lines(text)) {
      const bool is_json_line = line.text.starts_with('{') && trimmed(line.text).ends_with('}');
      if (is_json_line || line.text.starts_with("---")) {
        take(document);
        document = is_json_line ? std::string(line.text) : "";
        first_line_ = line.number + (is_json_line ? 0 : 1);
        continue;
      }
      document.append(line.text).append("\n");
    }
    take_last(document);
    return std::move(rows_);
  }

 private:
  // Who stops a recording stops it within a message.
  void take_last(const std::string& document) {
    try {
      take(document);
    } catch (const InputError&) {
      if (rows_.values.empty()) {
        throw;
      }
      rows_.is_cut_off = true;
    }
  }

  void take(const std::string& document) {
    if (trimmed(document).empty()) {
      return;
    }
    const std::string source =
        first_line_ > 1 ? fmt::format("{} after line {}", file_.string(), first_line_ - 1)
                        : file_.string();
    take(YamlElement::parse(document, source, "a message of a hand's joints"));
  }

  void take(const YamlElement& message) {
    if (message.is_list()) {
      std::ranges::for_each(message.items(), [&](const YamlElement& one) { take(one); });
      return;
    }
    for (const char* around : {"msg", "message", "data", "joint_state", "joint_states",
                               "joint_trajectory", "trajectory", "goal"}) {
      const auto inner = message.find(around);
      if (inner && (inner->is_map() || inner->is_list())) {
        take(*inner);
        return;
      }
    }
    if (message.find("points")) {
      take_trajectory(message);
    } else {
      const auto header = message.find("header");
      const auto stamp = (header ? *header : message).find("stamp");
      append(message.need("name"), message.need("position"), stamp ? time_of(*stamp) : kUnknown);
    }
  }

  void take_trajectory(const YamlElement& trajectory) {
    for (const YamlElement& point : trajectory.need("points").items()) {
      const auto time = point.find("time_from_start");
      append(trajectory.need("joint_names"), point.need("positions"),
             time ? time_of(*time) : kUnknown);
    }
  }

  void append(const YamlElement& names, const YamlElement& positions, double time) {
    const std::vector<YamlElement> joints = names.items();
    const std::vector<YamlElement> numbers = positions.items();
    if (joints.size() != numbers.size()) {
      positions.refuse(fmt::format("{} positions", numbers.size()),
                       fmt::format("{}, one a joint", joints.size()));
    }
    Eigen::VectorXd values = Eigen::VectorXd::Constant(hand_.variable_count(), kUnknown);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const std::string name = joints[i].text();
      if (const auto variable = variable_of(hand_, name)) {
        values[*variable] = parse_number(numbers[i].text()).value_or(kUnknown);
      } else {
        rows_.others.insert(name);
      }
    }
    if (!values.array().isNaN().all()) {
      rows_.times.push_back(time);
      rows_.values.push_back(std::move(values));
    }
  }

  const fs::path& file_;
  const RobotModel& hand_;
  std::size_t first_line_ = 1;
  Rows rows_;
};

void name_others(const Rows& rows, std::vector<std::string>& warnings) {
  if (rows.others.empty()) {
    return;
  }
  constexpr std::ptrdiff_t kNamed = 5;
  const std::ptrdiff_t more = std::ssize(rows.others) - kNamed;
  const auto end = more > 0 ? std::next(rows.others.begin(), kNamed) : rows.others.end();
  warnings.push_back(fmt::format("passed over, as none of the hand's joints: {}{}",
                                 fmt::join(rows.others.begin(), end, ", "),
                                 more > 0 ? fmt::format(" and {} more", more) : ""));
}

// Joints that no row has stay in the middle.
void fill_missing(const RobotModel& hand, Rows& rows, std::vector<std::string>& warnings) {
  std::vector<std::string> missing;
  const geometric::Configuration neutral = hand.neutral();
  for (int v = 0; v < hand.variable_count(); ++v) {
    if (std::ranges::all_of(rows.values, [&](const auto& row) { return std::isnan(row[v]); })) {
      missing.push_back(hand.variable(v).name);
      std::ranges::for_each(rows.values, [&](auto& row) { row[v] = neutral[v]; });
    }
  }
  if (!missing.empty()) {
    warnings.push_back(
        fmt::format("no values of {}: taken to stand still", fmt::join(missing, ", ")));
  }
}

// Rows without gaps whose times do not run backwards.
void keep_whole_rows(Rows& rows, std::vector<std::string>& warnings) {
  Rows kept;
  Eigen::VectorXd latest = Eigen::VectorXd::Constant(rows.values.front().size(), kUnknown);
  const double begin = rows.times.front();
  const bool has_times = std::isfinite(rows.times.back() - begin) && rows.times.back() != begin;
  std::size_t backwards = 0;
  std::size_t gaps = 0;
  for (std::size_t i = 0; i < rows.values.size(); ++i) {
    const auto& row = rows.values[i];
    latest = rows.holds ? row.array().isNaN().select(latest, row).eval() : row;
    const double time = has_times ? rows.times[i] - begin : static_cast<double>(i) / kRate;
    if (latest.array().isNaN().any() || std::isnan(time)) {
      ++gaps;
    } else if (!kept.times.empty() && time < kept.times.back()) {
      ++backwards;
    } else {
      kept.times.push_back(time);
      kept.values.push_back(latest);
    }
  }
  if (gaps > 0) {
    warnings.push_back(fmt::format("{} rows that lack a value are left out", gaps));
  }
  if (backwards > 0) {
    warnings.push_back(fmt::format("{} rows whose time runs backwards are left out", backwards));
  }
  rows.times = std::move(kept.times);
  rows.values = std::move(kept.values);
}

// Nothing turns by more than a whole turn, so the unit is degrees.
void turn_to_radians(const RobotModel& hand, Eigen::MatrixXd& values,
                     std::vector<std::string>& warnings) {
  std::vector<int> turning;
  for (int v = 0; v < hand.variable_count(); ++v) {
    if (hand.variable(v).type != geometric::JointType::kPrismatic) {
      turning.push_back(v);
    }
  }
  if (turning.empty() ||
      values(Eigen::all, turning).lpNorm<Eigen::Infinity>() <= 2.0 * std::numbers::pi) {
    return;
  }
  values(Eigen::all, turning) *= geometric::kDegree;
  warnings.emplace_back("angles beyond a whole turn: all are taken for degrees");
}

}  // namespace

Recording read_joint_recording(const fs::path& file, const RobotModel& hand) {
  const std::string text = geometric::read_text_file(file, kWhat, kLargestFile);
  const bool messages = has_joint_messages(std::string_view(text).substr(0, 1U << 16));
  Rows rows = messages ? Messages(file, hand).read(text) : TableOfJoints(file, hand).read(text);
  const auto is_known = [](const Eigen::VectorXd& row) { return !row.array().isNaN().all(); };
  if (std::ranges::none_of(rows.values, is_known)) {
    throw InputError({file.string(), "", "no values of joints of " + hand.name(),
                      messages ? "messages with names and positions of its joints"
                               : "a header with the names of its joints, and rows of their values",
                      fmt::format("Its joints are {}", fmt::join(OwnJoints(hand).joints(), ", "))});
  }
  Recording recording;
  recording.header.kind = RecordingKind::kAngles;
  recording.header.origin = "joints of " + hand.name();
  name_others(rows, recording.warnings);
  if (rows.is_cut_off) {
    recording.warnings.emplace_back("the last message is not whole and is left out");
  }
  fill_missing(hand, rows, recording.warnings);
  keep_whole_rows(rows, recording.warnings);
  if (rows.values.empty()) {
    throw InputError({file.string(), "", "no row without gaps", "rows with all joints", ""});
  }
  recording.times = Eigen::VectorXd::Map(rows.times.data(), std::ssize(rows.times));
  recording.values.resize(std::ssize(rows.values), hand.variable_count());
  for (Eigen::Index row = 0; row < recording.values.rows(); ++row) {
    recording.values.row(row) = rows.values[static_cast<std::size_t>(row)];
  }
  turn_to_radians(hand, recording.values, recording.warnings);
  return recording;
}

bool is_joint_recording(const fs::path& file, const RobotModel& hand) {
  const std::string head = geometric::head_of(file);
  if (has_joint_messages(head)) {
    return true;
  }
  std::set<int> named;
  for (const TextLine& line : text_lines(head)) {
    const std::string_view header = trimmed(line.text);
    for (const std::string_view cell : cells(header, separator_of(header))) {
      if (const auto variable = variable_of(hand, cell)) {
        named.insert(*variable);
      }
    }
    if (!named.empty()) {
      break;
    }
  }
  return !named.empty() && 2 * std::ssize(named) >= hand.variable_count();
}

OwnJoints::OwnJoints(const RobotModel& hand) {
  for (int v = 0; v < hand.variable_count(); ++v) {
    joints_.push_back(hand.variable(v).name);
  }
  lower_ = hand.lower();
  upper_ = hand.upper();
}

std::vector<bool> OwnJoints::driven() const { return std::vector<bool>(joints_.size(), true); }

MappedPostures OwnJoints::map_recording(const Recording& recording,
                                        const std::stop_token& /*stop*/) const {
  return within_limits(recording.values);
}

}  // namespace handway::device
