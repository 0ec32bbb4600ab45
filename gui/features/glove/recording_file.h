#pragma once

#include <filesystem>

namespace handway::gui {

/// A new, empty file in `folder`, named by the time. Nothing else gets it: another window that
/// begins to record in the same second has a file of its own.
/// @throws handway::geometric::InputError if none can be made.
[[nodiscard]] std::filesystem::path new_recording_file(const std::filesystem::path& folder);

}  // namespace handway::gui
