#include "app/figures/basis_figures.h"
#include "handway/geometric/math/units.h"
#include "widgets/plots/figure_file.h"
#include "widgets/plots/scatter_plot.h"
#include "widgets/plots/variance_plot.h"

#include <QSize>
#include <qwt_plot.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace handway::gui {
namespace {

using Pair = std::pair<Eigen::Index, Eigen::Index>;

constexpr std::size_t kPairs = 6;
constexpr QSize kCorrelationSize{720, 840};
constexpr QSize kVarianceSize{560, 400};

// Fig. 7, from the top left: joints by name, numbered as in the paper.
constexpr std::array<std::pair<const char*, const char*>, kPairs> kPaperPairs{
    {{"middle_proximal", "ring_proximal"},
     {"index_abduction", "ring_abduction"},
     {"index_medial", "middle_medial"},
     {"middle_proximal", "ring_abduction"},
     {"thumb_base", "index_proximal"},
     {"thumb_base", "ring_medial"}}};

Eigen::Index index_of(const sampling::PmdBasis& basis, const char* joint) {
  const auto found = std::ranges::find(basis.joints, joint);
  return found == basis.joints.end() ? -1 : found - basis.joints.begin();
}

std::vector<Pair> strongest_pairs(const FigureData& data) {
  std::vector<std::pair<double, Pair>> all;
  for (Eigen::Index a = 0; a < data.postures.cols(); ++a) {
    for (Eigen::Index b = a + 1; b < data.postures.cols(); ++b) {
      all.push_back({-std::abs(correlation(data.postures.col(a), data.postures.col(b))), {a, b}});
    }
  }
  std::ranges::sort(all);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < std::min(kPairs, all.size()); ++i) {
    pairs.push_back(all[i].second);
  }
  return pairs;
}

std::vector<Pair> pairs_of(const FigureData& data) {
  std::vector<Pair> pairs;
  for (const auto& [first, second] : kPaperPairs) {
    const Pair pair{index_of(data.basis, first), index_of(data.basis, second)};
    if (pair.first < 0 || pair.second < 0) {
      return strongest_pairs(data);
    }
    pairs.push_back(pair);
  }
  return pairs;
}

PlotVariable variable(const FigureData& data, Eigen::Index joint) {
  QString name = QString::fromStdString(data.basis.joints[static_cast<std::size_t>(joint)]);
  name.replace('_', ' ');
  return {QStringLiteral("Joint %1, %2 (%3)").arg(joint).arg(name).arg(QChar(0x00b0)),
          data.postures.col(joint) / geometric::kDegree};
}

}  // namespace

void write_correlation_figure(const FigureData& data, const QString& path) {
  std::vector<std::unique_ptr<QwtPlot>> plots;
  std::vector<QwtPlot*> drawn;
  for (const auto& [first, second] : pairs_of(data)) {
    plots.push_back(make_scatter_plot(variable(data, first), variable(data, second)));
    drawn.push_back(plots.back().get());
  }
  write_figure(path, QStringLiteral("Correlations between joints"), kCorrelationSize,
               [&](QPainter& painter, const QSize& size) { draw_plots(painter, size, drawn, 2); });
}

void write_variance_figure(const FigureData& data, const QString& path) {
  const std::unique_ptr<QwtPlot> plot = make_variance_plot(data.shares);
  write_figure(
      path, QStringLiteral("Variance covered by principal motion directions"), kVarianceSize,
      [&](QPainter& painter, const QSize& size) { draw_plots(painter, size, {plot.get()}, 1); });
}

}  // namespace handway::gui
