#include "handway/device/glove/line_faults.h"

#include <stdexcept>

namespace handway::device {

LineFaults::LineFaults(const LineFaultSettings& settings)
    : settings_(settings), random_(settings.seed) {
  for (const double probability : {settings.dropout, settings.garbage}) {
    if (!(probability >= 0.0 && probability <= 1.0)) {
      throw std::invalid_argument("a probability has to be from 0 to 1");
    }
  }
}

// The standard's distributions differ between libraries; these don't.
bool LineFaults::happens(double probability) {
  return static_cast<double>(random_() >> 11U) * 0x1.0p-53 < probability;
}

std::size_t LineFaults::index_below(std::size_t size) { return random_() % size; }

std::vector<std::uint8_t> LineFaults::apply(std::vector<std::uint8_t> record) {
  if (record.empty()) {
    return record;
  }
  if (happens(settings_.dropout)) {
    ++count_;
    return {};
  }
  if (happens(settings_.garbage)) {
    ++count_;
    damage(record);
  }
  return record;
}

void LineFaults::damage(std::vector<std::uint8_t>& record) {
  const auto at = record.begin() + static_cast<std::ptrdiff_t>(index_below(record.size()));
  switch (index_below(5)) {
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
      std::vector<std::uint8_t> noise(1 + index_below(40));
      for (std::uint8_t& byte : noise) {
        byte = static_cast<std::uint8_t>(random_());
      }
      record.insert(record.begin(), noise.begin(), noise.end());
    }
  }
}

}  // namespace handway::device
