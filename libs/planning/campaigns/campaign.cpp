#include "handway/planning/campaigns/campaign.h"

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/parameter.h"
#include "handway/geometric/io/resources.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <system_error>

namespace handway::planning {

std::vector<RunSpec> Campaign::runs() const {
  std::vector<RunSpec> runs;
  runs.reserve(run_count());
  for (const std::uint64_t seed : seeds) {
    for (int problem = 0; problem < static_cast<int>(problems.size()); ++problem) {
      for (int planner = 0; planner < static_cast<int>(planners.size()); ++planner) {
        runs.push_back({problem, planner, seed});
      }
    }
  }
  return runs;
}

std::string CampaignProblem::tag(std::string_view key) const {
  const auto found = std::ranges::find(tags, key, &ProblemTags::value_type::first);
  return found == tags.end() ? std::string() : found->second;
}

CampaignPlanner default_entry(const std::string& planner, const PlannerRegistry& registry) {
  CampaignPlanner entry{planner, planner, {}};
  for (const geometric::Parameter& parameter : registry.create(planner)->parameters()) {
    entry.parameters.emplace_back(parameter.key, to_text(parameter));
  }
  return entry;
}

std::unique_ptr<Planner> make_planner(const CampaignPlanner& entry,
                                      const PlannerRegistry& registry) {
  std::unique_ptr<Planner> planner = registry.create(entry.planner);
  for (const auto& [key, value] : entry.parameters) {
    planner->set_parameter(key, value);
  }
  return planner;
}

namespace {

namespace fs = std::filesystem;
using geometric::InputError;
using geometric::YamlElement;

constexpr int kFormatVersion = 1;
constexpr double kMostSteps = 1000.0;
constexpr double kMostSeeds = 1e6;
constexpr double kLargestSeed = 9007199254740992.0;  // 2^53
constexpr std::size_t kMostPlanners = 10000;

/// The whole number or number that an element holds, within bounds.
/// @throws InputError naming the element.
double bounded_number(const YamlElement& element, double lower, double upper, bool whole) {
  const std::optional<double> value = geometric::parse_number(element.text());
  if (!value || *value < lower || *value > upper || (whole && *value != std::floor(*value))) {
    element.refuse(element.found(), fmt::format("a {}number from {:.12g} to {:.12g}",
                                                whole ? "whole " : "", lower, upper));
  }
  return *value;
}

std::string accepted(const YamlElement& element, geometric::Parameter parameter,
                     const std::string& text) {
  try {
    set_from_text(parameter, text);
  } catch (const InputError& error) {
    element.refuse(error.problem().found, error.problem().expected);
  }
  return to_text(parameter);
}

std::vector<double> range_values(const YamlElement& range) {
  constexpr double kMost = 1e12;
  range.allow_keys({"from", "to", "steps", "scale"});
  const double from = bounded_number(range.need("from"), -kMost, kMost, false);
  const double to = bounded_number(range.need("to"), -kMost, kMost, false);
  const int steps = static_cast<int>(bounded_number(range.need("steps"), 2, kMostSteps, true));
  const auto scale = range.find("scale");
  if (scale && scale->text() != "linear" && scale->text() != "log") {
    scale->refuse(scale->found(), "linear or log");
  }
  const bool logarithmic = scale && scale->text() == "log";
  if (logarithmic && (from <= 0.0 || to <= 0.0)) {
    range.refuse(fmt::format("a range from {:g} to {:g}", from, to),
                 "ends above 0 on a logarithmic scale");
  }
  std::vector<double> values;
  for (int i = 0; i < steps; ++i) {
    const double t = static_cast<double>(i) / (steps - 1);
    values.push_back(logarithmic ? from * std::pow(to / from, t) : from + (to - from) * t);
  }
  return values;
}

// Formats a value with six digits.
std::string range_text(const geometric::Parameter& parameter, double value) {
  if (std::holds_alternative<int>(parameter.value)) {
    return fmt::format("{:.0f}", std::round(value));
  }
  return fmt::format("{:.6g}", value);
}

/// The values that a campaign gives a parameter: one, a list, or a range `{from: A, to: B, steps:
/// N, scale: linear|log}` with both ends. Each is text that the parameter has accepted. In a
/// range of a whole-numbered parameter they are rounded, and equal ones are taken once. At least
/// one.
/// @throws InputError naming the element.
std::vector<std::string> parameter_values(const YamlElement& element,
                                          const geometric::Parameter& parameter) {
  std::vector<std::string> values;
  const auto add = [&](const YamlElement& source, const std::string& text) {
    const std::string value = accepted(source, parameter, text);
    if (std::ranges::count(values, value) == 0) {
      values.push_back(value);
    }
  };
  if (element.is_list()) {
    for (const YamlElement& item : element.items()) {
      add(item, item.text());
    }
    if (values.empty()) {
      element.refuse("an empty list", "at least one value");
    }
  } else if (element.is_map()) {
    for (const double value : range_values(element)) {
      add(element, range_text(parameter, value));
    }
  } else {
    add(element, element.text());
  }
  return values;
}

// File that a problem's name stands for, or the reason why it is missing.
struct Found {
  fs::path file;
  std::string fault;
  std::string advice;
};

Found with_environment(const std::string& text) {
  std::string result = text;
  for (std::size_t at = result.find("${"); at != std::string::npos; at = result.find("${", at)) {
    const std::size_t end = result.find('}', at);
    if (end == std::string::npos) {
      return {{}, fmt::format("\"{}\", a \"${{\" without \"}}\"", text), ""};
    }
    const std::string name = result.substr(at + 2, end - at - 2);
    const char* value = std::getenv(name.c_str());
    if (value == nullptr) {
      return {{}, fmt::format("${{{}}}, which is not set", name), "Set the variable " + name};
    }
    result.replace(at, end + 1 - at, value);
    at += std::string_view(value).size();
  }
  return {result, "", ""};
}

Found find_problem(const std::string& text, const fs::path& folder) {
  Found named = with_environment(text);
  if (!named.fault.empty()) {
    return named;
  }
  const fs::path scenes = geometric::resource_dir().parent_path() / "scenes";
  std::error_code error;
  for (const fs::path& file :
       {folder / named.file, scenes / named.file, scenes / (named.file.string() + ".yaml")}) {
    if (fs::is_regular_file(file, error)) {
      return {fs::absolute(file).lexically_normal(), "", ""};
    }
  }
  return {{},
          fmt::format("\"{}\", which is no file", named.file.string()),
          fmt::format("Looked in {} and {}", folder.string(), scenes.string())};
}

ProblemTags tags_in(const YamlElement& map) {
  ProblemTags tags;
  for (const auto& [key, value] : map.entries()) {
    tags.emplace_back(key, value.text());
  }
  return tags;
}

/// The problems under a campaign's key `problems`.
/// @param folder of the campaign's file.
/// @throws InputError naming the element of a missing problem.
std::vector<CampaignProblem> campaign_problems(const YamlElement& list, const fs::path& folder) {
  std::vector<CampaignProblem> problems;
  std::set<std::string> names;
  for (const YamlElement& item : list.items()) {
    const bool is_map = item.is_map();
    if (is_map) {
      item.allow_keys({"name", "file", "optional", "tags"});
    }
    const YamlElement file = is_map ? item.need("file") : item;
    const Found found = find_problem(file.text(), folder);
    if (!found.fault.empty()) {
      if (const auto optional = is_map ? item.find("optional") : std::nullopt;
          optional && optional->flag()) {
        continue;
      }
      file.refuse(found.fault, "a scene or problem file", found.advice);
    }
    const std::optional<YamlElement> own_name = is_map ? item.find("name") : std::nullopt;
    const std::string name = own_name ? own_name->text() : found.file.stem().string();
    if (!names.insert(name).second) {
      item.refuse(fmt::format("a second problem called \"{}\"", name), "different names",
                  "Give it a \"name\" of its own");
    }
    const std::optional<YamlElement> tags = is_map ? item.find("tags") : std::nullopt;
    problems.push_back({name, found.file, {}, tags ? tags_in(*tags) : ProblemTags{}});
  }
  if (problems.empty()) {
    list.refuse("no problem that exists", "at least one");
  }
  return problems;
}

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
  const std::vector<geometric::Parameter> parameters = planner.parameters();
  for (const auto& [key, element] : map->entries()) {
    if (const geometric::Parameter* found = parameter_called(parameters, key)) {
      result.push_back({key, parameter_values(element, *found)});
      continue;
    }
    std::vector<std::string> keys;
    std::ranges::transform(parameters, std::back_inserter(keys), &geometric::Parameter::key);
    element.refuse(fmt::format("\"{}\", which is no parameter of {}", key, planner.name()),
                   "one of its parameters", geometric::advise_name(key, keys));
  }
  return result;
}

/// The planners of a campaign: an entry for each combination of parameters.
class PlannerList {
 public:
  explicit PlannerList(const PlannerRegistry& registry) : registry_(registry) {}

  [[nodiscard]] const std::vector<CampaignPlanner>& planners() const { return planners_; }

  void add(const YamlElement& item) {
    const bool is_map = item.is_map();
    if (is_map) {
      item.allow_keys({"planner", "label", "parameters", "vary"});
    }
    const auto find = [&](const char* key) { return is_map ? item.find(key) : std::nullopt; };
    const YamlElement name = is_map ? item.need("planner") : item;
    if (std::ranges::count(registry_.names(), name.text()) == 0) {
      name.refuse("the unknown planner \"" + name.text() + "\"", "a planner",
                  geometric::advise_name(name.text(), registry_.names()));
    }
    const std::optional<YamlElement> label = find("label");
    const std::string label_text = label ? label->text() : name.text();
    const std::unique_ptr<Planner> planner = registry_.create(name.text());
    const std::optional<YamlElement> varied = find("vary");
    const std::vector<Axis> grid = axes(find("parameters"), *planner);
    const std::vector<Axis> vary = axes(varied, *planner);
    add_grid(item, {label_text, name.text(), {}}, grid);
    for (const Axis& axis : vary) {
      std::vector<Axis> others = grid;
      if (const auto fixed = std::ranges::find(others, axis.key, &Axis::key);
          fixed != others.end()) {
        if (fixed->values.size() > 1) {
          varied->need(axis.key).refuse("a parameter that also has a list under \"parameters\"",
                                        "each list in one place");
        }
        others.erase(fixed);
      }
      for (const std::string& value : axis.values) {
        add_grid(item,
                 {fmt::format("{} {}={}", label_text, axis.key, value),
                  name.text(),
                  {{axis.key, value}}},
                 others);
      }
    }
  }

 private:
  // @param entry with its parameters up to those of `axes`.
  void add_grid(const YamlElement& item, const CampaignPlanner& entry, std::span<const Axis> axes) {
    if (axes.empty()) {
      add_one(item, entry);
      return;
    }
    const Axis& axis = axes.front();
    for (const std::string& value : axis.values) {
      CampaignPlanner with = entry;
      with.parameters.emplace_back(axis.key, value);
      with.label += axis.values.size() > 1 ? fmt::format(" {}={}", axis.key, value) : "";
      add_grid(item, with, axes.subspan(1));
    }
  }

  // @param entry with its parameters that differ from the defaults.
  void add_one(const YamlElement& item, CampaignPlanner entry) {
    const std::unique_ptr<Planner> planner = make_planner(entry, registry_);
    entry.parameters.clear();
    for (const geometric::Parameter& parameter : planner->parameters()) {
      entry.parameters.emplace_back(parameter.key, to_text(parameter));
    }
    if (std::ranges::any_of(planners_, [&](const CampaignPlanner& other) {
          return other.planner == entry.planner && other.parameters == entry.parameters;
        })) {
      return;
    }
    if (std::ranges::count(planners_, entry.label, &CampaignPlanner::label) != 0) {
      item.refuse(fmt::format("a second planner called \"{}\"", entry.label), "different labels",
                  "Give it a \"label\" of its own");
    }
    if (planners_.size() == kMostPlanners) {
      item.refuse(fmt::format("more than {} combinations of parameters", kMostPlanners),
                  "fewer values");
    }
    planners_.push_back(std::move(entry));
  }

  const PlannerRegistry& registry_;
  std::vector<CampaignPlanner> planners_;
};

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
  const bool is_map = element.is_map();
  if (is_map) {
    element.allow_keys({"first", "count"});
  }
  const std::optional<YamlElement> own = is_map ? element.find("first") : std::nullopt;
  const std::uint64_t first = own ? seed_of(*own) : 1;
  const double count =
      bounded_number(is_map ? element.need("count") : element, 1, kMostSeeds, true);
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
                  "time_limit_s", "check_paths", "measure_motions", "skip_unreadable"});
  if (version.text() != fmt::format("{}", kFormatVersion)) {
    version.refuse(version.found(), fmt::format("{}, the format's version", kFormatVersion));
  }
  Campaign campaign;
  const std::optional<YamlElement> name = top.find("name");
  campaign.name = name ? name->text() : file.stem().string();
  if (const std::optional<YamlElement> description = top.find("description")) {
    campaign.description = description->text();
  }
  campaign.problems = campaign_problems(top.need("problems"), fs::absolute(file).parent_path());
  const YamlElement planners = top.need("planners");
  PlannerList list(registry);
  std::ranges::for_each(planners.items(), [&](const YamlElement& item) { list.add(item); });
  if (list.planners().empty()) {
    planners.refuse("an empty list", "at least one planner");
  }
  campaign.planners = list.planners();
  campaign.seeds = campaign_seeds(top.need("seeds"));
  if (const std::optional<YamlElement> threads = top.find("threads")) {
    campaign.threads = static_cast<int>(bounded_number(*threads, 1, kMostThreads, true));
  }
  if (const std::optional<YamlElement> limit = top.find("time_limit_s")) {
    campaign.time_limit_s = bounded_number(*limit, 1e-3, kLongestRun, false);
  }
  for (const auto& [key, flag] : {std::pair("check_paths", &campaign.check_paths),
                                  std::pair("measure_motions", &campaign.measure_motions),
                                  std::pair("skip_unreadable", &campaign.skip_unreadable)}) {
    const std::optional<YamlElement> element = top.find(key);
    *flag = element && element->flag();
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
