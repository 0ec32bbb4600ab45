#include "model/devices/tracker_session.h"

#include "handway/device/emulators/tracker_signals.h"
#include "handway/device/emulators/tracker_units.h"
#include "handway/device/tracker/polhemus_tracker.h"
#include "handway/device/tracker/udp_tracker.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/arm_inverse_kinematics.h"

#include <exception>
#include <memory>
#include <utility>

namespace handway::gui {

using device::StreamState;

void TrackerLink::start(std::unique_ptr<device::Tracker> tracker,
                        std::unique_ptr<device::DeviceEmulator> emulator) {
  run(
      std::move(tracker), std::move(emulator),
      [](const device::TrackerSample& sample) { return sample; },
      [this](const Items& samples) { emit arrived(samples); });
}

namespace {

constexpr std::uint64_t kTrackerSeed = 1;

std::unique_ptr<device::Tracker> polhemus(device::PolhemusModel model, const std::string& address) {
  device::PolhemusSettings settings;
  settings.model = model;
  return std::make_unique<device::PolhemusTracker>(address, settings);
}

}  // namespace

TrackerSession::TrackerSession(QObject* parent) : QObject(parent) {
  connect(&link_, &TrackerLink::state_changed, this, &TrackerSession::state_changed);
  connect(&link_, &TrackerLink::arrived, this, &TrackerSession::sampled);
}

TrackerSession::~TrackerSession() { link_.blockSignals(true); }

QStringList TrackerSession::protocols() {
  return {QStringLiteral("emulator"), QStringLiteral("fastrak"), QStringLiteral("liberty"),
          QStringLiteral("udp")};
}

void TrackerSession::connect_to(const QString& device) {
  device_ = device.trimmed();
  const QString protocol = device_.section(QLatin1Char(':'), 0, 0).toLower();
  try {
    start(protocol, device_.mid(protocol.size() + 1).trimmed());
  } catch (const std::exception& error) {
    link_.stop();
    emit state_changed(StreamState::kFailed, QString::fromUtf8(error.what()));
  }
}

void TrackerSession::start(const QString& protocol, const QString& address) {
  if (protocol == QLatin1String("emulator")) {
    auto emulator = std::make_unique<device::DeviceEmulator>(
        device::DeviceEmulatorSettings{},
        device::make_fastrak_unit({}, device::wrist_motion_signal(kTrackerSeed)));
    auto tracker = polhemus(device::PolhemusModel::kFastrak, emulator->address());
    link_.start(std::move(tracker), std::move(emulator));
    return;
  }
  if (!protocols().contains(protocol)) {
    throw geometric::InputError({"tracker", "", protocol.toStdString(),
                                 protocols().join(QStringLiteral(", ")).toStdString(),
                                 "Write, for example, fastrak:/dev/ttyUSB0"});
  }
  if (address.isEmpty()) {
    throw geometric::InputError({"tracker", "", "no address",
                                 protocol == QLatin1String("udp") ? "a port to hear datagrams on"
                                                                  : "a serial port or HOST:PORT",
                                 "Fill it in, or choose the emulator to try without a tracker"});
  }
  if (protocol == QLatin1String("udp")) {
    link_.start(std::make_unique<device::UdpTracker>(address.toStdString()));
  } else {
    link_.start(polhemus(protocol == QLatin1String("liberty") ? device::PolhemusModel::kLiberty
                                                              : device::PolhemusModel::kFastrak,
                         address.toStdString()));
  }
}

void TrackerSession::disconnect_tracker() { link_.stop(); }

namespace {

using geometric::InverseKinematics;
using geometric::RobotModel;

// In closed form if the arm allows it, else by iteration from where it is, briefly.
std::unique_ptr<InverseKinematics> make_kinematics(const std::shared_ptr<const RobotModel>& model,
                                                   int tool) {
  geometric::NumericIkOptions options;
  options.max_iterations = 30;
  options.max_restarts = 0;
  return geometric::make_arm_inverse_kinematics(model, tool,
                                                geometric::chain_variables(*model, tool), options);
}

}  // namespace

ArmLeader::ArmLeader(QObject* parent) : QObject(parent), problem_(tr("There is no robot")) {}

void ArmLeader::set_robot(const std::shared_ptr<const RobotModel>& model,
                          const std::vector<int>& arm, const geometric::Configuration& q) {
  set_clutch(false);
  ik_.reset();
  joints_.clear();
  q_ = q;
  if (!model || arm.empty()) {
    problem_ = model ? tr("The robot has no arm") : tr("There is no robot");
    return;
  }
  try {
    ik_ = make_kinematics(model, model->variable_link(arm.back()));
    for (const int variable : ik_->variables()) {
      joints_.push_back(model->variable(variable).name);
    }
    problem_.clear();
  } catch (const std::exception& error) {
    problem_ = QString::fromUtf8(error.what());
  }
}

void ArmLeader::set_settings(const device::ToolFollowerSettings& settings) {
  settings_ = settings;
  if (closed_) {
    take_hold();
  }
}

std::optional<Eigen::Vector3d> ArmLeader::tool_position() const {
  if (!ik_) {
    return std::nullopt;
  }
  return device::ToolFollower(ik_, q_).tool_pose().translation();
}

void ArmLeader::take_hold() {
  follower_.emplace(ik_, q_, settings_);
  follower_->engage();
}

void ArmLeader::set_clutch(bool closed) {
  closed = closed && ik_;
  if (closed == closed_) {
    return;
  }
  closed_ = closed;
  if (closed) {
    take_hold();
  } else {
    follower_.reset();
  }
  emit clutch_changed(closed);
}

void ArmLeader::take(const device::TrackerSample& sample) {
  if (!follower_) {
    return;
  }
  const device::FollowStep step = follower_->update(sample);
  if (!follower_->engaged()) {
    set_clutch(false);
  } else {
    geometric::NamedPosture posture;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      posture.values[joints_[j]] = step.q[ik_->variables()[j]];
    }
    emit wanted(posture);
  }
  emit followed(step);
}

}  // namespace handway::gui
