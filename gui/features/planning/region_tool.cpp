#include "features/planning/region_tool.h"

#include "features/planning/plan_panel.h"
#include "handway/geometric/math/units.h"
#include "model/document/document.h"
#include "view3d/overlay.h"
#include "view3d/region_drawings.h"
#include "view3d/scene_view.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/theme.h"

#include <QCheckBox>
#include <QColor>
#include <QGridLayout>
#include <QLabel>
#include <QLocale>
#include <QScopedValueRollback>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QSlider>
#include <QTimer>

#include <algorithm>
#include <cmath>
#include <utility>

namespace handway::gui {
namespace {

// The slider of ρ_a goes by its logarithm.
constexpr double kLeastRho = 1e-4;
constexpr double kMostRho = 0.5;
constexpr int kRhoSteps = 1000;

double rho_of(int position) {
  const double rho =
      kLeastRho * std::pow(kMostRho / kLeastRho, static_cast<double>(position) / kRhoSteps);
  const double unit = std::pow(10.0, std::floor(std::log10(rho)) - 1.0);  // two digits
  return std::round(rho / unit) * unit;
}

int position_of(double rho) {
  const double share =
      std::log(std::clamp(rho, kLeastRho, kMostRho) / kLeastRho) / std::log(kMostRho / kLeastRho);
  return static_cast<int>(std::lround(share * kRhoSteps));
}

QString bullet(const geometric::Color& color, const QString& name) {
  return QStringLiteral("<span style='color:%1'>&#9679;</span>&nbsp;%2")
      .arg(QColor::fromRgbF(color.red, color.green, color.blue).name(), name);
}

}  // namespace

RegionPreviewBox::RegionPreviewBox(QWidget* parent)
    : QWidget(parent),
      on_(named("preview_region", new QCheckBox(tr("Show the sampling region")))),
      sliders_(new QWidget),
      rho_(named("preview_rho", new QSlider(Qt::Horizontal))),
      pmds_(named("preview_pmds", new QSlider(Qt::Horizontal))),
      rho_value_(new QLabel),
      pmds_value_(new QLabel),
      note_(named("preview_note", note())),
      legend_(new QLabel) {
  on_->setToolTip(
      tr("Show the positions of palm and fingertips in configurations that the planner may sample, "
         "free or in collision"));
  rho_->setRange(0, kRhoSteps);
  rho_->setPageStep(kRhoSteps / 20);
  pmds_->setPageStep(1);
  note_->setWordWrap(true);
  legend_->setTextFormat(Qt::RichText);
  legend_->setText(bullet(kPalmColor, tr("palm")) + QStringLiteral(" &nbsp; ") +
                   bullet(kFingertipColor, tr("fingertips")) + QStringLiteral(" &nbsp; ") +
                   bullet(kStraightColor, tr("straight motion")));
  auto* rows = new QGridLayout(sliders_);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setHorizontalSpacing(8);
  rows->setVerticalSpacing(4);
  rows->addWidget(new QLabel(tr("Half-width ρₐ")), 0, 0);
  rows->addWidget(rho_, 0, 1);
  rows->addWidget(rho_value_, 0, 2);
  rows->addWidget(new QLabel(tr("Directions")), 1, 0);
  rows->addWidget(pmds_, 1, 1);
  rows->addWidget(pmds_value_, 1, 2);
  rows->addWidget(legend_, 2, 0, 1, 3);
  for (QLabel* value : {rho_value_, pmds_value_}) {
    value->setMinimumWidth(scaled(48));
    value->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  }
  lay_out(*this, in_column({heading(tr("Sampling region")), on_, sliders_, note_}, 6));
  sliders_->hide();
  note_->hide();
  connect(on_, &QCheckBox::toggled, this, [this](bool on) {
    sliders_->setVisible(on && region_);
    note_->setVisible(on);
    was_switched_on_ = on;
    emit changed();
  });
  connect(rho_, &QSlider::valueChanged, this, [this] {
    take_sliders();
    emit rho_edited(region_->rho_a);
    emit changed();
  });
  connect(pmds_, &QSlider::valueChanged, this, [this] {
    take_sliders();
    emit pmds_edited(region_->pmds);
    emit changed();
  });
}

// A scroll area would not make room for all lines of a text that is wrapped.
void RegionPreviewBox::set_note(const QString& text) {
  note_->setText(text);
  note_->setMinimumHeight(note_->heightForWidth(width()));
}

void RegionPreviewBox::come_into_sight() {
  for (QWidget* above = parentWidget(); above; above = above->parentWidget()) {
    if (auto* area = qobject_cast<QScrollArea*>(above)) {
      area->verticalScrollBar()->setValue(area->verticalScrollBar()->maximum());
    }
  }
}

bool RegionPreviewBox::is_on() const { return on_->isChecked(); }

void RegionPreviewBox::show_region(const std::optional<planning::SamplingRegion>& region,
                                   int directions, bool bound) {
  region_ = region;
  bound_ = bound;
  sliders_->setVisible(is_on() && region_);
  if (!region_) {
    set_note(tr("This planner samples everywhere within the joints' limits."));
    return;
  }
  const QSignalBlocker quiet_rho(rho_);
  const QSignalBlocker quiet_pmds(pmds_);
  rho_->setValue(position_of(region_->rho_a));
  pmds_->setRange(1, std::max(1, directions));
  pmds_->setValue(region_->pmds);
  pmds_->setEnabled(region_->hand == planning::HandSpace::kPrincipalDirections && directions > 1);
  label_values();
}

void RegionPreviewBox::take_sliders() {
  region_->rho_a = rho_of(rho_->value());
  region_->pmds = pmds_->value();
  label_values();
}

void RegionPreviewBox::label_values() {
  rho_value_->setText(QString::number(region_->rho_a, 'g', 2));
  pmds_value_->setText(region_->hand == planning::HandSpace::kPrincipalDirections
                           ? QString::number(region_->pmds)
                           : tr("all joints"));
}

void RegionPreviewBox::show_draws(const planning::RegionDraws& draws) {
  QString text =
      tr("Nine of ten palms are within %1 mm of the straight motion; the corridor has "
         "%2 hypercubes.")
          .arg(geometric::millimetres(draws.palm_reach), 0, 'f', draws.palm_reach < 0.01 ? 1 : 0)
          .arg(QLocale().toString(draws.hypercubes));
  if (!bound_) {
    text += QLatin1Char(' ') + tr("This planner chooses the width itself, starting with 0.1. The "
                                  "sliders only change the display.");
  }
  set_note(text);
  if (std::exchange(was_switched_on_, false)) {
    QTimer::singleShot(300, this, &RegionPreviewBox::come_into_sight);  // once it has its size
  }
}

void RegionPreviewBox::show_failure(const QString& message) { set_note(message); }

namespace {

constexpr int kConfigurations = 700;

}  // namespace

RegionTool::RegionTool(Document& document, PlanSettings& settings, PlanPanel& panel,
                       SceneView& view, QObject* parent)
    : QObject(parent),
      document_(document),
      settings_(settings),
      panel_(panel),
      view_(view),
      box_(new RegionPreviewBox) {
  panel_.add_section(box_);
  connect(&settings_, &PlanSettings::parameters_changed, this, &RegionTool::read_planner);
  connect(&document_, &Document::opened, this, &RegionTool::read_planner);
  connect(&document_, &Document::edited, this, &RegionTool::update);
  connect(&document_, &Document::hand_changed, this, &RegionTool::read_planner);
  connect(box_, &RegionPreviewBox::changed, this, &RegionTool::update);
  connect(&job_, &LatestJob::failed, this, [this](const QString& message) {
    clear();
    box_->show_failure(message);
  });
  connect(box_, &RegionPreviewBox::rho_edited, this, [this](double rho) {
    const QScopedValueRollback writing(busy_writing_, true);
    panel_.enter("rho_a", rho);
  });
  connect(box_, &RegionPreviewBox::pmds_edited, this, [this](int pmds) {
    const QScopedValueRollback writing(busy_writing_, true);
    panel_.enter("max_pmds", pmds);
  });
  read_planner();
}

void RegionTool::read_planner() {
  if (busy_writing_ || !settings_.planner()) {
    return;
  }
  const auto& basis = document_.loaded().basis;
  const int directions = basis ? static_cast<int>(basis->directions.size()) : 0;
  box_->show_region(
      planning::first_region(*settings_.planner(), directions), directions,
      geometric::parameter_called(settings_.planner()->parameters(), "rho_a") != nullptr);
  update();
}

void RegionTool::clear() {
  job_.cancel();
  shown_ = false;
  view_.set_overlay(Overlay::kRegion, nullptr);
}

void RegionTool::update() {
  const auto& scene = document_.scene();
  if (!box_->is_on() || !box_->region() || !scene || !scene->start || !scene->goal ||
      !document_.problem()) {
    clear();
    return;
  }
  job_.run([this, problem = document_.problem(), palm = document_.palm(),
            region = *box_->region()](const std::stop_token& stop) -> LatestJob::Answer {
    const PreparedProblem::Problem prepared = problem->wait(stop);
    if (!prepared) {
      return {};
    }
    return [this, draws = planning::draw_region(*prepared, palm, region, kConfigurations, stop)] {
      shown_ = true;
      box_->show_draws(draws);
      view_.set_overlay(Overlay::kRegion, make_region_node(draws));
    };
  });
}

}  // namespace handway::gui
