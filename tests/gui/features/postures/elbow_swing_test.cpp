/// Jogging in the null space.
#include "features/postures/elbow_swing.h"

#include "handway_test/robots.h"
#include "widgets/forms/slider_row.h"

#include <QLabel>
#include <QSignalSpy>
#include <QtTest>

#include <gtest/gtest.h>

namespace handway::test {
namespace {

using geometric::Configuration;

class SwingingTheElbow : public ::testing::Test {
 protected:
  void use(const geometric::RobotDescription& robot, int joints) {
    model_ = std::make_shared<const geometric::RobotModel>(robot);
    std::vector<int> arm(static_cast<std::size_t>(joints));
    std::iota(arm.begin(), arm.end(), 0);
    palm_ = model_->variable_link(joints - 1);
    swing_.set_arm(model_, palm_, arm);
    swing_.show();
  }
  [[nodiscard]] geometric::Pose palm(const Configuration& q) const {
    std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(model_->link_count()));
    model_->forward_kinematics(q, X_BL);
    return X_BL[static_cast<std::size_t>(palm_)];
  }
  [[nodiscard]] gui::SliderRow& slider() const {
    return *swing_.findChild<gui::SliderRow*>(QStringLiteral("elbow_swing"));
  }

  gui::ElbowSwing swing_;
  std::shared_ptr<const geometric::RobotModel> model_;
  int palm_ = 0;
};

TEST_F(SwingingTheElbow, LeavesThePalmWhereItIs) {
  use(iiwa14(), 7);
  Configuration q(7);
  q << 0.3, 0.6, 0.1, -1.2, 0.2, 0.9, 0.0;
  swing_.set_configuration(q);
  EXPECT_TRUE(slider().isVisible());
  Configuration shown = q;
  QObject::connect(&swing_, &gui::ElbowSwing::configuration_edited, [&](const Eigen::VectorXd& to) {
    shown = to;
    swing_.set_configuration(to);
  });
  emit slider().value_edited(0.4);
  EXPECT_GT((shown - q).norm(), 0.3);
  EXPECT_LT((palm(shown).matrix() - palm(q).matrix()).norm(), 1e-3);
  emit slider().value_edited(0.0);
  EXPECT_LT((shown - q).norm(), 0.02) << "back again";
  EXPECT_TRUE(swing_.findChild<QLabel*>(QStringLiteral("reach_figures"))
                  ->text()
                  .startsWith(QStringLiteral("Manipulability 0.")));
}

TEST_F(SwingingTheElbow, IsNotOfferedToArmsOfSixJoints) {
  use(ur5e(), 6);
  swing_.set_configuration(Configuration::Zero(6));
  EXPECT_FALSE(slider().isVisible());
  EXPECT_TRUE(swing_.isVisible()) << "the figures are";
}

}  // namespace
}  // namespace handway::test
