#include "app/figures/basis_figures.h"

#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/math/units.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "view3d/scene_pictures.h"
#include "widgets/plots/figure_file.h"
#include "widgets/plots/plot_style.h"
#include "widgets/plots/statistics_plots.h"

#include <QImage>
#include <QPainter>
#include <QSize>
#include <qwt_plot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

namespace handway::gui {
namespace {

using geometric::InputError;

constexpr std::size_t kLargestFile = std::size_t{1} << 30;

// The rows of a CSV file whose header is `names`.
Eigen::MatrixXd read_table(const std::filesystem::path& file,
                           const std::vector<std::string>& names) {
  std::istringstream in(geometric::read_text_file(file, "a table of numbers", kLargestFile));
  std::string line;
  std::getline(in, line);
  if (!std::ranges::equal(geometric::cells(line, ','), names)) {
    throw InputError({file.string() + ":1", "", "another header", "the joints of the basis", ""});
  }
  std::vector<double> values;
  Eigen::Index rows = 0;
  for (; std::getline(in, line); ++rows) {
    const std::string where = file.string() + ':' + std::to_string(rows + 2);
    const std::vector<std::string_view> row = geometric::cells(line, ',');
    if (row.size() != names.size()) {
      throw InputError({where, "", std::to_string(row.size()) + " values",
                        std::to_string(names.size()) + " as in the header", ""});
    }
    for (const std::string_view cell : row) {
      const std::optional<double> value = geometric::parse_number(cell);
      if (!value) {
        throw InputError({where, "", '"' + std::string(cell) + '"', "a finite number", ""});
      }
      values.push_back(*value);
    }
  }
  if (rows == 0) {
    throw InputError({file.string(), "", "no rows", "at least one", ""});
  }
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(values.data(), rows, static_cast<Eigen::Index>(names.size()));
}

}  // namespace

geometric::Configuration FigureData::configuration(const Eigen::VectorXd& posture) const {
  geometric::Configuration q = hand->neutral();
  for (std::size_t j = 0; j < basis.joints.size(); ++j) {
    const int variable = hand->find_variable(basis.joints[j]).value();
    q[variable] = std::lerp(hand->lower()[variable], hand->upper()[variable],
                            posture[static_cast<Eigen::Index>(j)]);
  }
  return q;
}

FigureData read_figure_data(const std::filesystem::path& folder) {
  FigureData data;
  const std::filesystem::path basis = folder / "basis.yaml";
  data.basis = sampling::read_pmd_basis(basis);
  data.hand = geometric::load_robot(geometric::find_resource(
      geometric::ResourceKind::kRobot, data.basis.hand, folder, basis.string()));
  for (const std::string& joint : data.basis.joints) {
    if (!data.hand->find_variable(joint)) {
      throw InputError({basis.string(), "joints", "joint \"" + joint + '"',
                        "joints of " + data.hand->name(), ""});
    }
  }
  data.postures = read_table(folder / "postures.csv", data.basis.joints);
  data.shares = read_table(folder / "variance.csv", {"share"}).col(0);
  return data;
}

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

namespace {

constexpr int kSteps = 5;
constexpr int kCell = 150;       // pixels
constexpr int kSideMargin = 64;  // for the names of rows
constexpr int kFootMargin = 44;  // for the names of columns
constexpr int kPictureScale = 3;

OrbitCamera::Placement in_front_of_the_palm() {
  OrbitCamera::Placement placement;
  placement.azimuth = geometric::radians(-35.0);
  placement.elevation = geometric::radians(20.0);
  return placement;
}

// -1 … 1: part of the half side at a step.
double part(int step) { return 2.0 * step / (kSteps - 1) - 1.0; }

// Returns e = part · λ in the usual notation.
QString part_text(int step) {
  static const std::array<const char*, kSteps> kTexts{"−λ", "−λ/2", "0", "λ/2", "λ"};
  return QString::fromUtf8(kTexts.at(static_cast<std::size_t>(step)));
}

// The posture at these parts of the first directions' half sides, free joints in their centres.
Eigen::VectorXd posture_at(const sampling::PmdBasis& basis, std::array<double, 2> parts) {
  Eigen::VectorXd u = Eigen::VectorXd::Constant(basis.dimension(), 0.5);
  for (std::size_t k = 0; k < std::min<std::size_t>(2, basis.directions.size()); ++k) {
    u[static_cast<Eigen::Index>(basis.free_joints.size() + k)] = 0.5 + 0.5 * parts.at(k);
  }
  return sampling::map_to_posture(basis, u);
}

void draw_text(QPainter& painter, const QRect& where, const QString& text, bool bold = false) {
  painter.setFont(plot_font(9.0, bold));
  painter.setPen(kPlotInk);
  painter.drawText(where, Qt::AlignCenter, text);
}

void draw_upright(QPainter& painter, const QRect& where, const QString& text) {
  painter.save();
  painter.translate(where.center());
  painter.rotate(-90);
  draw_text(painter, QRect(-where.height() / 2, -where.width() / 2, where.height(), where.width()),
            text, true);
  painter.restore();
}

class PostureSheet {
 public:
  explicit PostureSheet(const FigureData& data)
      : data_(data), pictures_(data.hand, in_front_of_the_palm()) {}

  void add(int row, int column, std::array<double, 2> parts) {
    images_.push_back({row, column,
                       pictures_.picture(data_.configuration(posture_at(data_.basis, parts)),
                                         QSize(kPictureScale * kCell, kPictureScale * kCell))});
  }

  void draw(QPainter& painter) const {
    for (const Entry& entry : images_) {
      const QRect cell(kSideMargin + entry.column * kCell, entry.row * kCell, kCell, kCell);
      painter.drawImage(cell, entry.image);
      painter.setPen(QPen(kPlotGrid, 0.75));
      painter.drawRect(cell);
    }
  }

 private:
  struct Entry {
    int row;
    int column;
    QImage image;
  };

  const FigureData& data_;
  PosturePictures pictures_;
  std::vector<Entry> images_;
};

QString direction_name(const FigureData& data, std::size_t direction) {
  return QString::fromStdString(data.basis.directions[direction].name);
}

}  // namespace

void write_direction_figure(const FigureData& data, const QString& path) {
  const int rows = static_cast<int>(std::min<std::size_t>(2, data.basis.directions.size()));
  PostureSheet sheet(data);
  for (int row = 0; row < rows; ++row) {
    for (int step = 0; step < kSteps; ++step) {
      sheet.add(row, step, {row == 0 ? part(step) : 0.0, row == 1 ? part(step) : 0.0});
    }
  }
  const QSize size(kSideMargin + kSteps * kCell + 8, rows * kCell + kFootMargin);
  write_figure(path, QStringLiteral("Postures along the first principal motion directions"), size,
               [&](QPainter& painter, const QSize&) {
                 sheet.draw(painter);
                 for (int row = 0; row < rows; ++row) {
                   draw_text(painter, QRect(0, row * kCell, kSideMargin, kCell),
                             direction_name(data, static_cast<std::size_t>(row)), true);
                 }
                 for (int step = 0; step < kSteps; ++step) {
                   draw_text(painter,
                             QRect(kSideMargin + step * kCell, rows * kCell, kCell, kFootMargin),
                             part_text(step));
                 }
               });
}

void write_grid_figure(const FigureData& data, const QString& path) {
  if (data.basis.directions.size() < 2) {
    return;
  }
  PostureSheet sheet(data);
  for (int row = 0; row < kSteps; ++row) {
    for (int column = 0; column < kSteps; ++column) {
      sheet.add(row, column, {part(column), part(kSteps - 1 - row)});
    }
  }
  const QSize size(kSideMargin + kSteps * kCell + 8, kSteps * kCell + kFootMargin + 12);
  write_figure(
      path, QStringLiteral("Postures over the first two principal motion directions"), size,
      [&](QPainter& painter, const QSize&) {
        sheet.draw(painter);
        const int foot = kSteps * kCell;
        for (int step = 0; step < kSteps; ++step) {
          draw_text(painter, QRect(kSideMargin + step * kCell, foot, kCell, kFootMargin / 2),
                    part_text(step));
          draw_text(painter,
                    QRect(kSideMargin / 2, (kSteps - 1 - step) * kCell, kSideMargin / 2, kCell),
                    part_text(step));
        }
        draw_text(painter,
                  QRect(kSideMargin, foot + kFootMargin / 2, kSteps * kCell, kFootMargin / 2),
                  direction_name(data, 0), true);
        draw_upright(painter, QRect(0, 0, kSideMargin / 2, foot), direction_name(data, 1));
      });
}

}  // namespace handway::gui
