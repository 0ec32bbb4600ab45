#include "handway/planning/campaigns/campaign_reader.h"

#include "campaigns/parameter_values.h"
#include "campaigns/problem_files.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/nearest_name.h"
#include "handway/geometric/io/yaml_element.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace handway::planning {
namespace {

namespace fs = std::filesystem;
using geometric::YamlElement;

constexpr int kVersion = 1;
constexpr double kMostSeeds = 1e6;
constexpr double kLargestSeed = 9007199254740992.0;  // 2^53
constexpr std::size_t kMostPlanners = 10000;

/// The values that one parameter takes.
struct Axis {
  std::string key;
  std::vector<std::string> values;
};

std::vector<Axis> axes(const std::optional<YamlElement>& map, Planner& planner) {
  std::vector<Axis> result;
  if (!map) {
    return result;
  }
  const std::vector<Parameter> parameters = planner.parameters();
  for (const auto& [key, element] : map->entries()) {
    const auto found = std::ranges::find(parameters, key, &Parameter::key);
    if (found != parameters.end()) {
      const std::string before = to_text(*found);
      result.push_back({key, parameter_values(element, *found)});
      set_from_text(*found, before);
      continue;
    }
    std::vector<std::string> keys;
    std::ranges::transform(parameters, std::back_inserter(keys), &Parameter::key);
    element.refuse(fmt::format("the parameter \"{}\", which {} has not", key, planner.name()),
                   "one of its parameters", geometric::advise_name(key, keys));
  }
  return result;
}

class PlannerList {
 public:
  explicit PlannerList(const PlannerRegistry& registry) : registry_(registry) {}

  void add(const YamlElement& item);
  [[nodiscard]] std::vector<CampaignPlanner> take() { return std::move(planners_); }

 private:
  void add_grid(const YamlElement& item, const std::string& label, const std::string& name,
                const std::vector<Axis>& grid);
  void add_one(const YamlElement& item, CampaignPlanner entry, const ParameterTexts& settings);

  const PlannerRegistry& registry_;
  std::vector<CampaignPlanner> planners_;
};

void PlannerList::add(const YamlElement& item) {
  const bool is_map = item.is_map();
  if (is_map) {
    item.allow_keys({"planner", "label", "parameters", "vary"});
  }
  const YamlElement name = is_map ? item.need("planner") : item;
  if (std::ranges::count(registry_.names(), name.text()) == 0) {
    name.refuse("the unknown planner \"" + name.text() + "\"", "a planner",
                geometric::advise_name(name.text(), registry_.names()));
  }
  const std::optional<YamlElement> label = is_map ? item.find("label") : std::nullopt;
  const std::string label_text = label ? label->text() : name.text();
  const std::unique_ptr<Planner> planner = registry_.create(name.text());
  const std::optional<YamlElement> fixed = is_map ? item.find("parameters") : std::nullopt;
  const std::optional<YamlElement> varied = is_map ? item.find("vary") : std::nullopt;
  const std::vector<Axis> grid = axes(fixed, *planner);
  const std::vector<Axis> vary = axes(varied, *planner);
  add_grid(item, label_text, name.text(), grid);
  for (const Axis& axis : vary) {
    if (std::ranges::count(grid, axis.key, &Axis::key) != 0 &&
        std::ranges::find(grid, axis.key, &Axis::key)->values.size() > 1) {
      varied->need(axis.key).refuse("a parameter that has a list under \"parameters\" too",
                                    "each list in one place");
    }
    std::vector<Axis> with_axis = grid;
    std::erase_if(with_axis, [&](const Axis& other) { return other.key == axis.key; });
    with_axis.push_back({axis.key, {}});
    for (const std::string& value : axis.values) {
      with_axis.back().values = {value};
      add_grid(item, fmt::format("{} {}={}", label_text, axis.key, value), name.text(), with_axis);
    }
  }
}

void PlannerList::add_grid(const YamlElement& item, const std::string& label,
                           const std::string& name, const std::vector<Axis>& grid) {
  std::vector<std::size_t> at(grid.size(), 0);
  for (bool more = true; more;) {
    ParameterTexts settings;
    std::string full_label = label;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      settings.emplace_back(grid[i].key, grid[i].values[at[i]]);
      if (grid[i].values.size() > 1) {
        full_label += fmt::format(" {}={}", grid[i].key, grid[i].values[at[i]]);
      }
    }
    add_one(item, {full_label, name, {}}, settings);
    more = false;
    for (std::size_t i = grid.size(); i-- > 0 && !more;) {  // the last axis turns fastest
      more = ++at[i] < grid[i].values.size();
      at[i] = more ? at[i] : 0;
    }
  }
}

void PlannerList::add_one(const YamlElement& item, CampaignPlanner entry,
                          const ParameterTexts& settings) {
  const std::unique_ptr<Planner> planner =
      make_planner({entry.label, entry.planner, settings}, registry_);
  for (const Parameter& parameter : planner->parameters()) {
    entry.parameters.emplace_back(parameter.key, to_text(parameter));
  }
  if (std::ranges::any_of(planners_, [&](const CampaignPlanner& other) {
        return other.planner == entry.planner && other.parameters == entry.parameters;
      })) {
    return;
  }
  if (std::ranges::count(planners_, entry.label, &CampaignPlanner::label) != 0) {
    item.refuse(fmt::format("a second planner called \"{}\"", entry.label), "labels that differ",
                "Give it a \"label\" of its own");
  }
  if (planners_.size() == kMostPlanners) {
    item.refuse(fmt::format("more than {} combinations of parameters", kMostPlanners),
                "fewer values");
  }
  planners_.push_back(std::move(entry));
}

std::vector<CampaignPlanner> campaign_planners(const YamlElement& list,
                                               const PlannerRegistry& registry) {
  PlannerList planners(registry);
  for (const YamlElement& item : list.items()) {
    planners.add(item);
  }
  std::vector<CampaignPlanner> result = planners.take();
  if (result.empty()) {
    list.refuse("an empty list", "at least one planner");
  }
  return result;
}

std::uint64_t seed_of(const YamlElement& element) {
  return static_cast<std::uint64_t>(bounded_number(element, 0, kLargestSeed, true));
}

std::vector<std::uint64_t> campaign_seeds(const YamlElement& element) {
  std::vector<std::uint64_t> seeds;
  if (element.is_list()) {
    for (const YamlElement& item : element.items()) {
      const std::uint64_t seed = seed_of(item);
      if (std::ranges::count(seeds, seed) != 0) {
        item.refuse(fmt::format("the seed {} a second time", seed), "every seed once");
      }
      seeds.push_back(seed);
    }
    if (seeds.empty()) {
      element.refuse("an empty list", "at least one seed");
    }
    return seeds;
  }
  std::uint64_t first = 1;
  double count = 0.0;
  if (element.is_map()) {
    element.allow_keys({"first", "count"});
    const std::optional<YamlElement> own = element.find("first");
    first = own ? seed_of(*own) : first;
    count = bounded_number(element.need("count"), 1, kMostSeeds, true);
  } else {
    count = bounded_number(element, 1, kMostSeeds, true);
  }
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(count); ++i) {
    seeds.push_back(first + i);
  }
  return seeds;
}

}  // namespace

Campaign read_campaign(const fs::path& file, const PlannerRegistry& registry) {
  constexpr int kMostThreads = 1024;
  constexpr double kLongestRun = 1e6;
  const YamlElement top = YamlElement::read(file, "a campaign file");
  const YamlElement version = top.need("campaign");
  top.allow_keys({"campaign", "name", "description", "problems", "planners", "seeds", "threads",
                  "time_limit_s"});
  if (version.text() != fmt::format("{}", kVersion)) {
    version.refuse(version.found(), fmt::format("{}, the format's version", kVersion));
  }
  Campaign campaign;
  const std::optional<YamlElement> name = top.find("name");
  campaign.name = name ? name->text() : file.stem().string();
  if (const std::optional<YamlElement> description = top.find("description")) {
    campaign.description = description->text();
  }
  campaign.problems = campaign_problems(top.need("problems"), fs::absolute(file).parent_path());
  campaign.planners = campaign_planners(top.need("planners"), registry);
  campaign.seeds = campaign_seeds(top.need("seeds"));
  if (const std::optional<YamlElement> threads = top.find("threads")) {
    campaign.threads = static_cast<int>(bounded_number(*threads, 1, kMostThreads, true));
  }
  if (const std::optional<YamlElement> limit = top.find("time_limit_s")) {
    campaign.time_limit_s = bounded_number(*limit, 1e-3, kLongestRun, false);
  }
  return campaign;
}

bool is_campaign(const fs::path& file) {
  std::error_code error;
  if ((!geometric::has_extension(file, ".yaml") && !geometric::has_extension(file, ".yml")) ||
      !fs::is_regular_file(file, error)) {
    return false;
  }
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("campaign") && line.find_first_not_of(" \t", 8) != std::string::npos &&
        line[line.find_first_not_of(" \t", 8)] == ':') {
      return true;
    }
  }
  return false;
}

}  // namespace handway::planning
