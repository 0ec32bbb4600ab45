#include "glove_dock.h"

#include <QComboBox>
#include <QLabel>

#include <cmath>

namespace handway::test {
namespace {

using ::testing::HasSubstr;

// Returns the closing angle by the typical calibration.
double closing_at(double counts) { return 0.01616 * (counts - 72.0); }

class ContactGuard : public GloveDock {
 protected:
  [[nodiscard]] bool waits_until_held() const {
    return QTest::qWaitFor([&] { return !part<QLabel>("glove_contact").isHidden(); }, 8000);
  }
};

TEST_F(ContactGuard, HoldsTheLastFreePosture) {
  connect_to_emulator();
  set_counts(80);
  ASSERT_TRUE(QTest::qWaitFor([&] { return std::abs(joint("left") - closing_at(80)) < 1e-9; }));
  const double left = joint("left");
  part<QComboBox>("contact_rule").setCurrentIndex(1);
  // The arm's lower link in the post: whatever the glove does, it is not free.
  geometric::Configuration q = window().document().configuration();
  q[*window().document().robot()->model->find_variable("shoulder")] = 0.75;
  window().document().set_configuration(q);
  ASSERT_TRUE(waits_until_held());
  EXPECT_THAT(part<QLabel>("glove_contact").text().toStdString(), HasSubstr("post"));
  set_counts(100);
  QTest::qWait(200);
  EXPECT_DOUBLE_EQ(joint("left"), left);
  part<QComboBox>("contact_rule").setCurrentIndex(0);
  EXPECT_TRUE(QTest::qWaitFor([&] { return std::abs(joint("left") - closing_at(100)) < 1e-9; }));
  EXPECT_TRUE(part<QLabel>("glove_contact").isHidden());
}

}  // namespace
}  // namespace handway::test
