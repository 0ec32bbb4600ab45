#pragma once

#include "handway/planning/export.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

/// @file
/// Text of programs for robot controllers, whose languages have narrow rules for names, comments
/// and numbers.

namespace handway::planning {

/// Returns the number with this many decimals, without an exponent, and never as "-0".
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string fixed_decimals(double value, int decimals);

/// Returns a duration with this many decimals, rounded up so that no move gets shorter. Excess of
/// less than a thousandth of the last decimal counts as rounding. @param seconds ≥ 0.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string duration_decimals(double seconds, int decimals);

/// Returns `text` as one line of printable ASCII for a comment or a message: other characters,
/// line ends and quotes become "?", and it is cut after `longest` characters.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string printable_line(std::string_view text,
                                                                 std::size_t longest = 70);

/// Returns the name of a motion as an identifier of a language. A name that is too long is cut, and
/// gets "_" and four digits that depend on all of it. A keyword gets "hw_" in front.
/// @param name as of Motion::name. @param longest in characters, at least 8.
/// @param keywords in lower case; case does not count.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string program_name(
    const std::string& name, std::size_t longest, std::span<const std::string_view> keywords);

}  // namespace handway::planning
