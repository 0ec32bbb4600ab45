#include "motion_bench_maker.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/table_text.h"
#include "handway/geometric/io/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <system_error>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kScene = "scene";

bool is_scene(const fs::path& file) {
  const std::string stem = file.stem().string();
  return file.extension() == ".yaml" && stem.starts_with(kScene) && stem.size() > kScene.size() &&
         std::ranges::all_of(stem.substr(kScene.size()),
                             [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::vector<fs::path> scenes_below(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> scenes;
  for (auto entry = fs::recursive_directory_iterator(
           folder, fs::directory_options::follow_directory_symlink, error);
       !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    if (is_scene(entry->path())) {
      scenes.push_back(entry->path());
    }
  }
  if (error || scenes.empty()) {
    throw geometric::InputError(
        {folder.string(), "--motionbenchmaker", error ? error.message() : "no scene0001.yaml",
         "a folder of sets of MotionBenchMaker: folders with scene0001.yaml and request0001.yaml",
         "Unpack its problems, for example bookshelf_small_panda"});
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

// Returns `robot_model_name` of a scene; "?" if it has none.
std::string robot_of(const fs::path& scene) {
  constexpr std::string_view kKey = "robot_model_name:";
  const std::string head = geometric::head_of(scene);
  for (const geometric::TextLine& line : geometric::text_lines(head)) {
    if (line.text.starts_with(kKey)) {
      return std::string(geometric::trimmed(line.text.substr(kKey.size())));
    }
  }
  return "?";
}

fs::path folder_of_set(const fs::path& scene) {
  return fs::absolute(scene).lexically_normal().parent_path();
}

// Returns the deepest folder that has all sets below it.
fs::path folder_of_sets(const std::vector<fs::path>& scenes) {
  fs::path common = folder_of_set(scenes.front()).parent_path();
  for (const fs::path& scene : scenes) {
    const fs::path set = folder_of_set(scene);
    while (*set.lexically_relative(common).begin() == ".." || set == common) {
      common = common.parent_path();
    }
  }
  return common;
}

planning::CampaignProblem problem_of(const fs::path& scene, const fs::path& folder) {
  const fs::path set = folder_of_set(scene).lexically_relative(folder);
  const std::string number = scene.stem().string().substr(kScene.size());
  return {fmt::format("{}/{}", set.generic_string(), number),
          fs::absolute(scene).lexically_normal(),
          {},
          {{"set", set.generic_string()}, {"robot", robot_of(scene)}}};
}

}  // namespace

planning::Campaign motion_bench_maker_campaign(const fs::path& folder,
                                               const std::vector<std::string>& planners,
                                               const planning::PlannerRegistry& registry) {
  planning::Campaign campaign;
  campaign.name = "MotionBenchMaker";
  campaign.description =
      "Problems of MotionBenchMaker (C. Chamzas et al., IEEE RA-L 7(2), 2022). Paths are certified "
      "on the meshes along their whole length.";
  campaign.skip_unreadable = true;
  const std::vector<fs::path> scenes = scenes_below(folder);
  const fs::path sets = folder_of_sets(scenes);
  for (const fs::path& scene : scenes) {
    campaign.problems.push_back(problem_of(scene, sets));
  }
  for (const std::string& planner :
       planners.empty() ? std::vector<std::string>{"auto", "rrt-connect", "ompl-rrt-connect"}
                        : planners) {
    campaign.planners.push_back(planning::default_entry(planner, registry));
  }
  return campaign;
}

}  // namespace handway::tools
