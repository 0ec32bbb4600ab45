#include "handway/sampling/regions/corridor_steps.h"

namespace handway::sampling {

int corridor_steps(double length, double rho) {
  constexpr int kMost = 1 << 20;
  int count = 1;
  while (count < kMost && length / count > rho) {
    count *= 2;
  }
  return count;
}

}  // namespace handway::sampling
