#include "handway/geometric/formats/joint_table.h"

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/lower_case.h"
#include "handway/geometric/io/plural.h"
#include "handway/geometric/io/table_text.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <numbers>
#include <regex>
#include <span>
#include <utility>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestFile = std::size_t{256} << 20;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

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

// "/joint_states/index_joint_1/velocity", "pan [rad/s]"
bool is_no_position(std::string_view column) {
  constexpr std::array<std::string_view, 9> kOthers = {
      "velocity", "acceleration", "effort", "vel", "acc", "torque", "current", "jerk", "load"};
  constexpr std::array<std::string_view, 14> kUnits = {
      "rpm", "dps", "nm", "n m", "n\u00B7m", "n", "a", "ma", "v", "mv", "w", "hz", "\u00B0c", "c"};
  const std::string unit = unit_in_brackets(column);
  return unit.find("/s") != std::string::npos || std::ranges::count(kUnits, unit) > 0 ||
         std::ranges::any_of(parts(column, "/.[]"), [&](std::string_view part) {
           return std::ranges::count(kOthers, part) > 0;
         });
}

// Removes a unit in brackets at the end: "pan [deg]".
std::string_view without_brackets(std::string_view name) {
  if (name.empty() || (name.back() != ']' && name.back() != ')')) {
    return name;
  }
  const std::size_t begin = name.find_last_of("[(");
  return begin == std::string_view::npos || begin == 0 ? name : trimmed(name.substr(0, begin));
}

// Finds a joint by its name, alone or with a word for positions.
std::optional<int> joint_called(const JointLookup& lookup, std::string_view name) {
  constexpr std::array<std::string_view, 13> kEndings = {
      "_position", ".position", "_pos",     ".pos",     "_rad",     "_deg", ".deg",
      ".rad",      "_degrees",  ".degrees", "_radians", ".radians", "_q"};
  std::optional<int> found = lookup(name);
  for (const std::string_view ending : kEndings) {
    if (!found && name.ends_with(ending)) {
      found = joint_called(lookup, name.substr(0, name.size() - ending.size()));
    }
  }
  return found;
}

// Returns whether a text in brackets names a joint or a kind of value, but no unit: "pan [actual]",
// "position[pan]", "position[0]".
bool is_no_unit(const JointLookup& lookup, std::string_view column, const std::string& text) {
  constexpr std::array<std::string_view, 18> kWords = {
      "actual",    "measured",  "feedback", "state", "desired", "command",
      "target",    "reference", "joint",    "angle", "angles",  "position",
      "positions", "pos",       "q",        "value", "left",    "right"};
  const std::size_t begin = column.find_last_of("[(") + 1;
  const std::string_view name = trimmed(column.substr(begin, column.size() - begin - 1));
  return std::ranges::count(kWords, text) > 0 || parse_number(text) || lookup(name);
}

}  // namespace

PositionUnit position_unit(const JointLookup& lookup, std::string_view column,
                           const std::string& where) {
  if (lookup(column)) {
    return {};  // the joint's own name
  }
  const std::vector<std::string> words = words_of_column(column);
  const std::string last = words.empty() ? "" : words.back();
  constexpr std::array<const char*, 5> kDegrees = {"deg", "degs", "degree", "degrees", "\u00B0"};
  constexpr std::array<const char*, 4> kRadians = {"rad", "rads", "radian", "radians"};
  constexpr std::array<const char*, 6> kTurns = {"turn", "turns",      "rev",
                                                 "revs", "revolution", "revolutions"};
  const std::string unit = unit_in_brackets(column);
  if (std::ranges::count(kDegrees, last) > 0) {
    return {kDegree, true};
  }
  if (std::ranges::count(kRadians, last) > 0) {
    return {1.0, true};
  }
  if (unit == "mrad") {
    return {1e-3, true};
  }
  if (std::ranges::count(kTurns, unit) > 0) {
    return {2.0 * std::numbers::pi, true};
  }
  if (unit == "mm" || unit == "cm") {
    return {unit == "mm" ? 1e-3 : 1e-2, false};
  }
  if (!unit.empty() && unit != "m" && !is_no_unit(lookup, column, unit)) {
    throw InputError(
        {where, fmt::format("column \"{}\"", column), fmt::format("the unit \"{}\"", unit),
         "rad, mrad, deg or turns, or m, cm or mm", "Convert its values to one of them."});
  }
  return {};
}

std::optional<int> joint_of_column(const JointLookup& lookup, std::string_view column) {
  std::optional<int> found = lookup(column);
  if (found || is_no_position(column)) {
    return found;
  }
  column = without_brackets(column);
  for (const std::string_view separators : {"", "/", "/.[]"}) {
    for (const std::string_view part : parts(column, separators)) {
      found = found ? found : joint_called(lookup, part);
    }
  }
  return found;
}

bool has_joint_messages(std::string_view head) {
  if (head.find("position") == std::string_view::npos) {
    return false;  // most files: soon known
  }
  // Landmarks have names and positions, too, but not as parallel lists.
  static const std::regex kNames(R"re((^|\n)name:|"name"\s*:\s*\[)re");
  static const std::regex kPositions(R"re((^|\n)position:|"position"\s*:\s*\[)re");
  static const std::regex kJointNames(R"re(joint_names"?\s*:)re");
  const auto has = [&](const std::regex& key) {
    return std::regex_search(head.begin(), head.end(), key);
  };
  return has(kJointNames) || (has(kNames) && has(kPositions));
}

namespace {

/// Returns the names in output of `rostopic echo -p`: "field.name0" and "field.position0" belong
/// together.
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

/// The items of a list in a cell: "['a', 'b']", "[0.1 0.2]", "array('d', [0.1, 0.2])", "(1, 2)".
std::vector<std::string_view> items_of_cell(std::string_view cell) {
  const std::size_t begin = cell.find_last_of("[(");
  const std::size_t end = begin == std::string_view::npos ? begin : cell.find_first_of(")]", begin);
  if (end == std::string_view::npos) {
    return {};
  }
  std::vector<std::string_view> items;
  for (std::string_view item : parts(cell.substr(begin + 1, end - begin - 1), ", \t")) {
    while (!item.empty() && (item.front() == '\'' || item.front() == '"')) {
      item.remove_prefix(1);
    }
    while (!item.empty() && (item.back() == '\'' || item.back() == '"')) {
      item.remove_suffix(1);
    }
    items.push_back(item);
  }
  return items;
}

class TableOfJoints {
 public:
  TableOfJoints(const fs::path& file, const JointLookup& lookup, int count)
      : file_(file), lookup_(lookup), count_(count) {
    table_.columns.assign(static_cast<std::size_t>(count), 0);
  }

  JointTable read(const std::string& text) {
    for (const TextLine& line : text_lines(text)) {
      const std::string_view content = trimmed(line.text);
      if (content.empty() || content.front() == '#') {
        take_comment(content, line.number);
        continue;
      }
      if (kind_ == Kind::kOpen) {
        begin(line);
      } else if (kind_ == Kind::kNamedRows) {
        append_named_row(line);
      } else {
        take_row(line);
      }
    }
    if (kind_ == Kind::kColumns && !is_begun_) {
      begin_rows({});  // a header alone
    }
    return std::move(table_);
  }

 private:
  enum class Kind { kOpen, kColumns, kLists, kNamedRows };

  // NumPy writes a header as a comment.
  void take_comment(std::string_view line, std::size_t number) {
    if (line.starts_with("# handway postures")) {
      throw InputError({file_.string() + ":1", "", "normalised postures", "joints in rad",
                        "Give what they were made from"});
    }
    line.remove_prefix(std::min<std::size_t>(1, line.size()));
    if (kind_ == Kind::kOpen &&
        std::ranges::any_of(cells(line, separator_of(line)), [&](auto cell) {
          return joint_of_column(lookup_, cell).has_value();
        })) {
      read_header(line, number);
    }
  }

  // Reads a header, or a row with names and numbers.
  void begin(const TextLine& line) {
    const std::vector<std::string_view> row = cells(line.text, separator_of(line.text));
    const auto names = std::ranges::count_if(
        row, [&](std::string_view cell) { return lookup_(cell).has_value(); });
    const auto numbers = std::ranges::count_if(
        row, [](std::string_view cell) { return parse_cell(cell).has_value(); });
    if (names > 0 && numbers >= names) {
      kind_ = Kind::kNamedRows;
      table_.holds = true;
      separator_ = separator_of(line.text);
      append_named_row(line);
      return;
    }
    read_header(line.text, line.number);
  }

  void read_header(std::string_view line, std::size_t number) {
    kind_ = Kind::kColumns;
    header_place_ = fmt::format("{}:{}", file_.string(), number);
    separator_ = separator_of(line);
    header_ = cell_names(line, separator_);
    if (header_.size() > 1 && header_.back().empty()) {  // a separator at the end
      header_.pop_back();
      ends_in_separator_ = true;
    }
  }

  void take_row(const TextLine& line) {
    std::vector<std::string_view> row = cells(line.text, separator_);
    if (row.size() == header_.size() + 1 && row.back().empty() && ends_in_separator_) {
      row.pop_back();
    }
    if (!is_begun_ && append_units(header_, row)) {
      return;
    }
    if (!is_begun_) {
      is_begun_ = true;
      begin_rows(row);
    }
    if (row.size() != header_.size() && line.ended) {
      throw InputError({fmt::format("{}:{}", file_.string(), line.number), "",
                        plural(row.size(), "value"),
                        fmt::format("{} as in the header", header_.size()), ""});
    }
    if (row.size() != header_.size()) {
      table_.is_cut_off = true;
      return;
    }
    if (kind_ == Kind::kLists) {
      append_lists(row, line.number);
    } else {
      append(row, line.number);
    }
  }

  void begin_rows(const std::vector<std::string_view>& row) {
    std::vector<CellContent> contents(header_.size(), CellContent::kOther);
    for (std::size_t c = 0; c < std::min(row.size(), header_.size()); ++c) {
      contents[c] = joint_of_column(lookup_, header_[c]) ? CellContent::kOther : content_of(row[c]);
    }
    time_ = time_columns(header_, contents);
    table_.time_unit = time_.unit;
    name_list_ = list_column({"name", "names", "joint_name", "joint_names"}, row);
    position_list_ = list_column({"position", "positions"}, row);
    if (name_list_ && position_list_) {
      kind_ = Kind::kLists;
      table_.holds = true;
    } else {
      find_columns(row);
    }
  }

  // The column of lists whose name ends with this.
  [[nodiscard]] std::optional<std::size_t> list_column(
      std::initializer_list<std::string_view> names,
      const std::vector<std::string_view>& row) const {
    for (std::size_t c = 0; c < std::min(row.size(), header_.size()); ++c) {
      const std::string name = lower_case(header_[c]);
      const std::vector<std::string_view> ends = parts(name, "/.");
      if (!ends.empty() && std::ranges::count(names, ends.back()) > 0 &&
          !items_of_cell(row[c]).empty()) {
        return c;
      }
    }
    return std::nullopt;
  }

  void find_columns(const std::vector<std::string_view>& first_row) {
    const std::map<std::string, std::string> named = names_in_rows(header_, first_row);
    for (std::size_t c = 0; c < header_.size(); ++c) {
      const auto name = named.find(header_[c]);
      const std::string& column = name == named.end() ? header_[c] : name->second;
      const std::optional<int> joint =
          time_.has(c) ? std::nullopt : joint_of_column(lookup_, column);
      columns_.push_back(joint);
      units_.push_back(joint ? position_unit(lookup_, column, header_place_) : PositionUnit());
      table_.units_are_named |= units_.back().is_angle;
      if (joint) {
        ++table_.columns[static_cast<std::size_t>(*joint)];
      } else if (named.empty() && !column.empty() && !time_.has(c) && !time_name(column) &&
                 !is_no_position(column)) {
        table_.others.insert(column);
      }
    }
  }

  [[nodiscard]] double time_of_row(const std::vector<std::string_view>& row) {
    double time = time_.parts.empty() ? kUnknown : 0.0;
    for (const TimeColumns::Part& part : time_.parts) {
      const std::optional<double> number = parse_cell(row[part.column]);
      const std::optional<SpelledTime> spelled =
          number ? std::nullopt : parse_time(row[part.column]);
      table_.times_are_spelled |= spelled.has_value();
      time += number ? part.unit * *number : spelled ? spelled->seconds : kUnknown;
    }
    return time;
  }

  Eigen::VectorXd& add_row(double time, std::size_t line) {
    table_.times.push_back(time);
    table_.lines.push_back(line);
    return table_.values.emplace_back(Eigen::VectorXd::Constant(count_, kUnknown));
  }

  [[nodiscard]] double number_of(std::string_view cell, std::string_view column, std::size_t line) {
    const std::optional<double> value = parse_cell(cell);
    if (!value && !table_.bad_cell) {
      table_.bad_cell = {line, std::string(column), std::string(cell)};
    }
    return value.value_or(kUnknown);
  }

  void append(const std::vector<std::string_view>& row, std::size_t line) {
    Eigen::VectorXd& values = add_row(time_of_row(row), line);
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (columns_[c] && std::isnan(values[*columns_[c]])) {
        values[*columns_[c]] = number_of(row[c], header_[c], line) * units_[c].factor;
      }
    }
  }

  // Appends a row. @pre there are as many positions as names.
  void append(std::span<const std::string_view> names, std::span<const std::string_view> positions,
              double time, std::size_t line) {
    if (names.size() != positions.size()) {
      throw InputError({fmt::format("{}:{}", file_.string(), line), "",
                        plural(positions.size(), "position"),
                        fmt::format("{}, one a name", names.size()), ""});
    }
    Eigen::VectorXd& values = add_row(time, line);
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (const std::optional<int> joint = joint_of_column(lookup_, names[i])) {
        values[*joint] = number_of(positions[i], names[i], line);
        table_.columns[static_cast<std::size_t>(*joint)] = 1;
      } else {
        table_.others.insert(std::string(names[i]));
      }
    }
    if (values.array().isNaN().all()) {  // of another robot
      table_.times.pop_back();
      table_.values.pop_back();
      table_.lines.pop_back();
    }
  }

  void append_lists(const std::vector<std::string_view>& row, std::size_t line) {
    append(items_of_cell(row[*name_list_]), items_of_cell(row[*position_list_]), time_of_row(row),
           line);
  }

  // Layout: sec, nanosec, frame, then all names, then as many positions, velocities, efforts.
  void append_named_row(const TextLine& line) {
    const std::vector<std::string_view> row = cells(line.text, separator_);
    const auto is_number = [](std::string_view cell) { return parse_cell(cell).has_value(); };
    std::size_t first = 0;
    while (first < row.size() && is_number(row[first])) {
      ++first;
    }
    double time = kUnknown;
    if (first == 2) {
      time = *parse_cell(row[0]) + 1e-9 * *parse_cell(row[1]);
      table_.time_unit.seconds = 1.0;
      ++first;  // the frame, which may be empty
    } else if (first == 1) {
      time = *parse_cell(row[0]);
    } else if (first == 0 && !row.empty() && parse_time(row[0])) {
      time = parse_time(row[0])->seconds;
      table_.times_are_spelled = true;
      first = 1;
    }
    std::size_t end = std::min(first, row.size());
    while (end < row.size() && !is_number(row[end])) {
      ++end;
    }
    const std::span all(row);
    const std::size_t count = end - std::min(first, end);
    if (end + count > row.size() && !line.ended) {
      table_.is_cut_off = true;
      return;
    }
    append(all.subspan(std::min(first, end), count),
           all.subspan(end, std::min(count, row.size() - end)), time, line.number);
  }

  const fs::path& file_;
  const JointLookup& lookup_;
  int count_;
  Kind kind_ = Kind::kOpen;
  char separator_ = ',';
  std::vector<std::string> header_;
  std::string header_place_;  ///< File and line.
  bool ends_in_separator_ = false;
  bool is_begun_ = false;
  std::vector<std::optional<int>> columns_;  ///< The joint of each.
  std::vector<PositionUnit> units_;          ///< Unit of each column.
  TimeColumns time_;
  std::optional<std::size_t> name_list_;
  std::optional<std::size_t> position_list_;
  JointTable table_;
};

class Messages {
 public:
  Messages(const fs::path& file, const JointLookup& lookup, int count, const std::string& what)
      : file_(file), lookup_(lookup), count_(count), what_(what) {
    table_.holds = true;
    table_.columns.assign(static_cast<std::size_t>(count), 0);
  }

  // Messages are parsed one by one: an hour's recording would be too large for a document.
  JointTable read(const std::string& text) {
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
    return std::move(table_);
  }

 private:
  // A recording that was stopped ends within a message.
  void take_last(const std::string& document) {
    try {
      take(document);
    } catch (const InputError&) {
      if (table_.values.empty()) {
        throw;
      }
      table_.is_cut_off = true;
    }
  }

  void take(const std::string& document) {
    if (trimmed(document).empty()) {
      return;
    }
    const std::string source =
        first_line_ > 1 ? fmt::format("{} after line {}", file_.string(), first_line_ - 1)
                        : file_.string();
    take(YamlElement::parse(document, source, what_));
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

  // Reads {sec, nanosec} of ROS 2, {secs, nsecs} of ROS 1, or a number.
  double time_of(const YamlElement& stamp) {
    const auto part = [&](const char* key) {
      const auto found = stamp.find(key);
      return found ? parse_number(found->text()) : std::nullopt;
    };
    if (!stamp.is_map()) {
      return parse_number(stamp.text()).value_or(kUnknown);
    }
    table_.time_unit.seconds = 1.0;
    const auto whole = part("sec") ? part("sec") : part("secs");
    const auto nanoseconds = part("nanosec") ? part("nanosec") : part("nsecs");
    return whole ? *whole + 1e-9 * nanoseconds.value_or(0.0) : kUnknown;
  }

  void append(const YamlElement& names, const YamlElement& positions, double time) {
    const std::vector<YamlElement> joints = names.items();
    const std::vector<YamlElement> numbers = positions.items();
    if (joints.size() != numbers.size()) {
      positions.refuse(plural(numbers.size(), "position"),
                       fmt::format("{}, one a joint", joints.size()));
    }
    Eigen::VectorXd values = Eigen::VectorXd::Constant(count_, kUnknown);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const std::string name = joints[i].text();
      if (const auto joint = joint_of_column(lookup_, name)) {
        values[*joint] = parse_number(numbers[i].text()).value_or(kUnknown);
        table_.columns[static_cast<std::size_t>(*joint)] = 1;
      } else {
        table_.others.insert(name);
      }
    }
    if (!values.array().isNaN().all()) {
      table_.times.push_back(time);
      table_.values.push_back(std::move(values));
    }
  }

  const fs::path& file_;
  const JointLookup& lookup_;
  int count_;
  const std::string& what_;
  std::size_t first_line_ = 1;
  JointTable table_;
};

}  // namespace

JointTable read_joint_table(const fs::path& file, const JointLookup& lookup, int count,
                            const std::string& what) {
  const std::string text = read_text_file(file, what, kLargestFile);
  constexpr std::size_t kHead = std::size_t{1} << 16;
  return has_joint_messages(std::string_view(text).substr(0, kHead))
             ? Messages(file, lookup, count, what).read(text)
             : TableOfJoints(file, lookup, count).read(text);
}

}  // namespace handway::geometric
