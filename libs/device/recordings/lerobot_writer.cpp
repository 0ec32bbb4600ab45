#include "handway/device/recordings/lerobot_writer.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/plural.h"
#include "handway/geometric/io/replace_file.h"
#include "recordings/frame_statistics.h"
#include "recordings/lerobot_episodes.h"
#include "recordings/numbered_tables.h"
#include "recordings/parquet_writer.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <system_error>
#include <utility>

namespace handway::device {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;
using DataSetJson = nlohmann::ordered_json;

constexpr const char* kStateFeature = "observation.state";
constexpr const char* kActionFeature = "action";
constexpr const char* kTimestamp = "timestamp";
constexpr std::size_t kEpisodesOfGroup = 100;

/// Removes the tables of an earlier data set, and the file by which it is found.
void remove_data_set(const fs::path& folder) {
  std::vector<fs::path> files = parquet_files_below(folder / "data");
  std::ranges::move(parquet_files_below(folder / "meta" / "episodes"), std::back_inserter(files));
  files.insert(files.begin(), folder / "meta" / "info.json");
  for (const fs::path& file : files) {
    std::error_code error;
    fs::remove(file, error);
    if (error) {
      throw geometric::OutputError({file.string(), "", error.message(),
                                    "a file that can be removed", "Choose another folder"});
    }
  }
}

/// A feature of the frames.
struct FrameFeature {
  std::string name;
  bool is_integer = false;
  std::vector<std::string> names;  ///< Names of its numbers; empty: a single one without a name.

  [[nodiscard]] std::size_t width() const { return std::max<std::size_t>(names.size(), 1); }
  [[nodiscard]] DataSetJson json() const {
    return {{"dtype", is_integer ? "int64" : "float32"},
            {"shape", DataSetJson::array({width()})},
            {"names", names.empty() ? DataSetJson() : DataSetJson(names)}};
  }
  [[nodiscard]] ParquetField field() const {
    return {name, is_integer ? ParquetType::kInt64 : ParquetType::kFloat, width() > 1};
  }
};

std::vector<FrameFeature> features_of(const LeRobotLayout& layout) {
  std::vector<FrameFeature> features{{kStateFeature, false, layout.joints},
                                     {kActionFeature, false, layout.joints}};
  for (const LeRobotColumns& other : layout.others) {
    features.push_back({other.feature, other.is_integer, other.columns});
  }
  features.push_back({kTimestamp, false, {}});
  for (const char* index : {"frame_index", kEpisodeColumn, "index", "task_index"}) {
    features.push_back({index, true, {}});
  }
  return features;
}

std::vector<ParquetField> frame_fields(const std::vector<FrameFeature>& features) {
  std::vector<ParquetField> fields;
  std::ranges::transform(features, std::back_inserter(fields), &FrameFeature::field);
  return fields;
}

/// Kinds of statistics and their values.
std::vector<std::pair<std::string, Eigen::RowVectorXd>> values_of_statistics(
    const FrameStatistics& statistics) {
  return {{"min", statistics.least()},
          {"max", statistics.most()},
          {"mean", statistics.mean()},
          {"std", statistics.deviation()},
          {"count", Eigen::RowVectorXd::Constant(1, static_cast<double>(statistics.count()))}};
}

constexpr const char* kCountStatistic = "count";

DataSetJson statistics_json(const FrameStatistics& statistics) {
  DataSetJson json;
  for (const auto& [kind, values] : values_of_statistics(statistics)) {
    if (kind == kCountStatistic) {
      json[kind] = DataSetJson::array({statistics.count()});
    } else {
      json[kind] = std::vector<double>(values.begin(), values.end());
    }
  }
  return json;
}

/// A row of the list of episodes.
struct EpisodeRow {
  std::int64_t episode = 0;
  std::string task;
  std::int64_t first = 0;  ///< Index of its first frame.
  std::int64_t length = 0;
  NumberedTables::Place place;
  std::vector<FrameStatistics> statistics;  ///< One for each feature.
};

std::vector<ParquetField> episode_fields(const std::vector<FrameFeature>& features) {
  using Type = ParquetType;
  std::vector<ParquetField> fields{
      {kEpisodeColumn, Type::kInt64},    {"tasks", Type::kByteArray, true},
      {"length", Type::kInt64},          {"data/chunk_index", Type::kInt64},
      {"data/file_index", Type::kInt64}, {"dataset_from_index", Type::kInt64},
      {"dataset_to_index", Type::kInt64}};
  for (const FrameFeature& feature : features) {
    for (const char* kind : {"min", "max", "mean", "std", kCountStatistic}) {
      const Type type = kind == std::string_view(kCountStatistic) ? Type::kInt64 : Type::kDouble;
      fields.push_back({fmt::format("stats/{}/{}", feature.name, kind), type, true});
    }
  }
  fields.push_back({"meta/episodes/chunk_index", Type::kInt64});
  fields.push_back({"meta/episodes/file_index", Type::kInt64});
  return fields;
}

/// One number for each row.
template <typename Rows, typename Number>
ParquetCells integer_cells(const Rows& rows, const Number& number) {
  Eigen::MatrixXd values(std::ssize(rows), 1);
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    values(i, 0) = static_cast<double>(number(rows[static_cast<std::size_t>(i)]));
  }
  return values;
}

/// Cells of a group of episodes, in the order of episode_fields().
/// @param place of the file with the group.
std::vector<ParquetCells> episode_cells(const std::vector<EpisodeRow>& rows,
                                        NumberedTables::Place place) {
  std::vector<std::string> tasks;
  std::ranges::transform(rows, std::back_inserter(tasks), &EpisodeRow::task);
  const auto cells_of = [&rows](const auto& number) { return integer_cells(rows, number); };
  std::vector<ParquetCells> cells{
      cells_of([](const EpisodeRow& row) { return row.episode; }),
      tasks,
      cells_of([](const EpisodeRow& row) { return row.length; }),
      cells_of([](const EpisodeRow& row) { return row.place.chunk; }),
      cells_of([](const EpisodeRow& row) { return row.place.file; }),
      cells_of([](const EpisodeRow& row) { return row.first; }),
      cells_of([](const EpisodeRow& row) { return row.first + row.length; })};
  for (std::size_t feature = 0; feature < rows.front().statistics.size(); ++feature) {
    const std::size_t begin = cells.size();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto values = values_of_statistics(rows[i].statistics[feature]);
      for (std::size_t kind = 0; kind < values.size(); ++kind) {
        if (i == 0) {
          cells.emplace_back(Eigen::MatrixXd(std::ssize(rows), values[kind].second.size()));
        }
        std::get<Eigen::MatrixXd>(cells[begin + kind]).row(static_cast<Eigen::Index>(i)) =
            values[kind].second;
      }
    }
  }
  cells.push_back(cells_of([place](const EpisodeRow&) { return place.chunk; }));
  cells.push_back(cells_of([place](const EpisodeRow&) { return place.file; }));
  return cells;
}

/// The description by which pandas makes the texts in `__index_level_0__` the index of the table.
std::string pandas_description() {
  constexpr const char* kIndexLevel = "__index_level_0__";
  const DataSetJson names = {{"name", nullptr},
                             {"field_name", nullptr},
                             {"pandas_type", "unicode"},
                             {"numpy_type", "object"},
                             {"metadata", {{"encoding", "UTF-8"}}}};
  const DataSetJson number = {{"name", "task_index"},
                              {"field_name", "task_index"},
                              {"pandas_type", "int64"},
                              {"numpy_type", "int64"},
                              {"metadata", nullptr}};
  const DataSetJson index = {{"name", nullptr},
                             {"field_name", kIndexLevel},
                             {"pandas_type", "unicode"},
                             {"numpy_type", "object"},
                             {"metadata", nullptr}};
  DataSetJson description;
  description["index_columns"] = DataSetJson::array({kIndexLevel});
  description["column_indexes"] = DataSetJson::array({names});
  description["columns"] = DataSetJson::array({number, index});
  description["pandas_version"] = "2.2.0";
  return description.dump();
}

/// The file meta/tasks.parquet. @param tasks in the order of their numbers.
std::string tasks_file(const std::vector<std::string>& tasks) {
  ParquetWriter writer(
      {{"task_index", ParquetType::kInt64}, {"__index_level_0__", ParquetType::kByteArray}});
  const auto last = static_cast<double>(tasks.size() - 1);
  writer.add_rows(
      {Eigen::MatrixXd(Eigen::VectorXd::LinSpaced(std::ssize(tasks), 0.0, last)), tasks});
  return writer.file({{"pandas", pandas_description()}});
}

std::string text_of_json(const DataSetJson& json) {
  return json.dump(4, ' ', false, DataSetJson::error_handler_t::replace) + "\n";
}

}  // namespace

/// The data set under construction.
class LeRobotWriter::Parts {
 public:
  Parts(fs::path folder, LeRobotLayout layout)
      : folder_(std::move(folder)),
        layout_(std::move(layout)),
        features_(features_of(layout_)),
        frames_(folder_ / "data", frame_fields(features_)),
        episodes_(folder_ / "meta" / "episodes", episode_fields(features_)),
        statistics_(features_.size()) {
    remove_data_set(folder_);
    std::error_code ignored;
    fs::create_directories(folder_ / "meta", ignored);
  }

  void add(const RecordedTable& table, const std::string& task, const std::string& source) {
    check_times(table, source);
    EpisodeRow row{episode_count_, task, frame_count_, table.values.rows(), {}, {}};
    std::vector<ParquetCells> cells;
    for (Eigen::MatrixXd& values : values_of(table, task, source)) {
      row.statistics.emplace_back(values);
      statistics_[cells.size()].merge(row.statistics.back());
      cells.emplace_back(std::move(values));
    }
    row.place = frames_.next_place();
    frames_.add_rows(cells);
    ++episode_count_;
    frame_count_ += row.length;
    rows_.push_back(std::move(row));
    if (rows_.size() == kEpisodesOfGroup) {
      add_episodes();
    }
  }

  void finish() {
    frames_.close();
    if (!rows_.empty()) {
      add_episodes();
    }
    episodes_.close();
    geometric::replace_file(folder_ / "meta" / "tasks.parquet", tasks_file(tasks_));
    DataSetJson statistics;
    for (std::size_t i = 0; i < features_.size(); ++i) {
      statistics[features_[i].name] = statistics_json(statistics_[i]);
    }
    geometric::replace_file(folder_ / "meta" / "stats.json", text_of_json(statistics));
    geometric::replace_file(folder_ / "meta" / "info.json", text_of_json(info()));
  }

 private:
  void check_times(const RecordedTable& table, const std::string& source) const {
    constexpr double kTolerance = 0.1;  // of a period
    if (table.values.rows() == 0) {
      throw InputError({source, "", "no frame", "at least one", ""});
    }
    for (Eigen::Index row = 0; row < table.times.size(); ++row) {
      const double frames = (table.times[row] - table.times[0]) * layout_.fps;
      if (!(std::abs(frames - static_cast<double>(row)) <= kTolerance)) {
        throw InputError({source, "time", fmt::format("row {} at {:g} s", row, table.times[row]),
                          fmt::format("{} frames per second", layout_.fps), ""});
      }
    }
  }

  [[nodiscard]] static Eigen::MatrixXd columns_of(const RecordedTable& table,
                                                  const std::vector<std::string>& names,
                                                  const std::string& source) {
    Eigen::MatrixXd values(table.values.rows(), std::ssize(names));
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto found = std::ranges::find(table.names, names[i]);
      if (found == table.names.end()) {
        throw InputError({source, "", "no column " + names[i], "the columns of the other episodes",
                          "Make the data set again"});
      }
      values.col(static_cast<Eigen::Index>(i)) = table.values.col(found - table.names.begin());
    }
    return values;
  }

  /// Values of all features.
  std::vector<Eigen::MatrixXd> values_of(const RecordedTable& table, const std::string& task,
                                         const std::string& source) {
    const Eigen::Index rows = table.values.rows();
    const Eigen::MatrixXd state = columns_of(table, layout_.joints, source);
    Eigen::MatrixXd action = state;
    action.topRows(rows - 1) = state.bottomRows(rows - 1);
    std::vector<Eigen::MatrixXd> values{state, action};
    for (const LeRobotColumns& other : layout_.others) {
      values.push_back(columns_of(table, other.columns, source));
    }
    const auto number_of_last = static_cast<double>(rows - 1);
    const Eigen::VectorXd frames = Eigen::VectorXd::LinSpaced(rows, 0.0, number_of_last);
    values.emplace_back(frames / layout_.fps);
    values.emplace_back(frames);
    values.emplace_back(Eigen::VectorXd::Constant(rows, static_cast<double>(episode_count_)));
    values.emplace_back(frames.array() + static_cast<double>(frame_count_));
    values.emplace_back(Eigen::VectorXd::Constant(rows, static_cast<double>(number_of(task))));
    return values;
  }

  std::size_t number_of(const std::string& task) {
    const auto [found, is_new] = task_numbers_.emplace(task, tasks_.size());
    if (is_new) {
      tasks_.push_back(task);
    }
    return found->second;
  }

  void add_episodes() {
    const NumberedTables::Place place = episodes_.next_place();
    episodes_.add_rows(episode_cells(rows_, place));
    rows_.clear();
  }

  [[nodiscard]] DataSetJson info() const {
    DataSetJson features;
    for (const FrameFeature& feature : features_) {
      features[feature.name] = feature.json();
    }
    return {{"codebase_version", "v3.0"},
            {"robot_type", layout_.robot},
            {"total_episodes", episode_count_},
            {"total_frames", frame_count_},
            {"total_tasks", tasks_.size()},
            {"chunks_size", kFilesOfChunk},
            {"data_files_size_in_mb", kTableFileSize},
            {"video_files_size_in_mb", 200},
            {"fps", layout_.fps},
            {"splits", {{"train", fmt::format("0:{}", episode_count_)}}},
            {"data_path", "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet"},
            {"video_path", nullptr},
            {"features", features}};
  }

  fs::path folder_;
  LeRobotLayout layout_;
  std::vector<FrameFeature> features_;
  NumberedTables frames_;
  NumberedTables episodes_;
  std::vector<EpisodeRow> rows_;             ///< Episodes that are not in `episodes_` yet.
  std::vector<FrameStatistics> statistics_;  ///< One for each feature.
  std::vector<std::string> tasks_;
  std::map<std::string, std::size_t> task_numbers_;
  std::int64_t episode_count_ = 0;
  std::int64_t frame_count_ = 0;
};

LeRobotWriter::LeRobotWriter(fs::path folder, LeRobotLayout layout)
    : parts_(std::make_unique<Parts>(std::move(folder), std::move(layout))) {}

LeRobotWriter::~LeRobotWriter() = default;

void LeRobotWriter::add(const RecordedTable& episode, const std::string& task,
                        const std::string& source) {
  parts_->add(episode, task, source);
}

void LeRobotWriter::finish() { parts_->finish(); }

}  // namespace handway::device
