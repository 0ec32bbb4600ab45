/// The emulated controller without wires.
#include "handway/device/arm/val3_arm.h"
#include "handway/device/emulators/arm_emulator.h"

#include <gtest/gtest.h>

namespace handway::device {
namespace {

Val3ControllerSettings settings() {
  Val3ControllerSettings made;
  made.joints = tx90_joints();
  made.position = Eigen::VectorXd::Zero(6);
  return made;
}

SimpleMessage point(float joint_1, float velocity) {
  SimpleMessage message;
  message.type = SimpleMessageType::kJointTrajectoryPoint;
  message.kind = SimpleMessageKind::kRequest;
  message.joints[0] = joint_1;
  message.velocity = velocity;
  message.duration = 5.0F;
  return message;
}

bool takes(Val3Controller& controller, const SimpleMessage& message, double now = 0.0) {
  return controller.receive(message, now).reply == SimpleMessageReply::kSuccess;
}

TEST(Val3Controller, GoesAtTheShareOfItsVelocity) {
  Val3Controller controller(settings());
  EXPECT_TRUE(takes(controller, point(0.5F, 0.1F)));
  const double full = tx90_joints().velocity[0];
  controller.advance(0.4);
  EXPECT_NEAR(controller.position()[0], 0.1 * full * (0.4 - 0.01), 0.002) << "less its lag";
  EXPECT_TRUE(controller.moving());
  controller.advance(1.0);
  EXPECT_NEAR(controller.position()[0], 0.5, 1e-6);
  EXPECT_FALSE(controller.moving());
}

TEST(Val3Controller, RefusesWhatTheServerRefuses) {
  Val3Controller controller(settings());
  EXPECT_FALSE(takes(controller, point(0.5F, 0.0F))) << "no velocity";
  EXPECT_FALSE(takes(controller, point(4.0F, 0.1F))) << "out of range";
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(takes(controller, point(0.1F * static_cast<float>(i + 1), 0.01F))) << i;
  }
  EXPECT_FALSE(takes(controller, point(1.1F, 0.01F))) << "queue full";
  EXPECT_TRUE(takes(controller, point(1.1F, 0.01F), 2.0)) << "room again";
}

TEST(Val3Controller, ForgetsItsQueueAtAStop) {
  Val3Controller controller(settings());
  EXPECT_TRUE(takes(controller, point(2.0F, 0.5F)));
  SimpleMessage stop = point(0.0F, 0.0F);
  stop.sequence = kStopSequence;
  EXPECT_TRUE(takes(controller, stop, 0.2));
  // Braking from 3.5 rad/s takes half of the 0.25 s that it takes from full speed.
  controller.advance(0.2 + 0.125 + 0.1);
  EXPECT_FALSE(controller.moving());
  const double stood = controller.position()[0];
  EXPECT_NEAR(stood, 3.49 * (0.2 + 0.5 * 0.125), 0.02);
  controller.advance(2.0);
  EXPECT_NEAR(controller.position()[0], stood, 1e-3);
  EXPECT_TRUE(takes(controller, point(0.0F, 0.5F), 2.0)) << "it can go on";
  controller.advance(3.0);
  EXPECT_NEAR(controller.position()[0], 0.0, 1e-6);
}

TEST(Val3Controller, TellsItsStatusEveryFifthTime) {
  Val3Controller controller(settings());
  int statuses = 0;
  for (int i = 0; i < 10; ++i) {
    for (const SimpleMessage& message : controller.feedback()) {
      statuses += message.type == SimpleMessageType::kStatus ? 1 : 0;
    }
  }
  EXPECT_EQ(statuses, 2);
}

TEST(Val3Controller, CutsItsPowerAtAnEmergencyStop) {
  Val3ControllerSettings faulty = settings();
  faulty.fault = {FaultKind::kEstop, 0.1};
  Val3Controller controller(faulty);
  EXPECT_TRUE(takes(controller, point(2.0F, 0.2F)));
  controller.advance(1.0);
  EXPECT_FALSE(controller.moving());
  EXPECT_LT(controller.position()[0], 0.5);
  EXPECT_FALSE(takes(controller, point(0.0F, 0.2F), 1.0));
  const SimpleMessage status = controller.feedback().back();
  EXPECT_EQ(status.status.emergency_stopped, 1);
  EXPECT_EQ(status.status.drives_powered, 0);
}

}  // namespace
}  // namespace handway::device
