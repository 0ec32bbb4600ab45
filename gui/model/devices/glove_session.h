#pragma once

#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/hand_mapper.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/geometric/robot/robot_model.h"
#include "model/devices/glove_link.h"
#include "model/devices/glove_sample.h"

#include <QObject>
#include <QString>

#include <memory>
#include <optional>
#include <vector>

namespace handway::gui {

/// The glove that the workbench listens to: its link, calibration, and mapping to the
/// hand of the scene.
class GloveSession : public QObject {
  Q_OBJECT

 public:
  explicit GloveSession(QObject* parent = nullptr);
  ~GloveSession() override;

  /// What stands for the built-in emulator among devices.
  [[nodiscard]] static QString emulator_name();

  /// Connects to a serial port, a TCP port, the emulator, or a recording to be replayed. What goes
  /// wrong is told by state_changed().
  void connect_to(const QString& device);
  void disconnect_glove();
  [[nodiscard]] const QString& device() const { return device_; }
  [[nodiscard]] GloveLink& link() { return link_; }

  /// Null: no robot.
  void set_robot(std::shared_ptr<const geometric::RobotModel> model);
  /// Nothing: the typical one.
  void set_calibration(std::optional<device::GloveCalibration> calibration);
  void set_mapping(device::HandMapping mapping);
  [[nodiscard]] const device::GloveCalibration& calibration() const;
  [[nodiscard]] const device::HandMapping& mapping() const { return mapping_; }
  /// The mapping made ready for the robot; nullptr if it doesn't fit, see mapping_error().
  [[nodiscard]] const device::HandMapper* mapper() const { return mapper_ ? &*mapper_ : nullptr; }
  [[nodiscard]] const QString& mapping_error() const { return mapping_error_; }
  /// Calibrated and mapped.
  [[nodiscard]] GloveSample sample_of(const device::GloveFrame& frame) const;

  /// The mapping does not move the hand while this is off.
  void set_following(bool follow);
  [[nodiscard]] bool following() const { return following_; }

 signals:
  void state_changed(handway::device::StreamState state, const QString& error);
  /// All frames since the last time, the latest last.
  void sampled(const std::vector<handway::gui::GloveSample>& samples);
  void mapping_changed();
  void following_changed(bool follow);

 private:
  void start(const QString& device);
  void rebuild_mapper();

  GloveLink link_;
  QString device_;
  std::shared_ptr<const geometric::RobotModel> model_;
  device::GloveCalibration typical_;
  std::optional<device::GloveCalibration> chosen_;
  device::HandMapping mapping_;
  std::optional<device::HandMapper> mapper_;
  QString mapping_error_;
  bool following_ = true;
};

}  // namespace handway::gui
