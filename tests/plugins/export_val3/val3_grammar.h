#pragma once

#include <set>
#include <string>
#include <vector>

namespace handway::test {

/// Returns the faults in the code of a VAL3 program, a sentence each, with its line: blocks that
/// are not closed in order, brackets that don't match, words that are neither the language's, nor
/// its library's, nor in `known`.
[[nodiscard]] std::vector<std::string> val3_faults(const std::string& code,
                                                   const std::set<std::string>& known);

}  // namespace handway::test
