#pragma once

#include <mujoco/mujoco.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace handway::import_mjcf {

struct ModelDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
using ModelPointer = std::unique_ptr<mjModel, ModelDeleter>;

/// What MuJoCo's compiler makes of an MJCF file. One file at a time; any thread.
/// @param[out] warnings what it said about it.
/// @throws InputError with what it says if it refuses the file.
[[nodiscard]] ModelPointer compile_mjcf(const std::filesystem::path& file,
                                        std::vector<std::string>& warnings);

/// The name of an object, or KIND_NUMBER if it has none.
[[nodiscard]] std::string name_of(const mjModel& model, mjtObj kind, int index);

}  // namespace handway::import_mjcf
