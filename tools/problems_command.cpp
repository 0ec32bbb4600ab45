#include "campaign_command.h"
#include "commands.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/table_text.h"
#include "handway/geometric/io/text_file.h"
#include "numbers.h"
#include "on_all_cores.h"
#include "open_problems.h"
#include "printing.h"
#include "terminal.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;

struct ProblemsOptions {
  fs::path out;
  int count = 1000;
  std::uint64_t seed = 1;
  bool resume = false;
  int seeds = 1;               ///< Seeds of the campaign.
  double time_limit_s = 10.0;  ///< Time limit of a run of the campaign.
};

/// A problem in a file, or the reason why there is none.
struct WrittenProblem {
  planning::ProblemTags tags;
  std::string fault;
};

std::string number_text(int number) { return fmt::format("{:04}", number); }

fs::path file_of(const ProblemsOptions& options, int number) {
  return options.out / fmt::format("problem{}.yaml", number_text(number));
}

// The name of a problem's scene: its number, seed and tags.
std::string name_of(int number, std::uint64_t seed, const planning::ProblemTags& tags) {
  std::string name = fmt::format("Hands on arms {} of seed {}", number_text(number), seed);
  for (const auto& [key, value] : tags) {
    name += fmt::format(", {} {}", key, value);
  }
  return name;
}

// The tags in such a name; nothing for the name of another problem.
std::optional<planning::ProblemTags> tags_in(std::string_view name, int number,
                                             std::uint64_t seed) {
  const std::string begin = name_of(number, seed, {}) + ", ";
  if (!name.starts_with(begin)) {
    return std::nullopt;
  }
  planning::ProblemTags tags;
  for (const std::string_view part : geometric::cells(name.substr(begin.size()), ',')) {
    const std::size_t space = part.find(' ');
    if (space == std::string_view::npos) {
      return std::nullopt;
    }
    tags.emplace_back(part.substr(0, space), part.substr(space + 1));
  }
  return tags;
}

// The tags of a problem that was written before.
std::optional<planning::ProblemTags> written_before(const ProblemsOptions& options, int number) {
  constexpr std::string_view kKey = "name: ";
  const std::string head = geometric::head_of(file_of(options, number));
  for (const geometric::TextLine& line : geometric::text_lines(head)) {
    if (line.text.starts_with(kKey)) {
      return tags_in(geometric::trimmed(line.text.substr(kKey.size())), number, options.seed);
    }
  }
  return std::nullopt;
}

WrittenProblem write_problem(const OpenProblemGenerator& generator, const ProblemsOptions& options,
                             int number) {
  OpenProblem problem = generator.make(number);
  if (!problem.state.scene) {
    return {problem.tags,
            fmt::format("no start and goal that are free in {} scenes", problem.draws)};
  }
  geometric::Scene scene = *problem.state.scene;
  scene.name = name_of(number, options.seed, problem.tags);
  write_scene(scene, file_of(options, number));
  return {problem.tags, ""};
}

std::string campaign_text(const ProblemsOptions& options,
                          const std::vector<WrittenProblem>& problems) {
  std::string text = fmt::format(
      "campaign: 1\n"
      "name: Hands on arms\n"
      "description: Problems 1 to {} of the open benchmark for hands on arms, seed {}.\n"
      "seeds: {}\n"
      "time_limit_s: {:g}\n"
      "measure_motions: true\n"
      "planners: [auto, pmd-prm, rrt-connect, ompl-rrt-connect, ompl-bit-star]\n"
      "problems:\n",
      options.count, options.seed, options.seeds, options.time_limit_s);
  for (int number = 1; number <= options.count; ++number) {
    const WrittenProblem& problem = problems[static_cast<std::size_t>(number - 1)];
    if (!problem.fault.empty()) {
      continue;
    }
    std::string tags;
    for (const auto& [key, value] : problem.tags) {
      tags += fmt::format("{}{}: {}", tags.empty() ? "" : ", ", key, value);
    }
    text += fmt::format("  - {{name: \"{0}\", file: problem{0}.yaml, tags: {{{1}}}}}\n",
                        number_text(number), tags);
  }
  return text;
}

int write_problems(const ProblemsOptions& options) {
  make_out_folder(options.out);
  std::vector<WrittenProblem> problems(static_cast<std::size_t>(options.count));
  std::vector<int> missing;
  for (int number = 1; number <= options.count; ++number) {
    const auto before = options.resume ? written_before(options, number) : std::nullopt;
    if (before) {
      problems[static_cast<std::size_t>(number - 1)].tags = *before;
    } else {
      missing.push_back(number);
    }
  }
  std::stop_source stop;
  if (!missing.empty()) {
    const StopsOnInterrupt guard(stop);
    const OpenProblemGenerator generator(options.seed);
    on_all_cores(missing.size(), [&](std::size_t i) {
      if (!stop.stop_requested()) {
        problems[static_cast<std::size_t>(missing[i] - 1)] =
            write_problem(generator, options, missing[i]);
      }
    });
  }
  if (stop.stop_requested()) {
    print_error("handway: interrupted; continue with --resume\n");
    return kNoPath;
  }
  const fs::path campaign = options.out / "CAMPAIGN.yaml";
  geometric::replace_file(campaign, campaign_text(options, problems));
  int written = 0;
  for (int number = 1; number <= options.count; ++number) {
    const std::string& fault = problems[static_cast<std::size_t>(number - 1)].fault;
    written += fault.empty() ? 1 : 0;
    if (!fault.empty()) {
      print_error("handway: problem {} left out: {}\n", number_text(number), fault);
    }
  }
  print_out("{} problems in {}; run them with: handway bench {} --out DIR\n", written,
            options.out.string(), campaign.string());
  return kDone;
}

}  // namespace

void add_problems_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ProblemsOptions>();
  CLI::App* command = app.add_subcommand(
      "problems", "Generate the open benchmark for hands on arms: scenes and a campaign");
  command->add_option("--out", options->out, "Folder for the scenes and CAMPAIGN.yaml")->required();
  command->add_option("--count", options->count, "Number of problems")
      ->check(CLI::Range(1, 9999))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Seed of the problems")
      ->check(not_negative())
      ->capture_default_str();
  command
      ->add_option("--seeds", options->seeds,
                   "Runs of each planner on each problem in the campaign, with seeds from 1")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command
      ->add_option("--time-limit", options->time_limit_s,
                   "Seconds before a run of the campaign gives up")
      ->check(positive_number())
      ->capture_default_str();
  command->add_flag("--resume", options->resume,
                    "Keep the problems of this seed that are in --out");
  command->callback([options, &exit_code] { exit_code = write_problems(*options); });
}

}  // namespace handway::tools
