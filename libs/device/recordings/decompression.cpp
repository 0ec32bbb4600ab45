#include "recordings/decompression.h"

#include <bzlib.h>
#include <lz4frame.h>
#include <snappy-c.h>
#include <zstd.h>

#include <algorithm>
#include <memory>

namespace handway::device {
namespace {

/// Part of the output that is decompressed at once.
constexpr std::size_t kOutputPiece = std::size_t{1} << 20;

/// Progress of a decompressor.
struct DecompressedPiece {
  std::size_t read = 0;
  std::size_t written = 0;
  bool is_damaged = false;
};

/// Decompresses piece by piece.
/// @param step decompresses a part of its input to an output of a given size.
template <typename Step>
std::optional<std::string> decompressed_in_pieces(std::string_view block, std::size_t size,
                                                  const Step& step) {
  std::string output;
  while (true) {
    const std::size_t before = output.size();
    // One byte more than expected shows that the block is longer.
    output.resize(before + std::min(kOutputPiece, size + 1 - before));
    const DecompressedPiece piece = step(block, output.data() + before, output.size() - before);
    output.resize(before + piece.written);
    block.remove_prefix(piece.read);
    const bool is_stuck = piece.read == 0 && piece.written == 0;
    if (piece.is_damaged || output.size() > size || (is_stuck && !block.empty())) {
      return std::nullopt;
    }
    if (is_stuck) {
      return output.size() == size ? std::optional(std::move(output)) : std::nullopt;
    }
  }
}

}  // namespace

std::optional<std::string> snappy_decompressed(std::string_view block, std::size_t size) {
  constexpr std::size_t kHighestRatio = 64;  // bytes of a copy, which takes two at least
  std::size_t length = 0;
  if (snappy_uncompressed_length(block.data(), block.size(), &length) != SNAPPY_OK ||
      length != size || size / kHighestRatio > block.size()) {
    return std::nullopt;
  }
  std::string output(size, '\0');
  if (snappy_uncompress(block.data(), block.size(), output.data(), &length) != SNAPPY_OK ||
      length != size) {
    return std::nullopt;
  }
  return output;
}

std::optional<std::string> zstd_decompressed(std::string_view block, std::size_t size) {
  const std::unique_ptr<ZSTD_DStream, std::size_t (*)(ZSTD_DStream*)> stream(ZSTD_createDStream(),
                                                                             ZSTD_freeDStream);
  return decompressed_in_pieces(
      block, size, [&](std::string_view input, char* to, std::size_t most) {
        ZSTD_inBuffer in{input.data(), input.size(), 0};
        ZSTD_outBuffer out{to, most, 0};
        const std::size_t result = ZSTD_decompressStream(stream.get(), &out, &in);
        return DecompressedPiece{in.pos, out.pos, ZSTD_isError(result) != 0};
      });
}

std::optional<std::string> bzip2_decompressed(std::string_view block, std::size_t size) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) {
    return std::nullopt;
  }
  const std::unique_ptr<bz_stream, int (*)(bz_stream*)> opened(&stream, BZ2_bzDecompressEnd);
  bool is_at_end = false;
  return decompressed_in_pieces(
      block, size, [&](std::string_view input, char* to, std::size_t most) {
        if (is_at_end) {
          return DecompressedPiece{0, 0, !input.empty()};
        }
        const std::size_t given = std::min<std::size_t>(input.size(), kOutputPiece);
        std::string copy(input.substr(0, given));  // the library's interface is not const
        stream.next_in = copy.data();
        stream.avail_in = static_cast<unsigned>(given);
        stream.next_out = to;
        stream.avail_out = static_cast<unsigned>(most);
        const int result = BZ2_bzDecompress(&stream);
        is_at_end = result == BZ_STREAM_END;
        return DecompressedPiece{given - stream.avail_in, most - stream.avail_out,
                                 result != BZ_OK && result != BZ_STREAM_END};
      });
}

std::optional<std::string> lz4_decompressed(std::string_view block, std::size_t size) {
  LZ4F_dctx* created = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&created, LZ4F_VERSION)) != 0) {
    return std::nullopt;
  }
  const std::unique_ptr<LZ4F_dctx, std::size_t (*)(LZ4F_dctx*)> context(
      created, LZ4F_freeDecompressionContext);
  return decompressed_in_pieces(
      block, size, [&](std::string_view input, char* to, std::size_t most) {
        DecompressedPiece piece{input.size(), most, false};
        const std::size_t result =
            LZ4F_decompress(context.get(), to, &piece.written, input.data(), &piece.read, nullptr);
        piece.is_damaged = LZ4F_isError(result) != 0;
        return piece;
      });
}

}  // namespace handway::device
