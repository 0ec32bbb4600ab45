#pragma once

#include <nlohmann/json.hpp>

#include <map>
#include <string>

namespace handway::tools {

/// Returns the text (Markdown) that others need to use a data set: counts, columns, what the
/// motions are certified for, how many were solved of each object, and why others were not.
/// @param settings content of `dataset.json`. @param entries lines of `episodes.jsonl` by number.
[[nodiscard]] std::string data_card(const nlohmann::ordered_json& settings,
                                    const std::map<int, nlohmann::ordered_json>& entries);

}  // namespace handway::tools
