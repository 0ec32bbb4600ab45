#include "campaign_command.h"
#include "campaign_report.h"
#include "commands.h"
#include "handway/geometric/io/resources.h"
#include "handway/planning/campaigns/campaign.h"
#include "printing.h"
#include "reproduce_report.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;

struct ReproduceOptions {
  std::vector<int> tables;
  std::vector<int> figures;
  bool quick = false;
  int runs = 0;  ///< 0: as many as the paper.
  int jobs = 0;
  fs::path out = "reproduce";
  bool resume = false;
};

/// A campaign that ships, with its table.
struct Part {
  int table;
  const char* name;
  const char* published = nullptr;  ///< Its published file, if it is about a single one.
  bool beside_the_paper = false;    ///< At most the runs of its file.
};
constexpr const char* kShelfT2 = "auro/TX90_RHand_ICRA10_5PMD-shelfT2_new.xml";
constexpr std::array<Part, 4> kParts = {{{2, "paper_table_2"},
                                         {4, "paper_table_4"},
                                         {4, "file_shelf_t2", kShelfT2},
                                         {4, "file_shelf_t2_auto", kShelfT2, true}}};

bool has_problems(const Part& part) {
  if (part.published == nullptr) {
    return true;
  }
  const char* reference = std::getenv("HANDWAY_REFERENCE_DIR");
  return reference != nullptr && fs::exists(fs::path(reference) / part.published);
}

// Leaves the scenes that ship: a preview has no time for the authors' files.
void leave_out_files(planning::Campaign& campaign) {
  std::erase_if(campaign.problems, [](const planning::CampaignProblem& problem) {
    return problem.name.find("file ") != std::string::npos;
  });
}

void take_runs(planning::Campaign& campaign, const Part& part, const ReproduceOptions& options) {
  constexpr std::size_t kQuickRuns = 3;
  constexpr double kQuickLimit = 0.5;  // s
  std::size_t runs = campaign.seeds.size();
  if (options.quick) {
    leave_out_files(campaign);
    runs = kQuickRuns;
    campaign.time_limit_s = kQuickLimit;
  }
  if (options.runs > 0) {
    const auto asked = static_cast<std::size_t>(options.runs);
    runs = part.beside_the_paper ? std::min(asked, campaign.seeds.size()) : asked;
  }
  campaign.seeds.clear();
  for (std::size_t seed = 1; seed <= runs; ++seed) {
    campaign.seeds.push_back(seed);
  }
}

std::set<int> asked_tables(const ReproduceOptions& options) {
  return options.tables.empty() && options.figures.empty()
             ? std::set{2, 3, 4}
             : std::set<int>(options.tables.begin(), options.tables.end());
}

std::set<int> asked_figures(const ReproduceOptions& options) {
  return options.tables.empty() && options.figures.empty()
             ? reproducible_figures()
             : std::set<int>(options.figures.begin(), options.figures.end());
}

int reproduce(const ReproduceOptions& options, planning::ProcessTeam* team) {
  const auto begin = std::chrono::steady_clock::now();
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  const std::set<int> tables = asked_tables(options);
  std::vector<ReproducedCampaign> done;
  for (const Part& part : kParts) {
    const bool read_only = part.table == 2 && !tables.contains(2) && tables.contains(3);
    const bool left_out = options.quick && part.published != nullptr;
    if ((!tables.contains(part.table) && !read_only) || !has_problems(part) || left_out) {
      continue;
    }
    const fs::path file =
        geometric::resource_dir() / "campaigns" / fmt::format("{}.yaml", part.name);
    planning::Campaign campaign = planning::read_campaign(file, plugins.planners());
    take_runs(campaign, part, options);
    if (read_only) {
      done.push_back({part.table, std::move(campaign), {}});
      continue;
    }
    CampaignSession session;
    session.folder = options.out / part.name;
    session.resume = options.resume;
    session.jobs = options.jobs;
    std::optional<CampaignOutcome> outcome = conduct_campaign(campaign, plugins, session, team);
    if (!outcome) {
      continue;
    }
    write_campaign_report(campaign, *outcome, session.folder);
    const bool complete = outcome->complete;
    done.push_back({part.table, std::move(campaign), std::move(*outcome)});
    if (!complete) {
      break;
    }
  }
  if (team != nullptr && !team->leads()) {
    return kDone;
  }
  make_out_folder(options.out);
  const bool interrupted =
      tables != std::set{3} && std::ranges::any_of(done, [&](const ReproducedCampaign& part) {
        return tables.contains(part.table) && !part.outcome.complete;
      });
  constexpr double kFigureLimit = 60.0;  // s, of each path
  constexpr double kQuickFigureLimit = 8.0;
  const std::vector<ReproducedFigure> figures = reproduce_figures(
      interrupted ? std::set<int>{} : asked_figures(options), plugins,
      options.quick ? kQuickFigureLimit : kFigureLimit, options.quick, options.out);
  const double elapsed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  write_reproduce_report(tables, done, figures,
                         options.quick ? std::optional(elapsed) : std::nullopt, options.out);
  print_out("report in {}\n", (options.out / "report.html").string());
  if (interrupted) {
    print_error("handway: interrupted; continue with --resume\n");
  }
  return interrupted ? kNoPath : kDone;
}

}  // namespace

void add_reproduce_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ReproduceOptions>();
  CLI::App* command =
      app.add_subcommand("reproduce", "Reproduce the tables and figures of the paper");
  command->add_option("--table", options->tables, "Table 2, 3 or 4 (default: all)")
      ->check(CLI::IsMember({2, 3, 4}))
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--figure", options->figures, "Figure 7 to 17 (default: all)")
      ->check(CLI::IsMember(reproducible_figures()))
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_flag("--quick", options->quick, "Preview within a minute: a few short runs");
  command->add_option("--runs", options->runs, "Runs of each planner on each problem")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--jobs", options->jobs, "Simultaneous runs (default: one per core)")
      ->check(CLI::Range(1, 1024));
  command->add_option("--out", options->out, "Folder for runs and reports")->capture_default_str();
  command->add_flag("--resume", options->resume, "Continue with the runs that are in --out");
  command->callback([options, &exit_code] {
    exit_code = run_in_team([&](planning::ProcessTeam* team) { return reproduce(*options, team); });
  });
}

}  // namespace handway::tools
