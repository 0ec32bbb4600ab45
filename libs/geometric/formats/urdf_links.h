#pragma once

#include "formats/urdf_elements.h"
#include "formats/urdf_mesh_files.h"
#include "handway/geometric/formats/urdf.h"
#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/robot/robot_description.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace handway::geometric {

/// The colours of a URDF file's materials. Errors in them refuse no file: they become a warning.
class UrdfMaterials {
 public:
  /// Reads the materials that are defined at the top, then those defined where they are first used.
  /// The first definition of a name counts.
  explicit UrdfMaterials(const pugi::xml_node& robot);

  /// Returns the colour of a <visual>; the default without a material that can be read.
  [[nodiscard]] Color color_of(const pugi::xml_node& visual);

  /// Returns the names of materials without a colour that can be read.
  [[nodiscard]] const std::set<std::string>& undefined() const { return undefined_; }

 private:
  std::map<std::string, Color> colors_;
  std::set<std::string> undefined_;
};

/// Visual elements that can't be read. Planning does not need them: one warning reports them.
class DrawingFaults {
 public:
  void add(const InputError& fault);

  /// Returns "3 visual elements can't be read, the collision geometry is drawn …: …"; an empty
  /// text without faults.
  [[nodiscard]] std::string summary() const;

 private:
  std::vector<std::string> faults_;
};

/// Reads the links of a URDF file with their shapes and mesh files.
class UrdfLinks {
 public:
  /// @param elements, meshes must outlive this object.
  UrdfLinks(UrdfElements& elements, UrdfMeshFiles& meshes)
      : elements_(elements), meshes_(meshes), materials_(elements.document().root("robot")) {}

  /// Reads a <link>. A visual element that can't be read is left out, and the collision geometry is
  /// drawn where no other is left. Both are noted, and so is a missing collision mesh.
  /// @throws InputError if another part of the collision geometry can't be read.
  [[nodiscard]] Link read(const pugi::xml_node& link);

  /// @throws MissingMeshError if collision meshes were missing.
  void refuse_missing_meshes() const { missing_.refuse(); }

  [[nodiscard]] const UrdfMaterials& materials() const { return materials_; }
  [[nodiscard]] const DrawingFaults& drawing_faults() const { return drawing_; }
  /// Returns the links with a collision shape without size, once for each shape.
  [[nodiscard]] const std::vector<std::string>& sizeless() const { return sizeless_; }

 private:
  [[nodiscard]] std::vector<LinkGeometry> read_shapes(const pugi::xml_node& parent,
                                                      const std::string& element);
  [[nodiscard]] Shape read_mesh_shape(const pugi::xml_node& mesh, const std::string& element);
  void read_collision(const pugi::xml_node& collision, Link& link);
  void read_visual(const pugi::xml_node& visual, Link& link);

  UrdfElements& elements_;
  UrdfMeshFiles& meshes_;
  UrdfMaterials materials_;
  DrawingFaults drawing_;
  MissingMeshes missing_;
  std::vector<std::string> sizeless_;
};

}  // namespace handway::geometric
