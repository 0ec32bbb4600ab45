#pragma once

#include "handway/geometric/export.h"

#include <stdexcept>
#include <string>

namespace handway::geometric {

/// Why an input (a file, an option, a configuration) was refused. Every field
/// is a piece of one sentence for the person who wrote the input.
struct InputProblem {
  std::string source;    ///< File (with ":line" where known) or option.
  std::string element;   ///< Key, XML element or joint; may be empty.
  std::string found;     ///< What is there.
  std::string expected;  ///< What should be there; may be empty.
  std::string advice;    ///< What to do about it; may be empty.
};

/// Thrown for input that can't be read or makes no sense; tools exit with code 3.
class HANDWAY_GEOMETRIC_EXPORT InputError : public std::runtime_error {
 public:
  /// `what()` reads "SOURCE: ELEMENT: found FOUND, expected EXPECTED. ADVICE".
  explicit InputError(InputProblem problem);

  [[nodiscard]] const InputProblem& problem() const { return problem_; }

 private:
  InputProblem problem_;
};

}  // namespace handway::geometric
