#pragma once

#include "handway/device/glove/hand_mapper.h"
#include "mapped_recording.h"
#include "posture_analysis.h"

#include <string>
#include <vector>

/// What `handway pca` prints, as text that ends its lines.
namespace handway::tools {

/// Rows, rate, repetitions, gaps and warnings of a recording, and what each sensor went through.
[[nodiscard]] std::string quality_text(const MappedRecording& recording);

/// How many samples of which joints were clamped to their limits.
[[nodiscard]] std::string clamp_text(const std::vector<MappedRecording>& recordings,
                                     const device::HandMapper& mapper);

/// A line of cumulative shares, in percent, for each of the named analyses.
[[nodiscard]] std::string share_text(
    const std::vector<std::pair<std::string, sampling::PrincipalComponents>>& analyses);

/// Principal angles between the spaces of the first components, in degrees, for each pair.
[[nodiscard]] std::string angle_text(
    const std::vector<std::pair<std::string, sampling::PrincipalComponents>>& analyses,
    int components);

/// Two lines: numbers of components k, and the largest principal angle between the spaces of the
/// first k of either, in degrees.
[[nodiscard]] std::string largest_angle_text(const sampling::PrincipalComponents& a,
                                             const sampling::PrincipalComponents& b);

/// Axes and half sides of a basis, and its largest entries.
[[nodiscard]] std::string basis_text(const sampling::PmdBasis& basis);

}  // namespace handway::tools
