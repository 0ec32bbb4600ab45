#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_description.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {

/// An argument of a xacro file: `<xacro:arg name="…" default="…"/>`.
struct XacroArgument {
  std::string name;
  /// The default as it is written, with its substitutions; nothing: the file has none.
  std::optional<std::string> default_text;
};

/// Contents of a xacro file that are known before it is expanded: its own and those of the files
/// that it includes, also under conditions.
struct XacroFile {
  /// Arguments that are declared, and then those that are only used, in order.
  std::vector<XacroArgument> arguments;
  std::vector<std::string> packages;  ///< Names in `$(find NAME)`, each once, in order.
  /// Included files that were not read, as they are written: arguments may be missing.
  std::vector<std::string> unread;
};

/// Reads a xacro file without expanding it.
/// @param given values, for names of included files that depend on arguments.
/// @throws InputError if the file itself can't be read or is not XML.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT XacroFile read_xacro_file(const std::filesystem::path& file,
                                                                 const XacroArguments& given = {});

/// Splits `NAME:=VALUE`, as the program xacro takes arguments.
/// @param source of the text, for messages: "--xacro".
/// @throws InputError for a text of another form.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::pair<std::string, std::string> xacro_argument_of(
    const std::string& text, const std::string& source);

/// Returns the arguments of $HANDWAY_XACRO, one per line. The option `--xacro` sets it.
/// @throws InputError for a line that is not `NAME:=VALUE`.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT XacroArguments xacro_arguments_of_environment();

}  // namespace handway::geometric
