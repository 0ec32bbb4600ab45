#include "basis_figures.h"
#include "figures_program.h"
#include "film_figures.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/resources.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/report/rendering/csv.h"
#include "mapped_recording.h"
#include "planner_figures.h"
#include "posture_study.h"
#include "reproduce_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;

struct PostureFigure {
  int number;
  const char* caption;
  const char* drawing;  ///< Name of its file.
  bool shows_hands;     ///< It has pictures of hands, which handway-figures draws.
};

constexpr std::array<PostureFigure, 4> kFigures = {
    {{7, "Correlations between joints of the hand", "correlations", false},
     {8, "The hand along each of the first two principal motion directions", "directions", true},
     {9, "The hand over both of the first two principal motion directions", "grid", true},
     {10, "Variance covered by the first principal motion directions", "variance", false}}};

constexpr std::array<double, 3> kPublishedVariance = {42.19, 77.12, 84.71};  // %, section 4.2

struct Studied {
  std::string name;  ///< Name of the recording, and of its folder.
  PostureStudy study;
};

std::string text_of(Normalisation normalisation) {
  return normalisation == Normalisation::kLimits ? "joints by limits" : "joints by own range";
}

// People's recordings leave the hand's joint limits: scaling by these would hide most of them.
std::vector<Studied> study_all(bool shipped_only, std::string& problem) {
  const fs::path shipped = geometric::resource_dir() / "recordings" / "free_hand.csv";
  std::vector<Studied> all;
  all.push_back({"free_hand", study_postures(shipped, Normalisation::kLimits)});
  const char* reference = shipped_only ? nullptr : std::getenv("HANDWAY_REFERENCE_DIR");
  for (const char* name : {"calib-rad-su01", "grasp-rad-su01"}) {
    const fs::path file =
        fs::path(reference != nullptr ? reference : "") / "glove" / fmt::format("{}.txt", name);
    if (reference == nullptr || !fs::exists(file)) {
      continue;
    }
    try {
      all.push_back({name, study_postures(file, Normalisation::kRange)});
    } catch (const InputError& error) {
      problem += fmt::format("{} ", error.what());
    }
  }
  return all;
}

// A joint without motion in a recording correlates with none.
report::Table correlation_table(const std::vector<Studied>& all) {
  report::Table table{{"Joints", "numbers", "published"}};
  for (const Studied& one : all) {
    table.columns.emplace_back(one.name);
  }
  for (const JointPair& pair : kPaperJointPairs) {
    std::string joints = fmt::format("{}, {}", pair.first, pair.second);
    std::ranges::replace(joints, '_', ' ');
    std::vector<report::Cell> row = {joints, pair.joints, pair.published};
    for (const Studied& one : all) {
      report::Number number = report::fixed(one.study.correlation(pair.first, pair.second), 2);
      number.has_plus = true;
      row.emplace_back(std::move(number));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

report::Table variance_table(const std::vector<Studied>& all) {
  report::Table table{{"Directions", {"published", "%"}}};
  std::vector<const Eigen::VectorXd*> columns;
  for (const Studied& one : all) {
    for (const Normalisation scaling : {Normalisation::kLimits, Normalisation::kRange}) {
      table.columns.emplace_back(fmt::format("{}, {}", one.name, text_of(scaling)), "%");
      columns.push_back(scaling == Normalisation::kLimits ? &one.study.limits_shares
                                                          : &one.study.range_shares);
    }
  }
  const Eigen::Index most = columns.front()->size();
  for (Eigen::Index count = 1; count <= most; ++count) {
    const auto at = static_cast<std::size_t>(count - 1);
    std::vector<report::Cell> row = {count, at < kPublishedVariance.size()
                                                ? report::fixed(kPublishedVariance[at], 2)
                                                : report::Number{}};
    for (const Eigen::VectorXd* shares : columns) {
      row.emplace_back(
          report::fixed(100.0 * shares->head(std::min(count, shares->size())).sum(), 2));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string sources_text(const std::vector<Studied>& all) {
  std::string text =
      "Recordings of a glove, mapped to the SAH hand by Table 1: free_hand, which ships and was "
      "recorded from an emulated hand, and, if HANDWAY_REFERENCE_DIR is set, the recordings of "
      "people in that folder. The directions are of all joints except the thumb base, which has an "
      "axis of its own. The figures show";
  for (const Studied& one : all) {
    text += fmt::format("{} {}, {} postures, {}", &one == all.data() ? "" : ";", one.name,
                        one.study.postures.rows(), text_of(one.study.normalisation));
  }
  return text + ".";
}

/// Figures of hand postures: 7, correlations between joints; 8 and 9, the hand along the first
/// two principal motion directions and over both; 10, the variance that they cover.
const std::set<int>& posture_figures() {
  static const std::set<int> kNumbers = {7, 8, 9, 10};
  return kNumbers;
}

// Draws the hands of the studies; returns the reason of those that can't be drawn.
std::string draw_hands(const std::vector<Studied>& all, const fs::path& folder) {
  for (const Studied& one : all) {
    try {
      draw_pictures(folder / "postures" / one.name);
    } catch (const InputError& error) {
      return error.what();
    }
  }
  return "";
}

report::Part drawing_of(const PostureFigure& figure, const Studied& one) {
  const std::string caption = fmt::format("{}: {}", figure.caption, one.name);
  const std::string file = fmt::format("postures/{}/{}", one.name, figure.drawing);
  if (figure.shows_hands) {
    return report::Picture{caption, file + ".png"};
  }
  report::Figure drawn = figure.number == 7
                             ? correlation_figure(one.study.basis, one.study.postures)
                             : variance_figure(one.study.shares);
  drawn.caption = caption;
  drawn.file = file + ".svg";
  return drawn;
}

/// Analyses the recording that ships and, if HANDWAY_REFERENCE_DIR names the folder of the
/// published files, the recordings of people in it, mapped by the paper's Table 1, and draws those
/// of `figures` that are figures of postures to `postures/RECORDING`. The numbers of 7 and 10 are
/// in `figure_7.csv` and `figure_10.csv` beside it.
/// @throws OutputError if a file can't be written, InputError if the recording that ships can't be
/// read.
std::vector<ReproducedFigure> reproduce_postures(const std::set<int>& figures, bool shipped_only,
                                                 const fs::path& folder) {
  if (std::ranges::none_of(figures, [](int f) { return posture_figures().contains(f); })) {
    return {};
  }
  std::string problem;
  const std::vector<Studied> all = study_all(shipped_only, problem);
  for (const Studied& one : all) {
    write_basis_plots(folder / "postures" / one.name, one.study.basis, one.study.postures,
                      one.study.shares);
  }
  const bool needs_hands = std::ranges::any_of(kFigures, [&](const PostureFigure& figure) {
    return figure.shows_hands && figures.contains(figure.number);
  });
  const std::string hands_problem = needs_hands ? draw_hands(all, folder) : "";
  std::vector<ReproducedFigure> made;
  for (const PostureFigure& figure : kFigures) {
    if (!figures.contains(figure.number)) {
      continue;
    }
    ReproducedFigure result{figure.number, figure.caption, "", {}, {}, ""};
    if (made.empty()) {  // what is said there is so for all of them
      result.text = sources_text(all);
      result.problem = problem;
    }
    if (figure.shows_hands && !hands_problem.empty()) {
      result.problem += hands_problem;
    } else {
      for (const Studied& one : all) {
        result.drawings.push_back(drawing_of(figure, one));
      }
    }
    if (figure.number == 7) {
      result.table = correlation_table(all);
    } else if (figure.number == 10) {
      result.table = variance_table(all);
    }
    if (result.table) {
      geometric::replace_file(folder / fmt::format("figure_{}.csv", figure.number),
                              report::to_csv(*result.table));
    }
    made.push_back(std::move(result));
  }
  return made;
}

}  // namespace

std::set<int> reproducible_figures() {
  std::set<int> all = posture_figures();
  all.insert(planner_figures().begin(), planner_figures().end());
  all.insert(film_figures().begin(), film_figures().end());
  return all;
}

std::vector<ReproducedFigure> reproduce_figures(const std::set<int>& figures,
                                                const planning::PluginManager& plugins,
                                                double time_limit_s, bool shipped_only,
                                                const std::filesystem::path& folder) {
  std::vector<ReproducedFigure> made = reproduce_postures(figures, shipped_only, folder);
  std::ranges::move(reproduce_planner_figures(figures, plugins, folder), std::back_inserter(made));
  std::ranges::move(reproduce_films(figures, plugins, time_limit_s, folder),
                    std::back_inserter(made));
  return made;
}

}  // namespace handway::tools
