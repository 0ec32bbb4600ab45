#include "handway/geometric/formats/yaml_element.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <set>
#include <sstream>
#include <unordered_map>

namespace handway::geometric {
namespace {

constexpr double kLargestNumber = 1e6;

std::string shortened(const std::string& text) {
  constexpr std::size_t kLongest = 60;
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "…";
}

std::string line_suffix(const YAML::Mark& mark) {
  return mark.is_null() ? "" : fmt::format(":{}", mark.line + 1);
}

}  // namespace

struct YamlElement::Document {
  std::filesystem::path file;
  std::string what;
};

struct YamlElement::Node {
  YAML::Node yaml;
};

YamlElement::YamlElement(std::shared_ptr<const Document> document, std::shared_ptr<const Node> node,
                         std::string name)
    : document_(std::move(document)), node_(std::move(node)), name_(std::move(name)) {}

std::string YamlElement::where() const {
  const YAML::Mark mark = node_->yaml.Mark();
  return document_->file.string() + line_suffix(mark);
}

void YamlElement::refuse(const std::string& found, const std::string& expected,
                         const std::string& advice) const {
  throw InputError({where(), name_, found, expected, advice});
}

std::string YamlElement::found() const {
  switch (node_->yaml.Type()) {
    case YAML::NodeType::Scalar:
      return fmt::format("\"{}\"", shortened(node_->yaml.Scalar()));
    case YAML::NodeType::Sequence:
      return fmt::format("a list of {}", node_->yaml.size());
    case YAML::NodeType::Map:
      return "a map of keys and values";
    default:
      return "nothing";
  }
}

bool YamlElement::is_map() const { return node_->yaml.IsMap(); }
bool YamlElement::is_list() const { return node_->yaml.IsSequence(); }
bool YamlElement::is_scalar() const { return node_->yaml.IsScalar(); }

void YamlElement::allow_keys(std::initializer_list<std::string> known) const {
  const std::vector<std::string> names(known);
  for (const auto& [key, value] : entries()) {
    if (std::ranges::count(names, key) == 0) {
      std::string list;
      for (const std::string& name : names) {
        list += (list.empty() ? "" : ", ") + name;
      }
      const std::string nearest = nearest_name(key, names);
      refuse_key(key, fmt::format("the unknown key \"{}\"", shortened(key)), list,
                 nearest.empty() ? "" : fmt::format("Did you mean \"{}\"?", nearest));
    }
  }
}

void YamlElement::refuse_slips(std::initializer_list<std::string> known) const {
  const std::vector<std::string> names(known);
  for (const auto& [key, value] : entries()) {
    const bool is_known = std::ranges::count(names, key) > 0;
    if (const auto meant = is_known ? std::nullopt : slip_of(key, names)) {
      refuse_key(key, fmt::format("the unknown key \"{}\"", shortened(key)), *meant,
                 fmt::format("Did you mean \"{}\"?", *meant));
    }
  }
}

void YamlElement::refuse_key(const std::string& key, const std::string& found,
                             const std::string& expected, const std::string& advice) const {
  for (const auto& entry : node_->yaml) {
    if (entry.first.Scalar() == key) {
      child({entry.first}, shortened(key)).refuse(found, expected, advice);
    }
  }
  refuse(found, expected, advice);
}

YamlElement YamlElement::child(const Node& node, const std::string& suffix) const {
  const char* dot = name_.empty() || suffix.starts_with('[') ? "" : ".";
  return {document_, std::make_shared<const Node>(Node{node}),
          fmt::format("{}{}{}", name_, dot, suffix)};
}

std::optional<YamlElement> YamlElement::find(const std::string& key) const {
  for (const auto& [name, value] : entries()) {
    if (name == key && !value.node_->yaml.IsNull()) {
      return value;
    }
  }
  return std::nullopt;
}

YamlElement YamlElement::need(const std::string& key) const {
  std::optional<YamlElement> value = find(key);
  if (!value) {
    refuse(fmt::format("no \"{}\"", key),
           fmt::format("it in {}", name_.empty() ? document_->what : name_));
  }
  return *value;
}

std::string YamlElement::text_or(const std::string& key, const std::string& otherwise) const {
  const std::optional<YamlElement> value = find(key);
  return value ? value->text() : otherwise;
}

bool YamlElement::flag_or(const std::string& key, bool otherwise) const {
  const std::optional<YamlElement> value = find(key);
  return value ? value->flag() : otherwise;
}

double YamlElement::number_or(const std::string& key, double otherwise) const {
  const std::optional<YamlElement> value = find(key);
  return value ? value->number() : otherwise;
}

Eigen::VectorXd YamlElement::numbers_or(const std::string& key,
                                        const Eigen::VectorXd& otherwise) const {
  const std::optional<YamlElement> value = find(key);
  return value ? value->numbers(static_cast<int>(otherwise.size())) : otherwise;
}

std::vector<YamlElement> YamlElement::items_of(const std::string& key) const {
  const std::optional<YamlElement> value = find(key);
  return value ? value->items() : std::vector<YamlElement>();
}

std::vector<std::pair<std::string, YamlElement>> YamlElement::entries() const {
  if (!is_map()) {
    refuse(found(), name_.empty() ? document_->what : "keys and values");
  }
  std::vector<std::pair<std::string, YamlElement>> result;
  std::set<std::string> seen;
  for (const auto& entry : node_->yaml) {
    const YamlElement key = child({entry.first}, shortened(entry.first.Scalar()));
    if (!key.is_scalar()) {
      refuse(key.found() + " as a key", "text");
    }
    const std::string name = entry.first.Scalar();
    if (!seen.insert(name).second) {
      key.refuse(fmt::format("the key \"{}\" a second time", shortened(name)), "every key once");
    }
    result.emplace_back(name, child({entry.second}, shortened(name)));
  }
  return result;
}

std::vector<YamlElement> YamlElement::items() const {
  if (!is_list()) {
    refuse(found(), "a list");
  }
  std::vector<YamlElement> result;
  for (const YAML::Node& item : node_->yaml) {
    result.push_back(child({item}, fmt::format("[{}]", result.size())));
  }
  return result;
}

std::string YamlElement::text() const {
  if (!is_scalar()) {
    refuse(found(), "text");
  }
  return node_->yaml.Scalar();
}

bool YamlElement::flag() const {
  const std::string word = text();
  const auto is_one_of = [&](std::initializer_list<const char*> words) {
    return std::ranges::find(words, word) != words.end();
  };
  if (is_one_of({"true", "True", "TRUE", "yes", "Yes", "YES", "on", "On", "ON"})) {
    return true;
  }
  if (!is_one_of({"false", "False", "FALSE", "no", "No", "NO", "off", "Off", "OFF"})) {
    refuse(found(), "true or false");
  }
  return false;
}

double YamlElement::number() const {
  const std::optional<double> value =
      is_scalar() ? parse_number(node_->yaml.Scalar()) : std::nullopt;
  if (!value) {
    refuse(found(), "a finite number");
  }
  if (std::abs(*value) > kLargestNumber) {
    refuse(found(), "a number within ±1000000", "Lengths are in metres, joint values in radians");
  }
  return node_->yaml.Tag() == "!degrees" ? radians(*value) : *value;  // as xacro reads YAML
}

Eigen::VectorXd YamlElement::numbers(int count) const {
  const std::string expected = fmt::format("a list of {} numbers", count);
  if (!is_list() || static_cast<int>(node_->yaml.size()) != count) {
    refuse(found(), expected);
  }
  Eigen::VectorXd result(count);
  int i = 0;
  for (const YamlElement& item : items()) {
    result[i++] = item.number();
  }
  return result;
}

namespace {

constexpr std::size_t kLargestFile = std::size_t{16} << 20;
constexpr std::size_t kMostElements = 1'000'000;
constexpr std::size_t kDeepest = 500;

/// Parses a document without storing it, and refuses it as soon as it exceeds a limit.
class LimitCheck final : public YAML::EventHandler {
 public:
  LimitCheck(const std::string& source, const std::string& what) : source_(source), what_(what) {}

  void OnDocumentStart(const YAML::Mark& /*mark*/) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { add({1, 1}, mark, anchor); }
  void OnScalar(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                const std::string& /*value*/) override {
    add({1, 1}, mark, anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto meant = anchored_.find(anchor);
    if (meant == anchored_.end()) {
      refuse(mark, "an alias within what it stands for", "Write the part out");
    }
    add(meant->second, mark, YAML::NullAnchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    begin(mark, anchor);
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    begin(mark, anchor);
  }
  void OnMapEnd() override { end(); }

 private:
  /// Counts a part of the document, aliases by their targets.
  struct Extent {
    std::size_t elements = 1;
    std::size_t levels = 1;
  };
  struct Open {
    YAML::Mark mark;
    YAML::anchor_t anchor;
    Extent extent;
  };

  [[noreturn]] void refuse(const YAML::Mark& mark, const std::string& found,
                           const std::string& advice) const {
    throw InputError({fmt::format("{}:{}", source_, mark.line + 1), "", found, what_, advice});
  }

  void begin(const YAML::Mark& mark, YAML::anchor_t anchor) { open_.push_back({mark, anchor, {}}); }

  void end() {
    const Open part = open_.back();
    open_.pop_back();
    add(part.extent, part.mark, part.anchor);
  }

  void add(const Extent& part, const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) {
      anchored_[anchor] = part;
    }
    if (open_.size() + part.levels > kDeepest) {
      refuse(mark, fmt::format("more than {} levels", kDeepest), "Is this the right file?");
    }
    if (open_.empty()) {
      return;
    }
    Extent& whole = open_.back().extent;
    whole.elements += part.elements;
    whole.levels = std::max(whole.levels, part.levels + 1);
    if (whole.elements > kMostElements) {
      refuse(
          mark,
          fmt::format("more than {} elements, aliases as often as they stand there", kMostElements),
          "Is this the right file?");
    }
  }

  const std::string& source_;
  const std::string& what_;
  std::vector<Open> open_;
  std::unordered_map<YAML::anchor_t, Extent> anchored_;
};

// Checks that a text can be parsed, see read_yaml_text().
void check_yaml(const std::string& text, const std::string& source, const std::string& what) {
  std::istringstream stream(text);
  int documents = 0;
  try {
    YAML::Parser parser(stream);
    LimitCheck check(source, what);
    while (documents < 2 && parser.HandleNextDocument(check)) {
      ++documents;
    }
  } catch (const YAML::Exception& error) {
    const std::string line = error.mark.is_null() ? "" : fmt::format(":{}", error.mark.line + 1);
    throw InputError({source + line, "", "broken YAML: " + error.msg, what,
                      "Check indentation, quotes and brackets around this line"});
  }
  if (documents != 1) {
    throw InputError({source, "",
                      documents == 0 ? "no YAML document" : "more than one YAML document", what,
                      "Keep one document a file"});
  }
}

// Removes the mark after each message that `rostopic echo` prints.
std::string text_of(const std::filesystem::path& file, const std::string& what) {
  std::string text = read_text_file(file, what, kLargestFile);
  text.erase(text.find_last_not_of(" \r\n") + 1);
  if (text.ends_with("\n---")) {
    text.resize(text.size() - 3);
  }
  return text;
}

}  // namespace

std::string read_yaml_text(const std::filesystem::path& file, const std::string& what) {
  std::string text = text_of(file, what);
  check_yaml(text, file.string(), what);
  return text;
}

YamlElement YamlElement::read(const std::filesystem::path& file, const std::string& what) {
  return parse(text_of(file, what), file.string(), what);
}

YamlElement YamlElement::parse(const std::string& text, const std::string& source,
                               const std::string& what) {
  check_yaml(text, source, what);
  YAML::Node top;
  try {
    top = YAML::Load(text);
  } catch (const std::exception& error) {
    throw InputError({source, "", std::string("broken YAML: ") + error.what(), what, ""});
  }
  return {std::make_shared<const Document>(Document{source, what}),
          std::make_shared<const Node>(Node{top}), ""};
}

}  // namespace handway::geometric
