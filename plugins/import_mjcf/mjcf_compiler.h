#pragma once

#include "mjcf_text.h"

#include <mujoco/mujoco.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace handway::import_mjcf {

struct ModelDeleter {
  void operator()(mjModel* model) const;
};
using ModelPointer = std::unique_ptr<mjModel, ModelDeleter>;

/// A compiled model, with the parts of the file that it lacks.
struct Compiled {
  ModelPointer model;
  MjcfText text;
  FaultyMeshes faulty_meshes;
};

/// Compiles an MJCF file with MuJoCo's compiler. One file at a time; any thread.
/// @param warnings MuJoCo's warnings are appended.
/// @throws InputError with MuJoCo's message, file and line.
[[nodiscard]] Compiled compile_mjcf(const std::filesystem::path& file,
                                    std::vector<std::string>& warnings);

}  // namespace handway::import_mjcf
