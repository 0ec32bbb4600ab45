#include <handway/geometric/robot/base_joint.h>
#include <handway/geometric/robot/group_proposal.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace handway::geometric {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Tree {
 public:
  Tree() { robot_.links.push_back({"root", {}, {}}); }

  /// A joint `NAME_joint` to a new link `name`.
  Tree& add(const std::string& parent, const std::string& name, double length,
            JointType type = JointType::kRevolute) {
    robot_.links.push_back({name, {}, {}});
    Joint joint;
    joint.name = name + "_joint";
    joint.type = type;
    joint.parent = parent;
    joint.child = name;
    joint.X_PJ.translation().z() = length;
    joint.limits = {-0.01, 0.01};
    robot_.joints.push_back(joint);
    return *this;
  }

  /// Adds two fingers of two joints each to `palm`, and a fixed tip on the first.
  Tree& add_fingers(const std::string& palm, const std::string& name) {
    add(palm, name + "1", 0.05).add(name + "1", name + "2", 0.05);
    add(name + "2", name + "tip", 0.02, JointType::kFixed);
    return add(palm, name + "3", 0.05).add(name + "3", name + "4", 0.05);
  }

  Tree& add_wheel(const std::string& axle, const std::string& name) {
    constexpr double kForever = std::numeric_limits<double>::infinity();
    add(axle, name, 0.05);
    robot_.joints.back().limits = {-kForever, kForever};
    return *this;
  }

  /// Couples the joint of one link to that of another.
  Tree& follow(const std::string& link, const std::string& leader) {
    const auto joint = std::ranges::find(robot_.joints, link, &Joint::child);
    joint->mimic = Mimic{leader + "_joint", 1.0, 0.0};
    return *this;
  }

  /// Couples the joint in the opposite direction.
  Tree& follow_against(const std::string& link, const std::string& leader) {
    follow(link, leader);
    std::ranges::find(robot_.joints, link, &Joint::child)->mimic->multiplier = -1.0;
    return *this;
  }

  /// Adds a box around the link's frame, m.
  Tree& draw(const std::string& link, double size = 0.1) {
    std::ranges::find(robot_.links, link, &Link::name)
        ->visual.push_back({Box{Eigen::Vector3d::Constant(size)}, Pose::Identity(), {}});
    return *this;
  }

  /// Adds two joints that turn balls of 3 cm, which are 10 cm from each other.
  Tree& add_eyes(const std::string& head) {
    for (const double side : {-0.05, 0.05}) {
      const std::string eye = side < 0.0 ? "right_eye" : "left_eye";
      add(head, eye, 0.05).draw(eye, 0.03);
      robot_.joints.back().X_PJ.translation().y() = side;
    }
    return *this;
  }

  Tree& add_arm(const std::string& parent, const std::string& name) {
    return add(parent, name + "a", 0.3)
        .add(name + "a", name + "b", 0.3)
        .add(name + "b", name + "c", 0.3);
  }

  [[nodiscard]] RobotModel model() const { return RobotModel(robot_); }

 private:
  RobotDescription robot_;
};

TEST(GroupProposal, CallsAChainAnArm) {
  const GroupProposal groups = propose_groups(Tree().add_arm("root", "").model());
  EXPECT_THAT(groups.arm, ElementsAre("a_joint", "b_joint", "c_joint"));
  EXPECT_THAT(groups.hand, IsEmpty());
  EXPECT_EQ(groups.tip, "c");
  EXPECT_THAT(groups.questions, IsEmpty());
}

TEST(GroupProposal, FindsTheHandWhereTheTreeBranchesIntoFingers) {
  const GroupProposal groups =
      propose_groups(Tree().add_arm("root", "").add_fingers("c", "f").model());
  EXPECT_THAT(groups.arm, ElementsAre("a_joint", "b_joint", "c_joint"));
  EXPECT_THAT(groups.hand, ElementsAre("f1_joint", "f2_joint", "f3_joint", "f4_joint"));
  EXPECT_EQ(groups.palm, "c");
  EXPECT_THAT(groups.fingertips, ElementsAre("ftip", "f4"));
}

TEST(GroupProposal, AsksWhoseTheWristIs) {
  const Tree tree = Tree().add("root", "forearm", 0.1, JointType::kFixed);
  const GroupProposal groups =
      propose_groups(Tree(tree).add("forearm", "wrist", 0.2).add_fingers("wrist", "f").model());
  EXPECT_THAT(groups.arm, IsEmpty());
  EXPECT_THAT(groups.wrist, ElementsAre("wrist_joint"));
  ASSERT_EQ(groups.questions.size(), 1U);
  EXPECT_EQ(groups.questions.front().open,
            "wrist_joint leads to the palm (wrist), and may be of the hand or of the arm");
  EXPECT_EQ(groups.hand_with_wrist().size(), 5U);
}

TEST(GroupProposal, CallsThreeJointsAWristOnlyIfTheyAreCloseTogether) {
  const auto with_joints_apart = [](double length) {
    Tree tree = Tree().add("root", "forearm", 0.2, JointType::kFixed);
    tree.add("forearm", "a", 0.2).add("a", "b", length).add("b", "c", length);
    return propose_groups(tree.add_fingers("c", "f").model());
  };
  EXPECT_THAT(with_joints_apart(0.04).wrist, ElementsAre("a_joint", "b_joint", "c_joint"));
  EXPECT_THAT(with_joints_apart(0.3).arm, ElementsAre("a_joint", "b_joint", "c_joint"));
}

TEST(GroupProposal, TakesNoBarOfALinkageForAFinger) {
  Tree tree;
  for (const std::string side : {"left", "right"}) {
    tree.add("root", side, 0.05).add(side, side + "_tip", 0.04).add("root", side + "_bar", 0.06);
  }
  for (const char* joint : {"left_tip", "left_bar", "right", "right_tip", "right_bar"}) {
    tree.follow(joint, "left");
  }
  const GroupProposal groups = propose_groups(tree.model());
  EXPECT_THAT(groups.fingertips, ElementsAre("left_tip", "right_tip"));
  EXPECT_EQ(groups.hand.size(), 6U);
}

TEST(GroupProposal, TakesAJawThatClosesAgainstALongerOneForAFinger) {
  Tree tree = Tree().add("root", "one", 0.05).add("one", "a", 0.04).add("a", "b", 0.04);
  tree.add("root", "other", 0.05).add("other", "c", 0.04);
  tree.follow("a", "one").follow("b", "one").follow("c", "one").follow_against("other", "one");
  EXPECT_THAT(propose_groups(tree.model()).fingertips, ElementsAre("b", "c"));
}

TEST(GroupProposal, TakesNoMotorThatIsNotDrawnForAFinger) {
  Tree tree = Tree().add("root", "motor", 0.01).add_fingers("root", "f");
  tree.draw("f2").draw("f4");
  const GroupProposal groups = propose_groups(tree.model());
  EXPECT_THAT(groups.fingertips, ElementsAre("ftip", "f4"));
  EXPECT_EQ(groups.hand.size(), 5U);
}

TEST(GroupProposal, TakesNoWheelsForFingers) {
  const Tree car =
      Tree().add("root", "caster", 0.1).add_wheel("caster", "l").add_wheel("caster", "r");
  const GroupProposal groups =
      propose_groups(Tree(car).add_arm("root", "").add_fingers("c", "f").model());
  EXPECT_THAT(groups.hand, ElementsAre("f1_joint", "f2_joint", "f3_joint", "f4_joint"));
  EXPECT_EQ(groups.palm, "c");
  EXPECT_THAT(propose_groups(car.model()).hand, IsEmpty());
}

TEST(GroupProposal, TakesLongBranchesForArms) {
  const GroupProposal groups =
      propose_groups(Tree().add_arm("root", "l").add_arm("root", "r").model());
  EXPECT_EQ(groups.arm.size(), 6U);
  EXPECT_THAT(groups.hand, IsEmpty());
}

TEST(GroupProposal, TakesNoHeadAndNoLegForAnArmWhereAnArmHasAHand) {
  Tree robot = Tree().add("root", "torso", 0.4, JointType::kPrismatic).add_arm("torso", "l");
  robot.add_fingers("lc", "f").add("torso", "head", 0.3).add_arm("root", "leg");
  const GroupProposal groups = propose_groups(robot.model());
  EXPECT_THAT(groups.arm, ElementsAre("torso_joint", "la_joint", "lb_joint", "lc_joint"));
  EXPECT_EQ(groups.hand.size(), 4U);
  EXPECT_EQ(groups.palm, "lc");
}

TEST(GroupProposal, TakesNoEyesForAHand) {
  const Tree head = Tree().add("root", "pan", 0.1).add("pan", "tilt", 0.05).add_eyes("tilt");
  EXPECT_THAT(propose_groups(head.model()).hand, IsEmpty());
  const GroupProposal groups =
      propose_groups(Tree(head).add_arm("root", "").add_fingers("c", "f").model());
  EXPECT_THAT(groups.arm, ElementsAre("a_joint", "b_joint", "c_joint"));
  EXPECT_EQ(groups.palm, "c");
}

TEST(GroupProposal, TakesWhatIsOnANeckForNoHandWhereArmsAreLonger) {
  Tree robot = Tree().add("root", "pan", 0.1).add("pan", "tilt", 0.05).add_fingers("tilt", "ear");
  robot.add_arm("root", "").add("c", "d", 0.1).add_fingers("d", "f");
  const GroupProposal groups = propose_groups(robot.model());
  EXPECT_THAT(groups.arm, ElementsAre("a_joint", "b_joint", "c_joint", "d_joint"));
  EXPECT_EQ(groups.palm, "d");
  EXPECT_EQ(groups.hand.size(), 4U);
}

TEST(GroupProposal, TakesWhatIsOnANeckForNoHandWhereArmsHaveNone) {
  Tree robot = Tree().add("root", "pan", 0.1).add("pan", "tilt", 0.05).add_fingers("tilt", "ear");
  robot.add_arm("root", "l").add("lc", "ld", 0.1).add_arm("root", "r").add("rc", "rd", 0.1);
  const GroupProposal groups = propose_groups(robot.model());
  EXPECT_EQ(groups.arm.size(), 8U);
  EXPECT_THAT(groups.hand, IsEmpty());
}

TEST(GroupProposal, EndsFingersWhereTheirShapesEnd) {
  Tree tree = Tree().add_fingers("root", "f").add("f4", "frame", 0.0, JointType::kPrismatic);
  tree.draw("f2").draw("f4");
  EXPECT_THAT(propose_groups(tree.model()).fingertips, ElementsAre("ftip", "f4"));
}

TEST(GroupProposal, TakesNoWheelsForArms) {
  const Tree cart = Tree().add_wheel("root", "left").add_wheel("root", "right");
  const GroupProposal groups = propose_groups(Tree(cart).add_arm("root", "").model());
  EXPECT_THAT(groups.arm, ElementsAre("a_joint", "b_joint", "c_joint"));
  EXPECT_EQ(groups.tip, "c");
}

TEST(GroupProposal, TakesNoFloatingBaseForAnArm) {
  RobotDescription robot = Tree().add_arm("root", "").add_fingers("c", "f").model().description();
  add_moving_root(robot, {"base", BaseMotion::kFloating}, "root", "world");
  const GroupProposal groups = propose_groups(RobotModel(robot));
  EXPECT_THAT(groups.arm, ElementsAre("a_joint", "b_joint", "c_joint"));
  EXPECT_EQ(groups.hand.size(), 4U);
}

TEST(GroupProposal, LeavesGroupsThatAreThere) {
  RobotDescription robot = Tree().add_arm("root", "").add_fingers("c", "f").model().description();
  robot.groups = {{"hand", {"f1_joint"}}};
  add_groups(propose_groups(RobotModel(robot)), robot);
  ASSERT_EQ(robot.groups.size(), 2U);
  EXPECT_THAT(robot.groups[0].joints, ElementsAre("f1_joint"));
  EXPECT_EQ(robot.groups[1].name, "arm");
}

}  // namespace
}  // namespace handway::geometric
