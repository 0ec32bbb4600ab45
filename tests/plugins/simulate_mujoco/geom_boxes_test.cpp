#include "geom_boxes.h"

#include "hand_model.h"
#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace handway::simulate_mujoco {
namespace {

/// Long bars of every shape, each of which floats freely.
ModelPointer floating_bars() {
  constexpr const char* kShapes[] = {"type='box' size='0.1 0.01 0.02'",
                                     "type='cylinder' size='0.01 0.1'", "type='sphere' size='0.03'",
                                     "type='mesh' mesh='bar'"};
  std::string bodies;
  for (int i = 0; i < 24; ++i) {
    bodies += fmt::format("<body><freejoint/><geom {} condim='4'/></body>", kShapes[i % 4]);
  }
  return compile(
      fmt::format("<mujoco>{}<asset><mesh name='bar' vertex='0 0 0 0.2 0 0 0.2 0.02 0 "
                  "0 0.02 0 0 0 0.01 0.2 0 0.03'/></asset>"
                  "<worldbody>{}</worldbody></mujoco>",
                  kSolver, bodies));
}

TEST(GeomBoxes, LeaveNoContactOut) {
  const ModelPointer model = floating_bars();
  const DataPointer data = make_data(*model);
  sampling::RandomStream random(3);
  int contacts = 0;
  for (int round = 0; round < 50; ++round) {
    for (int body = 0; body < 24; ++body) {
      const Eigen::VectorXd place = random.uniform(3) * 0.4;
      const Eigen::Quaterniond turn =
          Eigen::Quaterniond(Eigen::Vector4d(random.uniform(4).array() - 0.5)).normalized();
      std::copy_n(place.data(), 3, data->qpos + 7 * body);
      const double q[] = {turn.w(), turn.x(), turn.y(), turn.z()};
      std::copy_n(q, 4, data->qpos + 7 * body + 3);
    }
    mj_fwdPosition(model.get(), data.get());
    const int with_boxes = data->ncon;
    mjcb_contactfilter = nullptr;
    mj_fwdPosition(model.get(), data.get());
    install_box_filter();
    EXPECT_EQ(with_boxes, data->ncon);
    contacts += data->ncon;
  }
  EXPECT_GT(contacts, 100);
}

}  // namespace
}  // namespace handway::simulate_mujoco
