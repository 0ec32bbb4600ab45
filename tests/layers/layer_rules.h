#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

/// The project's rules on who may include whom (docs/architecture.md), as a test.
namespace handway::test {

/// A place in the sources that breaks a rule.
struct Breach {
  std::string file;  ///< Relative to the project's root.
  int line = 0;      ///< From 1.
  std::string rule;  ///< One sentence.
};

/// Reads sources line by line; knows nothing of the compiler.
class LayerRules {
 public:
  /// @param files all sources and headers, relative to the project's root, with '/'.
  explicit LayerRules(std::set<std::string> files);

  /// The breaches in `file` (relative, with '/') whose contents are `text`.
  [[nodiscard]] std::vector<Breach> check(const std::string& file, std::string_view text) const;

 private:
  [[nodiscard]] std::string rule_broken_by_include(const std::string& file,
                                                   std::string_view include, bool quoted) const;
  /// The file of `library` that a file of it includes, or nothing.
  [[nodiscard]] std::optional<std::string> file_of_library(const std::string& file,
                                                           const std::string& library,
                                                           std::string_view include) const;
  /// Returns the violation of the order of the library's folders by `file`, which belongs to the
  /// library.
  [[nodiscard]] std::string folder_rule_broken(const std::string& file, const std::string& library,
                                               std::string_view include) const;
  /// Returns the violation of the order of the window's layers by `file`, which is in gui/.
  [[nodiscard]] std::string window_rule_broken(std::string_view file,
                                               std::string_view include) const;
  [[nodiscard]] std::string owner_of(const std::string& file, std::string_view include) const;

  std::set<std::string> files_;
};

/// Sources and headers under libs/, gui/, tools/, plugins/, python/ and tests/ of `root`, relative
/// to it.
[[nodiscard]] std::set<std::string> project_sources(const std::filesystem::path& root);

/// "file:line: rule", one a line.
[[nodiscard]] std::string to_text(const std::vector<Breach>& breaches);

}  // namespace handway::test
