#include "view3d/scene_view.h"
#include "view3d/view_gizmo.h"
#include "window_test.h"

#include <optional>

namespace handway::test {
namespace {

using ItemKind = gui::SceneItem::Kind;

class Clicks : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (!IsSkipped()) {
      open(cell().post());
    }
  }
  [[nodiscard]] gui::SceneView& view() const { return window().view(); }

  [[nodiscard]] ItemKind clicked_at(const QPoint& place) const {
    ItemKind kind = ItemKind::kNone;
    window().editor().select({});  // handles would take clicks
    const auto connection =
        QObject::connect(&view(), &gui::SceneView::picked,
                         [&kind](const gui::SceneItem& item, bool) { kind = item.kind; });
    QTest::mouseClick(&view(), Qt::LeftButton, {}, place);
    QObject::disconnect(connection);
    return kind;
  }
  /// Returns the places on a grid where such an item is clicked.
  [[nodiscard]] std::vector<QPoint> places_of(ItemKind kind) const {
    constexpr int kStep = 12;  // px
    std::vector<QPoint> places;
    for (int y = kStep; y < view().height(); y += kStep) {
      for (int x = kStep; x < view().width(); x += kStep) {
        if (clicked_at({x, y}) == kind) {
          places.emplace_back(x, y);
        }
      }
    }
    return places;
  }
};

TEST_F(Clicks, MeanTheRobotAlsoBehindAGhost) {
  view().show_ghosts(false, false);
  const std::vector<QPoint> links = places_of(ItemKind::kLink);
  ASSERT_FALSE(links.empty());
  geometric::Configuration near = window().document().configuration();
  near[0] += 0.1;
  view().preview_ghost(false, near);
  view().show_ghosts(false, true);
  EXPECT_EQ(places_of(ItemKind::kLink), links);
  EXPECT_FALSE(places_of(ItemKind::kGoal).empty()) << "beside the robot the ghost can be clicked";
}

TEST_F(Clicks, MeanWhatAGhostHoldsAndNotTheGhost) {
  const geometric::Scene& scene = *window().document().scene();
  const Eigen::Vector3d palm =
      geometric::link_pose(scene, scene.goal.value(), "arm", "palm")->translation();
  const QPoint place = gui::place_of(view().camera(), view().size(), palm).toPoint();
  ASSERT_EQ(clicked_at(place), ItemKind::kGoal);
  window().editor().add("pea", geometric::Sphere{0.01}, {}, palm - Eigen::Vector3d(0, 0, 0.01));
  EXPECT_EQ(clicked_at(place), ItemKind::kObject) << "though the palm is all around it";
}

}  // namespace
}  // namespace handway::test
