#include "handway/geometric/io/yaml_file.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <exception>
#include <sstream>
#include <unordered_map>
#include <vector>

namespace handway::geometric {
namespace {

constexpr std::size_t kLargestFile = std::size_t{16} << 20;
constexpr std::size_t kMostElements = 1'000'000;
constexpr std::size_t kDeepest = 500;

/// Follows a document without keeping it, and refuses it as soon as it exceeds a limit.
class LimitCheck final : public YAML::EventHandler {
 public:
  LimitCheck(const std::filesystem::path& file, const std::string& what)
      : file_(file), what_(what) {}

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
  /// A part of the document, aliases counted as what they stand for.
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
    throw InputError(
        {fmt::format("{}:{}", file_.string(), mark.line + 1), "", found, what_, advice});
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

  const std::filesystem::path& file_;
  const std::string& what_;
  std::vector<Open> open_;
  std::unordered_map<YAML::anchor_t, Extent> anchored_;
};

}  // namespace

std::string read_yaml_text(const std::filesystem::path& file, const std::string& what) {
  std::string text = read_text_file(file, what, kLargestFile);
  std::istringstream stream(text);
  int documents = 0;
  try {
    YAML::Parser parser(stream);
    LimitCheck check(file, what);
    while (documents < 2 && parser.HandleNextDocument(check)) {
      ++documents;
    }
  } catch (const YAML::Exception& error) {
    const std::string line = error.mark.is_null() ? "" : fmt::format(":{}", error.mark.line + 1);
    throw InputError({file.string() + line, "", "broken YAML: " + error.msg, what,
                      "Check indentation, quotes and brackets around this line"});
  }
  if (documents != 1) {
    throw InputError({file.string(), "",
                      documents == 0 ? "no YAML document" : "more than one YAML document", what,
                      "Keep one document a file"});
  }
  return text;
}

}  // namespace handway::geometric
