#include "handway/geometric/io/obj_writer.h"

#include "handway/geometric/io/replace_file.h"
#include "io/number_text.h"

#include <string>

namespace handway::geometric {

void write_obj(const TriangleMesh& mesh, const std::filesystem::path& file) {
  std::string text;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    text += "v " + number_text(v.x()) + ' ' + number_text(v.y()) + ' ' + number_text(v.z()) + '\n';
  }
  for (const auto& triangle : mesh.triangles) {
    text += 'f';
    for (const std::uint32_t corner : triangle) {
      text += ' ' + std::to_string(corner + 1);
    }
    text += '\n';
  }
  replace_file(file, text);
}

}  // namespace handway::geometric
