#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/planning/export.h"

#include <filesystem>
#include <string>
#include <vector>

namespace handway::planning {

/// Writes scenes in the format of another program.
///
/// The public function checks; derived classes write.
class HANDWAY_PLANNING_EXPORT SceneExporter {
 public:
  virtual ~SceneExporter() = default;
  /// The word on the command line: "gltf".
  [[nodiscard]] virtual std::string name() const = 0;
  /// One line for a person.
  [[nodiscard]] virtual std::string description() const = 0;

  /// Writes the scene into `folder`, which is made if there is none; each file is replaced whole.
  /// @returns what has been written.
  /// @throws InputError for a scene without a robot, what the format can't hold, or a file that
  /// can't be written.
  [[nodiscard]] std::vector<std::filesystem::path> write(const geometric::Scene& scene,
                                                         const std::filesystem::path& folder) const;

 protected:
  /// The derived class's part. @param stem for names of files: that of the scene's file, or of its
  /// name.
  [[nodiscard]] virtual std::vector<std::filesystem::path> do_write(
      const geometric::Scene& scene, const std::filesystem::path& folder,
      const std::string& stem) const = 0;
};

}  // namespace handway::planning
