#include "app/view_actions.h"
#include "features/editing/editing_test.h"
#include "model/document/collision_monitor.h"
#include "view3d/body_meshes.h"
#include "view3d/scene_view.h"
#include "view3d/view_gizmo.h"

#include <QAction>
#include <QImage>

namespace handway::test {
namespace {

using gui::BodyDisplay;
using gui::SceneItem;

const char* const kActions[] = {"bodies_visual", "bodies_collision", "bodies_hulls",
                                "bodies_spheres"};

class DrawnBodies : public EditingTest {
 protected:
  [[nodiscard]] gui::SceneView& view() const { return window().view(); }
  void show(const char* action) const {
    part<QAction>(action).trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !tool<gui::BodyDisplayTool>().is_busy(); }, 8000));
  }
  [[nodiscard]] QImage picture() const {
    view().settle();
    return view().grabFramebuffer();
  }
  template <typename Condition>
  [[nodiscard]] int pixels(const Condition& condition) const {
    const QImage image = picture();
    int count = 0;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        count += condition(image.pixelColor(x, y)) ? 1 : 0;
      }
    }
    return count;
  }
  [[nodiscard]] int red_pixels() const {
    return pixels([](const QColor& color) {
      return color.red() > 120 && color.green() < 70 && color.blue() < 70;
    });
  }
  [[nodiscard]] int yellow_pixels() const {
    return pixels([](const QColor& color) {
      return color.red() > 150 && color.green() > 110 && color.blue() < 80;
    });
  }
};

TEST_F(DrawnBodies, LookOtherwiseAsSpheresAndTheSameAgainAsTheyAre) {
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window().workbench().collisions.is_busy(); }, 8000));
  const QImage visual = picture();
  show("bodies_spheres");
  EXPECT_NE(picture(), visual);
  show("bodies_visual");
  EXPECT_EQ(picture(), visual);
}

TEST_F(DrawnBodies, AreFoundByAClickInEveryDisplay) {
  for (const char* action : kActions) {
    SCOPED_TRACE(action);
    show(action);
    const QPoint post = place_of(view().camera(), view().size(), {0.41, 0.38, 0.15}).toPoint();
    QTest::mouseClick(&view(), Qt::LeftButton, {}, post);
    EXPECT_EQ(editor().selection(), (SceneItem{SceneItem::Kind::kObject, "", "post"}));
    QTest::mouseClick(&view(), Qt::LeftButton, {}, QPoint(4, 4));
  }
}

TEST_F(DrawnBodies, AreRedWhereTheyCollideInEveryDisplay) {
  geometric::Configuration q = window().document().configuration();
  q[0] = 0.75;  // into the post
  window().document().set_configuration(q);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window().workbench().collisions.is_busy(); }, 8000));
  for (const char* action : kActions) {
    SCOPED_TRACE(action);
    show(action);
    EXPECT_GT(red_pixels(), 100);
  }
}

TEST_F(DrawnBodies, AreYellowWhereTheyCollideIfTheyAreRed) {
  editor().select({SceneItem::Kind::kObject, "", "post"});
  editor().set_color({0.8F, 0.1F, 0.1F, 1.0F});
  editor().select({});
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window().workbench().collisions.is_busy(); }, 8000));
  const int before = yellow_pixels();
  geometric::Configuration q = window().document().configuration();
  q[0] = 0.75;  // into the post
  window().document().set_configuration(q);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window().workbench().collisions.is_busy(); }, 8000));
  EXPECT_GT(yellow_pixels(), before + 100);
}

TEST_F(DrawnBodies, AreDrawnAsVolumesAfterAnEditToo) {
  show("bodies_hulls");
  editor().add("ball", geometric::Sphere{0.1}, {}, {0.0, 0.6, 0.0});
  ASSERT_TRUE(QTest::qWaitFor([&] { return !tool<gui::BodyDisplayTool>().is_busy(); }, 8000));
  const gui::BodyMeshes meshes = gui::body_meshes(scene(), BodyDisplay::kHulls);
  EXPECT_EQ(meshes.objects.size(), scene().objects.size());
  editor().undo_stack().setClean();  // avoids the question about unsaved changes
  open(cell().post());
  ASSERT_TRUE(QTest::qWaitFor([&] { return !tool<gui::BodyDisplayTool>().is_busy(); }, 8000));
  EXPECT_EQ(tool<gui::BodyDisplayTool>().display(), BodyDisplay::kHulls);
}

}  // namespace
}  // namespace handway::test
