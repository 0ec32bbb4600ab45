/// Forward kinematics of the whole 25-link robot, against the textbook way:
/// one dense 4x4 product per joint origin and one per joint rotation.
#include "handway/geometric/robot/jacobian.h"
#include "handway/geometric/robot/numeric_inverse_kinematics.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/robot/spherical_wrist_inverse_kinematics.h"
#include "handway_test/robots.h"
#include "random_configurations.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <random>
#include <vector>

namespace handway::geometric {
namespace {

using test::random_configurations;

void dense_products(const RobotModel& model, const Configuration& q,
                    std::vector<Eigen::Matrix4d>& X_BL) {
  X_BL[0].setIdentity();
  for (int i = 1; i < model.link_count(); ++i) {
    const Joint& joint = model.joint(i);
    const RobotModel::MimicMapping& drive = model.mimic_mapping(i);
    Eigen::Matrix4d motion = Eigen::Matrix4d::Identity();
    if (drive.variable >= 0) {
      const double value = drive.multiplier * q[drive.variable] + drive.offset;
      motion.topLeftCorner<3, 3>() = Eigen::AngleAxisd(value, joint.axis).toRotationMatrix();
    }
    X_BL[static_cast<std::size_t>(i)] =
        X_BL[static_cast<std::size_t>(model.parent(i))] * joint.X_PJ.matrix() * motion;
  }
}

void bm_forward_kinematics(benchmark::State& state) {
  const RobotModel model(test::tx90_sah());
  const std::vector<Configuration> configurations = random_configurations(model, 256);
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  std::size_t k = 0;
  for (auto _ : state) {
    model.forward_kinematics(configurations[k++ % configurations.size()], X_BL);
    benchmark::DoNotOptimize(X_BL.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(bm_forward_kinematics);

void bm_forward_kinematics_dense4x4_baseline(benchmark::State& state) {
  const RobotModel model(test::tx90_sah());
  const std::vector<Configuration> configurations = random_configurations(model, 256);
  std::vector<Eigen::Matrix4d> X_BL(static_cast<std::size_t>(model.link_count()));
  std::size_t k = 0;
  for (auto _ : state) {
    dense_products(model, configurations[k++ % configurations.size()], X_BL);
    benchmark::DoNotOptimize(X_BL.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(bm_forward_kinematics_dense4x4_baseline);

void bm_point_jacobian(benchmark::State& state) {
  const RobotModel model(test::tx90_sah());
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(random_configurations(model, 1).front(), X_BL);
  const int link = model.find_link("Index-Dist").value();
  for (auto _ : state) {
    benchmark::DoNotOptimize(point_jacobian(model, X_BL, link));
  }
}
BENCHMARK(bm_point_jacobian);

void bm_spherical_wrist_inverse_kinematics(benchmark::State& state) {
  const auto model = std::make_shared<const RobotModel>(test::tx90_sah());
  const auto ik = make_spherical_wrist_inverse_kinematics(model, "Palm");
  const std::vector<Configuration> configurations = random_configurations(*model, 256);
  std::vector<Pose> X_BL(static_cast<std::size_t>(model->link_count()));
  std::vector<Pose> targets;
  for (const Configuration& q : configurations) {
    model->forward_kinematics(q, X_BL);
    targets.push_back(X_BL[static_cast<std::size_t>(ik->tip_link())]);
  }
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(ik->solve(targets[k % targets.size()], configurations.front()));
    ++k;
  }
}
BENCHMARK(bm_spherical_wrist_inverse_kinematics);

void bm_numeric_inverse_kinematics(benchmark::State& state) {
  const auto model = std::make_shared<const RobotModel>(test::tx90_urdf_style());
  const NumericInverseKinematics ik(model, "flange");
  const std::vector<Configuration> configurations = random_configurations(*model, 256);
  std::vector<Pose> X_BL(static_cast<std::size_t>(model->link_count()));
  std::vector<Pose> targets;
  for (const Configuration& q : configurations) {
    model->forward_kinematics(q, X_BL);
    targets.push_back(X_BL.back());
  }
  std::size_t k = 0;
  int iterations = 0;
  int reached = 0;
  for (auto _ : state) {
    const NumericIkResult result =
        ik.find(targets[k % targets.size()], configurations[(k + 1) % configurations.size()]);
    iterations += result.iterations;
    reached += result.converged ? 1 : 0;
    ++k;
  }
  state.counters["iterations"] = static_cast<double>(iterations) / static_cast<double>(k);
  state.counters["reached"] = static_cast<double>(reached) / static_cast<double>(k);
}
BENCHMARK(bm_numeric_inverse_kinematics);

/// Poses of 10 000 uniformly random configurations, each from the neutral one: the time of a single
/// solution, and how many are reached, as solvers of other projects are compared by.
void bm_arm_inverse_kinematics(benchmark::State& state, const RobotDescription& robot) {
  constexpr int kPoses = 10000;
  using Clock = std::chrono::steady_clock;
  const auto model = std::make_shared<const RobotModel>(robot);
  const NumericInverseKinematics ik(model, model->link(model->link_count() - 1).name);
  const std::vector<Configuration> configurations = random_configurations(*model, kPoses);
  std::vector<Pose> X_BL(static_cast<std::size_t>(model->link_count()));
  std::vector<double> times;
  int reached = 0;
  for (auto _ : state) {
    for (const Configuration& q : configurations) {
      model->forward_kinematics(q, X_BL);
      const Clock::time_point begin = Clock::now();
      reached += ik.find(X_BL.back(), model->neutral()).converged ? 1 : 0;
      times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
    }
  }
  std::ranges::sort(times);
  const auto at = [&](double share) {
    return times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1))];
  };
  state.counters["reached"] = static_cast<double>(reached) / static_cast<double>(times.size());
  state.counters["median_us"] = at(0.5);
  state.counters["p99_us"] = at(0.99);
}
BENCHMARK_CAPTURE(bm_arm_inverse_kinematics, ur5e, test::ur5e())->Iterations(1);
BENCHMARK_CAPTURE(bm_arm_inverse_kinematics, panda, test::panda_arm())->Iterations(1);
BENCHMARK_CAPTURE(bm_arm_inverse_kinematics, iiwa14, test::iiwa14())->Iterations(1);

}  // namespace
}  // namespace handway::geometric
