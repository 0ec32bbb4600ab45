/// Tests the map from the pose of a tool to the place on a path, and motions along it.
#include "handway/execution/guidance/guidance_run.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/robot_state.h"
#include "handway_test/robots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace handway::execution {
namespace {

/// A TX90 that turns its base by half a radian, moves its last joint alone, and turns back a bit.
class Guidance : public testing::Test {
 protected:
  Guidance() {
    const Eigen::VectorXd q = Eigen::VectorXd::Constant(6, 0.3);
    path_.waypoints.assign(4, q);
    path_.waypoints[1][0] += 0.5;
    path_.waypoints[2][0] += 0.5;
    path_.waypoints[2][5] += 0.4;
    path_.waypoints[3][0] += 0.3;
    path_.waypoints[3][5] += 0.4;
  }

  std::shared_ptr<const geometric::RobotModel> model_ =
      std::make_shared<geometric::RobotModel>(test::tx90_urdf_style());
  planning::Path path_;
};

TEST_F(Guidance, FindsThePlacesOfAPathByTheWayOfALink) {
  // The origin of the last link is on the last joint's axis: it stands while that one turns.
  const std::string link = tool_link(*model_, {0, 1, 2, 3, 4, 5});
  const PathToolCurve way(model_, path_, link);
  const double first = way.arc_length_at(1.0);
  EXPECT_GT(first, 0.1);
  EXPECT_NEAR(way.arc_length_at(2.0), first, 1e-12);
  EXPECT_NEAR(way.place_at(first), 2.0, 1e-6) << "the last place there";
  EXPECT_NEAR(way.place_at(0.5 * first), 0.5, 0.01);
  EXPECT_EQ(way.place_at(99.0), 3.0);
  geometric::RobotState robot(model_);
  robot.set_configuration(way.configuration(0.3));
  EXPECT_LT((robot.link_pose(link).translation() - way.curve()->at(way.arc_length_at(0.3))).norm(),
            1e-4);
  EXPECT_THROW(PathToolCurve(model_, path_, "leg"), geometric::InputError);
  EXPECT_THROW(PathToolCurve(model_, {}, link), geometric::InputError);
}

TEST_F(Guidance, GoesNoFasterThanTheJointsMay) {
  GuidedMotion motion(path_, Eigen::VectorXd::Constant(6, 0.5));
  EXPECT_NEAR(motion.advance(3.0, 0.5), 0.5, 1e-12);
  EXPECT_NEAR(motion.advance(3.0, 0.9), 1.5, 1e-12) << "0.5 s, and then 0.4 of 0.8 s";
  EXPECT_NEAR(motion.advance(0.9, 0.5), 0.9, 1e-12) << "back again, and not farther than asked";
  EXPECT_NEAR(motion.advance(3.0, 100.0), 3.0, 1e-12);
  EXPECT_NEAR(motion.advance(99.0, 1.0), 3.0, 1e-12);
  EXPECT_NEAR(motion.advance(-1.0, 100.0), 0.0, 1e-12);
  EXPECT_THROW(GuidedMotion(path_, Eigen::VectorXd::Zero(6)), std::invalid_argument);
  EXPECT_THROW(GuidedMotion(path_, Eigen::VectorXd::Ones(5)), std::invalid_argument);
}

/// A handle that is held 50 mm from where it began.
class FakeHandle final : public device::HapticDevice {
 public:
  FakeHandle() : HapticDevice("handle") {}

  std::string throws_in;  ///< read or apply
  int applied = 0;
  double force = 0.0;  ///< N

 private:
  [[nodiscard]] device::HapticAbilities do_connect(const std::stop_token& /*stop*/) override {
    return {3.3, {0.1, 0.1, 0.1}};
  }
  [[nodiscard]] Reading do_read(std::chrono::milliseconds /*timeout*/) override {
    if (throws_in == "read" && applied > 3) {
      throw std::runtime_error("read went wrong");
    }
    device::HapticSample sample;
    sample.time = 0.002 * ++reads_;
    sample.position = reads_ > 1 ? Eigen::Vector3d(0.05, 0.05, 0.05) : Eigen::Vector3d::Zero();
    sample.button = true;
    return {sample};
  }
  void do_apply(const Eigen::Vector3d& wanted) override {
    if (throws_in == "apply" && applied == 5) {
      throws_in.clear();
      throw std::runtime_error("apply went wrong");
    }
    ++applied;
    force = wanted.norm();
  }

  int reads_ = 0;
};

class GuidanceWithAnException : public Guidance, public testing::WithParamInterface<const char*> {};

TEST_P(GuidanceWithAnException, LeavesNoForceAndReportsIt) {
  const std::string call = GetParam();
  const PathToolCurve way(model_, path_, tool_link(*model_, {0, 1, 2, 3, 4, 5}));
  device::ForceGuide guide(way.curve(), {});
  GuidedMotion motion(path_, Eigen::VectorXd::Constant(6, 0.5));
  FakeHandle handle;
  handle.throws_in = call;
  handle.connect();
  bool was_pushed = false;
  int leads = 0;
  const GuidanceOutcome outcome = run_guidance(handle, guide, way, motion, {},
                                               {.on_sample =
                                                    [&](const GuidanceSample& sample) {
                                                      was_pushed = was_pushed || handle.force > 0.0;
                                                      if (call == "log" && sample.time > 0.1) {
                                                        throw std::runtime_error("log went wrong");
                                                      }
                                                    },
                                                .lead =
                                                    [&](const geometric::Configuration& /*q*/) {
                                                      if (call == "lead" && ++leads > 1) {
                                                        throw std::runtime_error("lead went wrong");
                                                      }
                                                    }});
  EXPECT_EQ(outcome.fault, call + " went wrong");
  EXPECT_FALSE(outcome.arrived);
  EXPECT_TRUE(was_pushed);
  EXPECT_EQ(handle.force, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Calls, GuidanceWithAnException,
                         testing::Values("read", "apply", "log", "lead"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace handway::execution
