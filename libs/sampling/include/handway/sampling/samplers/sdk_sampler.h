#pragma once

#include "handway/sampling/export.h"
#include "handway/sampling/samplers/sampler.h"
#include "handway/sampling/sequences/random_stream.h"
#include "handway/sampling/sequences/sdk_sequence.h"

#include <optional>

namespace handway::sampling {

/// One point in each cell of an SDK sequence, in the order of the sequence.
class HANDWAY_SAMPLING_EXPORT SdkSampler final : public Sampler {
 public:
  /// Points in the middles of cells; the seed of reset() changes nothing.
  /// @param levels M: cells have the side 2^-M.
  /// @throws std::invalid_argument as SdkSequence does.
  SdkSampler(int dimension, int levels);

  /// Points at random within cells: all differ even when the cells repeat, after
  /// 2^(dimension · levels) points.
  SdkSampler(int dimension, int levels, std::uint64_t seed);

 private:
  std::optional<Eigen::VectorXd> do_draw() override;
  void do_reset(std::uint64_t seed) override;

  SdkSequence sequence_;
  std::optional<RandomStream> stream_;
  std::uint64_t index_ = 0;
};

}  // namespace handway::sampling
