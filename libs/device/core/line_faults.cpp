#include "handway/device/core/line_faults.h"

#include "core/seeded_random.h"

#include <stdexcept>

namespace handway::device {

LineFaults::LineFaults(const LineFaultSettings& settings)
    : settings_(settings), random_(std::make_unique<SeededRandom>(settings.seed)) {
  for (const double probability : {settings.dropout, settings.garbage}) {
    if (!(probability >= 0.0 && probability <= 1.0)) {
      throw std::invalid_argument("a probability has to be from 0 to 1");
    }
  }
}

LineFaults::~LineFaults() = default;

std::vector<std::uint8_t> LineFaults::apply(std::vector<std::uint8_t> record) {
  if (record.empty()) {
    return record;
  }
  if (random_->uniform() < settings_.dropout) {
    ++count_;
    return {};
  }
  if (random_->uniform() < settings_.garbage) {
    ++count_;
    damage(record);
  }
  return record;
}

void LineFaults::damage(std::vector<std::uint8_t>& record) {
  const auto at = record.begin() + static_cast<std::ptrdiff_t>(random_->index(record.size()));
  switch (random_->index(5)) {
    case 0:
      record.erase(at);
      break;
    case 1:
      record.insert(at, *at);
      break;
    case 2:
      *at = 0;
      break;
    case 3:
      record.erase(at, record.end());
      break;
    default: {
      std::vector<std::uint8_t> noise(1 + random_->index(40));
      for (std::uint8_t& byte : noise) {
        byte = static_cast<std::uint8_t>(random_->bits());
      }
      record.insert(record.begin(), noise.begin(), noise.end());
    }
  }
}

}  // namespace handway::device
