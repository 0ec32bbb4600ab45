#pragma once

#include "handway/sampling/postures/pmd_basis.h"

/// The SAH hand's published principal motion directions and joint limits, as
/// facts to test against (Kautham's TX90_RHand_5PMD.rob: offsets, eigValues
/// halved to half sides, eigenvectors as printed).
namespace handway::test {

/// Offsets and the components of C1, C2, C3, C4 and C8. Thumb and thumb base
/// follow the same glove sensor, so the vectors aren't of unit length here.
inline sampling::PmdBasis sah_published_basis() {
  sampling::PmdBasis basis;
  basis.hand = "sah_right";
  basis.source = "TX90_RHand_5PMD.rob";
  basis.joints = {"thumb",           "thumb_base",     "thumb_proximal", "thumb_medial",
                  "index_base",      "index_proximal", "index_medial",   "middle_base",
                  "middle_proximal", "middle_medial",  "ring_base",      "ring_proximal",
                  "ring_medial"};
  basis.mean.resize(13);
  basis.mean << 0.3055, 0.3055, 0.6308, 0.5143, 0.5544, 0.5400, 0.5075, 0.5000, 0.5579, 0.4118,
      0.4909, 0.5407, 0.4806;
  Eigen::MatrixXd vectors(5, 13);
  vectors << -0.0683, -0.0683, 0.2222, 0.3194, 0.2409, -0.4246, 0.2125, 0, -0.4884, 0.2399, -0.1741,
      -0.4451, 0.1897,  //
      -0.0144, -0.0144, -0.1323, -0.2335, 0.2090, -0.2023, -0.5050, 0, -0.2759, -0.4695, -0.1258,
      -0.2616, -0.4554,  //
      0.6638, 0.6638, 0.6816, -0.0597, 0.0137, 0.1785, -0.1633, 0, 0.0215, -0.0470, 0.1078, -0.1351,
      0.0030,  //
      -0.2879, -0.2879, 0.2207, 0.5468, -0.4425, 0.0076, 0.0258, 0, 0.0387, -0.3149, 0.4037,
      -0.1768, -0.2791,  //
      0.1692, 0.1692, 0.0844, -0.0681, -0.2715, -0.7987, -0.1197, 0, 0.0321, -0.0169, 0.1239,
      0.4609, 0.0669;
  const double sides[] = {1.6550, 1.4355, 0.8851, 0.7174, 0.3032};
  const char* names[] = {"C1", "C2", "C3", "C4", "C8"};
  for (int i = 0; i < 5; ++i) {
    basis.directions.push_back({names[i], vectors.row(i).transpose(), sides[i] / 2.0, 0.0});
  }
  return basis;
}

/// Returns this basis with the thumb as a free joint and its component in the directions set to 0
/// (TX90_RHand_5PMD_thumb.rob): the paper's thumb base and PMDs.
inline sampling::PmdBasis sah_thumb_basis() {
  sampling::PmdBasis basis = sah_published_basis();
  basis.source = "TX90_RHand_5PMD_thumb.rob";
  basis.free_joints = {{0, 0.3055, 0.5}};
  for (sampling::PrincipalDirection& direction : basis.directions) {
    direction.vector[0] = 0.0;
  }
  return basis;
}

/// Joint values in degrees of normalised joints.
inline Eigen::VectorXd sah_degrees(const Eigen::VectorXd& normalised) {
  Eigen::VectorXd lower(13);
  Eigen::VectorXd upper(13);
  lower << -90, -15, -75, -75, -15, -75, -75, -15, -75, -75, -15, -75, -75;
  upper << 0, 15, 4, -4, 15, 4, -4, 15, 4, -4, 15, 4, -4;
  return lower + normalised.cwiseProduct(upper - lower);
}

}  // namespace handway::test
