#include "small_cell.h"

#include <fstream>

namespace handway::test {
namespace {

std::string link(const std::string& name, const std::string& size, const std::string& middle) {
  const std::string box =
      "<origin xyz=\"" + middle + "\"/><geometry><box size=\"" + size + "\"/></geometry>";
  return "<link name=\"" + name + "\"><visual>" + box + "</visual><collision>" + box +
         "</collision></link>\n";
}

std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& place, const std::string& more) {
  return "<joint name=\"" + name + "\" type=\"revolute\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/><origin xyz=\"" + place + "\"/><axis xyz=\"0 0 1\"/>" +
         more + "</joint>\n";
}

std::string limit(const std::string& lower, const std::string& upper) {
  return "<limit lower=\"" + lower + "\" upper=\"" + upper + "\" effort=\"1\" velocity=\"1\"/>";
}

std::string disabled(const std::string& a, const std::string& b) {
  return "<disable_collisions link1=\"" + a + "\" link2=\"" + b + "\" reason=\"Adjacent\"/>\n";
}

}  // namespace

SmallCell::SmallCell() {
  write("arm.urdf",
        "<robot name=\"arm\">\n" + link("base", "0.08 0.08 0.08", "0 0 -0.08") +
            link("upper", "0.26 0.04 0.04", "0.15 0 0") +
            link("lower", "0.26 0.04 0.04", "0.15 0 0") +
            link("palm", "0.04 0.08 0.04", "0.02 0 0") +
            link("finger_left", "0.05 0.01 0.02", "0.03 0 0") +
            link("finger_right", "0.05 0.01 0.02", "0.03 0 0") +
            link("finger_tip", "0.02 0.01 0.02", "0.015 0 0") +
            joint("shoulder", "base", "upper", "0 0 0", limit("-0.3", "1.8")) +
            joint("elbow", "upper", "lower", "0.3 0 0", limit("-2.5", "2.5")) +
            "<joint name=\"wrist\" type=\"fixed\"><parent link=\"lower\"/><child link=\"palm\"/>"
            "<origin xyz=\"0.3 0 0\"/></joint>\n" +
            joint("left", "palm", "finger_left", "0.04 0.03 0", limit("-0.2", "0.8")) +
            joint("right", "palm", "finger_right", "0.04 -0.03 0", limit("-0.8", "0.2")) +
            joint("tip", "finger_left", "finger_tip", "0.06 0 0",
                  limit("-0.1", "0.4") + R"(<mimic joint="left" multiplier="0.5"/>)") +
            "</robot>\n");
  write("arm.srdf",
        R"(<robot name="arm"><group name="arm"><joint name="shoulder"/><joint name="elbow"/>)"
        R"(</group><group name="hand"><joint name="left"/><joint name="right"/></group>)"
        R"(<group_state name="stretched" group="arm"><joint name="shoulder" value="0.5"/>)"
        R"(<joint name="elbow" value="0"/></group_state>)" +
            disabled("base", "upper") + disabled("upper", "lower") + disabled("lower", "palm") +
            disabled("palm", "finger_left") + disabled("palm", "finger_right") +
            disabled("finger_left", "finger_tip") + "</robot>\n");
  write("hand.yaml",
        "hand: pincers\nunits: normalised\njoints: [left, right]\nmean: [0.5, 0.5]\n"
        "directions:\n  - {name: PMD1, half_side: 0.4, variance: 0.05, vector: [0.6, 0.8]}\n");
}

std::filesystem::path SmallCell::scene(const std::string& objects, const std::string& goal) const {
  return write("scene.yaml",
               "handway: 1\nname: Small cell\nrobots:\n  - {name: arm, model: arm.urdf}\n"
               "objects:\n" +
                   objects + "start: {shoulder: 0}\ngoal: {shoulder: " + goal +
                   "}\nhand_basis: hand.yaml\nplanner: {name: rrt-connect}\n");
}

std::filesystem::path SmallCell::broken() const {
  return write("broken.yaml",
               "handway: 1\nname: Broken\nrobots:\n  - model: arm.urdf\nobject: []\n");
}

std::filesystem::path SmallCell::write(const std::string& name, const std::string& content) const {
  const std::filesystem::path file = folder_.path() / name;
  std::ofstream(file) << content;
  return file;
}

}  // namespace handway::test
