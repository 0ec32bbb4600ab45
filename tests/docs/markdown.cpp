#include "markdown.h"

#include "handway_test/paths.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace handway::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> all_matches(const std::string& text, const std::regex& form) {
  std::vector<std::string> found;
  std::transform(std::sregex_iterator(text.begin(), text.end(), form), std::sregex_iterator(),
                 std::back_inserter(found), [](const std::smatch& match) { return match.str(1); });
  return found;
}

std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ' || c == '-') {
      anchor += '-';
    } else if (std::isalnum(byte) != 0 || c == '_') {
      anchor += static_cast<char>(std::tolower(byte));
    }
  }
  return anchor;
}

// The lines between a heading that `is_wanted`, without its signs, and the next of its level or
// above.
template <typename Predicate>
std::string lines_below(const std::string& markdown, const Predicate& is_wanted) {
  std::istringstream lines(markdown);
  std::string found;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("# ") || line.starts_with("## ")) {
      std::string title = line.substr(line.find(' ') + 1);
      std::erase(title, '`');
      inside = is_wanted(title);
    } else if (inside) {
      found += line + '\n';
    }
  }
  return found;
}

}  // namespace

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw std::runtime_error("can't read " + file.string());
  }
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> link_targets(const std::string& markdown) {
  static const std::regex kLink(R"(\]\(([^)\s]+)\))");
  return all_matches(markdown, kLink);
}

std::set<std::string> heading_anchors(const std::string& markdown) {
  static const std::regex kHeading(R"((?:^|\n)#+ +([^\n]+))");
  std::set<std::string> anchors;
  for (const std::string& heading : all_matches(markdown, kHeading)) {
    anchors.insert(anchor_of(heading));
  }
  return anchors;
}

std::string section(const std::string& markdown, std::string_view name) {
  return lines_below(markdown, [name](const std::string& title) { return title == name; });
}

std::string section_at(const std::string& markdown, std::string_view anchor) {
  return lines_below(markdown,
                     [anchor](const std::string& title) { return anchor_of(title) == anchor; });
}

std::set<std::string> setting_options(const std::string& table) {
  static const std::regex kRow(R"(\| `([a-z_]+)` \| ([^|]*) \|[^\n]*)");
  std::set<std::string> options;
  for (std::sregex_iterator row(table.begin(), table.end(), kRow), end; row != end; ++row) {
    std::string key = row->str(1);
    std::ranges::replace(key, '_', '-');
    options.insert((row->str(2) == "true" ? "--no-" : "--") + key);
  }
  return options;
}

std::set<std::string> long_options(const std::string& text) {
  static const std::regex kOption(R"((?:^|[^-\w])(--[a-z][a-z-]*))");
  const std::vector<std::string> found = all_matches(text, kOption);
  return {found.begin(), found.end()};
}

std::vector<fs::path> manual_pages() {
  std::vector<fs::path> pages = {source_dir() / "README.md", source_dir() / "CHANGELOG.md"};
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(source_dir() / "docs")) {
    if (entry.path().extension() == ".md") {
      pages.push_back(entry.path());
    }
  }
  return pages;
}

}  // namespace handway::test
