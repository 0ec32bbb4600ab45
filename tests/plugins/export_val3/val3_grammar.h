#pragma once

#include <set>
#include <string>
#include <vector>

namespace handway::test {

/// What is wrong with the code of a VAL3 program: blocks that are not closed in order, brackets
/// that don't match, words that are neither the language's, nor its library's, nor in `known`. A
/// sentence each, with its line.
[[nodiscard]] std::vector<std::string> val3_faults(const std::string& code,
                                                   const std::set<std::string>& known);

}  // namespace handway::test
