#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

/// @file
/// Messages between the library and its program handway-mesh-reader, as these structures' bytes:
/// both are of one build on one machine.
///
/// The library sends a MeshRequest, followed by the file's path, over a socket of type
/// SOCK_SEQPACKET that the program has as descriptor 3; with it goes, as SCM_RIGHTS, the writing
/// end of a pipe. A process of its own reads the file and writes into the pipe a MeshReply,
/// followed by the text, the vertices (three doubles each) and the triangles (three 32-bit indices
/// each). When that process has ended, for any reason, a MeshReadingEnd comes back over the socket.
namespace handway::geometric {

/// Library that reads the file.
enum class MeshFormat : std::uint32_t {
  kAssimp,    ///< All formats of assimp: STL, OBJ, DAE, PLY, glTF, …
  kInventor,  ///< Open Inventor and VRML, by Coin.
};

/// File descriptor of the socket that the mesh reader finds open when it starts.
inline constexpr int kMeshReaderSocket = 3;
/// First number of every message, by which a mesh reader of another version is recognised.
inline constexpr std::uint32_t kMeshStreamMark = 0x48574D34;  // changes with the structures
/// Longest path of a mesh file, bytes.
inline constexpr std::size_t kLongestMeshPath = 4096;
/// Longest text of a reply, bytes.
inline constexpr std::size_t kLongestMeshText = 65536;

/// Request to read a mesh file, followed by the file's path.
struct MeshRequest {
  std::uint32_t mark = kMeshStreamMark;
  MeshFormat format = MeshFormat::kAssimp;
  double scale = 1.0;               ///< Scale from the lengths of Inventor files to mm.
  double seconds = 0.0;             ///< Limit of processor time.
  std::uint64_t memory = 0;         ///< Bytes of address space, at most.
  std::uint64_t most_vertices = 0;  ///< Limit of vertices, and of triangles.
};

/// Result of reading a mesh.
enum class MeshReplyKind : std::uint32_t {
  kMesh,         ///< The text holds warnings, one a line.
  kRefused,      ///< The text holds source, found, expected and advice, each ended by a 0.
  kTooLarge,     ///< More vertices or triangles than allowed.
  kOutOfMemory,  ///< The memory allowed did not suffice.
};

/// Header of a reply, followed by its text and the mesh.
struct MeshReply {
  std::uint32_t mark = kMeshStreamMark;
  MeshReplyKind kind = MeshReplyKind::kMesh;
  float color[4] = {0.7F, 0.7F, 0.7F, 1.0F};  ///< Colour of the first triangle, if given.
  std::uint32_t includes_files = 0;           ///< 1 if parts come from other files.
  std::uint32_t text_bytes = 0;
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  double largest = 0.0;  ///< Coordinate that was handled in single precision.
};

/// State in which the process that read a mesh ended.
enum class MeshReadingOutcome : std::uint32_t {
  kDone,
  kTookTooLong,
  kCrashed,
};

/// Last message about a request.
struct MeshReadingEnd {
  std::uint32_t mark = kMeshStreamMark;
  MeshReadingOutcome outcome = MeshReadingOutcome::kDone;
  std::int32_t signal = 0;  ///< Signal that ended the process, or 0.
};

static_assert(std::is_trivially_copyable_v<MeshRequest> &&
              std::is_trivially_copyable_v<MeshReply> &&
              std::is_trivially_copyable_v<MeshReadingEnd>);

}  // namespace handway::geometric
