#pragma once

#include "handway/geometric/formats/mesh_stream.h"

#include <array>
#include <cstdint>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

namespace handway::mesh_reader {

/// Refusal of a file, with the fields of geometric::InputProblem.
class Refusal : public std::runtime_error {
 public:
  Refusal(std::string source, const std::string& found, std::string expected, std::string advice)
      : std::runtime_error(found),
        source_(std::move(source)),
        expected_(std::move(expected)),
        advice_(std::move(advice)) {}

  /// The four texts, each ended by a 0.
  [[nodiscard]] std::string text() const;

 private:
  std::string source_;
  std::string expected_;
  std::string advice_;
};

/// Thrown for more vertices or triangles than the request allows.
class TooLarge : public std::exception {};

/// Triangles over shared vertices, limited in number.
class Mesh {
 public:
  explicit Mesh(std::uint64_t most) : most_(most) {}

  /// @returns the vertex's index. @throws TooLarge
  std::uint32_t add_vertex(const std::array<double, 3>& vertex);
  /// @throws TooLarge
  void add_triangle(const std::array<std::uint32_t, 3>& triangle);

  [[nodiscard]] std::uint32_t vertex_count() const {
    return static_cast<std::uint32_t>(vertices_.size());
  }
  [[nodiscard]] bool empty() const { return triangles_.empty(); }

  std::array<float, 4> color = {0.7F, 0.7F, 0.7F, 1.0F};
  bool includes_files = false;
  double largest =
      0.0;  ///< Coordinate that was handled in single precision, in add_vertex()'s units.
  std::string warnings;  ///< One a line.

  /// Writes the whole reply. @returns false if the pipe is closed.
  [[nodiscard]] bool send(int descriptor) const;

 private:
  std::uint64_t most_;
  std::vector<std::array<double, 3>> vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

/// Writes a reply without a mesh.
bool send_refusal(int descriptor, geometric::MeshReplyKind kind, const std::string& text);

}  // namespace handway::mesh_reader
