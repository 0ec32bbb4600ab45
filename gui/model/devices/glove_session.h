#pragma once

#include "handway/device/emulators/glove_emulator.h"
#include "handway/device/glove/glove.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/hand_mapper.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/device/glove/recording.h"
#include "handway/device/retargeting/fingertip_retargeter.h"
#include "handway/geometric/robot/robot_model.h"
#include "model/devices/stream_link.h"
#include "model/jobs/background.h"

#include <QObject>
#include <QString>

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace handway::gui {

/// Methods that make postures of the robot's hand from those of a person's.
enum class PostureMethod { kJointMapping, kFingertips };

/// One frame of a glove, and what calibration, mapping and retargeting make of it.
struct GloveSample {
  device::GloveFrame frame;
  device::GloveAngles angles;
  Eigen::VectorXd unclamped;   ///< rad, as mapped, shape [mapped joints]; empty without mapping.
  Eigen::VectorXd posture;     ///< rad, within limits, shape [mapped joints].
  Eigen::VectorXd retargeted;  ///< rad, shape [retargeted joints]; empty unless that is chosen.
};

/// A frame, and the posture that retargeting made of it.
struct ArrivedFrame {
  device::GloveFrame frame;
  std::shared_ptr<const device::FingertipRetargeter> retargeter = nullptr;  ///< Null: none.
  Eigen::VectorXd retargeted = {};
};

/// Retargets the frames that pass by, one after the other, while it has something to do so with.
/// For any thread.
class RetargetingTap {
 public:
  /// @param retargeter null: frames pass by.
  void set(std::shared_ptr<const device::FingertipRetargeter> retargeter,
           const device::GloveCalibration& calibration);

  [[nodiscard]] ArrivedFrame take(const device::GloveFrame& frame);

 private:
  std::mutex mutex_;
  std::shared_ptr<const device::FingertipRetargeter> retargeter_;
  device::GloveCalibration calibration_;
  Eigen::VectorXd last_;
};

/// Writes the frames that pass by into a recording, row by row as they come, while it is
/// switched on. For any thread.
class RecordingTap {
 public:
  /// Starts a new file.
  /// @param raw names and units of the source's columns.
  /// @throws geometric::InputError if it can't be written.
  void begin(const std::filesystem::path& file, device::RecordingHeader header,
             device::RawColumns raw = {});
  /// Closes the file.
  void end();

  void take(const device::GloveFrame& frame);

  [[nodiscard]] bool is_on() const;
  [[nodiscard]] std::size_t rows() const;
  /// Returns the time from the first row to the last, s.
  [[nodiscard]] double duration() const;
  /// Returns the error in writing rows; empty if all were written.
  [[nodiscard]] std::string error() const;

 private:
  mutable std::mutex mutex_;
  std::unique_ptr<device::RecordingWriter> writer_;
  std::size_t rows_ = 0;
  double first_ = 0.0;
  double last_ = 0.0;
  std::string error_;
};

/// A glove's stream brought to the window's thread. The taps see every frame, on the stream's
/// thread.
class GloveLink : public DeviceLink<device::Glove, ArrivedFrame> {
  Q_OBJECT

 public:
  explicit GloveLink(QObject* parent = nullptr);

  /// Replaces the stream.
  /// @param emulator that the glove talks to, kept as long; may be null.
  void start(std::unique_ptr<device::Glove> glove,
             std::unique_ptr<device::GloveEmulator> emulator = nullptr);

  [[nodiscard]] RecordingTap& tap() { return *tap_; }
  [[nodiscard]] RetargetingTap& retargeting() { return *retargeting_; }

 signals:
  /// Frames since the last time, oldest first, never none.
  void arrived(const std::vector<handway::gui::ArrivedFrame>& frames);

 private:
  std::shared_ptr<RecordingTap> tap_;
  std::shared_ptr<RetargetingTap> retargeting_;
};

/// The glove that the workbench listens to: its link, calibration, and what makes postures of the
/// scene's hand: a mapping of its joints, or retargeting by its fingertips.
class GloveSession : public QObject {
  Q_OBJECT

 public:
  explicit GloveSession(QObject* parent = nullptr);
  ~GloveSession() override;

  /// Returns the name that stands for the built-in emulator among devices.
  [[nodiscard]] static QString emulator_name();

  /// Connects to a serial port, a TCP port, a stream of hand landmarks (see
  /// device::is_landmark_address()), the emulator, or a recording to be replayed. Errors are
  /// reported by state_changed().
  void connect_to(const QString& device);
  void disconnect_glove();
  [[nodiscard]] const QString& device() const { return device_; }
  [[nodiscard]] GloveLink& link() { return link_; }

  /// A mapping that doesn't fit gives way to the paper's Table 1, or to one that is proposed for
  /// the hand. @param model null: no robot.
  void set_robot(std::shared_ptr<const geometric::RobotModel> model);
  /// Returns the robot; null if there is none.
  [[nodiscard]] const std::shared_ptr<const geometric::RobotModel>& robot() const { return model_; }
  /// Sets the calibration: its ranges are used by the mapping, its bones by retargeting. Nothing:
  /// the typical one.
  void set_calibration(std::optional<device::GloveCalibration> calibration);
  void set_mapping(device::HandMapping mapping);
  [[nodiscard]] const device::GloveCalibration& calibration() const;
  [[nodiscard]] const device::HandMapping& mapping() const { return mapping_; }
  /// The mapping made ready for the robot; nullptr if it doesn't fit, see mapping_error().
  [[nodiscard]] const device::HandMapper* mapper() const { return mapper_ ? &*mapper_ : nullptr; }
  [[nodiscard]] const QString& mapping_error() const { return mapping_error_; }
  /// Calibrated and mapped.
  [[nodiscard]] GloveSample sample_of(const device::GloveFrame& frame) const;

  void set_method(PostureMethod method);
  [[nodiscard]] PostureMethod method() const { return method_; }
  /// Finds the fingers of the hand, in the background, unless that is done.
  void prepare_retargeting();
  /// Returns the retargeter; nullptr before prepare_retargeting() has ended, or if the hand can't
  /// be retargeted, see retargeting_error().
  [[nodiscard]] const std::shared_ptr<const device::FingertipRetargeter>& retargeter() const {
    return retargeter_;
  }
  [[nodiscard]] const QString& retargeting_error() const { return retargeting_error_; }
  /// Returns the source of postures of the chosen method; nullptr if it isn't available.
  [[nodiscard]] const device::PostureSource* source() const;
  /// The posture by the chosen method, shape [joints of source()]; empty if there is none.
  [[nodiscard]] const Eigen::VectorXd& posture_of(const GloveSample& sample) const {
    return method_ == PostureMethod::kFingertips ? sample.retargeted : sample.posture;
  }

  /// The mapping does not move the hand while this is off.
  void set_following(bool follow);
  [[nodiscard]] bool following() const { return following_; }

 signals:
  void state_changed(handway::device::StreamState state, const QString& error);
  /// All frames since the last time, the latest last.
  void sampled(const std::vector<handway::gui::GloveSample>& samples);
  void mapping_changed();
  /// Emitted when source() is another one, or none.
  void source_changed();
  /// prepare_retargeting() has ended.
  void retargeting_prepared();
  void following_changed(bool follow);

 private:
  void start(const QString& device);
  void rebuild_mapper();
  void propose_mapping();
  void take_retargeter(std::shared_ptr<const device::FingertipRetargeter> retargeter,
                       const QString& error);
  void update_tap();

  GloveLink link_;
  QString device_;
  std::shared_ptr<const geometric::RobotModel> model_;
  device::GloveCalibration typical_;
  std::optional<device::GloveCalibration> chosen_;
  device::HandMapping mapping_;
  std::optional<device::HandMapper> mapper_;
  QString mapping_error_;
  PostureMethod method_ = PostureMethod::kJointMapping;
  std::shared_ptr<const device::FingertipRetargeter> retargeter_;
  QString retargeting_error_;
  LatestJob preparing_;
  bool following_ = true;
};

}  // namespace handway::gui
