#pragma once

#include "handway/sampling/export.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <filesystem>

/// PMD bases as YAML files:
///
///     hand: sah_right            # robot that the joints belong to: a file from this one's folder
///     source: "where the numbers come from"
///     units: normalised          # joints scaled to [0, 1]
///     postures: sah_right.csv    # optional: the recorded postures, from this file's folder
///     joints: [thumb_base, thumb_abduction, …]
///     mean: [0.3055, …]          # one number per joint
///     free_joints:               # optional
///       - {joint: thumb_base, half_side: 0.5, centre: 0.3055}
///     directions:                # optional; variance: optional
///       - {name: PMD1, half_side: 0.8275, variance: 0.1, vector: [0, -0.0683, …]}
namespace handway::sampling {

/// @throws geometric::InputError with file, line and key for whatever is not
/// YAML, missing, unknown, of the wrong length, not finite, or out of range:
/// half sides must be positive, variances not negative, vectors of unit length
/// within 1 %, joint names distinct.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT PmdBasis read_pmd_basis(const std::filesystem::path& file);

/// Replaces the file whole. Postures are named from the file's folder. Numbers are written with as
/// few digits as give the same bits when read again; a direction whose vector is not of unit length
/// is written as one that is and spans the same. A variance of 0 (not known) is left out.
/// @throws geometric::InputError if the file can't be written.
HANDWAY_SAMPLING_EXPORT void write_pmd_basis(const PmdBasis& basis,
                                             const std::filesystem::path& file);

}  // namespace handway::sampling
