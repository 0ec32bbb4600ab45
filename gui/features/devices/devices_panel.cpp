#include "features/devices/devices_panel.h"

#include "features/devices/following_plot.h"
#include "features/devices/motion_device_field.h"
#include "handway/device/arm/val3_arm.h"
#include "handway/device/hand/hand_protocol.h"
#include "handway/execution/motion/motion_parts.h"
#include "handway/geometric/math/units.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/slider_row.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/panels/motion_text.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QCheckBox>
#include <QFormLayout>
#include <QFrame>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QVariant>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace handway::gui {
namespace {

using State = MotionDriver::State;

constexpr int kMargin = 12;
constexpr double kCautiousSpeed = 0.1;  // until the user sets a higher speed
constexpr double kLeastSpeed = 0.01;

QLabel* make_text(const char* name) {
  auto* text = new QLabel;
  text->setObjectName(QLatin1String(name));
  text->setWordWrap(true);
  text->setTextFormat(Qt::RichText);
  text->setTextInteractionFlags(Qt::TextSelectableByMouse);
  return text;
}

QString state_text(State state, bool held) {
  switch (state) {
    case State::kConnecting:
      return QObject::tr("Connecting…");
    case State::kConnected:
      return QObject::tr("Connected, at rest");
    case State::kRunning:
      return held ? QObject::tr("Held") : QObject::tr("Moving");
    case State::kClosing:
      return QObject::tr("Disconnecting…");
    case State::kOff:
      break;
  }
  return QObject::tr("Not connected");
}

QColor state_color(State state, bool held) {
  const ThemeColors colors = colors_of(current_theme());
  switch (state) {
    case State::kConnected:
      return colors.good;
    case State::kRunning:
      return held ? colors.muted : colors.accent;
    default:
      return colors.muted;
  }
}

// The user confirms these before a motion. Each timing of the path takes it back.
QString arming_text(bool is_tight) {
  return is_tight ? QObject::tr("Move despite low clearance") : QObject::tr("Let the robot move");
}

}  // namespace

DevicesPanel::DevicesPanel(QWidget* parent)
    : QWidget(parent),
      arm_(new MotionDeviceField(QStringLiteral("arm"), device::kVal3MotionPort)),
      hand_(new MotionDeviceField(QStringLiteral("hand"), device::kHandPort)),
      connect_(named("devices_connect", new QPushButton)),
      state_text_(make_text("devices_state")),
      problem_(new QFrame),
      problem_text_(make_text("devices_problem")),
      mirror_(named("devices_mirror", new QCheckBox(tr("Show the measured robot")))),
      speed_(new SliderRow(
          tr("Speed"),
          {.lower = kLeastSpeed, .upper = 1.0, .scale = 100.0, .unit = tr(" %"), .decimals = 0})),
      motion_(make_text("devices_motion")),
      start_here_(
          named("devices_start_here", new QPushButton(tr("Plan from the measured position")))),
      with_margin_(named("devices_with_margin", new QPushButton)),
      armed_(named("devices_armed", new QCheckBox(arming_text(false)))),
      run_(named("devices_run", new QPushButton(tr("Run on the robot")))),
      hold_(named("devices_hold", new QPushButton(tr("Hold")))),
      progress_(new QProgressBar),
      progress_text_(named("devices_progress", note())),
      outcome_text_(make_text("devices_outcome")),
      plot_(new FollowingPlot) {
  outcome_ = make_outcome();
  auto* content = boxed(in_column({make_connection(), make_motion(), outcome_, room()}, 8),
                        {kMargin, 10, kMargin, kMargin});
  lay_out(*this, in_column({new PanelArea(content)}));
  show_state(State::kOff, false);
}

QWidget* DevicesPanel::make_connection() {
  auto* form = new QFormLayout;
  form->setHorizontalSpacing(10);
  form->setVerticalSpacing(6);
  form->addRow(heading(tr("Controllers")));
  form->addRow(tr("Arm"), arm_);
  form->addRow(tr("Hand"), hand_);
  mirror_->setChecked(true);
  mirror_->setToolTip(
      tr("Show the robot in the view at its measured joint positions, also during editing and "
         "playback"));
  connect(mirror_, &QCheckBox::toggled, this, &DevicesPanel::mirror_changed);
  connect(connect_, &QPushButton::clicked, this, [this] {
    if (state_ == State::kOff) {
      emit connect_requested();
    } else {
      emit disconnect_requested();
    }
  });
  return boxed(in_column({form, in_row({{state_text_, 1}, connect_}), mirror_}, 8));
}

QWidget* DevicesPanel::make_motion() {
  speed_->setObjectName(QStringLiteral("devices_speed"));
  speed_->set_value(kCautiousSpeed);
  speed_->setToolTip(tr("Share of the full speed that the joint limits allow"));
  armed_->setToolTip(tr("The robot moves only if this is ticked; applies to one motion"));
  run_->setProperty("role", "primary");
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  progress_->setFixedHeight(6);
  for (QWidget* shown_while_running :
       {static_cast<QWidget*>(progress_), static_cast<QWidget*>(progress_text_)}) {
    QSizePolicy keeps_room = shown_while_running->sizePolicy();
    keeps_room.setRetainSizeWhenHidden(true);
    shown_while_running->setSizePolicy(keeps_room);
  }
  problem_->setProperty("role", "banner");
  lay_out(*problem_, in_column({problem_text_}), {10, 7, 10, 7});
  problem_text_->setTextFormat(Qt::PlainText);
  problem_->hide();
  start_here_->setToolTip(tr("Set the start to the measured configuration, and plan"));
  start_here_->hide();
  with_margin_->setToolTip(tr("Plan a path with this clearance"));
  with_margin_->hide();
  connect(with_margin_, &QPushButton::clicked, this, [this] { emit margin_requested(margin_); });
  connect(speed_, &SliderRow::value_edited, this, &DevicesPanel::speed_changed);
  connect(start_here_, &QPushButton::clicked, this, &DevicesPanel::start_here_requested);
  connect(armed_, &QCheckBox::toggled, this, &DevicesPanel::update_buttons);
  connect(run_, &QPushButton::clicked, this, &DevicesPanel::run_requested);
  connect(hold_, &QPushButton::clicked, this, [this] { emit hold_requested(!held_); });
  return boxed(in_column({heading(tr("Motion")), speed_, armed_, in_row({{run_, 2}, {hold_, 1}}, 8),
                          progress_, progress_text_, problem_, motion_, start_here_, with_margin_},
                         8));
}

QWidget* DevicesPanel::make_outcome() {
  auto* box = boxed(in_column({heading(tr("Executed")), outcome_text_, plot_}, 8));
  box->hide();
  return box;
}

MotionDevices DevicesPanel::devices() const {
  QStringList addresses;
  for (const MotionDeviceField* field : {arm_, hand_}) {
    if (const QString address = field->address(); !address.isEmpty()) {
      addresses << address;
    }
  }
  return {addresses.join(QLatin1Char(',')), arm_->is_emulator(), hand_->is_emulator()};
}

void DevicesPanel::choose_devices(const QString& arm, const QString& hand) {
  arm_->choose(arm);
  hand_->choose(hand);
}

double DevicesPanel::speed() const { return std::max(speed_->value(), kLeastSpeed); }

bool DevicesPanel::mirrors() const { return mirror_->isChecked(); }

bool DevicesPanel::is_armed() const { return armed_->isChecked(); }

void DevicesPanel::show_state(State state, bool robot) {
  if (state == State::kConnected && state_ == State::kConnecting) {
    arm_->remember();
    hand_->remember();
  }
  if (state_ == State::kRunning && state != State::kRunning) {
    armed_->setChecked(false);
    held_ = false;
  }
  state_ = state;
  robot_ = robot;
  show_state_text();
  update_buttons();
}

void DevicesPanel::show_state_text() {
  state_text_->setText(dotted(state_text(state_, held_), state_color(state_, held_)));
}

void DevicesPanel::show_problem(const QString& message) {
  problem_text_->setText(message);
  problem_->setVisible(!message.isEmpty());
}

void DevicesPanel::show_no_motion(const QString& why) {
  motion_->setText(colored(why, colors_of(current_theme()).muted));
  cleared_ = false;
  armed_->setText(arming_text(false));
  start_here_->hide();
  with_margin_->hide();
  update_buttons();
}

void DevicesPanel::show_elsewhere(const QString& where) {
  show_no_motion(where);
  start_here_->show();
}

void DevicesPanel::show_motion(const planning::TimedPath& motion, bool backwards) {
  motion_->setText(motion_text(motion));
  run_->setText(backwards ? tr("Run backwards") : tr("Run on the robot"));
  cleared_ = motion.cleared();
  armed_->setText(arming_text(motion.preflight.is_tight()));
  start_here_->hide();
  offer_margin(motion.preflight);
  update_buttons();
}

void DevicesPanel::show_task(const QString& name, const planning::TimedPath& motion) {
  show_motion(motion, false);
  QString text =
      tr("<b>Task %1</b>").arg(name.toHtmlEscaped()) + QStringLiteral("<br>") + motion_text(motion);
  if (const std::string unset = execution::unset_outputs(motion.motion); !unset.empty()) {
    text += QStringLiteral("<br>") + colored(QString::fromStdString(unset), attention_color());
  }
  motion_->setText(text);
  with_margin_->hide();
}

void DevicesPanel::show_part(const QString& name) { part_ = name; }

// Planning with a margin can't help if the start or goal is too close, because they stay.
void DevicesPanel::offer_margin(const planning::PreflightReport& report) {
  with_margin_->setVisible(report.is_tight() && report.is_under_way());
  if (report.is_tight()) {
    margin_ = report.shortfall->suggested_margin();
    with_margin_->setText(tr("Plan with %1 mm margin").arg(geometric::millimetres(margin_)));
  }
}

void DevicesPanel::show_progress(double time, double duration, double error) {
  progress_->setValue(static_cast<int>(std::lround(1000.0 * time / std::max(duration, 1e-9))));
  const QString progress = tr("%1 of %2 s, largest error %3°")
                               .arg(time, 0, 'f', 1)
                               .arg(duration, 0, 'f', 1)
                               .arg(geometric::degrees(error), 0, 'f', 2);
  progress_text_->setText(part_.isEmpty() ? progress : tr("%1: %2").arg(part_, progress));
}

void DevicesPanel::show_held(bool held) {
  held_ = held;
  show_state_text();
  update_buttons();
}

void DevicesPanel::show_outcome(const execution::MotionOutcome& outcome,
                                std::shared_ptr<const ExecutedMotion> executed,
                                const geometric::RobotModel& model) {
  QString text = outcome_text(outcome);
  if (!executed->log.empty()) {
    text += QStringLiteral("<br>") +
            tr("Log: %1").arg(QString::fromStdString(executed->log.string()).toHtmlEscaped());
  }
  outcome_text_->setText(text);
  plot_->show_motion(std::move(executed), model);
  outcome_->show();
}

void DevicesPanel::clear_outcome() {
  outcome_->hide();
  plot_->clear();
}

void DevicesPanel::update_buttons() {
  const bool off = state_ == State::kOff;
  const bool running = state_ == State::kRunning;
  connect_->setText(off ? tr("Connect") : tr("Disconnect"));
  connect_->setEnabled(robot_ && state_ != State::kClosing);
  arm_->setEnabled(off);
  hand_->setEnabled(off);
  speed_->setEnabled(!running);
  armed_->setEnabled(state_ == State::kConnected && cleared_);
  if (!armed_->isEnabled() && !running) {
    armed_->setChecked(false);
  }
  const QString missing = off                    ? tr("Connect first.")
                          : !cleared_            ? tr("No motion is cleared to run: see below.")
                          : !armed_->isChecked() ? tr("Tick \"%1\" first.").arg(armed_->text())
                                                 : QString();
  run_->setEnabled(state_ == State::kConnected && missing.isEmpty());
  run_->setToolTip(missing);
  hold_->setEnabled(running);
  hold_->setText(held_ ? tr("Continue") : tr("Hold"));
  progress_->setVisible(running);
  progress_text_->setVisible(running);
}

}  // namespace handway::gui
