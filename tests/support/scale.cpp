#include "handway_test/scale.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace handway::test {
namespace {

#ifdef HANDWAY_SANITIZED
constexpr double kSlowness = 10.0;
#else
constexpr double kSlowness = 1.0;
#endif

double scale() {
  const char* given = std::getenv("HANDWAY_TEST_SCALE");
  if (!given) {
    return 1.0;
  }
  char* end = nullptr;
  const double value = std::strtod(given, &end);
  if (end == given || *end != '\0' || !(value > 0.0) || !std::isfinite(value)) {
    throw std::runtime_error("HANDWAY_TEST_SCALE is \"" + std::string(given) +
                             "\", not a number above 0");
  }
  return value;
}

}  // namespace

int scaled(int count) {
  return static_cast<int>(std::clamp(std::round(count * scale() / kSlowness), 1.0, 1e9));
}

}  // namespace handway::test
