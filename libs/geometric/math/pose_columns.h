#pragma once

#include "handway/geometric/math/pose.h"

namespace handway::geometric {

/// A column of a pose's 4 x 4 matrix: one register of a wide vector unit.
using PoseColumn = double __attribute__((vector_size(32)));

/// The columns of a pose's matrix, three axes and the origin, for functions with
/// HANDWAY_VECTOR_UNITS.
struct PoseColumns {
  explicit PoseColumns(const Pose& X) : x(at(X, 0)), y(at(X, 1)), z(at(X, 2)), p(at(X, 3)) {}

  void store(Pose& X) const {
    at(X, 0) = x;
    at(X, 1) = y;
    at(X, 2) = z;
    at(X, 3) = p;
  }

  /// Replaces the pose X_AB by X_AC. @param X_BC pose to multiply by.
  void multiply(const Pose& X_BC) {
    const double* const v = X_BC.data();
    const PoseColumn a = x * v[0] + y * v[1] + z * v[2];
    const PoseColumn b = x * v[4] + y * v[5] + z * v[6];
    const PoseColumn c = x * v[8] + y * v[9] + z * v[10];
    p += x * v[12] + y * v[13] + z * v[14];
    x = a;
    y = b;
    z = c;
  }

  PoseColumn x, y, z, p;

 private:
  /// A column where it stands in memory.
  using Stored = double __attribute__((vector_size(32), aligned(8), may_alias));

  static const Stored& at(const Pose& X, int column) {
    return *reinterpret_cast<const Stored*>(X.data() + 4 * column);
  }
  static Stored& at(Pose& X, int column) {
    return *reinterpret_cast<Stored*>(X.data() + 4 * column);
  }
};

}  // namespace handway::geometric
