#include "features/editing/editing_test.h"
#include "handway/planning/edits/arranging.h"

namespace handway::test {
namespace {

using geometric::Box;
using geometric::kRestingGap;
using geometric::Pose;
using geometric::Scene;
using geometric::SceneObject;
using planning::SceneState;

SceneObject box(const std::string& name, const Eigen::Vector3d& size, double z) {
  SceneObject made;
  made.name = name;
  made.shape = Box{size};
  made.X_PO.translation().z() = z;
  return made;
}

/// The upper side of the table is at 0.74 m.
planning::SceneState with_table(std::vector<SceneObject> objects) {
  Scene scene;
  scene.objects = std::move(objects);
  scene.objects.push_back(box("table", {1.0, 1.0, 0.04}, 0.72));
  return {std::make_shared<const Scene>(std::move(scene))};
}

SceneObject cube(const std::string& name, double z) { return box(name, {0.1, 0.1, 0.1}, z); }

planning::SceneState dropped(const planning::SceneState& state,
                             const std::vector<std::string>& names) {
  return planning::dropped(state, {}, names);
}

double height(const planning::SceneState& state, const char* name) {
  return state.find(name)->X_PO.translation().z();
}

TEST(Dropped, LeavesAGapToTheTable) {
  EXPECT_NEAR(height(dropped(with_table({cube("cup", 1.0)}), {"cup"}), "cup"), 0.79 + kRestingGap,
              1e-12);
  EXPECT_NEAR(height(dropped(with_table({cube("cup", 0.76)}), {"cup"}), "cup"), 0.79 + kRestingGap,
              1e-12)
      << "lifts what has sunk in";
}

TEST(Dropped, StandsOnTheFloorBesideOrBelowTheTable) {
  SceneObject beside = cube("beside", 1.0);
  beside.X_PO.translation().x() = 2.0;
  const planning::SceneState state =
      dropped(with_table({beside, cube("below", 0.5)}), {"beside", "below"});
  EXPECT_NEAR(height(state, "beside"), 0.05, 1e-12);
  EXPECT_NEAR(height(state, "below"), 0.05, 1e-12);
}

TEST(Dropped, LeavesAGapBetweenObjectsOfAStack) {
  const planning::SceneState state =
      dropped(with_table({cube("upper", 1.2), cube("lower", 1.0)}), {"upper", "lower"});
  EXPECT_NEAR(height(state, "lower"), 0.79 + kRestingGap, 1e-12);
  EXPECT_NEAR(height(state, "upper"), 0.89 + 2.0 * kRestingGap, 1e-12);
}

TEST(Dropped, StaysWhereItIsTheSecondTime) {
  const planning::SceneState once = dropped(with_table({cube("cup", 1.0)}), {"cup"});
  EXPECT_EQ(dropped(once, {"cup"}), once);
}

TEST(RiseToClear, MakesTheGapThatIsMissing) {
  EXPECT_NEAR(rise_to_clear(with_table({cube("cup", 0.79)}), {"cup"}), kRestingGap, 1e-12);
  EXPECT_NEAR(rise_to_clear(with_table({cube("cup", 0.7893)}), {"cup"}), kRestingGap + 0.7e-3,
              1e-12);
  EXPECT_NEAR(rise_to_clear(with_table({cube("cup", 0.7902)}), {"cup"}), kRestingGap - 0.2e-3,
              1e-12);
}

TEST(RiseToClear, IsNothingWhereThereIsNoContact) {
  EXPECT_EQ(rise_to_clear(with_table({cube("cup", 0.8)}), {"cup"}), 0.0);
  EXPECT_EQ(rise_to_clear(with_table({cube("cup", 0.5)}), {"cup"}), 0.0) << "below the table";
  EXPECT_EQ(rise_to_clear(dropped(with_table({cube("cup", 1.0)}), {"cup"}), {"cup"}), 0.0);
}

TEST(RiseToClear, LeavesARealOverlapForThePersonToSee) {
  EXPECT_EQ(rise_to_clear(with_table({cube("cup", 0.78)}), {"cup"}), 0.0);
}

TEST(RiseToClear, RaisesAStackAsOne) {
  const planning::SceneState stack = with_table({cube("upper", 0.89), cube("lower", 0.79)});
  EXPECT_NEAR(rise_to_clear(stack, {"upper", "lower"}), kRestingGap, 1e-12);
}

TEST(RiseToClear, CountsNoneThatIsHeldAlready) {
  SceneObject held = cube("held", 0.79);
  held.attachment = geometric::Attachment{"arm", "palm", {}};
  EXPECT_EQ(rise_to_clear(with_table({held}), {"held"}), 0.0);
}

using Attaching = EditingTest;

TEST_F(Attaching, RaisesWhatStandsOnATableAndSaysSo) {
  editor().add("table", Box{{0.2, 0.2, 0.1}}, {}, {-0.5, 0.0, 0.0});
  editor().add("cup", Box{{0.05, 0.05, 0.1}}, {}, {-0.5, 0.0, 0.1});
  const Pose X_WO = *editor().selected_pose();
  editor().attach("arm", "palm", {});
  const Pose X_WO_after = *editor().selected_pose();
  EXPECT_TRUE((X_WO_after.translation() - X_WO.translation())
                  .isApprox(Eigen::Vector3d(0.0, 0.0, kRestingGap), 1e-9));
  EXPECT_TRUE(X_WO_after.linear().isApprox(X_WO.linear(), 1e-12));
  EXPECT_EQ(editor().undo_stack().undoText(), "Attach cup to arm/palm, raised by 0.5 mm");
  editor().undo_stack().undo();
  EXPECT_EQ(editor().selected_pose()->matrix(), X_WO.matrix());
}

}  // namespace
}  // namespace handway::test
