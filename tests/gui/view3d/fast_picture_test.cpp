#include "pressed_mouse.h"
#include "view3d/scene_view.h"
#include "window_test.h"

#include <QImage>

#include <cstdlib>

namespace handway::test {
namespace {

constexpr int kFewLevels = 48;  // of 255
constexpr double kEdges = 0.004;

/// Share of pixels that differ by more than a few levels.
double difference(const QImage& a, const QImage& b) {
  int differing = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const QColor p = a.pixelColor(x, y);
      const QColor q = b.pixelColor(x, y);
      const int most = std::max({std::abs(p.red() - q.red()), std::abs(p.green() - q.green()),
                                 std::abs(p.blue() - q.blue())});
      differing += most > kFewLevels ? 1 : 0;
    }
  }
  return static_cast<double>(differing) / (static_cast<double>(a.width()) * a.height());
}

class FastPictures : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (!IsSkipped()) {
      open(cell().post());
      view().set_shadows(false);  // which fast pictures do without
      view().settle();
      static_cast<void>(view().grabFramebuffer());
    }
  }

  [[nodiscard]] gui::SceneView& view() const { return window().view(); }

  /// Moves both finger and arm, a step a picture. @returns the last picture.
  [[nodiscard]] QImage move(const std::vector<std::vector<double>>& postures) const {
    QImage picture;
    for (const std::vector<double>& posture : postures) {
      geometric::Configuration q = window().document().configuration();
      for (std::size_t j = 0; j < posture.size(); ++j) {
        q[static_cast<Eigen::Index>(j)] = posture[j];
      }
      window().document().set_configuration(q);
      picture = view().grabFramebuffer();
    }
    return picture;
  }

  [[nodiscard]] QImage fine_picture() const {
    view().settle();
    return view().grabFramebuffer();
  }
};

TEST_F(FastPictures, ShowWhatFinePicturesShow) {
  const QImage first = fine_picture();
  const QImage fast = move({{0.1, 0.0}, {0.2, 0.1}, {0.4, 0.2}, {0.4, 0.5}});
  const QImage fine = fine_picture();
  const double moved = difference(first, fine);
  EXPECT_GT(moved, 2.0 * kEdges);
  EXPECT_LT(difference(fast, fine), kEdges) << "but for smooth edges; moved: " << moved;
}

TEST_F(FastPictures, ShowContactsAndHiddenGhosts) {
  static_cast<void>(move({{0.1, 0.0}, {0.2, 0.0}}));
  view().show_ghosts(false, false);
  view().set_collisions({"lower", "post"});
  const QImage fast = move({{0.3, 0.0}});
  EXPECT_LT(difference(fast, fine_picture()), kEdges);
  view().set_collisions({});
  const QImage plain = move({{0.35, 0.0}});
  EXPECT_LT(difference(plain, fine_picture()), kEdges);
}

TEST_F(FastPictures, TurnWithTheMouse) {
  const QImage first = fine_picture();
  const QPoint middle = view().rect().center();
  QTest::mousePress(&view(), Qt::LeftButton, {}, middle);
  move_pressed_mouse(view(), middle + QPoint(40, 10));
  const QImage turned = view().grabFramebuffer();
  const QImage again = move({{0.1, 0.0}, {0.2, 0.1}});
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, middle + QPoint(40, 10));
  EXPECT_GT(difference(first, turned), 2.0 * kEdges);
  EXPECT_LT(difference(again, fine_picture()), kEdges);
}

}  // namespace
}  // namespace handway::test
