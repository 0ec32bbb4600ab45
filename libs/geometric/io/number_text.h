#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace handway::geometric {

/// The finite number that the whole of `text` spells, whatever the locale; blanks
/// around it do not matter. Nothing for anything else, NaN and infinity included.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// The shortest text that parse_number() reads back as the same number.
[[nodiscard]] std::string number_text(double value);

}  // namespace handway::geometric
