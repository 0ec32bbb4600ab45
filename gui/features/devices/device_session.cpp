#include "features/devices/device_session.h"

#include "features/devices/devices_panel.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/setup/placing.h"
#include "model/document/document.h"
#include "model/planning/path_history.h"
#include "model/playback/path_player.h"
#include "widgets/panels/motion_text.h"

#include <QDateTime>
#include <QMessageBox>
#include <QPushButton>
#include <QStandardPaths>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <utility>

namespace handway::gui {
namespace {

using State = MotionDriver::State;

// Period that an arm's queue of ten points allows, s.
constexpr double kPeriod = 0.02;
// Largest motion of the robot since a motion was cleared, rad.
constexpr double kSamePlace = 1e-3;
constexpr double kSameNumbers = 1e-6;  // relative
// Longest time until a stopped robot is at rest before the scene is left.
constexpr std::chrono::milliseconds kLongestRest(2500);

struct Offset {
  int variable = 0;
  double angle = 0.0;  ///< rad
};

QString text_of(const Offset& offset, const geometric::RobotModel& model) {
  return QObject::tr("%1 is %2° away")
      .arg(QString::fromStdString(model.variable(offset.variable).name),
           QString::number(geometric::degrees(offset.angle), 'f', 1));
}

// Returns the offset of the joint that is farthest off.
Offset offset(const geometric::Configuration& a, const geometric::Configuration& b) {
  Offset farthest;
  farthest.angle = (a - b).cwiseAbs().maxCoeff(&farthest.variable);
  return farthest;
}

}  // namespace

DeviceSession::DeviceSession(Document& document, PathPlayer& player, MotionDriver& driver,
                             QObject* parent)
    : QObject(parent),
      document_(document),
      player_(player),
      panel_(new DevicesPanel),
      stop_(stop_controls_.make_button(QStringLiteral("devices_stop"))),
      driver_(driver) {
  connect(&stop_controls_, &StopControls::stop_requested, &driver_, &MotionDriver::stop);
  connect(panel_, &DevicesPanel::connect_requested, this, &DeviceSession::connect_devices);
  connect(panel_, &DevicesPanel::disconnect_requested, &driver_, &MotionDriver::disconnect_all);
  connect(panel_, &DevicesPanel::speed_changed, this, &DeviceSession::time_again);
  connect(panel_, &DevicesPanel::run_requested, this, &DeviceSession::run);
  connect(panel_, &DevicesPanel::hold_requested, this, [this](bool held) {
    driver_.hold(held);
    panel_->show_held(held);
    panel_->show_problem({});
  });
  connect(panel_, &DevicesPanel::mirror_changed, this, &DeviceSession::mirror);
  connect(panel_, &DevicesPanel::start_here_requested, this,
          [this] { emit start_here_requested(measured_); });
  connect(panel_, &DevicesPanel::margin_requested, this, &DeviceSession::margin_requested);
  connect(&driver_, &MotionDriver::part_begun, this, [this](int stage, const QString& name) {
    stage_ = static_cast<std::size_t>(stage);
    panel_->show_part(name);
  });
  connect(&player_, &PathPlayer::timeline_changed, this, [this] {
    if (task_) {
      return;
    }
    // The player's own times change nothing here: the user may have armed the motion meanwhile.
    const bool is_timed = motion_.value != nullptr || timing_.is_busy();
    if (!is_timed || !same_path(timed_path_, player_.timeline().path())) {
      time_again();
    }
  });
  connect(&document_, &Document::edited, this, &DeviceSession::take_edit);
  connect(&document_, &Document::opened, this, [this] {
    driver_.disconnect_all();
    task_.reset();
    running_task_.reset();
    safety_.following_error.resize(0);
    panel_->show_problem({});
    panel_->clear_outcome();
    panel_->show_state(driver_.state(), document_.robot() != nullptr);
    emit executed_changed({});
    time_again();
  });
  connect(&timing_, &TimingRunner::timed, this, [this](const DerivedMotion& motion) {
    motion_ = motion;
    if (task_) {
      panel_->show_task(task_->value.name, *motion.value);
    } else {
      panel_->show_motion(*motion.value, backwards_);
    }
  });
  connect(&timing_, &TimingRunner::failed, panel_, &DevicesPanel::show_no_motion);
  connect(&driver_, &MotionDriver::state_changed, this, &DeviceSession::on_state_changed);
  connect(&driver_, &MotionDriver::measured, this, &DeviceSession::take_measured);
  connect(&driver_, &MotionDriver::progressed, panel_, &DevicesPanel::show_progress);
  connect(&driver_, &MotionDriver::held, this, [this](const QString& reason) {
    panel_->show_held(true);
    panel_->show_problem(tr("Paused: %1").arg(reason));
    emit reported(false, tr("The robot is paused: %1").arg(reason));
  });
  connect(&driver_, &MotionDriver::ended, this, &DeviceSession::take_outcome);
  connect(&driver_, &MotionDriver::failed, this, [this](const QString& message) {
    panel_->show_problem(message);
    emit reported(false, message);
  });
  time_again();
}

std::filesystem::path DeviceSession::log_folder() {
  const QString data = QStandardPaths::writableLocation(QStandardPaths::AppDataLocation);
  return std::filesystem::path(data.toStdString()) / "motions";
}

void DeviceSession::connect_devices() {
  const auto problem = document_.problem() ? document_.problem()->if_ready() : nullptr;
  if (!problem) {
    panel_->show_problem(tr("The scene is still being prepared: try again in a moment."));
    return;
  }
  panel_->show_problem({});
  panel_->clear_outcome();
  emit executed_changed({});
  safety_.following_error.resize(0);  // other devices, perhaps
  driver_.connect_to(panel_->devices(), problem, document_.configuration());
}

void DeviceSession::time_again() {
  motion_ = {};
  timing_.forget();
  timed_from_ = measured_;
  const bool has_path = !player_.timeline().empty() && document_.problem();
  if (!task_ && !has_path) {
    panel_->show_no_motion(tr("Plan or open a path first."));
    return;
  }
  if (driver_.state() == State::kRunning) {
    panel_->show_no_motion(tr("Timing is recomputed when the robot stops."));
    return;
  }
  planning::TimingOptions options;
  options.speed = panel_->speed();
  options.period = kPeriod;
  options.safety = safety_;
  options.measured_start = measured_;
  options.start_tolerance = device::MotionTolerances{}.start;
  backwards_ = false;
  if (task_) {
    time_task(options);
  } else {
    time_path(options);
  }
}

void DeviceSession::time_task(const planning::TimingOptions& options) {
  if (measured_.size() > 0) {
    const Offset from_start = offset(measured_, *task_->value.scenes.front().scene->start);
    if (from_start.angle > options.start_tolerance) {
      panel_->show_no_motion(tr("The robot is not at the start of the task: %1.")
                                 .arg(text_of(from_start, *document_.robot()->model)));
      return;
    }
  }
  panel_->show_no_motion(tr("Timing the task…"));
  timing_.start(*task_, "task", options);
}

void DeviceSession::time_path(const planning::TimingOptions& options) {
  planning::Path path = player_.timeline().path();
  timed_path_ = path;
  if (measured_.size() > 0) {
    const Offset from_start = offset(measured_, path.waypoints.front());
    const Offset from_end = offset(measured_, path.waypoints.back());
    if (from_start.angle > options.start_tolerance && from_end.angle <= options.start_tolerance) {
      backwards_ = true;
      std::ranges::reverse(path.waypoints);
    } else if (from_start.angle > options.start_tolerance) {
      panel_->show_elsewhere(tr("The robot is not at the start of the path: %1.")
                                 .arg(text_of(from_start, *document_.robot()->model)));
      return;
    }
  }
  panel_->show_no_motion(tr("Timing the path…"));
  timing_.start(document_.problem(), std::move(path), "path", options);
}

// An edit revokes the clearance at once; the path is timed and checked in the new scene.
void DeviceSession::take_edit(const planning::SceneState& before) {
  if (before.scene == document_.scene() || !document_.problem()) {
    return;
  }
  driver_.follow(document_.problem());
  task_.reset();  // it was planned in the scene before
  time_again();
  if (timing_.is_busy()) {
    panel_->show_no_motion(tr("Out of date, the scene was edited: checking the path again…"));
  }
}

void DeviceSession::take_task(const DerivedSource& task) {
  if (task.made_from == document_.revision()) {
    task_ = task;
    time_again();
  }
}

void DeviceSession::forget_task() {
  if (task_) {
    task_.reset();
    time_again();
  }
}

void DeviceSession::set_margin(double margin) {
  if (std::exchange(safety_.margin, margin) != margin) {
    time_again();
  }
}

void DeviceSession::run() {
  if (!motion_.value || !motion_.value->cleared() || !panel_->is_armed()) {
    return;
  }
  if (motion_.made_from != document_.revision()) {
    panel_->show_problem(tr("The path is out of date: the scene was edited."));
    time_again();
    return;
  }
  const QString name = QDateTime::currentDateTime().toString(QStringLiteral("yyyy-MM-dd_hh-mm-ss"));
  std::error_code ignored;  // the log says whether it can be written
  std::filesystem::create_directories(log_folder(), ignored);
  panel_->show_problem({});
  panel_->clear_outcome();
  emit executed_changed({});
  panel_->show_part({});
  running_task_ = task_;
  const std::filesystem::path log = log_folder() / (name.toStdString() + ".csv");
  if (task_) {
    driver_.run_task(motion_.value, task_->value.scenes, log);
  } else {
    driver_.run(motion_.value, document_.problem(), log);
  }
}

void DeviceSession::on_state_changed(State state) {
  if (state == State::kOff) {
    measured_.resize(0);
    mirror();
    time_again();
  } else if (state == State::kConnected && !motion_.value) {
    time_again();  // what the motion that ran has kept from it
  }
  show_stop(state == State::kConnected || state == State::kRunning);
  panel_->show_state(state, document_.robot() != nullptr);
}

void DeviceSession::show_stop(bool active) {
  stop_controls_.set_active(active);
  if (active && !stop_keys_) {
    stop_keys_.emplace(static_cast<std::uint32_t>(stop_->window()->effectiveWinId()),
                       [this] { driver_.stop(); });
  } else if (!active) {
    stop_keys_.reset();
  }
}

bool DeviceSession::may_leave(QWidget& window) {
  if (driver_.state() != State::kRunning) {
    return true;
  }
  const auto answer =
      QMessageBox::warning(&window, tr("The robot is moving"), tr("Stop the robot and leave?"),
                           QMessageBox::Yes | QMessageBox::Cancel, QMessageBox::Cancel);
  if (answer != QMessageBox::Yes) {
    return false;
  }
  if (driver_.stop_and_wait(kLongestRest)) {
    return true;
  }
  const QString message =
      tr("STOP was sent, but no state at rest was measured: look at the robot.");
  panel_->show_problem(message);
  emit reported(false, message);
  return false;
}

void DeviceSession::take_measured(const Eigen::VectorXd& q) {
  const State state = driver_.state();
  if (state != State::kConnected && state != State::kRunning) {
    return;  // of a robot that may not be the scene's any more
  }
  const bool changed = measured_.size() != q.size() || !measured_.isApprox(q, kSameNumbers);
  measured_ = q;
  if (changed || document_.shows_measured() != panel_->mirrors()) {
    mirror();
  }
  show_carried();
  const bool moved =
      timed_from_.size() != q.size() || (timed_from_ - q).lpNorm<Eigen::Infinity>() > kSamePlace;
  if (moved && driver_.state() == State::kConnected) {
    time_again();
  }
}

void DeviceSession::show_carried() {
  if (!running_task_ || driver_.state() != State::kRunning || !panel_->mirrors()) {
    return;
  }
  const geometric::Scene& scene = *running_task_->value.scenes[stage_].scene;
  for (const geometric::SceneObject& object : scene.objects) {
    const geometric::SceneObject* edited = document_.state().find(object.name);
    const geometric::Pose X_WO = object_pose(scene, measured_, object);
    if (edited && !X_WO.isApprox(object_pose(*document_.scene(), measured_, *edited))) {
      emit carried(QString::fromStdString(object.name), X_WO);
    }
  }
}

void DeviceSession::mirror() {
  if (panel_->mirrors() && measured_.size() > 0) {
    document_.show_measured(measured_);
  } else {
    document_.hide_measured();
  }
}

void DeviceSession::take_outcome(const execution::MotionOutcome& outcome,
                                 const std::shared_ptr<const ExecutedMotion>& executed) {
  if (!document_.robot()) {
    return;
  }
  if (!outcome.started) {
    running_task_.reset();
    const QString reason = outcome.collision.empty() ? tr("It was stopped before the start.")
                                                     : QString::fromStdString(outcome.collision);
    panel_->show_problem(tr("Not started: %1").arg(reason));
    emit reported(false, tr("The robot was not started: %1").arg(reason));
    return;
  }
  if (!running_task_) {  // an object in the hand is no error of the devices
    safety_.following_error = executed->following_error(*document_.robot()->model);
  }
  panel_->show_outcome(outcome, executed, *document_.robot()->model);
  emit executed_changed(executed->link_path(*document_.robot(), document_.palm()));
  const auto task = std::exchange(running_task_, std::nullopt);
  if (task) {
    emit carried_ended();
  }
  emit reported(outcome.done, outcome.done ? tr("The robot ran the %1 in %2 s")
                                                 .arg(task ? tr("task") : tr("path"))
                                                 .arg(outcome.time, 0, 'f', 2)
                                           : tr("The robot stopped after %1 s: %2")
                                                 .arg(outcome.time, 0, 'f', 2)
                                                 .arg(cause_of(outcome)));
  if (task && outcome.done) {
    emit task_done(task->value.scenes.back());
  }
}

}  // namespace handway::gui
