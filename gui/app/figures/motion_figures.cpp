#include "app/figures/motion_figures.h"

#include "widgets/plots/figure_file.h"
#include "widgets/plots/plot_style.h"
#include "widgets/plots/time_plot.h"

#include <QColor>
#include <QSize>
#include <qwt_plot.h>
#include <qwt_text.h>

#include <memory>

namespace handway::gui {
namespace {

constexpr int kColumns = 3;
constexpr QSize kFrame{300, 190};
constexpr double kTitleSize = 9.0;
constexpr double kMilli = 1e3;
constexpr QRgb kBlue = 0x0072b2;

}  // namespace

void write_motion_figure(const std::vector<execution::RecordedDevice>& devices,
                         const QString& path) {
  std::vector<std::unique_ptr<TimePlot>> owners;
  std::vector<QwtPlot*> plots;
  for (const execution::RecordedDevice& device : devices) {
    const Eigen::MatrixXd away = kMilli * (device.measured - device.planned);
    for (Eigen::Index j = 0; j < away.cols(); ++j) {
      const QString joint = QString::fromStdString(device.joints[static_cast<std::size_t>(j)]);
      auto plot =
          std::make_unique<TimePlot>(QStringLiteral("time [s]"), QStringLiteral("off [mrad]"));
      const Eigen::VectorXd column = away.col(j);
      plot->set_curve(plot->add_curve(joint, QColor(kBlue)), device.times,
                      {column.begin(), column.end()});
      plot->refresh();
      plots.push_back(plot->findChild<QwtPlot*>());
      QwtText title(joint);
      title.setFont(plot_font(kTitleSize));
      plots.back()->setTitle(title);
      owners.push_back(std::move(plot));
    }
  }
  const int rows = (static_cast<int>(plots.size()) + kColumns - 1) / kColumns;
  write_figure(
      path, QStringLiteral("Measured minus planned"),
      {kFrame.width() * kColumns, kFrame.height() * rows},
      [&](QPainter& painter, const QSize& size) { draw_plots(painter, size, plots, kColumns); });
}

}  // namespace handway::gui
