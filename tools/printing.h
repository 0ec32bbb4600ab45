#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string_view>
#include <utility>

namespace handway::tools {

/// Writes text to a stream after geometric::printable(): names from files can't control the
/// terminal. All output of commands goes through here.
/// @throws std::system_error if it can't be written.
void write_printable(std::FILE* stream, std::string_view text);

/// Prints to standard output, as fmt::print() would, by write_printable().
template <typename... Arguments>
void print_out(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  write_printable(stdout, fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// Prints to the error output, by write_printable().
template <typename... Arguments>
void print_error(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  write_printable(stderr, fmt::format(format, std::forward<Arguments>(arguments)...));
}

}  // namespace handway::tools
