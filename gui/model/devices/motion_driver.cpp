#include "model/devices/motion_driver.h"

#include "handway/device/emulators/arm_emulator.h"
#include "handway/device/emulators/hand_emulator.h"
#include "handway/execution/motion/motion_log.h"
#include "handway/execution/motion/motion_target.h"
#include "model/devices/executed_motion.h"

#include <QStringList>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <mutex>
#include <utility>

namespace handway::gui {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kNewsPeriod(33);
constexpr std::chrono::milliseconds kIdlePause(4);

execution::SceneWatch::ProblemSource source_of(std::shared_ptr<const PreparedProblem> scene) {
  return [scene = std::move(scene)](const std::stop_token& stop) { return scene->wait(stop); };
}

double farthest(const std::vector<execution::FollowingError>& errors) {
  double error = 0.0;
  for (const execution::FollowingError& device : errors) {
    error = std::max(error, device.max().maxCoeff());
  }
  return error;
}

}  // namespace

// Emulators outlive the connections to them.
struct MotionDriver::Devices {
  std::vector<std::unique_ptr<device::RobotEmulator>> emulators;
  std::vector<execution::MotionTarget> targets;
  geometric::Configuration q;  ///< Joints without a device.

  Devices(const MotionDevices& wanted, const planning::PlanningProblem& problem,
          const geometric::Configuration& shown)
      : q(shown) {
    QStringList addresses;
    const auto as_shown = [&](const char* kind, auto settings) {
      const geometric::JointIndices variables = problem.joints.of_part(kind);
      settings.joints = execution::device_joints(problem.model(), variables);
      settings.position = shown(variables).cwiseMax(settings.joints.lower);
      settings.position = settings.position.cwiseMin(settings.joints.upper);
      return settings;
    };
    if (wanted.emulated_arm) {
      emulators.push_back(std::make_unique<device::ArmEmulator>(
          as_shown("arm", device::Val3ControllerSettings()), 0));
    }
    if (wanted.emulated_hand) {
      emulators.push_back(std::make_unique<device::HandEmulator>(
          as_shown("hand", device::HandControllerSettings()), 0));
    }
    for (const auto& emulator : emulators) {
      addresses << QString::fromStdString(emulator->address());
    }
    if (!wanted.addresses.isEmpty()) {
      addresses << wanted.addresses;
    }
    targets = execution::parse_targets(addresses.join(QLatin1Char(',')).toStdString(), problem);
  }
};

// Keeps what was executed, and notifies the window now and then.
class MotionDriver::Recorder final : public execution::MotionObserver {
 public:
  Recorder(MotionDriver& driver, const Devices& devices, const Order& order)
      : driver_(driver),
        devices_(devices),
        log_(order.log, devices.targets),
        parts_(order.parts),
        duration_(duration_of(order.parts)),
        executed_(std::make_shared<ExecutedMotion>()) {
    executed_->start = execution::with_measured(devices.q, devices.targets);
    executed_->log = order.log;
    for (const execution::MotionTarget& target : devices.targets) {
      executed_->devices.push_back({target.kind, target.variables, {}});
    }
  }

  void on_sample(const execution::MotionSample& sample) override {
    log_.add(sample.time, sample.target, sample.planned, sample.measured);
    executed_->devices[sample.target].samples.push_back(sample);
  }
  void on_progress(double time, const std::vector<execution::FollowingError>& errors) override {
    if (Clock::now() < next_) {
      return;
    }
    next_ = Clock::now() + kNewsPeriod;
    driver_.notify([&driver = driver_, time = std::min(time, duration_), duration = duration_,
                    error = farthest(errors),
                    q = execution::with_measured(devices_.q, devices_.targets)] {
      emit driver.measured(q);
      emit driver.progressed(time, duration, error);
    });
  }

  void on_part(std::size_t part) override {
    driver_.notify([&driver = driver_, stage = static_cast<int>(parts_[part].stage),
                    name = QString::fromStdString(parts_[part].name)] {
      emit driver.part_begun(stage, name);
    });
  }
  void on_held(const std::string& reason) override {
    driver_.notify(
        [&driver = driver_, reason = QString::fromStdString(reason)] { emit driver.held(reason); });
  }

  [[nodiscard]] bool log_is_whole() const { return log_.good(); }
  [[nodiscard]] std::shared_ptr<const ExecutedMotion> executed() const { return executed_; }

 private:
  MotionDriver& driver_;
  const Devices& devices_;
  execution::MotionLog log_;
  const std::vector<execution::MotionPart>& parts_;
  double duration_;
  std::shared_ptr<ExecutedMotion> executed_;
  Clock::time_point next_;
};

MotionDriver::MotionDriver(QObject* parent) : QObject(parent) {}

MotionDriver::~MotionDriver() {
  blockSignals(true);
  stop();
  thread_.request_stop();
}

template <typename F>
void MotionDriver::notify(F&& news) {
  QMetaObject::invokeMethod(this, std::forward<F>(news), Qt::QueuedConnection);
}

void MotionDriver::set_state(State state) {
  if (state_ != state && !(state_ == State::kClosing && state != State::kOff)) {
    state_ = state;
    emit state_changed(state);
  }
}

void MotionDriver::connect_to(const MotionDevices& devices, Problem problem,
                              geometric::Configuration q) {
  set_state(State::kConnecting);
  {
    const std::lock_guard lock(mutex_);
    working_ = true;
  }
  thread_ = std::jthread(
      [this, devices, problem = std::move(problem), q = std::move(q)](const std::stop_token& stop) {
        work(devices, problem, q, stop);
        notify([this] {
          requests_.reset();
          set_state(State::kOff);
        });
        const std::lock_guard lock(mutex_);
        order_.reset();
        moves_ = false;
        working_ = false;
        ended_.notify_all();
      });
}

void MotionDriver::disconnect_all() {
  if (state_ != State::kOff) {
    set_state(State::kClosing);
    stop();
    thread_.request_stop();
  }
}

void MotionDriver::run(std::shared_ptr<const planning::TimedPath> motion,
                       std::shared_ptr<const PreparedProblem> scene, std::filesystem::path log) {
  runs_task_ = false;
  std::vector<execution::MotionPart> parts{
      {.trajectory = motion->motion.trajectory, .scene = source_of(std::move(scene))}};
  begin(std::move(motion), std::move(parts), std::move(log));
}

void MotionDriver::run_task(std::shared_ptr<const planning::TimedPath> motion,
                            const std::vector<planning::SceneState>& stages,
                            std::filesystem::path log) {
  runs_task_ = true;
  std::vector<execution::MotionPart> parts = execution::parts_of(motion->motion, stages);
  begin(std::move(motion), std::move(parts), std::move(log));
}

void MotionDriver::begin(std::shared_ptr<const planning::TimedPath> motion,
                         std::vector<execution::MotionPart> parts, std::filesystem::path log) {
  const execution::MotionPart& first = parts.front();
  watch_ = std::make_shared<execution::SceneWatch>(first.trajectory, first.scene);
  requests_ = std::make_shared<execution::MotionRequests>();
  requests_->watch = watch_.get();
  set_state(State::kRunning);
  const std::lock_guard lock(mutex_);
  motion_stop_ = {};
  requests_->stop = motion_stop_.get_token();
  moves_ = true;
  rested_ = true;
  order_ = Order{std::move(motion), std::move(parts), std::move(log), requests_, watch_};
  wake_.notify_one();
}

void MotionDriver::follow(std::shared_ptr<const PreparedProblem> scene) {
  if (state_ != State::kRunning) {
    return;
  }
  if (runs_task_) {
    watch_->revoke(
        tr("The scene was edited: stop the robot, and plan the task again.").toStdString());
  } else {
    watch_->follow(source_of(std::move(scene)));
  }
}

void MotionDriver::hold(bool held) {
  if (requests_) {
    requests_->hold = held;
  }
}

void MotionDriver::stop() {
  const std::lock_guard lock(mutex_);
  motion_stop_.request_stop();
}

bool MotionDriver::stop_and_wait(std::chrono::milliseconds longest) {
  std::unique_lock lock(mutex_);
  if (!moves_) {
    return true;
  }
  motion_stop_.request_stop();
  return ended_.wait_for(lock, longest, [this] { return !moves_; }) && rested_;
}

bool MotionDriver::end(std::chrono::milliseconds longest) {
  thread_.request_stop();
  std::unique_lock lock(mutex_);
  const bool moved = moves_;
  motion_stop_.request_stop();
  return ended_.wait_for(lock, longest, [this] { return !working_; }) && (!moved || rested_);
}

void MotionDriver::note_end(bool rested) {
  const std::lock_guard lock(mutex_);
  moves_ = false;
  rested_ = rested;
  ended_.notify_all();
}

void MotionDriver::work(const MotionDevices& wanted, const Problem& problem,
                        const geometric::Configuration& q, const std::stop_token& stop) {
  try {
    Devices devices(wanted, *problem, q);
    for (const execution::MotionTarget& target : devices.targets) {
      target.link->connect(stop);
    }
    notify([this] { set_state(State::kConnected); });
    serve(devices, stop);
  } catch (const std::exception& error) {
    if (!stop.stop_requested()) {
      notify([this, message = QString::fromUtf8(error.what())] { emit failed(message); });
    }
  }
}

void MotionDriver::serve(Devices& devices, const std::stop_token& stop) {
  auto next = Clock::now();
  while (!stop.stop_requested()) {
    std::optional<Order> order;
    {
      std::unique_lock lock(mutex_);
      wake_.wait_for(lock, stop, kIdlePause, [this] { return order_.has_value(); });
      order = std::exchange(order_, std::nullopt);
    }
    if (order) {
      if (!carry_out(devices, *order)) {
        return;
      }
      continue;
    }
    for (const execution::MotionTarget& target : devices.targets) {
      target.link->update();
      if (!target.link->fault().empty()) {
        notify([this, message = QString::fromStdString(target.link->fault())] {
          emit failed(message);
        });
        return;
      }
    }
    if (Clock::now() >= next) {
      next = Clock::now() + kNewsPeriod;
      notify(
          [this, q = execution::with_measured(devices.q, devices.targets)] { emit measured(q); });
    }
  }
}

bool MotionDriver::carry_out(Devices& devices, const Order& order) {
  try {
    const planning::Motion& motion = order.motion->motion;
    execution::check_that_the_rest_stands(*motion.model, motion.path, devices.targets);
    Recorder recorder(*this, devices, order);
    const execution::MotionOutcome outcome =
        run_parts(devices.targets, order.parts, {}, *order.requests, recorder);
    note_end(outcome.done || outcome.at_rest_ms >= 0.0);
    notify([this, outcome, executed = recorder.executed(), whole = recorder.log_is_whole()] {
      set_state(State::kConnected);
      emit ended(outcome, executed);
      if (!whole) {
        emit failed(tr("The log could not be written to its end."));
      }
    });
    return outcome.fault.empty();
  } catch (const std::exception& error) {
    note_end(true);  // it has not begun
    notify([this, message = QString::fromUtf8(error.what())] {
      set_state(State::kConnected);
      emit failed(message);
    });
    return true;
  }
}

}  // namespace handway::gui
