#pragma once

namespace handway::geometric {

/// The version of the scene format that this program reads and writes.
inline constexpr int kSceneVersion = 1;

}  // namespace handway::geometric
