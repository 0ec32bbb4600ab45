#include "handway/geometric/formats/xacro_file.h"

#include "formats/xml_document.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/package_path.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 1000;
constexpr std::string_view kBlanks = " \t\r\n";

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  return first == std::string::npos
             ? ""
             : text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

/// A substitution `$(COMMAND WORD…)` in a text.
struct Substitution {
  std::size_t begin = 0;
  std::size_t end = 0;  ///< Behind its bracket.
  std::string command;
  std::vector<std::string> words;
};

std::optional<Substitution> next_substitution(const std::string& text, std::size_t from) {
  const std::size_t begin = text.find("$(", from);
  const std::size_t end = begin == std::string::npos ? begin : text.find(')', begin);
  if (end == std::string::npos) {
    return std::nullopt;
  }
  Substitution found{begin, end + 1, "", {}};
  std::istringstream words(text.substr(begin + 2, end - begin - 2));
  words >> found.command;
  for (std::string word; words >> word;) {
    found.words.push_back(word);
  }
  return found;
}

// Names in calls xacro.arg('NAME') of an expression.
std::vector<std::string> names_in_calls(const std::string& text) {
  constexpr std::string_view kCall = "xacro.arg(";
  std::vector<std::string> names;
  for (std::size_t at = text.find(kCall); at != std::string::npos; at = text.find(kCall, at)) {
    at += kCall.size();
    const std::size_t quote = text.find_first_not_of(kBlanks, at);
    if (quote == std::string::npos || (text[quote] != '\'' && text[quote] != '"')) {
      continue;
    }
    const std::size_t end = text.find(text[quote], quote + 1);
    if (end != std::string::npos) {
      names.push_back(text.substr(quote + 1, end - quote - 1));
    }
  }
  return names;
}

class XacroReader {
 public:
  explicit XacroReader(const XacroArguments& given) : given_(given) {}

  void read(const fs::path& file) {
    read_.insert(fs::absolute(file).lexically_normal());
    XmlDocument document(file, "a robot file (xacro)");
    read_elements(document.nodes().document_element(), fs::absolute(file).parent_path());
  }

  XacroFile take() {
    for (const std::string& name : used_) {
      if (!find(name)) {
        result_.arguments.push_back({name, std::nullopt});
      }
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] const XacroArgument* find(const std::string& name) const {
    const auto found = std::ranges::find(result_.arguments, name, &XacroArgument::name);
    return found == result_.arguments.end() ? nullptr : &*found;
  }

  // Includes are read where they are, as xacro does: the first default of an argument counts.
  void read_elements(const pugi::xml_node& node, const fs::path& folder) {
    const std::string_view name = node.name();
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      note_text(attribute.value());
    }
    if (name == "xacro:arg") {
      declare(node);
    } else if (name == "xacro:include") {
      include(node.attribute("filename").value(), folder);
    }
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() == pugi::node_element) {
        read_elements(child, folder);
      } else if (child.type() == pugi::node_pcdata) {
        note_text(child.value());
      }
    }
  }

  void declare(const pugi::xml_node& node) {
    const std::string name = trimmed(node.attribute("name").value());
    const pugi::xml_attribute value = node.attribute("default");
    if (!name.empty() && !find(name)) {
      result_.arguments.push_back(
          {name, value ? std::optional<std::string>(value.value()) : std::nullopt});
    }
  }

  void note_text(const std::string& text) {
    for (auto found = next_substitution(text, 0); found;
         found = next_substitution(text, found->end)) {
      if (found->words.size() != 1) {
        continue;
      }
      if (found->command == "find") {
        note_once(result_.packages, found->words.front());
      } else if (found->command == "arg") {
        note_once(used_, found->words.front());
      }
    }
    for (const std::string& name : names_in_calls(text)) {
      note_once(used_, name);
    }
  }

  static void note_once(std::vector<std::string>& names, const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) {
      names.push_back(name);
    }
  }

  void include(const std::string& written, const fs::path& folder) {
    const std::optional<std::string> name = substituted(written, folder);
    const fs::path file = name ? existing_file(folder / trimmed(*name)) : fs::path();
    std::error_code error;
    if (file.empty() || read_.size() >= kMostFiles || !fs::is_regular_file(file, error)) {
      note_once(result_.unread, written);
      return;
    }
    if (read_.contains(fs::absolute(file).lexically_normal())) {
      return;
    }
    try {
      read(file);
    } catch (const InputError&) {
      note_once(result_.unread, written);  // the program says what is wrong, if it is used at all
    }
  }

  // The text with its substitutions replaced; nothing if that takes the program.
  [[nodiscard]] std::optional<std::string> substituted(const std::string& text,
                                                       const fs::path& folder,
                                                       int depth = 0) const {
    constexpr int kDeepest = 10;  // defaults that name other arguments
    if (text.find("${") != std::string::npos || depth > kDeepest) {
      return std::nullopt;
    }
    std::string result;
    std::size_t from = 0;
    for (auto found = next_substitution(text, 0); found;
         found = next_substitution(text, found->end)) {
      const std::optional<std::string> value = value_of(*found, folder, depth);
      if (!value) {
        return std::nullopt;
      }
      result.append(text, from, found->begin - from).append(*value);
      from = found->end;
    }
    return result.append(text, from, std::string::npos);
  }

  [[nodiscard]] std::optional<std::string> value_of(const Substitution& found,
                                                    const fs::path& folder, int depth) const {
    if (found.command == "dirname" && found.words.empty()) {
      return folder.string();
    }
    if (found.words.size() != 1) {
      return std::nullopt;
    }
    const std::string& word = found.words.front();
    if (found.command == "find") {
      const std::optional<fs::path> package = find_package(word, folder);
      return package ? std::optional(package->string()) : std::nullopt;
    }
    if (found.command == "arg") {
      if (const auto value = given_.find(word); value != given_.end()) {
        return value->second;
      }
      const XacroArgument* argument = find(word);
      return argument != nullptr && argument->default_text
                 ? substituted(*argument->default_text, folder, depth + 1)
                 : std::nullopt;
    }
    const char* value = found.command == "env" ? std::getenv(word.c_str()) : nullptr;
    return value != nullptr ? std::optional<std::string>(value) : std::nullopt;
  }

  const XacroArguments& given_;
  XacroFile result_;
  std::vector<std::string> used_;
  std::set<fs::path> read_;
};

}  // namespace

XacroFile read_xacro_file(const fs::path& file, const XacroArguments& given) {
  XacroReader reader(given);
  reader.read(file);
  return reader.take();
}

std::pair<std::string, std::string> xacro_argument_of(const std::string& text,
                                                      const std::string& source) {
  const std::size_t sign = text.find(":=");
  const std::string name = text.substr(0, sign);
  const bool is_name =
      !name.empty() && name.front() != '-' && name.find_first_of(kBlanks) == std::string::npos;
  if (sign == std::string::npos || !is_name) {
    throw InputError({source, "", "\"" + text + "\"", "an argument of a xacro file, NAME:=VALUE",
                      "Put it in quotes if the value has blanks"});
  }
  return {name, text.substr(sign + 2)};
}

XacroArguments xacro_arguments_of_environment() {
  const char* given = std::getenv("HANDWAY_XACRO");
  std::istringstream lines(given != nullptr ? given : "");
  XacroArguments arguments;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) {
      const auto [name, value] = xacro_argument_of(line, "--xacro");
      arguments[name] = value;
    }
  }
  return arguments;
}

}  // namespace handway::geometric
