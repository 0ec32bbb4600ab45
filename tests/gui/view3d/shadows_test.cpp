#include "view3d/scene_view.h"
#include "view3d/view_gizmo.h"
#include "window_test.h"

#include <QImage>

namespace handway::test {
namespace {

using Eigen::Vector3d;

/// The cell with a post (4 by 4 cm, at x = 0.3 m) on the floor, seen from above obliquely.
class Shadows : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (!IsSkipped()) {
      open(cell().post());
      view().show_ghosts(false, false);
    }
  }

  [[nodiscard]] gui::SceneView& view() const { return window().view(); }

  [[nodiscard]] QImage picture(bool with_shadows) const {
    view().set_shadows(with_shadows);
    view().settle();
    return view().grabFramebuffer();
  }

  [[nodiscard]] static int lightness(const QImage& image, const QPoint& place) {
    return image.pixelColor(place).lightness();
  }
};

TEST_F(Shadows, DarkenOnlyAndNotEverything) {
  const QImage plain = picture(false);
  const QImage shaded = picture(true);
  int darker = 0;
  int lighter = 0;
  int same = 0;
  for (int y = 0; y < plain.height(); ++y) {
    for (int x = 0; x < plain.width(); ++x) {
      const int change = lightness(shaded, {x, y}) - lightness(plain, {x, y});
      darker += change < -20 ? 1 : 0;
      lighter += change > 2 ? 1 : 0;
      same += std::abs(change) <= 2 ? 1 : 0;
    }
  }
  EXPECT_GT(darker, 200);
  EXPECT_EQ(lighter, 0);
  EXPECT_GT(same, plain.width() * plain.height() / 2);
}

TEST_F(Shadows, CanBeLeftAway) {
  const QImage plain = picture(false);
  EXPECT_NE(picture(true), plain);
  EXPECT_EQ(picture(false), plain);
}

TEST_F(Shadows, AreTheSameAfterMotionAndInParallelProjection) {
  const QImage before = picture(true);
  geometric::Configuration q = window().document().configuration();
  const double at_first = q[0];
  q[0] += 0.2;
  window().document().set_configuration(q);
  static_cast<void>(view().grabFramebuffer());
  q[0] = at_first;
  window().document().set_configuration(q);
  EXPECT_EQ(picture(true), before);
  view().set_projection(gui::Projection::kOrthographic);
  EXPECT_NE(picture(true), picture(false));
}

}  // namespace
}  // namespace handway::test
