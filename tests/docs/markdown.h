#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

/// The little of Markdown that the tests of the manual need.
namespace handway::test {

/// @throws std::runtime_error if the file can't be read.
[[nodiscard]] std::string read_text(const std::filesystem::path& file);

/// Targets of [text](target) and ![text](target), in order.
[[nodiscard]] std::vector<std::string> link_targets(const std::string& markdown);

/// Returns GitHub's anchors of the headings: "## Exit codes" is "exit-codes".
[[nodiscard]] std::set<std::string> heading_anchors(const std::string& markdown);

/// The lines between the heading "## `NAME`" or "## NAME" and the next of its level or above.
/// Empty if there is no such heading.
[[nodiscard]] std::string section(const std::string& markdown, std::string_view name);

/// Returns the lines below the heading with an anchor, as section(). Empty if there is none.
[[nodiscard]] std::string section_at(const std::string& markdown, std::string_view anchor);

/// Returns the options of a table of settings: "--period-ms" for "period_ms", "--no-blend" for
/// "blend" whose default is true.
[[nodiscard]] std::set<std::string> setting_options(const std::string& table);

/// Returns every "--option" in `text`, without its argument.
[[nodiscard]] std::set<std::string> long_options(const std::string& text);

/// README.md, CHANGELOG.md and all of docs/.
[[nodiscard]] std::vector<std::filesystem::path> manual_pages();

}  // namespace handway::test
