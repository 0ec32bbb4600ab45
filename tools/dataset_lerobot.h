#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <string>

/// Data sets of `handway dataset` as data sets of LeRobot.

namespace handway::tools {

/// Folder of a data set of LeRobot with a file for each motion, of which its tables are made.
inline constexpr const char* kEpisodeFolder = "episodes";

/// Returns the frames per second of a period (s). @throws InputError unless they are whole.
[[nodiscard]] int frames_per_second(double period);

/// Writes the tables and `meta` of a data set of LeRobot, version 3, with the episodes that have a
/// motion, in their order. Writes nothing if there is none.
/// @param folder with the files of the episodes. @param settings content of `dataset.json`.
/// @param entries lines of `episodes.jsonl` by number.
/// @throws InputError if a file of an episode can't be read, OutputError if one can't be written.
void write_lerobot_dataset(const std::filesystem::path& folder,
                           const nlohmann::ordered_json& settings,
                           const std::map<int, nlohmann::ordered_json>& entries, int fps);

}  // namespace handway::tools
