#include "reply.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace handway::mesh_reader {
namespace {

using geometric::MeshReply;
using geometric::MeshReplyKind;

bool write_all(int descriptor, const void* bytes, std::size_t size) {
  const char* at = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t written = ::write(descriptor, at, size);
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written <= 0) {
      return false;
    }
    at += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

std::string shortened(const std::string& text) {
  return text.substr(0, std::min(text.size(), geometric::kLongestMeshText));
}

template <typename Element>
bool write_list(int descriptor, const std::vector<Element>& elements) {
  return write_all(descriptor, elements.data(), elements.size() * sizeof(Element));
}

}  // namespace

std::string Refusal::text() const {
  std::string joined;
  for (const std::string& part : {source_, std::string(what()), expected_, advice_}) {
    joined += part.substr(0, part.find('\0'));
    joined += '\0';
  }
  return joined;
}

std::uint32_t Mesh::add_vertex(const std::array<double, 3>& vertex) {
  if (vertices_.size() >= most_) {
    throw TooLarge();
  }
  vertices_.push_back(vertex);
  return vertex_count() - 1;
}

void Mesh::add_triangle(const std::array<std::uint32_t, 3>& triangle) {
  if (triangles_.size() >= most_) {
    throw TooLarge();
  }
  triangles_.push_back(triangle);
}

bool Mesh::send(int descriptor) const {
  const std::string text = shortened(warnings);
  MeshReply reply;
  std::copy(color.begin(), color.end(), reply.color);
  reply.includes_files = includes_files ? 1 : 0;
  reply.text_bytes = static_cast<std::uint32_t>(text.size());
  reply.vertices = vertices_.size();
  reply.triangles = triangles_.size();
  reply.largest = largest;
  return write_all(descriptor, &reply, sizeof reply) &&
         write_all(descriptor, text.data(), text.size()) && write_list(descriptor, vertices_) &&
         write_list(descriptor, triangles_);
}

bool send_refusal(int descriptor, MeshReplyKind kind, const std::string& whole) {
  const std::string text = shortened(whole);
  MeshReply reply;
  reply.kind = kind;
  reply.text_bytes = static_cast<std::uint32_t>(text.size());
  return write_all(descriptor, &reply, sizeof reply) &&
         write_all(descriptor, text.data(), text.size());
}

}  // namespace handway::mesh_reader
