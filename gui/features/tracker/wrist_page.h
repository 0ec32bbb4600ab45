#pragma once

#include "model/devices/tracker_session.h"

#include <QTimer>
#include <QWidget>

#include <optional>

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace handway::gui {

class FollowForm;
class LinkStatus;

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
  /// How long the tracker has been listened to, s.
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
  QString complaint_;                            ///< What is wrong with the settings.
  double first_time_ = -1.0;                     ///< Of the samples since connecting, s.
  double last_time_ = -1.0;
};

}  // namespace handway::gui
