#pragma once

#include "features/glove/basis_report.h"
#include "features/glove/captured_postures.h"
#include "features/glove/hand_bases.h"
#include "features/glove/pmd_pad.h"
#include "handway/geometric/robot/robot_description.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "model/devices/glove_session.h"

#include <QPointF>
#include <QString>
#include <QWidget>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

class QComboBox;
class QLabel;
class QPushButton;
class QSpinBox;
class QTabBar;

namespace handway::gui {

class CorrelationMap;
class VarianceChart;

/// Settings of a basis of the postures: the number of principal motion directions, and the joints
/// that have an axis of their own.
class BasisOptions : public QWidget {
  Q_OBJECT

 public:
  explicit BasisOptions(QWidget* parent = nullptr);

  /// @param free joints, as indices, that have an axis of their own at first. Nothing changes while
  /// the joints are the same.
  void set_joints(const std::vector<std::string>& joints, const std::vector<int>& free);
  [[nodiscard]] sampling::PmdBasisOptions options() const;

 signals:
  void changed();

 private:
  void take_joints();

  std::vector<std::string> joints_;
  QSpinBox* directions_;
  QPushButton* free_;
};

/// Explores a hand along its principal motion directions: two axes as a pad to drag in, the
/// postures that were captured or recorded as dots, what the directions hold of the
/// variance, and which joints go together; or a report of how good a basis of them is. Bases are
/// chosen here, made of the postures, saved, compared, and taken for planning.
class PmdExplorer : public QWidget {
  Q_OBJECT

 public:
  explicit PmdExplorer(QWidget* parent = nullptr);

  /// Sets the hand of another scene. @param basis that it names; its basis may be null.
  void set_hand(std::shared_ptr<const geometric::RobotModel> model, const HandBasis& basis);
  /// The scene names another basis.
  void set_scene_basis(const HandBasis& basis);
  /// Sets the configuration of the robot. @param q shape [variable_count].
  void set_configuration(const geometric::Configuration& q);
  /// Shows captured or recorded postures. @param source text to show; empty: live.
  /// @param hand name of the hand in a basis of them.
  void show_postures(const CapturedPostures& postures, const QString& source,
                     const std::string& hand);
  /// Shows the method that converts the person's postures.
  void show_method(PostureMethod method);
  /// @param enabled false where the postures are the robot hand's own, so that none is needed.
  void enable_method(bool enabled);
  /// Shows the text about the fingertip errors of each method.
  void show_errors(const QString& text);
  [[nodiscard]] BasisReportView& report() { return *report_; }
  /// Returns the number of directions of a basis of the postures, and the joints with their own
  /// axis.
  [[nodiscard]] sampling::PmdBasisOptions options() const { return options_->options(); }
  /// Takes a basis from a file, and shows it.
  /// @throws geometric::InputError as open_basis().
  void open(const std::filesystem::path& file);
  /// Saves the basis that is shown, and shows it as that file's.
  /// @throws geometric::InputError as save_basis().
  void save(const std::filesystem::path& file);

 signals:
  void posture_changed(const handway::geometric::NamedPosture& posture);
  void method_chosen(handway::gui::PostureMethod method);
  void recording_requested();
  /// Show the live postures again.
  void live_requested();
  /// Plan with it. @param file as a scene names it.
  void basis_chosen(const std::filesystem::path& file,
                    const std::shared_ptr<const handway::sampling::PmdBasis>& basis);
  void failed(const QString& message);
  /// The page has come to be seen.
  void shown();
  /// Emitted when the number of directions or the free joints have changed.
  void options_changed();

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  [[nodiscard]] QWidget* build_buttons();
  [[nodiscard]] QWidget* build_views();
  void list_bases();
  void take_choice(int row);
  void add_basis(HandBasis basis);
  [[nodiscard]] HandBasis made_basis() const;
  [[nodiscard]] const HandBasis* shown_basis() const;
  void show_comparison();
  void choose_to_open();
  /// @returns whether it was saved.
  bool choose_to_save();
  void use_shown();
  void rebuild_axes();
  void choose_axes();
  void show_dots();
  void show_statistics();
  void move_hand(const QPointF& coordinates);
  [[nodiscard]] bool shows_own_basis() const;

  std::shared_ptr<const geometric::RobotModel> model_;
  HandBasis scene_basis_;         ///< Scene's basis, or without one if it names none.
  HandBasis made_;                ///< Basis of the postures; null if too few.
  std::vector<HandBasis> bases_;  ///< Bases of the library and of files.
  CapturedPostures postures_;
  QString postures_source_;
  std::string hand_;
  HandAxes axes_;
  geometric::Configuration q_;
  QComboBox* source_;
  QComboBox* method_;
  QLabel* errors_;
  QComboBox* basis_;
  BasisOptions* options_;
  QPushButton* save_;
  QPushButton* use_;
  QComboBox* across_;
  QComboBox* up_;
  PmdPad* pad_;
  VarianceChart* variance_;
  CorrelationMap* correlation_;
  BasisComparisonView* comparison_;
  BasisReportView* report_;
  QTabBar* views_;
  QLabel* note_;
  bool moving_ = false;  ///< The change that arrives is this widget's own.
};

}  // namespace handway::gui
