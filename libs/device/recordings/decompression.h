#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

/// Decompression of blocks whose size is known. Memory grows with the output, not with the sizes
/// that a damaged block names. All functions return nothing if the block is damaged or has another
/// size.

namespace handway::device {

/// Decompresses a block of Snappy, without frames.
[[nodiscard]] std::optional<std::string> snappy_decompressed(std::string_view block,
                                                             std::size_t size);
/// Decompresses frames of Zstandard.
[[nodiscard]] std::optional<std::string> zstd_decompressed(std::string_view block,
                                                           std::size_t size);
/// Decompresses streams of bzip2.
[[nodiscard]] std::optional<std::string> bzip2_decompressed(std::string_view block,
                                                            std::size_t size);
/// Decompresses frames of LZ4.
[[nodiscard]] std::optional<std::string> lz4_decompressed(std::string_view block, std::size_t size);

}  // namespace handway::device
