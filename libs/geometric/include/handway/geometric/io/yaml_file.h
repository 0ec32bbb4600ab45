#pragma once

#include "handway/geometric/export.h"

#include <filesystem>
#include <string>

namespace handway::geometric {

/// The text of a YAML file of one document that is fit to be parsed: at most 16 MB, a million
/// elements and 500 levels, what aliases stand for counted as often as they do.
/// @param what what the file should be, for messages: "a scene file".
/// @throws InputError as read_text_file(); if it is no YAML, has more or fewer documents than one,
/// exceeds a limit, or has an alias within what it stands for.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string read_yaml_text(const std::filesystem::path& file,
                                                                  const std::string& what);

}  // namespace handway::geometric
