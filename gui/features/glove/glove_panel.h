#pragma once

#include "features/glove/capture_pages.h"
#include "handway/geometric/robot/robot_description.h"
#include "model/devices/contact_guard.h"
#include "model/devices/glove_session.h"

#include <QTimer>
#include <QWidget>

#include <chrono>
#include <memory>
#include <optional>

class QCheckBox;
class QComboBox;
class QLabel;
class QPushButton;
class QTabBar;
class QUndoStack;
class QStackedWidget;

namespace handway::gui {

class DeviceField;
class LinkStatus;
class MappingEditor;
class RecordBar;
class SensorBars;
class Workbench;

/// The glove in the window: connects to it, shows what it measures, and moves the hand of the
/// scene with it. Others that lead the robot may have a page of their own in it.
class GlovePanel : public QWidget {
  Q_OBJECT

 public:
  /// @param guard decides on postures of glove and others; outlives the panel.
  GlovePanel(ContactGuard& guard, QUndoStack& history, QWidget* parent = nullptr);
  ~GlovePanel() override;

  /// @param model null: no robot.
  /// @param basis of the scene's hand; its basis may be null.
  /// @param problem to check for contacts; may be null.
  void set_hand(const std::shared_ptr<const geometric::RobotModel>& model, const HandBasis& basis,
                std::shared_ptr<const PreparedProblem> problem);
  /// Changes the basis of the same robot; captured postures are kept.
  void set_basis(const std::shared_ptr<const geometric::RobotModel>& model, const HandBasis& basis,
                 std::shared_ptr<const PreparedProblem> problem);
  /// Sets the configuration of the robot. @param q shape [variable_count].
  void set_configuration(const geometric::Configuration& q);
  /// The view has drawn the posture that was shown last.
  void note_drawn();
  void refresh_icons();
  /// Adds a page, which the panel takes over and scrolls.
  void add_page(const QString& name, QWidget* page);

  /// Connects as if the person had; an empty device does nothing.
  void connect_to(const QString& device);
  /// Makes this the current tab, with a page by its name if there is one of it.
  void come_to_front(const QString& page = {});
  /// Returns the time since the glove was connected, s.
  [[nodiscard]] double listening_time() const;

  [[nodiscard]] GloveSession& session() { return session_; }
  [[nodiscard]] CapturePages& capture() { return capture_; }
  [[nodiscard]] MappingEditor& mapping_editor() { return *mapping_editor_; }
  [[nodiscard]] RecordBar& record_bar() { return *record_; }

 signals:
  /// Joints of hand or arm are to be there.
  void posture_changed(const handway::geometric::NamedPosture& posture);

 private:
  QWidget* build_header();
  QWidget* build_sensors_page();
  QWidget* build_footer();
  void put_page(const QString& name, QWidget* page);
  void take_basis(const std::shared_ptr<const geometric::RobotModel>& model,
                  const std::shared_ptr<const sampling::PmdBasis>& basis,
                  std::shared_ptr<const PreparedProblem> problem);
  void toggle_connection();
  void show_state(device::StreamState state, const QString& error);
  void show_samples(const std::vector<GloveSample>& samples);
  void show_statistics();
  void move_hand(const GloveSample& sample);
  void show_glove(device::StreamState state, const QString& error);
  void show_problem(const QString& message);

  GloveSession session_;
  DeviceField* device_;
  QPushButton* connect_;
  LinkStatus* status_;
  QTabBar* tabs_;
  QStackedWidget* pages_;
  SensorBars* bars_;
  CapturePages capture_;
  MappingEditor* mapping_editor_;
  ContactGuard& guard_;
  QCheckBox* follow_;
  QComboBox* rule_;
  QLabel* contact_;
  RecordBar* record_;
  QTimer ticker_;
  std::optional<std::chrono::steady_clock::time_point> shown_since_;  ///< Undrawn frame's arrival.
  double to_screen_ = 0.0;
  double first_time_ = -1.0;  ///< Time of the first frame since connecting, s.
  double last_time_ = -1.0;
};

/// Adds the panel; its hand is the scene's.
void add_glove(Workbench& workbench);

}  // namespace handway::gui
