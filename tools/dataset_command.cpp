#include "commands.h"
#include "dataset_card.h"
#include "dataset_episode.h"
#include "dataset_lerobot.h"
#include "dataset_objects.h"
#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/timing/timing_settings.h"
#include "motion_sending.h"
#include "parameter_options.h"
#include "printing.h"
#include "task_request.h"
#include "terminal.h"
#include "version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kListName = "episodes.jsonl";
constexpr const char* kSettingsName = "dataset.json";
constexpr const char* kLeRobotFormat = "lerobot";
constexpr std::chrono::seconds kReportPeriod(5);

struct DatasetCommand {
  TaskRequest request;
  planning::TimingSettings timing;
  SceneVariation variation;
  fs::path objects;  ///< File of objects; empty: the picked one alone.
  int episodes = 100;
  int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::string format = "npz";
  fs::path out;
  bool resume = false;
};

bool is_lerobot(const DatasetCommand& command) { return command.format == kLeRobotFormat; }

// File of an episode in the folder of the data set.
std::string file_of(const DatasetCommand& command, int episode) {
  return is_lerobot(command) ? fmt::format("{}/episode_{:06}.npz", kEpisodeFolder, episode)
                             : fmt::format("episode_{:06}.{}", episode, command.format);
}

// All that episodes depend on: a data set is only continued with the same.
Json settings_of(DatasetCommand& command, const LoadedTask& loaded) {
  Json steps = Json::array();
  for (const planning::TaskStep& step : loaded.task) {
    steps.push_back(to_string(step));
  }
  Json files = Json::array();
  for (const SeenFile& file : loaded.files) {
    files.push_back({{"name", file.file.filename().string()}, {"digest", file.digest}});
  }
  Json values = Json::object();
  const auto add = [&values](const std::vector<geometric::BoundParameter>& parameters) {
    for (const geometric::Parameter& parameter : geometric::values_of(parameters)) {
      values[parameter.key] = to_text(parameter);
    }
  };
  add(planning::parameters_of(command.request.options));
  add(planning::parameters_of(command.timing));
  add(parameters_of(command.variation));
  Json settings = {{"scene", loaded.state.scene->name},
                   {"robot", loaded.state.scene->robots.front().model->name()},
                   {"steps", steps},
                   {"seed", command.request.options.seed},
                   {"planner", command.request.planner},
                   {"planner_settings", command.request.settings},
                   {"group", command.request.group},
                   {"format", command.format},
                   {"settings", values},
                   {"files", files},
                   {"version", kVersion}};
  if (!command.variation.objects.empty()) {
    settings["objects"] = objects_json(command.variation.objects);
  }
  return settings;
}

// Reads the objects of which each motion uses one.
void load_objects(DatasetCommand& command, LoadedTask& loaded) {
  if (command.objects.empty()) {
    return;
  }
  const geometric::FilesRead notes;
  command.variation.objects =
      planning::read_object_choices(command.objects, *loaded.state.scene, loaded.task);
  std::ranges::move(see_files(notes.files()), std::back_inserter(loaded.files));
}

// Words for the steps of an episode, with the name of the drawn object.
Json steps_of_episode(const Episode& episode, const DatasetCommand& command) {
  const std::string name = command.variation.objects[episode.drawn->choice].name;
  const planning::Task task =
      with_picked_object(episode.task, picked_objects(episode.task).front(), name);
  Json steps = Json::array();
  for (const planning::TaskStep& step : task) {
    steps.push_back(to_string(step));
  }
  return steps;
}

Json entry_of(const Episode& episode, int index, const DatasetCommand& command) {
  Json entry = {{"episode", index},
                {"seed", episode.seed},
                {"solved", episode.reason.empty()},
                {"reason", episode.reason},
                {"planned_in_s", episode.plan.time_s}};
  if (episode.drawn) {
    entry["object"] = drawn_json(command.variation.objects, episode);
    entry["steps"] = steps_of_episode(episode, command);
  }
  if (!episode.reason.empty()) {
    return entry;
  }
  const planning::Motion& motion = episode.timed.motion;
  entry["file"] = file_of(command, index);
  entry["duration_s"] = motion.trajectory.duration();
  entry["frames"] = motion.trajectory.points.size();
  entry["min_clearance_mm"] =
      geometric::millimetres(whole_task(episode.timed).preflight.min_clearance);
  Json stages = Json::array();
  for (std::size_t i = 0; i < motion.stages.size(); ++i) {
    stages.push_back({{"stage", motion.stages[i].name},
                      {"step", motion.stages[i].step},
                      {"begin_s", motion.waypoint_times[motion.stages[i].first]},
                      {"carried", episode.plan.stages[i].carried}});
  }
  entry["stages"] = stages;
  return entry;
}

// The episodes that a folder has, by number. A last line that a killed program has left incomplete
// does not count, nor does an episode whose file is gone.
std::map<int, Json> read_entries(const fs::path& folder) {
  std::map<int, Json> entries;
  std::ifstream list(folder / kListName);
  for (std::string line; std::getline(list, line);) {
    const Json entry = Json::parse(line, nullptr, false);
    const bool is_entry =
        entry.is_object() && entry.contains("episode") && entry["episode"].is_number_integer();
    if (is_entry &&
        (!entry.value("solved", false) || fs::exists(folder / entry.value("file", "none")))) {
      entries[entry["episode"].get<int>()] = entry;
    }
  }
  return entries;
}

std::string text_of(const std::map<int, Json>& entries) {
  std::string text;
  for (const auto& [index, entry] : entries) {
    text += entry.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  }
  return text;
}

/// A folder with episodes, which grows one by one.
class DatasetFolder {
 public:
  /// @throws InputError if the folder has a data set that this one does not continue.
  DatasetFolder(const DatasetCommand& command, Json settings)
      : folder_(command.out), settings_(std::move(settings)) {
    std::error_code ignored;
    fs::create_directories(is_lerobot(command) ? folder_ / kEpisodeFolder : folder_, ignored);
    const fs::path file = folder_ / kSettingsName;
    if (!fs::exists(file)) {
      geometric::replace_file(file, settings_.dump(2) + "\n");
    } else if (!command.resume) {
      refuse("a data set", "a folder without one", "Add --resume, or choose another folder");
    } else if (Json::parse(geometric::read_text_file(file, "settings of a data set"), nullptr,
                           false) != settings_) {
      refuse("a data set of another scene or of other settings", "the same",
             "Choose another folder");
    }
    entries_ = read_entries(folder_);
    geometric::replace_file(folder_ / kListName, text_of(entries_));  // without incomplete lines
    list_.open(folder_ / kListName, std::ios::app);
  }

  [[nodiscard]] const std::map<int, Json>& entries() const { return entries_; }
  [[nodiscard]] const fs::path& path() const { return folder_; }
  [[nodiscard]] const Json& settings() const { return settings_; }

  /// Adds a finished episode, whose file is written. @throws OutputError if the list can't grow.
  void add(int index, const Json& entry) {
    list_ << entry.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n';
    list_.flush();
    if (!list_) {
      throw geometric::OutputError({(folder_ / kListName).string(), "", "no room, or no permission",
                                    "a file that can be written", "Look at the disk"});
    }
    entries_[index] = entry;
  }
  /// Sorts the list by episodes and writes the data card.
  void finish() {
    list_.close();
    geometric::replace_file(folder_ / kListName, text_of(entries_));
    geometric::replace_file(folder_ / "README.md", data_card(settings_, entries_));
  }

 private:
  [[noreturn]] void refuse(const char* found, const char* expected, const char* advice) const {
    throw geometric::InputError({folder_.string(), "--out", found, expected, advice});
  }

  fs::path folder_;
  Json settings_;
  std::map<int, Json> entries_;
  std::ofstream list_;
};

/// Makes the episodes that a folder lacks, on several threads.
class EpisodeWork {
 public:
  EpisodeWork(const DatasetCommand& command, const LoadedTask& loaded,
              const planning::PluginManager& plugins, DatasetFolder& folder, std::stop_source& stop)
      : command_(command),
        loaded_(loaded),
        plugins_(plugins),
        folder_(folder),
        stop_(stop),
        timing_(timing_options(command.timing, *loaded.state.scene->robots.front().model)) {
    for (int i = 0; i < command.episodes; ++i) {
      if (!folder.entries().contains(i)) {
        missing_.push_back(i);
      }
    }
  }

  /// @throws exceptions of an episode, once no thread works any more.
  void run() {
    {
      std::vector<std::jthread> threads;
      threads.reserve(static_cast<std::size_t>(command_.jobs));
      for (int i = 0; i < command_.jobs; ++i) {
        threads.emplace_back([this] { work(); });
      }
    }
    if (error_) {
      std::rethrow_exception(error_);
    }
  }

 private:
  void work() {
    try {
      for (std::size_t i = next_++; i < missing_.size() && !stop_.stop_requested(); i = next_++) {
        make(missing_[i]);
      }
    } catch (const geometric::PreparationStopped&) {
      // The episode that was under way is made when the data set is continued.
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      error_ = error_ ? error_ : std::current_exception();
      stop_.request_stop();
    }
  }

  void make(int index) {
    const std::uint64_t seed = command_.request.options.seed + static_cast<std::uint64_t>(index);
    const Episode episode = make_episode(loaded_, command_.request, plugins_, timing_,
                                         command_.variation, seed, stop_.get_token());
    if (stop_.stop_requested()) {
      return;
    }
    if (episode.reason.empty()) {
      write_recorded_table(table_of(episode), folder_.path() / file_of(command_, index));
    }
    const std::scoped_lock lock(mutex_);
    folder_.add(index, entry_of(episode, index, command_));
    if (const auto now = std::chrono::steady_clock::now(); now >= report_) {
      report_ = now + kReportPeriod;
      print_line(fmt::format("{} of {} episodes", folder_.entries().size(), command_.episodes));
    }
  }

  const DatasetCommand& command_;
  const LoadedTask& loaded_;
  const planning::PluginManager& plugins_;
  DatasetFolder& folder_;
  std::stop_source& stop_;
  planning::TimingOptions timing_;
  std::vector<int> missing_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;  // guards the folder and what follows
  std::exception_ptr error_;
  std::chrono::steady_clock::time_point report_ = std::chrono::steady_clock::now() + kReportPeriod;
};

int make_dataset(DatasetCommand& command) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  LoadedTask loaded = load_requested(command.request, plugins);
  load_objects(command, loaded);
  const int fps = is_lerobot(command) ? frames_per_second(command.timing.period) : 0;
  DatasetFolder folder(command, settings_of(command, loaded));
  std::stop_source stop;
  const StopsOnInterrupt guard(stop);
  EpisodeWork(command, loaded, plugins, folder, stop).run();
  folder.finish();
  if (is_lerobot(command)) {
    write_lerobot_dataset(folder.path(), folder.settings(), folder.entries(), fps);
  }
  const auto solved = std::ranges::count_if(
      folder.entries(), [](const auto& entry) { return entry.second.value("solved", false); });
  print_out("{} episodes, {} with a motion: {}\n", folder.entries().size(), solved,
            folder.path().string());
  if (stop.stop_requested()) {
    print_error("handway: interrupted; continue with --resume\n");
    return kNoPath;
  }
  return solved > 0 ? kDone : kNoPath;
}

}  // namespace

void add_dataset_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<DatasetCommand>();
  command->timing.period = kPointPeriod;
  CLI::App* dataset = app.add_subcommand(
      "dataset", "Make a data set of motions that carry out a task in varied scenes");
  add_task_request(*dataset, command->request);
  dataset->add_option("--out", command->out, "Folder of the data set")->required();
  dataset->add_option("--objects", command->objects,
                      "File (YAML) with objects and ranges of sizes, of which each motion uses one "
                      "in place of the picked object");
  dataset->add_option("--episodes", command->episodes, "Number of episodes")
      ->check(CLI::Range(1, 10'000'000))
      ->capture_default_str();
  dataset->add_option("--format", command->format, "Format of the files")
      ->check(CLI::IsMember({"npz", "h5", "csv", "mcap", "parquet", kLeRobotFormat}))
      ->capture_default_str();
  dataset->add_option("--jobs", command->jobs, "Episodes at a time (default: one per core)")
      ->check(CLI::Range(1, 1024));
  dataset->add_flag("--resume", command->resume, "Continue with the episodes that are in --out");
  add_parameter_options(*dataset, parameters_of(command->variation));
  add_parameter_options(*dataset, parameters_of(command->timing));
  dataset->get_option("--no-blend")->excludes(dataset->get_option("--deviation"));
  dataset->callback([command, &exit_code] { exit_code = make_dataset(*command); });
}

}  // namespace handway::tools
