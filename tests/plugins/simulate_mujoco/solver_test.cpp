/// The solver with the settings of the hold test, against closed forms.
#include "hand_model.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace handway::simulate_mujoco {
namespace {

ModelPointer world(const std::string& bodies) {
  return compile(fmt::format(
      "<mujoco><compiler angle='radian'/>{}<worldbody>{}</worldbody></mujoco>", kSolver, bodies));
}

TEST(Solver, KeepsThePeriodOfAPendulum) {
  constexpr double kLength = 0.5;      // m
  constexpr double kAmplitude = 0.05;  // rad: the period is 1.6e-4 longer than of a small one
  const ModelPointer model =
      world(fmt::format("<body><joint name='j' type='hinge' axis='0 1 0'/>"
                        "<inertial pos='0 0 -{}' mass='1' diaginertia='1e-9 1e-9 1e-9'/></body>",
                        kLength));
  model->opt.gravity[2] = -9.81;
  const DataPointer data = make_data(*model);
  data->qpos[0] = kAmplitude;
  std::vector<double> crossings;  // s, downwards
  while (crossings.size() < 11) {
    const double before = data->qpos[0];
    mj_step(model.get(), data.get());
    if (before > 0.0 && data->qpos[0] <= 0.0) {
      const double share = before / (before - data->qpos[0]);
      crossings.push_back(data->time - (1.0 - share) * model->opt.timestep);
    }
  }
  const double period = (crossings.back() - crossings.front()) / 10.0;
  const double expected =
      2.0 * std::numbers::pi * std::sqrt(kLength / 9.81) * (1.0 + kAmplitude * kAmplitude / 16.0);
  EXPECT_NEAR(period, expected, 0.005 * expected);
}

TEST(Solver, KeepsMomentumAndEnergyOfAFreeBody) {
  const ModelPointer model = world(
      "<body><freejoint/><inertial pos='0 0 0' mass='0.3' diaginertia='1e-3 2e-3 2.5e-3'/></body>");
  const DataPointer data = make_data(*model);
  const Eigen::Vector3d velocity(0.1, -0.2, 0.3);
  const Eigen::Vector3d spin(2.0, 1.0, -3.0);  // rad/s, in the body's frame
  std::copy_n(velocity.data(), 3, data->qvel);
  std::copy_n(spin.data(), 3, data->qvel + 3);
  const auto energy = [&] {
    const Eigen::Map<const Eigen::Vector3d> v(data->qvel);
    const Eigen::Map<const Eigen::Vector3d> w(data->qvel + 3);
    return 0.5 * 0.3 * v.squaredNorm() +
           0.5 * w.cwiseAbs2().dot(Eigen::Vector3d(1e-3, 2e-3, 2.5e-3));
  };
  const double before = energy();
  while (data->time < 2.0) {
    mj_step(model.get(), data.get());
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(data->qvel[axis], velocity[axis], 1e-9);
  }
  EXPECT_NEAR(energy(), before, 0.01 * before);
}

TEST(Solver, TurnsErrorsIntoExceptions) {
  EXPECT_THROW(compile("<mujoco><worldbody><geom/></mujoco>"), std::runtime_error);
  EXPECT_THROW(compile("<mujoco><worldbody><geom type='mesh' mesh='none'/></worldbody></mujoco>"),
               std::runtime_error);
}

}  // namespace
}  // namespace handway::simulate_mujoco
