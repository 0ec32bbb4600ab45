#include "model/devices/glove_session.h"

#include "handway/device/emulators/glove_signals.h"
#include "handway/device/glove/cyberglove.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/glove/landmark_glove.h"
#include "handway/device/glove/replay_glove.h"
#include "handway/device/retargeting/fingertip_retargeter.h"
#include "handway/device/retargeting/mapping_proposal.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/robot/composed_robot.h"
#include "handway/geometric/robot/group_proposal.h"

#include <QFileInfo>

#include <algorithm>
#include <exception>
#include <utility>

namespace handway::gui {

void RecordingTap::begin(const std::filesystem::path& file, device::RecordingHeader header,
                         device::RawColumns raw) {
  auto writer = std::make_unique<device::RecordingWriter>(file, std::move(header), std::move(raw));
  const std::lock_guard lock(mutex_);
  writer_ = std::move(writer);
  rows_ = 0;
  first_ = last_ = 0.0;
  error_.clear();
}

void RecordingTap::end() {
  const std::lock_guard lock(mutex_);
  writer_.reset();
}

void RecordingTap::take(const device::GloveFrame& frame) {
  const std::lock_guard lock(mutex_);
  if (!writer_) {
    return;
  }
  device::GloveFrame row = frame;
  if (rows_ == 0) {
    first_ = frame.time;
  }
  row.time -= first_;
  try {
    writer_->append(row);
    last_ = frame.time;
    ++rows_;
  } catch (const std::exception& error) {
    error_ = error.what();
    writer_.reset();
  }
}

bool RecordingTap::is_on() const {
  const std::lock_guard lock(mutex_);
  return writer_ != nullptr;
}

std::size_t RecordingTap::rows() const {
  const std::lock_guard lock(mutex_);
  return rows_;
}

double RecordingTap::duration() const {
  const std::lock_guard lock(mutex_);
  return last_ - first_;
}

std::string RecordingTap::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

void RetargetingTap::set(std::shared_ptr<const device::FingertipRetargeter> retargeter,
                         const device::GloveCalibration& calibration) {
  const std::lock_guard lock(mutex_);
  if (retargeter != retargeter_) {
    last_ = retargeter ? retargeter->middle() : Eigen::VectorXd();
    retargeter_ = std::move(retargeter);
  }
  calibration_ = calibration;
}

ArrivedFrame RetargetingTap::take(const device::GloveFrame& frame) {
  const std::lock_guard lock(mutex_);
  if (retargeter_) {
    last_ = retargeter_->posture(retargeter_->landmarks(to_angles(frame, calibration_)), last_);
  }
  return {frame, retargeter_, last_};
}

using device::StreamState;

GloveLink::GloveLink(QObject* parent)
    : DeviceLink(parent),
      tap_(std::make_shared<RecordingTap>()),
      retargeting_(std::make_shared<RetargetingTap>()) {}

void GloveLink::start(std::unique_ptr<device::Glove> glove,
                      std::unique_ptr<device::GloveEmulator> emulator) {
  const auto tapped = [tap = tap_, retargeting = retargeting_](const device::GloveFrame& frame) {
    tap->take(frame);
    return retargeting->take(frame);
  };
  run(std::move(glove), std::move(emulator), tapped,
      [this](const Items& frames) { emit arrived(frames); });
}

namespace {

constexpr std::uint64_t kEmulatorSeed = 1;

}  // namespace

GloveSession::GloveSession(QObject* parent)
    : QObject(parent), typical_(device::typical_calibration()), mapping_(device::table1_mapping()) {
  QObject::connect(&link_, &GloveLink::state_changed, this, &GloveSession::state_changed);
  QObject::connect(&link_, &GloveLink::arrived, this,
                   [this](const std::vector<ArrivedFrame>& frames) {
                     std::vector<GloveSample> samples;
                     samples.reserve(frames.size());
                     for (const ArrivedFrame& arrived : frames) {
                       samples.push_back(sample_of(arrived.frame));
                       if (retargeter_ && arrived.retargeter == retargeter_) {
                         samples.back().retargeted = arrived.retargeted;
                       }
                     }
                     emit sampled(samples);
                   });
  QObject::connect(&preparing_, &LatestJob::failed, this,
                   [this](const QString& error) { take_retargeter(nullptr, error); });
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
  } else if (device::is_landmark_address(device.toStdString())) {
    link_.start(std::make_unique<device::LandmarkGlove>(device.toStdString()));
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
  preparing_.cancel();
  retargeter_.reset();
  retargeting_error_.clear();
  update_tap();
  rebuild_mapper();
  if (model_ && !mapper_) {
    propose_mapping();
  }
  if (method_ == PostureMethod::kFingertips) {
    emit source_changed();
    prepare_retargeting();
  }
}

namespace {

/// The paper's Table 1, or else another mapping that ships, if it fits the robot.
std::optional<device::HandMapping> shipped_mapping(const geometric::RobotModel& model) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(geometric::resource_dir() / "mappings")) {
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  std::vector<device::HandMapping> mappings{device::table1_mapping()};
  for (const std::filesystem::path& file : files) {
    if (!device::is_retargeting(file)) {
      mappings.push_back(device::read_mapping(file));
    }
  }
  const std::vector<std::string> hand = geometric::propose_groups(model).hand;
  const auto independent = static_cast<std::size_t>(std::ranges::count_if(
      hand, [&](const std::string& joint) { return model.find_variable(joint).has_value(); }));
  const auto found = std::ranges::find_if(mappings, [&](const device::HandMapping& mapping) {
    return mapping.joints.size() >= independent &&
           std::ranges::all_of(mapping.joints, [&](const device::JointMapping& mapped) {
             return geometric::find_variable_of_part(model, mapped.joint).has_value();
           });
  });
  return found == mappings.end() ? std::nullopt : std::optional(*found);
}

}  // namespace

void GloveSession::propose_mapping() {
  try {
    const std::optional<device::HandMapping> shipped = shipped_mapping(*model_);
    set_mapping(shipped ? *shipped : device::propose_mapping(*model_));
  } catch (const std::exception& error) {
    mapping_error_ = QString::fromUtf8(error.what());
  }
}

void GloveSession::set_calibration(std::optional<device::GloveCalibration> calibration) {
  const device::GloveCalibration before = this->calibration();
  chosen_ = std::move(calibration);
  if (before.bones != this->calibration().bones && (retargeter_ || preparing_.is_busy())) {
    preparing_.cancel();
    take_retargeter(nullptr, {});
    prepare_retargeting();
  }
  update_tap();
  const bool same_ranges = before.ranges == this->calibration().ranges;
  if (!same_ranges) {
    rebuild_mapper();
  }
  if (same_ranges || method_ != PostureMethod::kJointMapping) {
    emit source_changed();  // Recorded counts mean other angles now.
  }
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
      mapper_.emplace(mapping_, *model_, false, calibration().ranges);
    } catch (const std::exception& error) {
      mapping_error_ = QString::fromUtf8(error.what());
    }
  }
  emit mapping_changed();
  if (method_ == PostureMethod::kJointMapping) {
    emit source_changed();
  }
}

void GloveSession::set_method(PostureMethod method) {
  if (method_ == method) {
    return;
  }
  method_ = method;
  update_tap();
  emit source_changed();
  if (method_ == PostureMethod::kFingertips) {
    prepare_retargeting();
  }
}

// Solids for self-collision take a while.
void GloveSession::prepare_retargeting() {
  if (!model_ || retargeter_ || !retargeting_error_.isEmpty() || preparing_.is_busy()) {
    return;
  }
  device::RetargetingSettings settings;
  settings.bones = calibration().bones.value_or(settings.bones);
  preparing_.run([this, model = model_, settings](const std::stop_token&) {
    const auto made =
        std::make_shared<const device::FingertipRetargeter>(geometric::hand_alone(model), settings);
    return [this, made] { take_retargeter(made, {}); };
  });
}

void GloveSession::take_retargeter(std::shared_ptr<const device::FingertipRetargeter> retargeter,
                                   const QString& error) {
  retargeter_ = std::move(retargeter);
  retargeting_error_ = error;
  update_tap();
  emit retargeting_prepared();
  if (method_ == PostureMethod::kFingertips) {
    emit source_changed();
  }
}

void GloveSession::update_tap() {
  link_.retargeting().set(method_ == PostureMethod::kFingertips ? retargeter_ : nullptr,
                          calibration());
}

const device::PostureSource* GloveSession::source() const {
  return method_ == PostureMethod::kFingertips
             ? static_cast<const device::PostureSource*>(retargeter_.get())
             : mapper();
}

GloveSample GloveSession::sample_of(const device::GloveFrame& frame) const {
  GloveSample sample{frame, to_angles(frame, calibration()), {}, {}, {}};
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
