#include "geom_boxes.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace handway::simulate_mujoco {
namespace {

using Eigen::Vector3d;
using Rotation = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr int kBoxNumbers = 6;

struct Box {
  Vector3d middle;
  Vector3d half;
};

Box box_of(const mjModel& model, int geom) {
  const mjtNum* size = model.geom_size + 3 * geom;
  switch (model.geom_type[geom]) {
    case mjGEOM_SPHERE:
      return {Vector3d::Zero(), Vector3d::Constant(size[0])};
    case mjGEOM_CYLINDER:
      return {Vector3d::Zero(), {size[0], size[0], size[1]}};
    case mjGEOM_BOX:
      return {Vector3d::Zero(), Vector3d(size)};
    case mjGEOM_MESH: {
      const int mesh = model.geom_dataid[geom];
      const Eigen::Map<const Eigen::Matrix3Xf> corners(
          model.mesh_vert + 3 * model.mesh_vertadr[mesh], 3, model.mesh_vertnum[mesh]);
      const Vector3d lower = corners.rowwise().minCoeff().cast<double>();
      const Vector3d upper = corners.rowwise().maxCoeff().cast<double>();
      return {0.5 * (lower + upper), 0.5 * (upper - lower)};
    }
    default:  // never kept apart
      return {Vector3d::Zero(), Vector3d::Constant(std::numeric_limits<double>::infinity())};
  }
}

// MuJoCo's own rule, which a filter replaces.
bool may_collide(const mjModel& model, int a, int b) {
  return (model.geom_contype[a] & model.geom_conaffinity[b]) != 0 ||
         (model.geom_contype[b] & model.geom_conaffinity[a]) != 0;
}

bool spheres_overlap(const mjModel& model, const mjData& data, int a, int b, double margin) {
  const double ra = model.geom_rbound[a];
  const double rb = model.geom_rbound[b];
  if (ra <= 0.0 || rb <= 0.0) {  // a plane has none
    return true;
  }
  const Vector3d offset = Vector3d(data.geom_xpos + 3 * b) - Vector3d(data.geom_xpos + 3 * a);
  const double reach = ra + rb + margin;
  return offset.squaredNorm() <= reach * reach;
}

// Returns true if no face of the two boxes is between them.
bool boxes_overlap(const mjModel& model, const mjData& data, int a, int b, double margin) {
  const mjtNum* box_a = model.geom_user + kBoxNumbers * a;
  const mjtNum* box_b = model.geom_user + kBoxNumbers * b;
  const Eigen::Map<const Rotation> R_WA(data.geom_xmat + 9 * a);
  const Eigen::Map<const Rotation> R_WB(data.geom_xmat + 9 * b);
  const Eigen::Map<const Vector3d> half_a(box_a + 3);
  const Eigen::Map<const Vector3d> half_b(box_b + 3);
  const Vector3d offset_W =
      Vector3d(data.geom_xpos + 3 * b) + R_WB * Eigen::Map<const Vector3d>(box_b) -
      Vector3d(data.geom_xpos + 3 * a) - R_WA * Eigen::Map<const Vector3d>(box_a);
  const Eigen::Matrix3d R_AB = R_WA.transpose() * R_WB;
  const Eigen::Matrix3d shares = R_AB.cwiseAbs();
  const auto reaches = [margin](const Vector3d& offset, const Vector3d& reach) {
    return (offset.cwiseAbs().array() <= reach.array() + margin).all();
  };
  return reaches(R_WA.transpose() * offset_W, half_a + shares * half_b) &&
         reaches(R_WB.transpose() * offset_W, half_b + shares.transpose() * half_a);
}

int leaves_out(const mjModel* model, mjData* data, int a, int b) {
  if (!may_collide(*model, a, b)) {
    return 1;
  }
  if (model->nuser_geom != kBoxNumbers) {
    return 0;
  }
  constexpr double kSpare = 1e-6;  // m, of rounding: corners have 32 bits
  const double margin = model->geom_margin[a] + model->geom_margin[b] + kSpare;
  return spheres_overlap(*model, *data, a, b, margin) && boxes_overlap(*model, *data, a, b, margin)
             ? 0
             : 1;
}

}  // namespace

void set_geom_boxes(mjModel& model) {
  for (int geom = 0; geom < model.ngeom && model.nuser_geom == kBoxNumbers; ++geom) {
    const Box box = box_of(model, geom);
    mjtNum* numbers = model.geom_user + kBoxNumbers * geom;
    std::copy_n(box.middle.data(), 3, numbers);
    std::copy_n(box.half.data(), 3, numbers + 3);
  }
}

void install_box_filter() { mjcb_contactfilter = leaves_out; }

}  // namespace handway::simulate_mujoco
