#include "app/figures/basis_figures.h"

#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/units.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "view3d/scene_pictures.h"
#include "widgets/plots/figure_file.h"
#include "widgets/plots/plot_style.h"

#include <QImage>
#include <QPainter>
#include <QSize>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace handway::gui {

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
      throw geometric::InputError({basis.string(), "joints", "joint \"" + joint + '"',
                                   "joints of " + data.hand->name(), ""});
    }
  }
  return data;
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
