#include "collision/volumes/simplex.h"

#include <Eigen/LU>

namespace handway::geometric {

bool tetrahedron_contains(const Simplex& base, const Eigen::Vector3d& top,
                          const Eigen::Vector3d& p) {
  Eigen::Matrix3d edges;
  edges << base[0] - top, base[1] - top, base[2] - top;
  const Eigen::Vector3d shares = edges.inverse() * (p - top);
  return shares.allFinite() && shares.minCoeff() >= 0.0 && shares.sum() <= 1.0;
}

}  // namespace handway::geometric
