#pragma once

#include <handway_test/paths.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace handway::test {

/// A folder with `gripper.urdf` without SRDF: a base, two fingers by the joints `a` and `b`, and a
/// tip that overlaps the base in every posture; `camera.urdf`, which has no joints, and
/// `lost_mesh.urdf`, whose mesh is not there.
class RobotFiles {
 public:
  RobotFiles() {
    write("gripper.urdf", "<robot name=\"gripper\">" + link("base", "0.06 0.06 0.04") +
                              link("finger_a", "0.01 0.01 0.05") + link("tip_a", "0.01 0.01 0.05") +
                              link("finger_b", "0.01 0.01 0.05") +
                              joint("a", "base", "finger_a", "0 0.02 0.05") +
                              joint("bend", "finger_a", "tip_a", "0 0 -0.05") +
                              joint("b", "base", "finger_b", "0 -0.02 0.05") + "</robot>");
    write("camera.urdf", "<robot name=\"camera\">" + link("body", "0.03 0.03 0.03") + "</robot>");
    write("lost_mesh.urdf",
          "<robot name=\"lost\"><link name=\"a\"><collision><geometry><mesh "
          "filename=\"meshes/lost.stl\"/></geometry></collision></link></robot>");
    write("broken.urdf", "<robot name=\"broken\"><link name=\"a\"></robot>");
  }

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
    return folder_.path() / name;
  }

 private:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name) << text;
  }
  static std::string link(const std::string& name, const std::string& size) {
    return "<link name=\"" + name + "\"><collision><geometry><box size=\"" + size +
           "\"/></geometry></collision></link>\n";
  }
  static std::string joint(const std::string& name, const std::string& parent,
                           const std::string& child, const std::string& xyz) {
    return "<joint name=\"" + name + "\" type=\"revolute\"><parent link=\"" + parent +
           "\"/><child link=\"" + child + "\"/><origin xyz=\"" + xyz +
           "\"/><axis xyz=\"1 0 0\"/><limit lower=\"-0.5\" upper=\"0.5\" effort=\"0\" "
           "velocity=\"1\"/></joint>\n";
  }

  ScratchFolder folder_;
};

}  // namespace handway::test
