/// Meshes of third-party formats, by the library and its program: the first byte of an input says
/// which format, the others are the file. The program may do with it what it likes.
#include "handway/geometric/formats/mesh_import.h"
#include "handway/geometric/formats/mesh_reader.h"
#include "input_file.h"

#include <array>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  static const std::array<fuzz::InputFile, 8> files{
      fuzz::InputFile("mesh.stl"), fuzz::InputFile("mesh.obj"),  fuzz::InputFile("mesh.ply"),
      fuzz::InputFile("mesh.dae"), fuzz::InputFile("mesh.iv"),   fuzz::InputFile("mesh.wrl"),
      fuzz::InputFile("mesh.glb"), fuzz::InputFile("mesh.gltf"),
  };
  if (size == 0) {
    return 0;
  }
  const std::filesystem::path& file = files[data[0] % files.size()].hold(data + 1, size - 1);
  const bool inventor = file.extension() == ".iv" || file.extension() == ".wrl";
  return fuzz::read_or_refuse([&] {
    if (inventor) {
      static_cast<void>(geometric::import_mesh(file, geometric::MeshFormat::kInventor));
    } else {
      static_cast<void>(geometric::read_mesh(file));
    }
  });
}
