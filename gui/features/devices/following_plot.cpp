#include "features/devices/following_plot.h"

#include "handway/geometric/math/units.h"
#include "widgets/forms/arrangement.h"
#include "widgets/plots/cursor_plot.h"
#include "widgets/plots/screen_colors.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QVariant>

#include <algorithm>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kAnglesHeight = 150;
constexpr int kDifferenceHeight = 120;

const QColor kPlannedColor{0x3b, 0x82, 0xd0};  // seen on white and on black

enum AngleCurve : int { kPlanned, kMeasured };

std::vector<double> in_degrees(std::vector<double> angles) {
  for (double& angle : angles) {
    angle = geometric::degrees(angle);
  }
  return angles;
}

}  // namespace

FollowingPlot::FollowingPlot(QWidget* parent)
    : QWidget(parent),
      joints_(named("following_joint", new QComboBox)),
      angles_(new TimePlot({}, tr("angle, °"))),
      difference_(new TimePlot(tr("time, s"), tr("error, °"))) {
  angles_->setFixedHeight(kAnglesHeight);
  angles_->add_curve(tr("planned"), kPlannedColor);
  angles_->add_curve(tr("measured"), kPlotOrange, true);
  angles_->show_legend();
  difference_->setFixedHeight(kDifferenceHeight);
  difference_->add_curve(tr("measured − planned"), kPlotOrange);
  for (QWidget* plot : {angles_, difference_}) {  // Qwt asks for room for every label of the axis
    plot->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  }
  lay_out(*this, in_column({joints_, angles_, difference_}, 4));
  connect(joints_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          &FollowingPlot::show_joint);
  follow_theme(*this, [this] {
    angles_->set_colors(screen_colors());
    difference_->set_colors(screen_colors());
  });
  clear();
}

void FollowingPlot::show_motion(std::shared_ptr<const ExecutedMotion> motion,
                                const geometric::RobotModel& model) {
  motion_ = nullptr;  // the joints come one by one
  joints_->clear();
  for (const ExecutedMotion::Device& device : motion->devices) {
    for (const int variable : device.variables) {
      joints_->addItem(QString::fromStdString(model.variable(variable).name), variable);
    }
  }
  joints_->setCurrentIndex(joints_->findData(motion->worst_variable()));
  motion_ = std::move(motion);
  show_joint();
  show();
}

void FollowingPlot::clear() {
  motion_ = nullptr;
  hide();
}

void FollowingPlot::show_joint() {
  if (!motion_ || joints_->currentIndex() < 0) {
    return;
  }
  ExecutedMotion::JointCurve curve = motion_->curve(joints_->currentData().toInt());
  // The first sample may be from just before the start: the axis would begin a whole step before
  // it.
  std::ranges::transform(curve.times, curve.times.begin(),
                         [](double t) { return std::max(t, 0.0); });
  std::vector<double> error = curve.measured;
  for (std::size_t i = 0; i < error.size(); ++i) {
    error[i] -= curve.planned[i];
  }
  angles_->set_curve(kPlanned, curve.times, in_degrees(curve.planned));
  angles_->set_curve(kMeasured, curve.times, in_degrees(curve.measured));
  difference_->set_curve(0, curve.times, in_degrees(std::move(error)));
  angles_->refresh();
  difference_->refresh();
}

}  // namespace handway::gui
