#include "paper_tables.h"

#include <fmt/format.h>

#include <limits>
#include <numeric>

namespace handway::tools {
namespace {

using planning::RunRecord;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double number(std::uint64_t count) { return static_cast<double>(count); }

// The share, in %, of the roadmap's sampled nodes that were drawn with `count` PMDs.
double share_with_pmds(const RunRecord& run, std::size_t count) {
  if (run.nodes_per_pmds.size() < 2) {
    return kNone;
  }
  const double all =
      number(std::accumulate(run.nodes_per_pmds.begin() + 1, run.nodes_per_pmds.end(), 0UL));
  const std::uint64_t some = count < run.nodes_per_pmds.size() ? run.nodes_per_pmds[count] : 0;
  return all > 0.0 ? 100.0 * number(some) / all : kNone;
}

}  // namespace

std::vector<PaperRow> paper_table_2() {
  std::vector<PaperRow> rows = {
      {"Time to find a solution [s]", {10.39, 915.28}, [](const RunRecord& r) { return r.time_s; }},
      {"Smoothing time [s]", {0.096, 15.20}, [](const RunRecord& r) { return r.smoothing_s; }},
      {"Final neighboring threshold (rho_a)",
       {0.0013, 0.0631},
       [](const RunRecord& r) { return r.final_rho_a; }},
      {"Maximum num. of trials (j x h loops)",
       {22.55, 270.44},
       [](const RunRecord& r) { return number(r.max_trials); }},
      {"Total num. of samples (numSamples)",
       {698.82, 7274.78},
       [](const RunRecord& r) { return number(r.samples); }},
      {"Total num. of nodes in the PRM",
       {29.18, 567.22},
       [](const RunRecord& r) { return number(r.nodes); }},
  };
  constexpr std::array<double, 4> kShares = {22.4, 26.5, 16.5, 34.7};
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    rows.push_back({fmt::format("% of PRM nodes with thumb-base + {} PMDs", i + 1),
                    {kShares[i], kNone},
                    [count = i + 1](const RunRecord& r) { return share_with_pmds(r, count); }});
  }
  rows.push_back({"Total nodes in the solution path", {3.66, 3.22}, [](const RunRecord& r) {
                    return number(r.path_nodes);
                  }});
  return rows;
}

std::vector<PaperRow> paper_table_4() {
  return {
      {"Time to find a solution [s]",
       {21.06, 7.75, 71.64, 24.09},
       [](const RunRecord& r) { return r.time_s; }},
      {"Smoothing time [s]",
       {0.124, 0.022, 0.821, 0.142},
       [](const RunRecord& r) { return r.smoothing_s; }},
      {"Number of samples",
       {1188.7, 437.7, 2093.8, 2205.6},
       [](const RunRecord& r) { return number(r.samples); }},
      {"Nodes in the PRM",
       {53.6, 24.6, 131.7, 81.9},
       [](const RunRecord& r) { return number(r.nodes); }},
      {"Nodes in solution path",
       {3.9, 3.4, 4.2, 4.9},
       [](const RunRecord& r) { return number(r.path_nodes); }},
  };
}

std::vector<PaperParameter> paper_table_3() {
  return {{"rho_a (initial)", "rho_a", "0.001", "0.001"},
          {"K, neighbours", "k", "10", "10"},
          {"N, most samples (initial)", "max_samples", "100", "10000"},
          {"n_A, arm trials", "n_a", "10", "20"},
          {"n_H, hand trials", "n_h", "10", "20"},
          {"Largest rho_a (0: no limit)", "rho_max", "-", "-"},
          {"Samples in gaps between hypercubes", "fill_gaps", "-", "-"},
          {"N compared at each", "n_checked", "pass", "pass"},
          {"Edges of smoothing", "smoothing", "both-ways", "both-ways"}};
}

}  // namespace handway::tools
