#pragma once

#include "handway/geometric/robot/group_proposal.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/setup/robot_setup.h"

#include <QString>
#include <QTreeWidget>

#include <map>
#include <string>

namespace handway::gui {

enum class JointOwner { kArm, kHand, kNeither };

/// Joints that a person has given to the arm, the hand or neither.
using JointOwners = std::map<std::string, JointOwner>;

/// Moves joints to the groups that `moved` says. The hand has the wrist then, and nothing is open.
[[nodiscard]] geometric::GroupProposal with_moved(const geometric::RobotModel& model,
                                                  geometric::GroupProposal groups,
                                                  const JointOwners& moved);

/// decided_groups(), and in their place the groups "arm" and "hand" that the robot has, as long as
/// the wrist is undecided: those stay in its SRDF.
[[nodiscard]] geometric::GroupProposal present_groups(const geometric::RobotModel& model,
                                                      geometric::WristOwner wrist);

/// Returns the changes by which with_moved() makes the second groups of the first ones.
[[nodiscard]] JointOwners difference(const geometric::RobotModel& model,
                                     const geometric::GroupProposal& from,
                                     const geometric::GroupProposal& to);

/// A robot's joints, with boxes for the arm and the hand. A box of a selected row decides for all
/// rows that are selected.
class GroupTable : public QTreeWidget {
  Q_OBJECT

 public:
  explicit GroupTable(QWidget* parent = nullptr);

  void show_groups(const geometric::RobotModel& model, const geometric::GroupProposal& groups);

 signals:
  void decided(const handway::gui::JointOwners& owners);
  /// @param link that the joint moves.
  void looked_at(const QString& link);

 private:
  void decide(QTreeWidgetItem& row, int column);
};

}  // namespace handway::gui
