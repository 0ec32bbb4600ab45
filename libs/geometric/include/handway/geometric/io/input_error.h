#pragma once

#include "handway/geometric/export.h"

#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace handway::geometric {

/// Reason why an input (a file, an option, a configuration) was refused. Every field is a piece of
/// one sentence for the user who wrote the input.
struct InputProblem {
  std::string source;    ///< File (with ":line" where known) or option.
  std::string element;   ///< Key, XML element or joint; may be empty.
  std::string found;     ///< The value found.
  std::string expected;  ///< The value expected; may be empty.
  std::string advice;    ///< Advice on how to fix it; may be empty.
};

/// Thrown for input that can't be read or is invalid; tools exit with code 3.
class HANDWAY_GEOMETRIC_EXPORT InputError : public std::runtime_error {
 public:
  /// `what()` reads "SOURCE: ELEMENT: found FOUND, expected EXPECTED. ADVICE".
  explicit InputError(InputProblem problem);

  [[nodiscard]] const InputProblem& problem() const { return problem_; }

 private:
  InputProblem problem_;
};

/// Thrown for a result that can't be written to its destination; tools exit with code 1.
class HANDWAY_GEOMETRIC_EXPORT OutputError : public InputError {
 public:
  using InputError::InputError;
};

/// The one of `names` with the smallest edit distance to `word`, for advice on misspelt names;
/// empty if all are far (more than a third of the letters).
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string nearest_name(std::string_view word,
                                                                std::span<const std::string> names);

/// The `count` of `names`, or all if there are fewer, with the smallest edit distances to `word`,
/// nearest first, at any distance.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::string> nearest_names(
    std::string_view word, std::span<const std::string> names, std::size_t count);
/// The one of `names` of which `word`, which is not among them, is a misspelling: at most two
/// letters off, whatever their case, and not the whole word.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<std::string> slip_of(
    std::string_view word, std::span<const std::string> names);

/// Advice: `Did you mean "NAME"?`, or all names if they are few and none is near.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string advise_name(std::string_view word,
                                                               std::span<const std::string> names);

}  // namespace handway::geometric
