#include "features/microscope/microscope_panel.h"

#include "features/microscope/listing_view.h"
#include "features/microscope/step_text.h"
#include "features/workbench.h"
#include "model/document/document.h"
#include "model/planning/path_history.h"
#include "model/planning/plan_settings.h"
#include "view3d/microscope_drawing.h"
#include "view3d/overlay.h"
#include "view3d/scene_view.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QLabel>
#include <QObject>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>

#include <algorithm>
#include <cstddef>
#include <string>

namespace handway::gui {
namespace {

constexpr int kMain = 4;           // the algorithm that calls the others
constexpr double kLongest = 30.0;  // s, of planning
constexpr int kControlsWidth = 280;
constexpr const char* kPlanner = "pmd-prm";
constexpr const char* kFullPlanner = "full-prm";

// The line of the main algorithm from which another one is called.
int calling_line(int algorithm) {
  constexpr int kCalls[] = {15, 18, 19};
  return kCalls[algorithm - 1];
}

}  // namespace

MicroscopePanel::MicroscopePanel(Document& document, PlanSettings& planning, SceneView& view,
                                 QWidget* parent)
    : QWidget(parent),
      document_(document),
      planning_(planning),
      view_(view),
      record_(named("microscope_record", new QPushButton(tr("Record a run")))),
      rewind_(make_button("microscope_rewind", "step_back", tr("To the beginning"))),
      back_(make_button("microscope_back", "frame_back", tr("One step back"))),
      run_(make_button("microscope_run", "play", tr("Step by itself, or pause"))),
      forward_(make_button("microscope_forward", "frame_forward", tr("One step on"))),
      position_(named("microscope_position", new QSlider(Qt::Horizontal))),
      filter_(named("microscope_filter", new QComboBox)),
      pace_(new QComboBox),
      count_(note()),
      words_(named("microscope_words", new QLabel)),
      state_(note()),
      caller_(new ListingView),
      called_(new ListingView) {
  setAttribute(Qt::WA_StyledBackground);
  lay_out(*this, in_row({make_controls(), {caller_, 1}, {called_, 1}}, 14), {10, 6, 10, 6});
  follow_theme(*this, [this] { refresh_icons(); });
  connect(record_, &QPushButton::clicked, this, [this] {
    if (microscope_.is_recording()) {
      microscope_.forget();
      show_state();
    } else {
      record();
    }
  });
  connect(rewind_, &QToolButton::clicked, this, [this] {
    set_running(false);
    microscope_.go_to(0);
  });
  connect(back_, &QToolButton::clicked, this, [this] {
    set_running(false);
    step(-1);
  });
  connect(forward_, &QToolButton::clicked, this, [this] {
    set_running(false);
    step(1);
  });
  connect(run_, &QToolButton::clicked, this, [this] { set_running(!clock_.isActive()); });
  connect(position_, &QSlider::valueChanged, this, [this](int position) {
    set_running(false);
    microscope_.go_to(static_cast<std::size_t>(position));
  });
  connect(pace_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this] { clock_.setInterval(1000 / pace_->currentData().toInt()); });
  connect(&clock_, &QTimer::timeout, this, [this] { step(1); });
  connect(&microscope_, &Microscope::recorded, this, &MicroscopePanel::take_run);
  connect(&microscope_, &Microscope::moved, this, &MicroscopePanel::show_step);
  connect(&microscope_, &Microscope::failed, this, [this](const QString& message) {
    show_state();
    state_->setText(tr("Nothing to show: %1").arg(message));
  });
  connect(&document_, &Document::opened, &microscope_, &Microscope::forget);
  connect(&document_, &Document::edited, this, [this](const planning::SceneState& before) {
    if (before.scene != document_.scene() && microscope_.run()) {
      microscope_.forget();
    }
  });
  clock_.setInterval(1000 / pace_->currentData().toInt());
  show_step();
}

QWidget* MicroscopePanel::make_controls() {
  record_->setToolTip(
      tr("Plans with pmd-prm (or full-prm, if it is chosen), its settings and the seed of the "
         "planning panel, and keeps every step"));
  filter_->addItem(tr("All steps"), static_cast<int>(StepFilter::kAll));
  filter_->addItem(tr("Samples"), static_cast<int>(StepFilter::kSamples));
  filter_->addItem(tr("Nodes and edges"), static_cast<int>(StepFilter::kEdges));
  filter_->setToolTip(tr("Steps at which the buttons stop"));
  for (const int pace : {1, 3, 10, 25}) {
    pace_->addItem(tr("%1 per second").arg(pace), pace);
  }
  pace_->setCurrentIndex(1);
  for (QLabel* label : {words_, state_}) {
    label->setWordWrap(true);
    label->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  }
  auto* controls = new QWidget;
  controls->setMaximumWidth(scaled(kControlsWidth));
  lay_out(*controls, in_column({in_row({record_, room(), rewind_, back_, run_, forward_}, 2),
                                in_row({{position_, 1}, count_}), in_row({{filter_, 1}, pace_}),
                                words_, state_, room()},
                               6));
  return controls;
}

QToolButton* MicroscopePanel::make_button(const QString& name, const QString& icon_name,
                                          const QString& tip) {
  auto* button = new QToolButton;
  button->setObjectName(name);
  button->setProperty("icon_name", icon_name);
  button->setIcon(icon(icon_name));
  button->setIconSize({scaled(20), scaled(20)});
  button->setAutoRaise(true);
  button->setToolTip(tip);
  return button;
}

void MicroscopePanel::refresh_icons() {
  run_->setProperty("icon_name", clock_.isActive() ? "pause" : "play");
  for (QToolButton* button : {rewind_, back_, run_, forward_}) {
    button->setIcon(icon(button->property("icon_name").toString()));
  }
}

StepFilter MicroscopePanel::filter() const {
  return static_cast<StepFilter>(filter_->currentData().toInt());
}

std::shared_ptr<planning::Planner> MicroscopePanel::make_planner() const {
  const geometric::PlannerRequest choice = planning_.choice();
  const bool tells_steps = choice.name == kPlanner || choice.name == kFullPlanner;
  std::shared_ptr<planning::Planner> planner =
      planning_.registry().create(tells_steps ? choice.name : kPlanner);
  if (tells_steps) {
    for (const auto& [key, value] : choice.settings) {
      planner->set_parameter(key, value);
    }
  }
  return planner;
}

void MicroscopePanel::record() {
  const auto& scene = document_.scene();
  if (!document_.problem() || !scene->start || !scene->goal) {
    state_->setText(tr("The scene needs a start and a goal."));
    return;
  }
  set_running(false);
  planning::PlanRequest request = planning_.request();
  request.threads = 1;
  request.time_limit_s = std::min(request.time_limit_s, kLongest);
  microscope_.record(make_planner(), document_.problem(), request, document_.palm());
  show_state();
}

void MicroscopePanel::take_run() {
  {
    const QSignalBlocker quiet(position_);
    position_->setRange(0, static_cast<int>(microscope_.run()->steps.size()) - 1);
  }
  show_state();
}

void MicroscopePanel::show_state() {
  const auto& run = microscope_.run();
  record_->setText(microscope_.is_recording() && !run ? tr("Cancel") : tr("Record a run"));
  for (QWidget* part :
       {static_cast<QWidget*>(rewind_), static_cast<QWidget*>(back_), static_cast<QWidget*>(run_),
        static_cast<QWidget*>(forward_), static_cast<QWidget*>(position_)}) {
    part->setEnabled(run != nullptr);
  }
  if (run) {
    QString text = result_line(run->result);
    if (run->left_out > 0) {
      text += QLatin1Char(' ') + tr("Only the first %1 steps are recorded; %2 more followed.")
                                     .arg(run->steps.size())
                                     .arg(run->left_out);
    }
    if (!run->departures.empty()) {
      QStringList departures;
      for (const std::string& departure : run->departures) {
        departures += QString::fromStdString(departure);
      }
      text += QLatin1Char(' ') +
              tr("Departs from the listings by %1.").arg(departures.join(QStringLiteral(", ")));
    }
    state_->setText(text);
  } else if (microscope_.is_recording()) {
    state_->setText(tr("Planning and recording every step…"));
  } else {
    state_->setText(
        tr("Record a run of the paper's planner and step through it line by line. The robot shows "
           "the current sample, the view the roadmap at that step."));
  }
}

void MicroscopePanel::show_step() {
  const auto& run = microscope_.run();
  for (QLabel* label : {count_, words_}) {
    label->setVisible(run != nullptr);
  }
  if (!run) {
    set_running(false);
    view_.set_overlay(Overlay::kSteps, nullptr);
    caller_->clear();
    called_->clear();
    words_->clear();
    count_->clear();
    show_state();
    return;
  }
  const RecordedStep& recorded = microscope_.step();
  const planning::AlgorithmLine line = recorded.step.line;
  const QSignalBlocker quiet(position_);
  position_->setValue(static_cast<int>(microscope_.position()));
  count_->setText(tr("Step %1 of %2").arg(microscope_.position() + 1).arg(run->steps.size()));
  words_->setText(step_text(*run, microscope_.position()));
  if (line.algorithm == kMain) {
    caller_->show_line(kMain, line.line, false);
    called_->clear();
  } else {
    caller_->show_line(kMain, calling_line(line.algorithm), true);
    called_->show_line(line.algorithm, line.line, false);
  }
  view_.set_overlay(Overlay::kSteps, make_steps_node(microscope_));
  if (recorded.sample >= 0) {
    emit taken();
    document_.set_configuration(run->samples[static_cast<std::size_t>(recorded.sample)]);
  }
}

void MicroscopePanel::step(int direction) {
  if (!microscope_.go(direction, filter())) {
    set_running(false);
  }
}

void MicroscopePanel::set_running(bool running) {
  if (running && microscope_.run()) {
    clock_.start();
  } else {
    clock_.stop();
  }
  refresh_icons();
}

void add_microscope(Workbench& workbench) {
  auto* panel = new MicroscopePanel(workbench.document, workbench.plan_settings, workbench.view);
  workbench.add_dock(DockArea::kBelow, 2, {"microscope", QObject::tr("Microscope"), panel});
  QObject::connect(panel, &MicroscopePanel::taken, &workbench.player, &PathPlayer::pause);
}

}  // namespace handway::gui
