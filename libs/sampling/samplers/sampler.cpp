#include "handway/sampling/samplers/sampler.h"

#include <stdexcept>

namespace handway::sampling {

Sampler::Sampler(int dimension) : dimension_(dimension) {
  if (dimension < 1) {
    throw std::invalid_argument("a sampler has at least one dimension");
  }
}

std::optional<Eigen::VectorXd> Sampler::draw() {
  std::optional<Eigen::VectorXd> point = do_draw();
  if (point) {
    if (point->size() != dimension_) {
      throw std::logic_error("sampler drew " + std::to_string(point->size()) +
                             " coordinates, expected " + std::to_string(dimension_));
    }
    if (!(point->array() >= 0.0 && point->array() <= 1.0).all()) {
      throw std::logic_error("sampler drew a point outside of the unit cube");
    }
  }
  return point;
}

void Sampler::reset(std::uint64_t seed) { do_reset(seed); }

}  // namespace handway::sampling
