#pragma once

#include <string>

namespace handway::tools {

/// Prints a table of whole lines on a terminal, over the one of as many lines printed before
/// unless it is the first.
void print_table(const std::string& table, bool first);

/// Prints a line at once, also where standard output is a file.
void print_line(const std::string& line);

}  // namespace handway::tools
