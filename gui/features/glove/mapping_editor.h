#pragma once

#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/device/glove/recording.h"
#include "handway/geometric/robot/robot_model.h"
#include "model/devices/glove_session.h"
#include "model/jobs/background.h"

#include <QWidget>

#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

class QLabel;
class QLineEdit;
class QPushButton;
class QUndoStack;

namespace handway::gui {

class CurveView;
class JointMappingForm;
class MappingWires;

/// Edits which sensor drives which joint, while the glove moves the hand with it, and compares
/// the mapping with another by what both make of the same motion.
class MappingEditor : public QWidget {
  Q_OBJECT

 public:
  /// @param history where changes of the mapping can be undone; used no more once the editor is
  /// gone. Both outlive it.
  MappingEditor(GloveSession& session, QUndoStack& history, QWidget* parent = nullptr);

  /// @param free joints of the hand's basis, which take no part in comparisons.
  void set_hand(std::shared_ptr<const geometric::RobotModel> model, std::vector<std::string> free);
  void show_samples(const std::vector<GloveSample>& samples);

  /// @throws geometric::InputError if it is no mapping or can't be written.
  void open(const std::filesystem::path& file);
  void save(const std::filesystem::path& file) const;
  /// All joints fixed, to begin by hand.
  void clear();
  /// A mapping that is proposed for the hand of the scene.
  void propose();
  /// Fits signs and ranges to what a person's hand went through, in the background; another hand or
  /// mapping meanwhile ends it without effect.
  /// @param recording of angles.
  void fit(const device::Recording& recording);
  void compare_with(const device::HandMapping& other, const QString& name);
  [[nodiscard]] QString comparison() const;

 signals:
  void failed(const QString& message);

 private:
  QWidget* build_buttons();
  /// Takes another mapping, as an edit that can be undone.
  void change(const QString& text, const device::HandMapping& mapping);
  void use(const device::HandMapping& mapping);
  void change_joint_mapping(const device::JointMapping& mapped);
  void show_joint_mapping(const device::JointMapping& mapped);
  void refresh();
  void choose_to_open();
  void choose_to_save();
  void choose_to_compare();
  void choose_to_fit();
  /// @param recording called in the background; may throw.
  void start_fit(std::function<device::Recording()> recording);
  void show_fitting();

  GloveSession& session_;
  QUndoStack& history_;
  std::shared_ptr<const geometric::RobotModel> model_;
  std::vector<std::string> free_;
  std::deque<device::GloveAngles> motion_;
  int stride_ = 0;
  MappingWires* wires_;
  JointMappingForm* form_;
  CurveView* curve_;
  QLineEdit* source_;
  QLabel* comparison_;
  QPushButton* choices_;  ///< The menu of what can be done with a mapping.
  LatestJob fitting_;
};

}  // namespace handway::gui
