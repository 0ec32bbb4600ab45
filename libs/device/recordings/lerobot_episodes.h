#pragma once

#include "recordings/parquet_file.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

/// Episodes of LeRobot data sets, and the files with their frames.
///
/// Version 2 has a file for each episode, data/chunk-000/episode_000000.parquet, and lists episodes
/// in meta/episodes.jsonl. Version 3 has several episodes in a file, data/chunk-000/
/// file-000.parquet, and lists them in tables, meta/episodes/chunk-000/file-000.parquet.

namespace handway::device {

/// The column with the number of the episode that a frame belongs to.
inline constexpr const char* kEpisodeColumn = "episode_index";

/// Consecutive rows of a file that are an episode.
struct EpisodeRows {
  std::int64_t episode = 0;
  std::size_t first = 0;
  std::size_t count = 0;
};

/// Finds the episodes in a file by the column `episode_index`. A file without it is one episode,
/// whose number ends the file's name (0 if there is none).
/// @throws InputError if the column is damaged.
[[nodiscard]] std::vector<EpisodeRows> episode_rows(const ParquetFile& table,
                                                    const std::filesystem::path& file);

/// An episode of a data set.
struct LeRobotEpisode {
  std::int64_t number = 0;
  std::size_t file = 0;    ///< Index of the file with its frames.
  std::size_t frames = 0;  ///< By the list of episodes.
};

/// Returns the files with frames below a folder, in the order of their numbers.
[[nodiscard]] std::vector<std::filesystem::path> parquet_files_below(
    const std::filesystem::path& folder);

/// Lists the episodes of a data set that are in some files: by its list of episodes, or, if it has
/// none, by episode_rows(). Episodes whose file is missing are left out.
/// @throws InputError if the list or a file is damaged.
[[nodiscard]] std::vector<LeRobotEpisode> lerobot_episodes(
    const std::filesystem::path& data_set, const std::vector<std::filesystem::path>& files);

}  // namespace handway::device
