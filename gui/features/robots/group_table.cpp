#include "features/robots/group_table.h"

#include <QHeaderView>
#include <QSignalBlocker>

#include <algorithm>
#include <utility>
#include <vector>

namespace handway::gui {
namespace {

using geometric::GroupProposal;
using geometric::Joint;
using geometric::RobotModel;

enum GroupColumn { kJoint, kArmBox, kHandBox, kGroupColumns };

std::vector<const Joint*> moving_joints(const RobotModel& model) {
  std::vector<const Joint*> joints;
  for (const Joint& joint : model.description().joints) {
    if (joint.type != geometric::JointType::kFixed) {
      joints.push_back(&joint);
    }
  }
  return joints;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

JointOwner owner_of(const GroupProposal& groups, const std::string& joint) {
  return has(groups.arm, joint)                 ? JointOwner::kArm
         : has(groups.hand_with_wrist(), joint) ? JointOwner::kHand
                                                : JointOwner::kNeither;
}

}  // namespace

GroupProposal with_moved(const RobotModel& model, GroupProposal groups, const JointOwners& moved) {
  if (moved.empty()) {
    return groups;
  }
  std::vector<std::string> arm, hand;
  std::string carrier;  // of the hand's first joint
  for (const Joint* joint : moving_joints(model)) {
    const auto found = moved.find(joint->name);
    const JointOwner owner = found != moved.end() ? found->second : owner_of(groups, joint->name);
    if (owner == JointOwner::kArm) {
      arm.push_back(joint->name);
    } else if (owner == JointOwner::kHand) {
      carrier = hand.empty() ? joint->parent : carrier;
      hand.push_back(joint->name);
    }
  }
  groups.arm = std::move(arm);
  groups.hand = std::move(hand);
  groups.wrist.clear();
  groups.questions.clear();
  if (groups.hand.empty()) {
    groups.palm.clear();
    groups.fingertips.clear();
  } else if (groups.palm.empty()) {
    groups.palm = carrier;
  }
  return groups;
}

GroupProposal present_groups(const RobotModel& model, geometric::WristOwner wrist) {
  GroupProposal groups = geometric::decided_groups(model, wrist);
  if (wrist != geometric::WristOwner::kUndecided) {
    return groups;
  }
  for (const geometric::JointGroup& group : model.description().groups) {
    if (group.name == "arm") {
      groups.arm = group.joints;
    } else if (group.name == "hand") {
      groups.hand = group.joints;
      groups.wrist.clear();
    }
  }
  return groups;
}

JointOwners difference(const RobotModel& model, const GroupProposal& from,
                       const GroupProposal& to) {
  JointOwners moved;
  for (const Joint* joint : moving_joints(model)) {
    if (const JointOwner owner = owner_of(to, joint->name); owner != owner_of(from, joint->name)) {
      moved[joint->name] = owner;
    }
  }
  return moved;
}

GroupTable::GroupTable(QWidget* parent) : QTreeWidget(parent) {
  setObjectName(QStringLiteral("setup_joints"));
  setAccessibleName(tr("Groups of joints"));
  setColumnCount(kGroupColumns);
  setHeaderLabels({tr("Joint"), tr("Arm"), tr("Hand")});
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  header()->setSectionResizeMode(kJoint, QHeaderView::Stretch);
  setRootIsDecorated(false);
  setUniformRowHeights(true);
  setSelectionMode(QAbstractItemView::ExtendedSelection);
  setToolTip(tr("Changing a check box changes all selected rows"));
  connect(this, &QTreeWidget::itemChanged, this,
          [this](QTreeWidgetItem* row, int column) { decide(*row, column); });
  connect(this, &QTreeWidget::currentItemChanged, this, [this](const QTreeWidgetItem* row) {
    if (row) {
      emit looked_at(row->data(kJoint, Qt::UserRole).toString());
    }
  });
}

void GroupTable::show_groups(const RobotModel& model, const GroupProposal& groups) {
  const QSignalBlocker quiet(this);
  const std::vector<const Joint*> joints = moving_joints(model);
  // The rows stay, with what is selected, where only the groups are others.
  if (topLevelItemCount() != static_cast<int>(joints.size())) {
    clear();
    for (std::size_t i = 0; i < joints.size(); ++i) {
      static_cast<void>(new QTreeWidgetItem(this));
    }
  }
  for (std::size_t i = 0; i < joints.size(); ++i) {
    QTreeWidgetItem& row = *topLevelItem(static_cast<int>(i));
    const JointOwner owner = owner_of(groups, joints[i]->name);
    row.setText(kJoint, QString::fromStdString(joints[i]->name));
    row.setToolTip(kJoint, row.text(kJoint));
    row.setData(kJoint, Qt::UserRole, QString::fromStdString(joints[i]->child));
    row.setCheckState(kArmBox, owner == JointOwner::kArm ? Qt::Checked : Qt::Unchecked);
    row.setCheckState(kHandBox, owner == JointOwner::kHand ? Qt::Checked : Qt::Unchecked);
  }
}

void GroupTable::decide(QTreeWidgetItem& row, int column) {
  const JointOwner owner = row.checkState(column) == Qt::Unchecked ? JointOwner::kNeither
                           : column == kArmBox                     ? JointOwner::kArm
                                                                   : JointOwner::kHand;
  const QList<QTreeWidgetItem*> rows =
      row.isSelected() ? selectedItems() : QList<QTreeWidgetItem*>{&row};
  JointOwners owners;
  for (const QTreeWidgetItem* each : rows) {
    owners[each->text(kJoint).toStdString()] = owner;
  }
  emit decided(owners);
}

}  // namespace handway::gui
