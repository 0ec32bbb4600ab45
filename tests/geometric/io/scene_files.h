#pragma once

#include "scratch_files.h"

#include <string>

namespace handway::test {

/// A scratch folder with `arm.urdf` (joints shoulder and elbow; wrist follows
/// the elbow by q = 2 q_elbow + 0.1; tool is fixed) and `square.obj`.
class SceneFiles : public ScratchFiles {
 public:
  SceneFiles() {
    const auto joint = [](const std::string& name, const std::string& type,
                          const std::string& parent, const std::string& child,
                          const std::string& more) {
      return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
             "\"/><child link=\"" + child + "\"/><axis xyz=\"0 0 1\"/>" + more + "</joint>\n";
    };
    const std::string limit = R"(<limit lower="-2" upper="2" effort="0" velocity="1"/>)";
    write("arm.urdf",
          "<robot name=\"arm\">\n<link name=\"base\"/><link name=\"upper\"/>"
          "<link name=\"lower\"/><link name=\"hand\"/><link name=\"tip\"/>\n" +
              joint("shoulder", "revolute", "base", "upper", limit) +
              joint("elbow", "revolute", "upper", "lower", limit) +
              joint("wrist", "revolute", "lower", "hand",
                    limit + R"(<mimic joint="elbow" multiplier="2" offset="0.1"/>)") +
              joint("tool", "fixed", "hand", "tip", "") + "</robot>\n");
    write("square.obj", kSquareObj);
  }

  /// A scene file with one arm, followed by `more`.
  std::filesystem::path scene(const std::string& more) const {
    return write("scene.yaml", "handway: 1\nrobots:\n  - model: arm.urdf\n" + more);
  }
};

}  // namespace handway::test
