/// Tests that texts and icons are sharp on a screen of more pixels than units of layout. On others
/// it says nothing new: CTest runs it with two pixels for each (PixelRatio2).
#include "features/editing/editing_test.h"
#include "view3d/scene_view.h"

#include <QImage>
#include <QToolButton>

#include <cmath>

namespace handway::test {
namespace {

class PixelRatio : public EditingTest {
 protected:
  void SetUp() override {
    EditingTest::SetUp();
    if (!IsSkipped()) {
      ratio_ = static_cast<int>(std::lround(window().devicePixelRatioF()));
    }
  }
  int ratio_ = 1;
};

// Blocks of pixels that are not of one colour, as those of a picture that was enlarged would be.
int mixed_blocks(const QImage& image, int side) {
  int mixed = 0;
  for (int y = 0; y + side <= image.height(); y += side) {
    for (int x = 0; x + side <= image.width(); x += side) {
      const QRgb first = image.pixel(x, y);
      mixed += first != image.pixel(x + side - 1, y) || first != image.pixel(x, y + side - 1);
    }
  }
  return mixed;
}

TEST_F(PixelRatio, TheViewIsDrawnInThePixelsOfTheScreen) {
  gui::SceneView& view = window().view();
  view.settle();
  const QImage picture = view.grabFramebuffer();
  EXPECT_EQ(picture.size(), view.size() * ratio_);
  if (ratio_ > 1) {
    EXPECT_GT(mixed_blocks(picture, ratio_), 500);
  }
}

TEST_F(PixelRatio, IconsAreDrawnInThePixelsOfTheScreen) {
  int icons = 0;
  for (const auto* button : window().findChildren<QToolButton*>()) {
    if (!button->icon().isNull() && button->isVisible()) {
      const QPixmap icon = button->icon().pixmap(window().windowHandle(), button->iconSize());
      EXPECT_GE(icon.width(), button->iconSize().width() * ratio_)
          << qPrintable(button->toolTip()) << qPrintable(button->objectName());
      ++icons;
    }
  }
  EXPECT_GT(icons, 20);
}

}  // namespace
}  // namespace handway::test
