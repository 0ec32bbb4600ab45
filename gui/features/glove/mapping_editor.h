#pragma once

#include "model/devices/glove_session.h"

#include <QWidget>

#include <deque>
#include <filesystem>
#include <string>
#include <vector>

class QLabel;
class QLineEdit;
class QPushButton;

namespace handway::gui {

class CurveView;
class MappingWires;
class WireForm;

/// Edits which sensor drives which joint, while the glove moves the hand with it, and compares
/// the mapping with another by what both make of the same motion.
class MappingEditor : public QWidget {
  Q_OBJECT

 public:
  explicit MappingEditor(GloveSession& session, QWidget* parent = nullptr);

  /// @param free joints of the hand's basis, which take no part in comparisons.
  void set_hand(std::shared_ptr<const geometric::RobotModel> model, std::vector<std::string> free);
  void show_samples(const std::vector<GloveSample>& samples);

  /// @throws geometric::InputError if it is no mapping or can't be written.
  void open(const std::filesystem::path& file);
  void save(const std::filesystem::path& file) const;
  /// All joints fixed, to begin by hand.
  void clear();
  void compare_with(const device::HandMapping& other, const QString& name);
  [[nodiscard]] QString comparison() const;

 signals:
  void failed(const QString& message);

 private:
  QWidget* build_buttons();
  void change(const device::HandMapping& mapping);
  void change_wire(const device::JointWire& wire);
  void show_wire(const device::JointWire& wire);
  void refresh();
  void choose_to_open();
  void choose_to_save();
  void choose_to_compare();

  GloveSession& session_;
  std::shared_ptr<const geometric::RobotModel> model_;
  std::vector<std::string> free_;
  std::deque<device::GloveAngles> motion_;
  int stride_ = 0;
  MappingWires* wires_;
  WireForm* form_;
  CurveView* curve_;
  QLineEdit* source_;
  QLabel* comparison_;
};

}  // namespace handway::gui
