#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove_layout.h"

#include <cstdint>
#include <memory>

namespace handway::device {

/// Joint angles of a human hand that moves freely, without a task, "trying to cover the whole hand
/// workspace" (paper, section 4.1), as measured by a glove's sensors.
///
/// The hand goes in minimum-jerk moves from posture to posture. A posture consists of few synergies
/// (flat fist to hook, open to closed, thumb to opposition, spread), of moves of single fingers
/// with parts of the motion in their neighbours (enslaving), and of small moves of thumb, palm and
/// wrist. Distal joints bend 2/3 as far as medial ones (Rijpkema and Girard 1991); bent fingers
/// spread less; all joints stay in their anatomic ranges.
///
/// Signs: flexion positive; abductions between fingers positive when the fingers spread; thumb
/// roll positive towards opposition; wrist flexion and ulnar abduction positive.
///
/// Over 135 s at 100 Hz (13,500 samples), mapped to the SAH hand by the paper's Table 1 and
/// normalised by joint range, the first principal components have nearly the paper's shares of the
/// variance: 42.19, 77.12 and 84.71 % for 1, 2 and 3. The same seed gives the same motion.
class HANDWAY_DEVICE_EXPORT HandExploration {
 public:
  explicit HandExploration(std::uint64_t seed);
  ~HandExploration();
  HandExploration(HandExploration&&) noexcept;
  HandExploration& operator=(HandExploration&&) noexcept;

  /// @param time s, never falling from one call to the next.
  [[nodiscard]] GloveAngles at(double time);

 private:
  struct Moves;
  std::unique_ptr<Moves> moves_;
};

}  // namespace handway::device
