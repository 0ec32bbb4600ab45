#include "recordings/lerobot_episodes.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

namespace handway::device {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;

/// Chunk and number of a file: 0 and 12 of chunk-000/file-012.parquet.
using FileNumber = std::pair<std::int64_t, std::int64_t>;

/// The number at the end of a name; 0 if there is none.
std::int64_t last_number(const std::string& name) {
  const auto digits = std::find_if(name.rbegin(), name.rend(),
                                   [](unsigned char c) { return std::isdigit(c) == 0; });
  std::int64_t number = 0;
  const char* end = name.data() + name.size();
  std::from_chars(end - (digits - name.rbegin()), end, number);
  return number;
}

FileNumber number_of(const fs::path& file) {
  return {last_number(file.parent_path().filename().string()), last_number(file.stem().string())};
}

/// A whole number from a table. @throws InputError if it is none.
std::int64_t whole_number(double value, const fs::path& file, const char* column) {
  constexpr double kHighest = 1e15;
  if (!(value >= 0.0 && value <= kHighest)) {
    throw InputError({file.string(), fmt::format("column {}", column), fmt::format("{}", value),
                      "numbers from 0", "Download the file again."});
  }
  return static_cast<std::int64_t>(value);
}

/// All whole numbers in a column. @throws InputError if it is missing.
std::vector<std::int64_t> whole_column(const ParquetFile& table, const fs::path& file,
                                       const char* name) {
  const ParquetColumn* column = table.find(name);
  if (column == nullptr || column->has_lists()) {
    throw InputError({file.string(), fmt::format("column {}", name), "no such column",
                      "a list of episodes of a LeRobot data set, version 3", ""});
  }
  const Eigen::MatrixXd values = table.numbers(*column, 1, 0, table.rows());
  std::vector<std::int64_t> numbers;
  for (const double value : values.reshaped()) {
    numbers.push_back(whole_number(value, file, name));
  }
  return numbers;
}

/// Reads the list of episodes of version 2.
std::vector<LeRobotEpisode> episodes_of_lines(const fs::path& list,
                                              const std::map<FileNumber, std::size_t>& files) {
  std::map<std::int64_t, std::size_t> file_of_episode;
  for (const auto& [number, file] : files) {
    file_of_episode.emplace(number.second, file);
  }
  const std::string text = geometric::read_text_file(list, "a list of episodes (JSON lines)");
  std::vector<LeRobotEpisode> episodes;
  std::size_t line = 0;
  for (std::size_t begin = 0; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const auto json =
        nlohmann::json::parse(text.begin() + static_cast<std::ptrdiff_t>(begin),
                              text.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
    const bool is_blank = text.find_first_not_of(" \t\r", begin) >= end;
    begin = end + 1;
    if (is_blank) {
      continue;
    }
    const auto number_in = [&](const char* key) {
      if (!json.is_object() || !json.contains(key) || !json.at(key).is_number()) {
        throw InputError({fmt::format("{}:{}", list.string(), line + 1), key,
                          "no number of that name", "an object with episode_index and length",
                          "Download the file again."});
      }
      return whole_number(json.at(key).get<double>(), list, key);
    };
    const std::int64_t number = number_in(kEpisodeColumn);
    if (const auto file = file_of_episode.find(number); file != file_of_episode.end()) {
      episodes.push_back({number, file->second, static_cast<std::size_t>(number_in("length"))});
    }
  }
  return episodes;
}

/// Reads the list of episodes of version 3.
std::vector<LeRobotEpisode> episodes_of_tables(const std::vector<fs::path>& lists,
                                               const std::map<FileNumber, std::size_t>& files) {
  std::vector<LeRobotEpisode> episodes;
  for (const fs::path& list : lists) {
    const ParquetFile table(list);
    const std::vector<std::int64_t> numbers = whole_column(table, list, kEpisodeColumn);
    const std::vector<std::int64_t> lengths = whole_column(table, list, "length");
    const std::vector<std::int64_t> chunks = whole_column(table, list, "data/chunk_index");
    const std::vector<std::int64_t> indices = whole_column(table, list, "data/file_index");
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (const auto file = files.find({chunks[i], indices[i]}); file != files.end()) {
        episodes.push_back({numbers[i], file->second, static_cast<std::size_t>(lengths[i])});
      }
    }
  }
  return episodes;
}

/// Finds the episodes without a list.
std::vector<LeRobotEpisode> episodes_in_files(const std::vector<fs::path>& files) {
  std::vector<LeRobotEpisode> episodes;
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (const EpisodeRows& rows : episode_rows(ParquetFile(files[i]), files[i])) {
      episodes.push_back({rows.episode, i, rows.count});
    }
  }
  return episodes;
}

}  // namespace

std::vector<EpisodeRows> episode_rows(const ParquetFile& table, const fs::path& file) {
  if (table.find(kEpisodeColumn) == nullptr) {
    return {{last_number(file.stem().string()), 0, table.rows()}};
  }
  const std::vector<std::int64_t> numbers = whole_column(table, file, kEpisodeColumn);
  std::vector<EpisodeRows> all;
  std::set<std::int64_t> known;
  for (std::size_t row = 0; row < numbers.size(); ++row) {
    if (all.empty() || all.back().episode != numbers[row]) {
      if (!known.insert(numbers[row]).second) {
        throw InputError({file.string(), fmt::format("column {}", kEpisodeColumn),
                          fmt::format("rows of episode {} in several places", numbers[row]),
                          "the rows of an episode one after the other", ""});
      }
      all.push_back({numbers[row], row, 0});
    }
    ++all.back().count;
  }
  return all;
}

std::vector<fs::path> parquet_files_below(const fs::path& folder) {
  constexpr int kDeepest = 1;  // folders of chunks
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error); !error && at != fs::end(at);
       at.increment(error)) {
    if (at.depth() >= kDeepest) {
      at.disable_recursion_pending();
    }
    if (geometric::has_extension(at->path(), ".parquet")) {
      files.push_back(at->path());
    }
  }
  std::ranges::sort(
      files, {}, [](const fs::path& file) { return std::tuple(number_of(file), file.string()); });
  return files;
}

std::vector<LeRobotEpisode> lerobot_episodes(const fs::path& data_set,
                                             const std::vector<fs::path>& files) {
  std::map<FileNumber, std::size_t> numbers;
  for (std::size_t i = 0; i < files.size(); ++i) {
    numbers.emplace(number_of(files[i]), i);
  }
  std::error_code error;
  const fs::path meta = data_set / "meta";
  const std::vector<fs::path> lists = parquet_files_below(meta / "episodes");
  std::vector<LeRobotEpisode> episodes;
  if (!lists.empty()) {
    episodes = episodes_of_tables(lists, numbers);
  } else if (fs::exists(meta / "episodes.jsonl", error)) {
    episodes = episodes_of_lines(meta / "episodes.jsonl", numbers);
  } else {
    episodes = episodes_in_files(files);
  }
  std::ranges::stable_sort(episodes, {}, &LeRobotEpisode::number);
  return episodes;
}

}  // namespace handway::device
