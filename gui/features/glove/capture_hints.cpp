#include "features/glove/capture_hints.h"

#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/human_hand.h"

#include <QObject>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace handway::gui {
namespace {

constexpr double kHardly = 0.2;   // of the joint's range
constexpr double kLittle = 0.5;   // of the joint's range
constexpr double kMissing = 0.3;  // of the joint's range, at one end
constexpr const char* kSpreading = "jnr";
constexpr const char* kFingerBending = "ghklopst";
constexpr char kThumbRoll = 'c';

bool is_in(const char* letters, char letter) {
  return std::string_view(letters).find(letter) != std::string_view::npos;
}

// One joint that a sensor drives, in terms of the person's hand.
struct Moved {
  char letter = ' ';
  QString label;
  double range = 0.0;
  double not_bent = 0.0;       // of the range, missing at the end where the sensor's angle is large
  double not_stretched = 0.0;  // at the other end
};

bool rises(const device::JointMapping& mapped) {
  return mapped.curve.empty() ? mapped.gain > 0.0
                              : mapped.curve.back().joint > mapped.curve.front().joint;
}

std::vector<Moved> moved_joints(const JointCoverage& coverage, const device::HandMapping& mapping) {
  std::vector<Moved> result;
  for (const JointVisits& visits : coverage.joints()) {
    const auto mapped =
        std::ranges::find(mapping.joints, visits.joint, &device::JointMapping::joint);
    if (!visits.driven || mapped == mapping.joints.end() || mapped->sensor < 0) {
      continue;
    }
    const auto& sensor = device::cyberglove_sensors()[static_cast<std::size_t>(mapped->sensor)];
    Moved moved{sensor.letter,
                QString::fromUtf8(sensor.label.data(), static_cast<int>(sensor.label.size())),
                visits.range(), 1.0 - visits.most, visits.least};
    if (!rises(*mapped)) {
      std::swap(moved.not_bent, moved.not_stretched);
    }
    if (std::ranges::count(result, moved.letter, &Moved::letter) == 0) {
      result.push_back(moved);
    }
  }
  return result;
}

// Returns whether at least half of the finger-bending joints, and two of them, miss that end.
bool most_miss(const std::vector<Moved>& joints, double Moved::*end) {
  int bending = 0;
  int missing = 0;
  for (const Moved& joint : joints) {
    if (is_in(kFingerBending, joint.letter)) {
      ++bending;
      missing += joint.*end > kMissing ? 1 : 0;
    }
  }
  return missing >= 2 && 2 * missing >= bending;
}

bool none_spreads(const std::vector<Moved>& joints) {
  const auto still = [](const Moved& joint) { return joint.range < kHardly; };
  int spreading = 0;
  for (const Moved& joint : joints) {
    if (is_in(kSpreading, joint.letter)) {
      ++spreading;
      if (!still(joint)) {
        return false;
      }
    }
  }
  return spreading > 1;
}

}  // namespace

QStringList capture_hints(const JointCoverage& coverage, const device::HandMapping& mapping,
                          int most) {
  const std::vector<Moved> joints = moved_joints(coverage, mapping);
  QStringList hints;
  const bool fist = most_miss(joints, &Moved::not_bent);
  const bool flat = most_miss(joints, &Moved::not_stretched);
  const bool spread = none_spreads(joints);
  if (spread) {
    hints << QObject::tr("Spread the fingers and close them again");
  }
  if (fist) {
    hints << QObject::tr("Make a tight fist");
  }
  if (flat) {
    hints << QObject::tr("Stretch all fingers out");
  }
  for (const Moved& joint : joints) {
    const bool bending = is_in(kFingerBending, joint.letter);
    if (joint.range >= kHardly || (spread && is_in(kSpreading, joint.letter)) ||
        (bending && (fist || flat))) {
      continue;
    }
    hints << (joint.letter == kThumbRoll ? QObject::tr("Bring the thumb across the palm and back")
                                         : QObject::tr("%1 has hardly moved").arg(joint.label));
  }
  for (const Moved& joint : joints) {
    if (joint.range < kHardly) {
      continue;
    }
    if (!is_in(kFingerBending, joint.letter)) {
      if (joint.range < kLittle) {
        hints << QObject::tr("%1: go further both ways").arg(joint.label);
      }
    } else if (!fist && joint.not_bent > kMissing) {
      hints << QObject::tr("%1: bend further").arg(joint.label);
    } else if (!flat && joint.not_stretched > kMissing) {
      hints << QObject::tr("%1: stretch further").arg(joint.label);
    }
  }
  return hints.mid(0, most);
}

}  // namespace handway::gui
