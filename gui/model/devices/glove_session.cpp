#include "model/devices/glove_session.h"

#include "handway/device/glove/cyberglove.h"
#include "handway/device/glove/glove_signals.h"
#include "handway/device/glove/replay_glove.h"
#include "handway/geometric/io/input_error.h"

#include <QFileInfo>

#include <exception>
#include <utility>

namespace handway::gui {
namespace {

using device::StreamState;

constexpr std::uint64_t kEmulatorSeed = 1;

}  // namespace

GloveSession::GloveSession(QObject* parent)
    : QObject(parent), typical_(device::typical_calibration()), mapping_(device::table1_mapping()) {
  QObject::connect(&link_, &GloveLink::state_changed, this, &GloveSession::state_changed);
  QObject::connect(&link_, &GloveLink::arrived, this,
                   [this](const std::vector<device::GloveFrame>& frames) {
                     std::vector<GloveSample> samples;
                     samples.reserve(frames.size());
                     for (const device::GloveFrame& frame : frames) {
                       samples.push_back(sample_of(frame));
                     }
                     emit sampled(samples);
                   });
}

GloveSession::~GloveSession() { link_.blockSignals(true); }

QString GloveSession::emulator_name() { return tr("Emulator"); }

void GloveSession::connect_to(const QString& device) {
  try {
    start(device.trimmed());
  } catch (const std::exception& error) {
    link_.stop();
    emit state_changed(StreamState::kFailed, QString::fromUtf8(error.what()));
  }
}

void GloveSession::start(const QString& device) {
  device_ = device;
  if (device.compare(emulator_name(), Qt::CaseInsensitive) == 0) {
    auto emulator = std::make_unique<device::GloveEmulator>(
        device::GloveEmulatorSettings{}, device::exploring_hand_signal(kEmulatorSeed));
    auto glove = std::make_unique<device::CyberGlove>(emulator->address());
    link_.start(std::move(glove), std::move(emulator));
  } else if (QFileInfo(device).isFile()) {
    const device::Recording recording = device::read_recording(device.toStdString());
    link_.start(std::make_unique<device::ReplayGlove>(recording, device.toStdString(),
                                                      device::ReplaySettings{1.0, true}));
  } else {
    if (device.isEmpty()) {
      throw geometric::InputError({"device", "", "nothing", "a serial port or HOST:PORT",
                                   "Choose a device, or Emulator to try without one"});
    }
    link_.start(std::make_unique<device::CyberGlove>(device.toStdString()));
  }
}

void GloveSession::disconnect_glove() { link_.stop(); }

void GloveSession::set_robot(std::shared_ptr<const geometric::RobotModel> model) {
  model_ = std::move(model);
  rebuild_mapper();
}

void GloveSession::set_calibration(std::optional<device::GloveCalibration> calibration) {
  chosen_ = std::move(calibration);
}

const device::GloveCalibration& GloveSession::calibration() const {
  return chosen_ ? *chosen_ : typical_;
}

void GloveSession::set_mapping(device::HandMapping mapping) {
  mapping_ = std::move(mapping);
  rebuild_mapper();
}

void GloveSession::rebuild_mapper() {
  mapper_.reset();
  mapping_error_.clear();
  if (model_) {
    try {
      mapper_.emplace(mapping_, *model_);
    } catch (const std::exception& error) {
      mapping_error_ = QString::fromUtf8(error.what());
    }
  }
  emit mapping_changed();
}

GloveSample GloveSession::sample_of(const device::GloveFrame& frame) const {
  GloveSample sample{frame, to_angles(frame, calibration()), {}, {}};
  if (mapper_) {
    sample.unclamped = mapper_->unclamped(sample.angles);
    sample.posture = sample.unclamped.cwiseMax(mapper_->lower()).cwiseMin(mapper_->upper());
  }
  return sample;
}

void GloveSession::set_following(bool follow) {
  if (following_ != follow) {
    following_ = follow;
    emit following_changed(follow);
  }
}

}  // namespace handway::gui
