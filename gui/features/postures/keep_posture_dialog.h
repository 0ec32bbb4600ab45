#pragma once

#include "model/document/joint_groups.h"

#include <QDialog>
#include <QStringList>

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace handway::gui {

/// Asks under which name a posture is kept, and of which part of the robot.
class KeepPostureDialog : public QDialog {
  Q_OBJECT

 public:
  /// @param taken names of postures that are kept already: one of them is kept in its place.
  KeepPostureDialog(const JointGroups& groups, const QStringList& taken, QWidget* parent = nullptr);

  [[nodiscard]] QString name() const;
  /// The variables that belong to it.
  [[nodiscard]] const std::vector<int>& variables() const;

 private:
  void add_part(const QString& text, std::vector<int> variables);
  void look_at_name();

  QStringList taken_;
  std::vector<std::vector<int>> parts_;  ///< By row of the choice.
  QLineEdit* name_;
  QComboBox* part_;
  QLabel* note_;
  QPushButton* keep_;
};

}  // namespace handway::gui
