#pragma once

#include "collision/volume_cache.h"

#include <string>

namespace handway::geometric {

/// Volumes as bytes, for this kind of processor.
[[nodiscard]] std::string archive_volumes(const CachedVolumes& volumes);

/// @pre `bytes` are what archive_volumes() gave.
[[nodiscard]] CachedVolumes unarchive_volumes(const std::string& bytes);

}  // namespace handway::geometric
