#include "basis_figures.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/math/units.h"
#include "handway/report/rendering/csv.h"
#include "handway/report/rendering/report_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;
using ColumnPair = std::pair<Eigen::Index, Eigen::Index>;

std::vector<ColumnPair> strongest_pairs(const Eigen::MatrixXd& postures) {
  std::vector<std::pair<double, ColumnPair>> all;
  for (Eigen::Index a = 0; a < postures.cols(); ++a) {
    for (Eigen::Index b = a + 1; b < postures.cols(); ++b) {
      all.push_back({-std::abs(correlation(postures.col(a), postures.col(b))), {a, b}});
    }
  }
  std::ranges::sort(all);
  std::vector<ColumnPair> pairs;
  for (std::size_t i = 0; i < std::min(kPaperJointPairs.size(), all.size()); ++i) {
    pairs.push_back(all[i].second);
  }
  return pairs;
}

std::vector<ColumnPair> drawn_pairs(const sampling::PmdBasis& basis,
                                    const Eigen::MatrixXd& postures) {
  std::vector<ColumnPair> pairs;
  for (const JointPair& pair : kPaperJointPairs) {
    const auto first = std::ranges::find(basis.joints, pair.first);
    const auto second = std::ranges::find(basis.joints, pair.second);
    if (first == basis.joints.end() || second == basis.joints.end()) {
      return strongest_pairs(postures);
    }
    pairs.emplace_back(first - basis.joints.begin(), second - basis.joints.begin());
  }
  return pairs;
}

report::Axis joint_axis(const sampling::PmdBasis& basis, Eigen::Index joint) {
  std::string name = basis.joints[static_cast<std::size_t>(joint)];
  std::ranges::replace(name, '_', ' ');
  return {.title = fmt::format("Joint {}, {}", joint, name), .unit = "°"};
}

report::Table joint_table(const std::vector<std::string>& header, const Eigen::MatrixXd& rows) {
  report::Table table{{header.begin(), header.end()}};
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    table.rows.emplace_back(rows.row(row).begin(), rows.row(row).end());
  }
  return table;
}

}  // namespace

double correlation(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  const Eigen::VectorXd u = x.array() - x.mean();
  const Eigen::VectorXd v = y.array() - y.mean();
  const double scale = u.norm() * v.norm();
  return scale > 0.0 ? u.dot(v) / scale : 0.0;
}

report::Figure correlation_figure(const sampling::PmdBasis& basis,
                                  const Eigen::MatrixXd& postures) {
  constexpr Eigen::Index kMostDots = 1500;
  report::Figure figure{"Correlations between joints", {}, 2};
  for (const auto& [first, second] : drawn_pairs(basis, postures)) {
    report::Series dots{"", report::Mark::kDots};
    const Eigen::Index count = std::min(kMostDots, postures.rows());
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Index row = i * postures.rows() / count;
      dots.x.push_back(postures(row, first) / geometric::kDegree);
      dots.y.push_back(postures(row, second) / geometric::kDegree);
    }
    std::string title =
        fmt::format("r = {:.2f}", correlation(postures.col(first), postures.col(second)));
    if (const std::size_t minus = title.find('-'); minus != std::string::npos) {
      title.replace(minus, 1, "−");
    }
    figure.plots.push_back(report::XyPlot{
        std::move(title), joint_axis(basis, first), joint_axis(basis, second), {std::move(dots)}});
  }
  return figure;
}

report::Figure variance_figure(const Eigen::VectorXd& shares) {
  constexpr Eigen::Index kLabelled = 4;  // directions whose sum is written down
  report::Series each{"each direction", report::Mark::kBars};
  report::Series sum{.label = "all up to it", .mark = report::Mark::kPoints, .color = 0};
  double covered = 0.0;
  for (Eigen::Index k = 0; k < shares.size(); ++k) {
    covered += 100.0 * shares[k];
    each.x.push_back(static_cast<double>(k + 1));
    each.y.push_back(100.0 * shares[k]);
    sum.x.push_back(static_cast<double>(k + 1));
    sum.y.push_back(covered);
    if (k < kLabelled && k + 1 < shares.size()) {
      sum.notes.push_back(fmt::format("{:.1f} %", covered));
    }
  }
  return {"Variance covered by principal motion directions",
          {report::XyPlot{"",
                          {.title = "Number of principal motion directions",
                           .is_whole = true,
                           .least = 0.5,
                           .most = static_cast<double>(shares.size()) + 0.5},
                          {.title = "Variance covered", .unit = "%", .least = 0.0, .most = 100.0},
                          {std::move(each), std::move(sum)}}}};
}

void write_basis_plots(const fs::path& folder, const sampling::PmdBasis& basis,
                       const Eigen::MatrixXd& postures, const Eigen::VectorXd& shares) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw geometric::InputError({folder.string(), "", error.message(), "a folder for figures", ""});
  }
  geometric::replace_file(folder / "postures.csv",
                          report::to_csv(joint_table(basis.joints, postures)));
  geometric::replace_file(folder / "variance.csv", report::to_csv(joint_table({"share"}, shares)));
  sampling::write_pmd_basis(basis, folder / "basis.yaml");
  report::write_svg(correlation_figure(basis, postures), folder / "correlations.svg");
  report::write_svg(variance_figure(shares), folder / "variance.svg");
}

}  // namespace handway::tools
