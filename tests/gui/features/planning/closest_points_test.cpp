#include "features/planning/collision_display.h"
#include "window_test.h"

#include <QAction>
#include <QSignalSpy>

namespace handway::test {
namespace {

class ClosestPointsInTheView : public WindowTest {
 protected:
  /// Returns the monitor's report on the start, moved by this much in the shoulder.
  gui::CollisionReport report(double shoulder) {
    gui::CollisionReport latest;
    const auto connection =
        QObject::connect(&window().workbench().collisions, &gui::CollisionMonitor::checked,
                         [&](const gui::CollisionReport& report) { latest = report; });
    geometric::Configuration q = *window().document().scene()->start;
    q[0] += shoulder;
    window().document().set_configuration(q);
    EXPECT_TRUE(QTest::qWaitFor([&] { return !window().workbench().collisions.is_busy(); }));
    QObject::disconnect(connection);
    return latest;
  }
};

TEST_F(ClosestPointsInTheView, AreAsFarApartAsThePair) {
  open(cell().post());
  int shown = 0;
  for (int i = 0; i < 40; ++i) {
    const gui::CollisionReport found = report(0.04 * i);
    EXPECT_EQ(found.closest.has_value(), found.points.has_value());
    if (found.points) {
      ++shown;
      EXPECT_NEAR((found.points->p_WA - found.points->p_WB).norm(), found.closest->distance, 1e-3);
    }
  }
  EXPECT_GT(shown, 0) << "the arm passes the post";
}

TEST_F(ClosestPointsInTheView, MayBeHidden) {
  open(cell().post());
  auto& shown = part<QAction>("closest_points");
  EXPECT_TRUE(shown.isChecked());
  shown.trigger();
  EXPECT_FALSE(shown.isChecked());
}

}  // namespace
}  // namespace handway::test
