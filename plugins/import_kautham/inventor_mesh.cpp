#include "inventor_mesh.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/mesh_import.h"

#include <optional>
#include <system_error>
#include <utility>

namespace handway::import_kautham {

InventorMesh read_inventor_mesh(const std::filesystem::path& file, double scale) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    throw geometric::InputError(
        {file.string(), "", "no such file", "an Open Inventor or VRML file",
         "Put the mesh there or correct the name in the file that refers to it"});
  }
  geometric::ImportedMesh mesh =
      geometric::import_mesh(file, geometric::MeshFormat::kInventor, scale);
  if (std::optional<geometric::InputProblem> problem = geometric::rounding_problem(mesh.largest)) {
    problem->source = file.string();
    throw geometric::InputError(*std::move(problem));
  }
  return {std::make_shared<const geometric::TriangleMesh>(std::move(mesh.triangles)), mesh.color,
          mesh.includes_files, std::move(mesh.warnings)};
}

}  // namespace handway::import_kautham
