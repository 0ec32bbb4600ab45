#include "reproduce_postures.h"

#include "basis_plots.h"
#include "campaign_session.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/resources.h"
#include "number_text.h"
#include "posture_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <utility>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;

struct PostureFigure {
  int number;
  const char* caption;
  const char* drawing;  ///< What handway-figures calls it.
};

constexpr std::array<PostureFigure, 4> kFigures = {
    {{7, "Correlations between joints of the hand", "correlations"},
     {8, "The hand along each of the first two principal motion directions", "directions"},
     {9, "The hand over both of the first two principal motion directions", "grid"},
     {10, "Variance covered by the first principal motion directions", "variance"}}};

/// Joints that Fig. 7 plots over each other, and what it finds.
struct JointPair {
  const char* first;
  const char* second;
  const char* joints;  ///< Their numbers in the paper.
  const char* published;
};
constexpr std::array<JointPair, 6> kPairs = {
    {{"middle_proximal", "ring_proximal", "8, 11", "positive"},
     {"index_abduction", "ring_abduction", "4, 10", "negative"},
     {"index_medial", "middle_medial", "6, 9", "positive"},
     {"middle_proximal", "ring_abduction", "8, 10", "positive"},
     {"thumb_base", "index_proximal", "0, 5", "none"},
     {"thumb_base", "ring_medial", "0, 12", "none"}}};

constexpr std::array<double, 3> kPublishedVariance = {42.19, 77.12, 84.71};  // %, section 4.2

struct Studied {
  std::string name;  ///< Of the recording, and of its folder.
  PostureStudy study;
};

std::string way_text(Normalisation normalisation) {
  return normalisation == Normalisation::kLimits ? "joints by limits" : "joints by own range";
}

// People's recordings leave the hand's joint limits: by these, little would be seen of them.
std::vector<Studied> study_all(std::string& problem) {
  const fs::path shipped = geometric::resource_dir() / "recordings" / "free_hand.csv";
  std::vector<Studied> all;
  all.push_back({"free_hand", study_postures(shipped, Normalisation::kLimits)});
  const char* reference = std::getenv("HANDWAY_REFERENCE_DIR");
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

// A joint that a recording never moves correlates with none.
ReportTable correlation_table(const std::vector<Studied>& all) {
  ReportTable table{{"Joints", "numbers", "published"}, {}};
  for (const Studied& one : all) {
    table.columns.push_back(one.name);
  }
  for (const JointPair& pair : kPairs) {
    std::vector<std::string> row = {fmt::format("{}, {}", pair.first, pair.second), pair.joints,
                                    pair.published};
    for (const Studied& one : all) {
      row.push_back(fmt::format("{:+.2f}", one.study.correlation(pair.first, pair.second)));
    }
    std::ranges::replace(row.front(), '_', ' ');
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable variance_table(const std::vector<Studied>& all) {
  ReportTable table{{"Directions", "published [%]"}, {}};
  std::vector<const Eigen::VectorXd*> columns;
  for (const Studied& one : all) {
    for (const Normalisation way : {Normalisation::kLimits, Normalisation::kRange}) {
      table.columns.push_back(fmt::format("{}, {} [%]", one.name, way_text(way)));
      columns.push_back(way == Normalisation::kLimits ? &one.study.limits_shares
                                                      : &one.study.range_shares);
    }
  }
  const Eigen::Index most = columns.front()->size();
  for (Eigen::Index count = 1; count <= most; ++count) {
    const auto at = static_cast<std::size_t>(count - 1);
    std::vector<std::string> row = {
        fmt::format("{}", count),
        at < kPublishedVariance.size() ? fmt::format("{:.2f}", kPublishedVariance[at]) : "-"};
    for (const Eigen::VectorXd* shares : columns) {
      row.push_back(
          fmt::format("{:.2f}", 100.0 * shares->head(std::min(count, shares->size())).sum()));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string sources_text(const std::vector<Studied>& all) {
  std::string text =
      "Recordings of a glove, mapped to the SAH hand by Table 1: free_hand, which ships and was "
      "made by an emulated hand, and where HANDWAY_REFERENCE_DIR names the folder of the "
      "published files, those of a person in it. Directions are of all joints but the thumb base, "
      "which has an axis of its own. Drawn are";
  for (const Studied& one : all) {
    text += fmt::format("{} {}, {} postures, {}", &one == all.data() ? "" : ";", one.name,
                        one.study.postures.rows(), way_text(one.study.normalisation));
  }
  return text + ".";
}

}  // namespace

const std::set<int>& posture_figures() {
  static const std::set<int> kNumbers = {7, 8, 9, 10};
  return kNumbers;
}

std::vector<ReproducedFigure> reproduce_postures(const std::set<int>& figures,
                                                 const fs::path& folder) {
  if (std::ranges::none_of(figures, [](int f) { return posture_figures().contains(f); })) {
    return {};
  }
  std::string problem;
  const std::vector<Studied> all = study_all(problem);
  std::vector<const Studied*> drawn;
  for (const Studied& one : all) {
    try {
      const fs::path own = folder / "postures" / one.name;
      write_basis_plots(own, one.study.basis, one.study.postures, one.study.shares);
      drawn.push_back(&one);
    } catch (const InputError& error) {
      problem += fmt::format("{} ", error.what());
    }
  }
  std::vector<ReproducedFigure> made;
  for (const PostureFigure& figure : kFigures) {
    if (!figures.contains(figure.number)) {
      continue;
    }
    const bool first = made.empty();  // what is said there is so for all of them
    ReproducedFigure result{
        figure.number,       figure.caption, first ? sources_text(all) : "", {}, {},
        first ? problem : ""};
    for (const Studied* one : drawn) {
      result.pictures.push_back({fmt::format("{}: {}", figure.caption, one->name),
                                 fmt::format("postures/{}/{}.png", one->name, figure.drawing)});
    }
    if (figure.number == 7) {
      result.table = correlation_table(all);
    } else if (figure.number == 10) {
      result.table = variance_table(all);
    }
    if (result.table) {
      geometric::replace_file(folder / fmt::format("figure_{}.csv", figure.number),
                              to_csv(*result.table));
    }
    made.push_back(std::move(result));
  }
  return made;
}

}  // namespace handway::tools
