#include "layer_rules.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <regex>
#include <utility>
#include <vector>

namespace handway::test {
namespace {

namespace fs = std::filesystem;

/// Libraries that the files of each library may include.
const std::map<std::string, std::set<std::string>, std::less<>> kBelow = {
    {"geometric", {}},
    {"sampling", {"geometric"}},
    {"planning", {"geometric", "sampling"}},
    {"device", {"geometric"}},
    {"execution", {"geometric", "sampling", "planning", "device"}},
    {"report", {"geometric", "sampling"}},
};

/// The folders of libraries, lowest first: sources and headers of each, the public ones too, may
/// include those of the folders before it. A library that is not named here is not checked.
const std::map<std::string, std::vector<std::string>, std::less<>> kLibraryFolders = {
    {"geometric",
     {"math", "io", "mesh", "robot", "scene", "collision/volumes", "collision",
      "collision/continuous", "collision/cache", "collision/broad_phase", "collision/narrow_phase",
      "collision/checkers", "setup", "formats"}},
    {"sampling", {"sequences", "samplers", "regions", "postures"}},
    {"planning",
     {"edits", "core", "spaces", "paths", "roadmap", "timing", "planners", "queries", "extensions",
      "replanning", "grasps", "tasks", "campaigns"}},
    {"device",
     {"core", "glove", "recordings", "retargeting", "tracker", "arm", "hand", "ros", "haptic",
      "emulators"}},
    {"execution", {"motion", "guidance"}},
    {"report", {"document", "plots", "rendering", "studies"}},
};

/// The folders of the window, lowest first: each may include those before it. Two exceptions:
/// `view3d` and `widgets` do not know each other, nor does a feature know another.
const std::vector<std::string> kWindowFolders = {
    "model/jobs",     "model/meshes",
    "model/settings", "model/document",
    "model/playback", "model/planning",
    "model/devices",  "view3d",
    "widgets/style",  "widgets/forms",
    "widgets/plots",  "widgets/panels",
    "features",       "app",
};

/// File that lists the window's features, the only place that names them.
constexpr std::string_view kFeatureList = "app/features.cpp";

/// The part of the project that a file belongs to: "libs/geometric", "plugins/NAME", "gui",
/// "tools", "python".
std::string part_of(std::string_view file) {
  const std::size_t first = file.find('/');
  const std::string_view top = file.substr(0, first);
  if (top != "libs" && top != "plugins") {
    return std::string(top);
  }
  return std::string(file.substr(0, file.find('/', first + 1)));
}

/// The library that a file of libs/ belongs to, or nothing.
std::optional<std::string> library_of(std::string_view file) {
  constexpr std::string_view kLibs = "libs/";
  if (!file.starts_with(kLibs)) {
    return std::nullopt;
  }
  return part_of(file).substr(kLibs.size());
}

/// The library that a file of tests/LIBRARY/ tests, or nothing: tests/contracts and others test
/// several.
std::optional<std::string> tested_library_of(std::string_view file) {
  constexpr std::string_view kTests = "tests/";
  if (!file.starts_with(kTests)) {
    return std::nullopt;
  }
  file.remove_prefix(kTests.size());
  const std::string library(file.substr(0, file.find('/')));
  return kBelow.contains(library) ? std::optional(library) : std::nullopt;
}

/// "collision/cache" of "libs/geometric/collision/cache/a.cpp" and of its public headers, which
/// are in libs/geometric/include/handway/geometric/collision/cache.
std::string library_folder_of(std::string_view file, const std::string& library) {
  for (const std::string& prefix : {"libs/" + library + '/', "include/handway/" + library + '/'}) {
    if (file.starts_with(prefix)) {
      file.remove_prefix(prefix.size());
    }
  }
  const std::size_t slash = file.rfind('/');
  return slash == std::string_view::npos ? std::string() : std::string(file.substr(0, slash));
}

bool is_header(std::string_view file) { return file.ends_with(".h"); }

bool is_public_header(std::string_view file) {
  return library_of(file).has_value() && is_header(file) &&
         file.find("/include/handway/") != std::string_view::npos;
}

bool is_standard_header(std::string_view include) {
  return include.find_first_of("./") == std::string_view::npos;
}

/// Qt's and Coin's headers: <QWidget>, <QtCore/…>, <Inventor/…>.
bool is_screen_header(std::string_view include) {
  const bool qt = include.size() > 1 && include[0] == 'Q' &&
                  (include[1] == 't' || (include[1] >= 'A' && include[1] <= 'Z'));
  return qt || include.starts_with("Inventor/") || include.starts_with("qwt");
}

/// Headers of Qt's widgets; QUndoStack, which only is delivered with them, is none.
bool is_widget_header(std::string_view include) {
  static const std::regex kWidget(
      R"(Q(Widget|MainWindow|Frame|Label|Menu|Action|Splitter|Dock|Tool|Tab|Tree|Table|List|Stacked)"
      R"(|Scroll|Style|StatusBar|Progress|Header|Application|Message|Abstract|Form|Grid|HBox|VBox)"
      R"(|Group|Check|Combo|Radio|Spin|Double|Slider|Dial|Undo|Line|Plain|Text|Push|File)"
      R"().*(Widget|Window|Frame|Label|Menu|Action|Splitter|Bar|View|Area|Style\w*|Application)"
      R"(|Dialog|Box|Layout|Edit|Button|Slider|Item|Delegate))");
  static const std::regex kShort(
      R"(Q(Widget|Frame|Label|Menu|Action|Splitter|Dialog|Slider|Dial))");
  const std::string name(include);
  return std::regex_match(name, kShort) || std::regex_match(name, kWidget);
}

/// The place in kWindowFolders of a file of gui/ (without "gui/"), or nothing.
std::optional<std::size_t> window_folder_of(std::string_view file) {
  for (std::size_t i = 0; i < kWindowFolders.size(); ++i) {
    if (file.starts_with(kWindowFolders[i] + '/')) {
      return i;
    }
  }
  return std::nullopt;
}

/// "editing" of "features/editing/scene_tree.h"; empty of a file that features have in common.
std::string_view feature_of(std::string_view file) {
  constexpr std::string_view kFeatures = "features/";
  file.remove_prefix(kFeatures.size());
  const std::size_t end = file.find('/');
  return end == std::string_view::npos ? std::string_view() : file.substr(0, end);
}

std::string without_comment(const std::string& line) {
  const std::size_t comment = line.find("//");
  return comment == std::string::npos ? line : line.substr(0, comment);
}

// Returns the error if a test of one library includes what the library itself must not.
std::string test_rule_broken(const std::string& library, std::string_view include) {
  for (const auto& [other, below] : kBelow) {
    if (include.starts_with("handway/" + other + '/') && other != library &&
        !kBelow.at(library).contains(other)) {
      return "a test of " + library + " must not include " + other;
    }
  }
  return {};
}

}  // namespace

LayerRules::LayerRules(std::set<std::string> files) : files_(std::move(files)) {}

std::string LayerRules::owner_of(const std::string& file, std::string_view include) const {
  std::string part = part_of(file);
  const std::string name(include);
  const fs::path beside = (fs::path(file).parent_path() / name).lexically_normal();
  if (beside.generic_string().starts_with(part + '/')) {
    if (files_.contains(beside.generic_string()) || files_.contains(part + '/' + name)) {
      return part;
    }
  } else if (name.starts_with("..")) {
    return part_of(beside.generic_string());
  }
  for (const std::string& other : files_) {
    if (other.ends_with('/' + name) && part_of(other) != part) {
      return part_of(other);
    }
  }
  return part;  // made by the build
}

std::optional<std::string> LayerRules::file_of_library(const std::string& file,
                                                       const std::string& library,
                                                       std::string_view include) const {
  const std::string root = "libs/" + library + '/';
  const std::string name(include);
  const fs::path beside = (fs::path(file).parent_path() / name).lexically_normal();
  for (const std::string& candidate :
       {root + "include/" + name, beside.generic_string(), root + name}) {
    if (candidate.starts_with(root) && files_.contains(candidate)) {
      return candidate;
    }
  }
  return std::nullopt;
}

std::string LayerRules::folder_rule_broken(const std::string& file, const std::string& library,
                                           std::string_view include) const {
  const auto rule = kLibraryFolders.find(library);
  const std::optional<std::string> included = file_of_library(file, library, include);
  if (rule == kLibraryFolders.end() || !included) {
    return {};
  }
  const std::vector<std::string>& folders = rule->second;
  const std::string from = library_folder_of(file, library);
  const std::string to = library_folder_of(*included, library);
  const auto place = std::ranges::find(folders, from);
  if (place == folders.end()) {
    return "the layer of the folder " + library + '/' + from + " is not laid down";
  }
  const bool below = std::find(folders.begin(), place + 1, to) != place + 1;
  return below ? std::string() : library + '/' + from + " must not include " + to;
}

std::string LayerRules::window_rule_broken(std::string_view file, std::string_view include) const {
  constexpr std::string_view kGui = "gui/";
  file.remove_prefix(kGui.size());
  const auto from = window_folder_of(file);
  if (!from) {
    return "the layer of gui/" + std::string(file) + " is not laid down";
  }
  const std::string& folder = kWindowFolders[*from];
  if (include.starts_with("Inventor/") && folder != "view3d") {
    return "only view3d knows Coin: " + std::string(include);
  }
  if (folder.starts_with("model/") && is_widget_header(include)) {
    return "the model must not know widgets: " + std::string(include);
  }
  if (!files_.contains(std::string(kGui) + std::string(include))) {
    return {};
  }
  const auto to = window_folder_of(include);
  const bool upwards = !to || *to > *from;
  const bool across =
      to && ((folder.starts_with("widgets/") && kWindowFolders[*to] == "view3d") ||
             (folder == "features" && *to == *from && !feature_of(include).empty() &&
              feature_of(file) != feature_of(include)));
  if (include.starts_with("features/") && !feature_of(include).empty() && folder == "app" &&
      file != kFeatureList) {
    return "only gui/" + std::string(kFeatureList) + " must include features";
  }
  return upwards || across ? "gui/" + folder + " must not include " + std::string(include)
                           : std::string();
}

std::string LayerRules::rule_broken_by_include(const std::string& file, std::string_view include,
                                               bool quoted) const {
  if (file.starts_with("tests/")) {
    const std::optional<std::string> tested = tested_library_of(file);
    return tested ? test_rule_broken(*tested, include) : std::string();
  }
  const std::optional<std::string> library = library_of(file);
  if (library) {
    if (std::string rule = folder_rule_broken(file, *library, include); !rule.empty()) {
      return rule;
    }
  }
  constexpr std::string_view kOurs = "handway/";
  if (include.starts_with(kOurs)) {
    const std::string_view rest = include.substr(kOurs.size());
    const std::string used(rest.substr(0, rest.find('/')));
    if (!kBelow.contains(used)) {
      return "there is no library " + used;
    }
    if (!library || *library == used) {
      return {};
    }
    const auto below = kBelow.find(*library);
    if (below == kBelow.end()) {
      return "the layer of " + *library + " is not laid down";
    }
    return below->second.contains(used) ? std::string() : *library + " must not include " + used;
  }
  if (library && is_screen_header(include)) {
    return "a library must not know Qt or Coin: " + std::string(include);
  }
  if (file.starts_with("gui/")) {
    if (std::string rule = window_rule_broken(file, include); !rule.empty()) {
      return rule;
    }
  }
  if (quoted) {
    const std::string owner = owner_of(file, include);
    if (owner != part_of(file)) {
      return std::string(include) + " belongs to " + owner;
    }
  }
  if (is_public_header(file) &&
      (quoted || (!is_standard_header(include) && !include.starts_with("Eigen/")))) {
    return "a public header includes only the standard library, Eigen and handway/: " +
           std::string(include);
  }
  return {};
}

std::vector<Breach> LayerRules::check(const std::string& file, std::string_view text) const {
  static const std::regex kInclude(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"].*)");
  static const std::regex kUsingStd(R"(\busing\s+namespace\s+std\b)");
  static const std::regex kScreenName(R"(\b(Q[A-Z][a-z]\w*|So[A-Z][a-z]\w*))");

  std::vector<Breach> breaches;
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = without_comment(std::string(text.substr(begin, end - begin)));
    begin = end + 1;
    ++number;
    std::smatch match;
    if (std::regex_match(line, match, kInclude)) {
      const std::string rule = rule_broken_by_include(file, match[2].str(), match[1] == "\"");
      if (!rule.empty()) {
        breaches.push_back({file, number, rule});
      }
    } else if (!file.starts_with("tests/") && std::regex_search(line, kUsingStd)) {
      breaches.push_back({file, number, "no using namespace std"});
    } else if (library_of(file) && is_header(file) && std::regex_search(line, match, kScreenName)) {
      breaches.push_back({file, number, "a library must not know Qt or Coin: " + match.str()});
    }
  }
  return breaches;
}

std::set<std::string> project_sources(const fs::path& root) {
  constexpr std::array kFolders = {"libs", "gui", "tools", "plugins", "python", "tests"};
  std::set<std::string> files;
  for (const char* folder : kFolders) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      const fs::path extension = entry.path().extension();
      if (entry.is_regular_file() && (extension == ".h" || extension == ".cpp")) {
        files.insert(fs::relative(entry.path(), root).generic_string());
      }
    }
  }
  return files;
}

std::string to_text(const std::vector<Breach>& breaches) {
  std::string text;
  for (const Breach& breach : breaches) {
    text += breach.file + ':' + std::to_string(breach.line) + ": " + breach.rule + '\n';
  }
  return text;
}

}  // namespace handway::test
