#pragma once

#include "handway/device/tracker/tool_follower.h"
#include "model/devices/tracker_session.h"

#include <QTimer>
#include <QWidget>

#include <array>
#include <optional>

class QCheckBox;
class QDoubleSpinBox;
class QSpinBox;

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace handway::gui {

class QuantityField;

/// Form of how the arm follows the wrist: scale, rotation, orientation of the source, smoothing,
/// speed and workspace.
class FollowForm : public QWidget {
  Q_OBJECT

 public:
  explicit FollowForm(QWidget* parent = nullptr);

  [[nodiscard]] device::ToolFollowerSettings settings() const;
  /// The sensor that leads; nothing for whichever speaks first.
  [[nodiscard]] std::optional<int> sensor() const;
  /// Returns whether the sensor's button closes the clutch.
  [[nodiscard]] bool button_closes() const;
  /// Centres the box at a point of the base frame, m, as long as it is off.
  void centre_box(const Eigen::Vector3d& p_B);

 signals:
  void settings_edited();

 private:
  QWidget* build_motion();
  QWidget* build_workspace();

  QSpinBox* sensor_;
  QCheckBox* button_;
  QDoubleSpinBox* scale_;
  QCheckBox* turn_;
  QuantityField* source_yaw_;
  QSpinBox* smoothing_;
  QuantityField* speed_;
  QCheckBox* box_;
  QWidget* box_fields_;
  std::array<QuantityField*, 3> least_{};
  std::array<QuantityField*, 3> most_{};
  QCheckBox* limits_reach_;
  QuantityField* reach_;
};

class LinkStatus;
class Workbench;

/// The wrist tracker in the window: connects to it, and leads the arm of the scene with it.
class WristPage : public QWidget {
  Q_OBJECT

 public:
  explicit WristPage(QWidget* parent = nullptr);
  ~WristPage() override;

  /// @param model null: no robot. @param arm variables of its arm.
  void set_robot(const std::shared_ptr<const geometric::RobotModel>& model,
                 const std::vector<int>& arm);
  void set_configuration(const geometric::Configuration& q);

  /// Connects as if the person had, and closes the clutch; an empty device does nothing.
  void connect_to(const QString& device);
  /// Returns the time since the tracker was connected, s.
  [[nodiscard]] double listening_time() const;

  [[nodiscard]] TrackerSession& session() { return session_; }
  [[nodiscard]] ArmLeader& leader() { return leader_; }

 signals:
  /// The arm's joints are to be there.
  void posture_wanted(const handway::geometric::NamedPosture& posture);
  /// The tracker leads no more.
  void released();

 private:
  QWidget* build_device();
  QWidget* build_clutch();
  void toggle_connection();
  void apply_settings();
  void show_state(device::StreamState state, const QString& error);
  void show_samples(const std::vector<device::TrackerSample>& samples);
  void show_clutch(bool closed);
  void refresh();

  TrackerSession session_;
  ArmLeader leader_;
  QComboBox* protocol_;
  QLineEdit* address_;
  QPushButton* connect_;
  LinkStatus* status_;
  QPushButton* clutch_;
  QLabel* follow_;
  QLabel* wrist_;
  FollowForm* form_;
  QTimer ticker_;
  std::optional<device::TrackerSample> sample_;  ///< Latest of the sensor that leads.
  std::optional<device::FollowStep> step_;       ///< Latest since the clutch was closed.
  QString complaint_;                            ///< Error in the settings.
  double first_time_ = -1.0;                     ///< Time of the first sample since connecting, s.
  double last_time_ = -1.0;
};

/// Adds the page to the glove's panel; its arm is the scene's.
void add_tracker(Workbench& workbench);

}  // namespace handway::gui
