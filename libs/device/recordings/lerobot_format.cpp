#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/table_times.h"
#include "recordings/array_recording.h"
#include "recordings/lerobot_episodes.h"
#include "recordings/lerobot_info.h"
#include "recordings/parquet_file.h"
#include "recordings/recording_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace handway::device {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;

constexpr const char* kTableVariable = "table";

/// Parts of a data set.
struct DataSetFiles {
  fs::path data_set;            ///< Its folder; empty for a table that is not part of one.
  std::vector<fs::path> files;  ///< With frames.
  bool is_whole = true;         ///< False: one of its files was named.
};

/// Finds the parts by a folder, its meta/info.json, or a file with frames.
DataSetFiles files_of_data_set(const fs::path& given) {
  std::error_code error;
  const fs::path path = fs::absolute(given, error);
  if (!geometric::has_extension(path, ".json") && !fs::is_directory(path, error)) {
    const fs::path data_set = path.parent_path().parent_path().parent_path();
    const bool has_info = fs::exists(data_set / "meta" / "info.json", error);
    return {has_info ? data_set : fs::path(), {given}, false};
  }
  const fs::path data_set =
      fs::is_directory(path, error) ? given : path.parent_path().parent_path();
  DataSetFiles found{data_set, parquet_files_below(data_set / "data")};
  if (found.files.empty()) {
    throw InputError({given.string(), "", "no files data/chunk-000/*.parquet beside meta",
                      "a LeRobot data set, version 2 or 3",
                      "Download the folder data of the data set, too."});
  }
  return found;
}

/// The product of all sizes.
std::size_t product_of(const std::vector<std::size_t>& sizes) {
  std::size_t product = 1;
  for (const std::size_t size : sizes) {
    product *= size;
  }
  return product;
}

/// A column that is offered as variables.
struct FrameColumn {
  std::string name;
  std::vector<std::size_t> shape;  ///< Sizes of one frame; empty: a single number.
  std::string type;
  std::string problem;
  std::vector<std::string> names;
};

FrameColumn frame_column(const ParquetFile& table, const ParquetColumn& column,
                         const LeRobotFeature* feature) {
  FrameColumn frame{column.name, {}, column.type_name(), column.problem, {}};
  if (feature != nullptr && !feature->has_numbers()) {
    const bool is_picture = feature->type == "image" || feature->type == "video";
    frame.type = feature->type;
    frame.shape = feature->shape;
    frame.problem = is_picture ? "pictures" : "texts or bytes";
  } else if (column.problem.empty() && column.has_lists()) {
    const std::size_t width = table.width(column);
    frame.shape = feature != nullptr ? feature->shape : std::vector<std::size_t>{width};
    frame.problem = product_of(frame.shape) == 0 ? "lists of different lengths" : "";
  }
  if (frame.shape.empty()) {
    frame.names = {frame.name};
  } else if (feature != nullptr && frame.problem.empty()) {
    frame.names = feature->names;
  }
  return frame;
}

/// Frames of one or several episodes.
struct Frames {
  Eigen::MatrixXd values;
  std::vector<double> times;
};

/// The episodes of a data set, or a table in Parquet.
class LeRobotArrays final : public ArrayFile {
 public:
  explicit LeRobotArrays(const fs::path& given)
      : ArrayFile(given), parts_(files_of_data_set(given)) {
    if (!parts_.data_set.empty()) {
      info_ = read_lerobot_info(parts_.data_set / "meta" / "info.json");
    }
    const ParquetFile& first = open(0).table;
    const bool has_episodes = info_ || first.find(kEpisodeColumn) != nullptr;
    if (has_episodes) {
      episodes_ =
          parts_.is_whole ? lerobot_episodes(parts_.data_set, parts_.files) : episodes_of_file();
    }
    find_columns(first, has_episodes);
    find_times(first, has_episodes);
    list_variables(has_episodes);
  }

  [[nodiscard]] std::vector<std::string> column_names(
      const RecordingVariable& variable) const override {
    const Source& source = sources_.at(variable.name);
    std::vector<std::string> names;
    if (source.column) {
      names = columns_[*source.column].names;
    } else {
      for (const std::size_t column : columns_of_table()) {
        names.push_back(columns_[column].name);
      }
    }
    return names;
  }

 private:
  static constexpr std::size_t kMostVariables = 10000;

  /// Column and episode of a variable.
  struct Source {
    std::optional<std::size_t> column;   ///< Empty for the table of all columns.
    std::optional<std::size_t> episode;  ///< Empty for all episodes.
  };
  /// An open file.
  struct OpenTable {
    std::size_t index = 0;
    ParquetFile table;
    std::vector<EpisodeRows> episodes;
  };

  [[nodiscard]] const OpenTable& open(std::size_t index) const {
    if (!open_ || open_->index != index) {
      open_.reset();
      ParquetFile table(parts_.files.at(index));
      std::vector<EpisodeRows> episodes = episode_rows(table, parts_.files.at(index));
      open_ = std::make_unique<OpenTable>(OpenTable{index, std::move(table), std::move(episodes)});
    }
    return *open_;
  }

  [[nodiscard]] std::vector<LeRobotEpisode> episodes_of_file() const {
    std::vector<LeRobotEpisode> episodes;
    for (const EpisodeRows& rows : open(0).episodes) {
      episodes.push_back({rows.episode, 0, rows.count});
    }
    return episodes;
  }

  /// Columns of the files, and pictures that are beside them.
  void find_columns(const ParquetFile& table, bool has_episodes) {
    constexpr std::array<std::string_view, 4> kIndices{kEpisodeColumn, "frame_index", "index",
                                                       "task_index"};
    for (const ParquetColumn& column : table.columns()) {
      if (!has_episodes || std::ranges::find(kIndices, column.name) == kIndices.end()) {
        columns_.push_back(frame_column(table, column, info_ ? info_->find(column.name) : nullptr));
      }
    }
    for (const LeRobotFeature& feature : info_ ? info_->features : std::vector<LeRobotFeature>{}) {
      if (!feature.has_numbers() && table.find(feature.name) == nullptr) {
        columns_.push_back({feature.name, feature.shape, feature.type, "pictures", {}});
      }
    }
  }

  void find_times(const ParquetFile& table, bool has_episodes) {
    for (const ParquetColumn& column : table.columns()) {
      const auto time = geometric::time_name(column.name);
      if (!time_column_ && column.problem.empty() && !column.has_lists() && time && time->plain &&
          time->kind == geometric::TimeName::Kind::kTime) {
        time_column_ = column.name;
        time_unit_ = has_episodes ? geometric::TimeUnit{1.0} : time->unit;
      }
    }
  }

  void list_variables(bool has_episodes) {
    std::size_t frames = 0;
    for (const LeRobotEpisode& episode : episodes_) {
      frames += episode.frames;
    }
    const std::size_t rows = has_episodes ? frames : open(0).table.rows();
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (episodes_.size() != 1 || !columns_[i].problem.empty()) {
        add_variable(columns_[i].name, i, {}, rows);
      }
    }
    if (const std::size_t count = columns_of_table().size(); !has_episodes && count > 0) {
      sources_.emplace(kTableVariable, Source{});
      variables_.push_back({kTableVariable, {rows, count}, "float64", ""});
    }
    for (std::size_t e = 0; e < episodes_.size(); ++e) {
      for (std::size_t i = 0; i < columns_.size() && variables_.size() < kMostVariables; ++i) {
        if (columns_[i].problem.empty()) {
          add_variable(fmt::format("episode_{}/{}", episodes_[e].number, columns_[i].name), i, e,
                       episodes_[e].frames);
        }
      }
    }
  }

  void add_variable(const std::string& name, std::size_t column, std::optional<std::size_t> episode,
                    std::size_t rows) {
    if (!sources_.emplace(name, Source{column, episode}).second) {
      return;  // the first of two columns with the same name is read
    }
    const FrameColumn& frame = columns_[column];
    RecordingVariable variable{name, {rows}, frame.type, frame.problem};
    variable.shape.insert(variable.shape.end(), frame.shape.begin(), frame.shape.end());
    variables_.push_back(std::move(variable));
  }

  /// The columns that make a table, if all columns are single numbers; without times.
  [[nodiscard]] std::vector<std::size_t> columns_of_table() const {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (!columns_[i].shape.empty()) {
        return {};
      }
      if (columns_[i].problem.empty() && columns_[i].name != time_column_) {
        chosen.push_back(i);
      }
    }
    return chosen;
  }

  [[nodiscard]] Series read(const RecordingVariable& variable) const override {
    const Source& source = sources_.at(variable.name);
    Frames frames;
    if (!source.column) {
      frames = read_table();
    } else if (source.episode) {
      const LeRobotEpisode& episode = episodes_[*source.episode];
      frames = read_rows(columns_[*source.column], episode.file, rows_of(episode));
    } else {
      frames = read_all(columns_[*source.column]);
    }
    Series series;
    series.values = std::move(frames.values);
    series.times = std::move(frames.times);
    series.time_unit = time_unit_;
    if (source.column && !source.episode && episodes_.size() > 1) {
      series.warnings.push_back(
          fmt::format("{} episodes one after the other: episode_{}/{} is the first alone",
                      episodes_.size(), episodes_.front().number, variable.name));
    }
    return series;
  }

  [[nodiscard]] const EpisodeRows& rows_of(const LeRobotEpisode& episode) const {
    const OpenTable& opened = open(episode.file);
    const auto rows = std::ranges::find(opened.episodes, episode.number, &EpisodeRows::episode);
    if (rows == opened.episodes.end()) {
      throw InputError({parts_.files[episode.file].string(),
                        fmt::format("column {}", kEpisodeColumn),
                        fmt::format("no rows of episode {}", episode.number),
                        fmt::format("{} by the list of episodes in meta", episode.frames),
                        "Download the data set again."});
    }
    return *rows;
  }

  [[nodiscard]] Eigen::MatrixXd numbers(const std::string& name, std::size_t width,
                                        std::size_t file, const EpisodeRows& rows) const {
    const ParquetFile& table = open(file).table;
    const ParquetColumn* column = table.find(name);
    if (column == nullptr) {
      throw InputError({parts_.files[file].string(), "column " + name, "no such column",
                        "the columns of the first file of the data set", ""});
    }
    return table.numbers(*column, width, rows.first, rows.count);
  }

  [[nodiscard]] Frames read_rows(const FrameColumn& column, std::size_t file,
                                 const EpisodeRows& rows) const {
    return {numbers(column.name, product_of(column.shape), file, rows), read_times(file, rows)};
  }

  [[nodiscard]] std::vector<double> read_times(std::size_t file, const EpisodeRows& rows) const {
    std::vector<double> times;
    if (time_column_) {
      const Eigen::MatrixXd read = numbers(*time_column_, 1, file, rows);
      times.assign(read.data(), read.data() + read.size());
    } else if (info_ && info_->rate > 0.0) {
      for (std::size_t row = 0; row < rows.count; ++row) {
        times.push_back(static_cast<double>(row) / info_->rate);
      }
    }
    return times;
  }

  [[nodiscard]] Frames read_table() const {
    const EpisodeRows rows{0, 0, open(0).table.rows()};
    Frames frames;
    std::vector<Eigen::MatrixXd> read;
    for (const std::size_t column : columns_of_table()) {
      read.push_back(numbers(columns_[column].name, 1, 0, rows));
    }
    frames.values.resize(static_cast<Eigen::Index>(rows.count), std::ssize(read));
    for (std::size_t i = 0; i < read.size(); ++i) {
      frames.values.col(static_cast<Eigen::Index>(i)) = read[i];
    }
    frames.times = read_times(0, rows);
    return frames;
  }

  /// All episodes, one after the other.
  [[nodiscard]] Frames read_all(const FrameColumn& column) const {
    std::vector<Frames> parts;
    Eigen::Index count = 0;
    for (std::size_t file = 0; file < parts_.files.size(); ++file) {
      const EpisodeRows all{0, 0, open(file).table.rows()};
      parts.push_back(read_rows(column, file, all));
      count += parts.back().values.rows();
      if (static_cast<std::size_t>(count) > kMostNumbers / product_of(column.shape)) {
        throw InputError({path().string(), "variable " + column.name,
                          "more numbers than can be read", fmt::format("{} at most", kMostNumbers),
                          "Choose an episode."});
      }
      for (const EpisodeRows& rows : open(file).episodes) {
        begin_after_last(parts, rows);
      }
    }
    return joined(parts, count, static_cast<Eigen::Index>(product_of(column.shape)));
  }

  /// Moves the times of an episode, which begin at 0, behind those of the one before.
  void begin_after_last(std::vector<Frames>& parts, const EpisodeRows& rows) const {
    std::vector<double>& times = parts.back().times;
    const std::vector<double>* before = rows.first > 0     ? &times
                                        : parts.size() > 1 ? &parts[parts.size() - 2].times
                                                           : nullptr;
    if (episodes_.empty() || times.empty() || before == nullptr) {
      return;
    }
    constexpr double kUsualStep = 0.02;  // s
    double step = rows.count > 1 ? times[rows.first + 1] - times[rows.first] : kUsualStep;
    step = info_ && info_->rate > 0.0 ? 1.0 / info_->rate : step;
    const std::size_t end = rows.first > 0 ? rows.first : before->size();
    const double begin = (end > 0 ? (*before)[end - 1] : 0.0) + step;
    const double shift = begin - times[rows.first];
    for (std::size_t row = rows.first; row < rows.first + rows.count; ++row) {
      times[row] += shift;
    }
  }

  static Frames joined(const std::vector<Frames>& parts, Eigen::Index rows, Eigen::Index columns) {
    Frames all;
    all.values.resize(rows, columns);
    Eigen::Index begin = 0;
    for (const Frames& part : parts) {
      all.values.middleRows(begin, part.values.rows()) = part.values;
      all.times.insert(all.times.end(), part.times.begin(), part.times.end());
      begin += part.values.rows();
    }
    return all;
  }

  DataSetFiles parts_;
  std::optional<LeRobotInfo> info_;
  std::vector<LeRobotEpisode> episodes_;
  std::vector<FrameColumn> columns_;
  std::map<std::string, Source> sources_;
  std::optional<std::string> time_column_;
  geometric::TimeUnit time_unit_;
  mutable std::unique_ptr<OpenTable> open_;
};

class LeRobotDataSets final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"LeRobot", "Episodes of a LeRobot data set (version 2 or 3), or a table in Parquet."};
  }
  [[nodiscard]] bool has_variables() const override { return true; }
  [[nodiscard]] bool recognises(const RecordingFile& file) const override {
    std::error_code error;
    const fs::path& path = file.path();
    return file.head().starts_with(kParquetMark) || geometric::has_extension(path, ".parquet") ||
           (path.filename() == "info.json" &&
            file.head().find("\"codebase_version\"") != std::string::npos) ||
           (fs::is_directory(path, error) && fs::exists(path / "meta" / "info.json", error));
  }
  [[nodiscard]] std::unique_ptr<ArrayFile> open(const RecordingFile& file) const override {
    return std::make_unique<LeRobotArrays>(file.path());
  }
  [[nodiscard]] Recording read(const RecordingFile& file) const override {
    return read_array_recording(*open(file), file.variable());
  }
};

}  // namespace

const RecordingFormat& lerobot_format() {
  static const LeRobotDataSets kFormat;
  return kFormat;
}

}  // namespace handway::device
