#include "location.h"

#include "handway/geometric/math/units.h"

namespace handway::import_kautham {

geometric::Pose read_location(const XmlFile& xml, pugi::xml_node node) {
  geometric::Pose X = geometric::Pose::Identity();
  X.translation() =
      geometric::kMillimetre *
      Eigen::Vector3d(xml.number(node, "X"), xml.number(node, "Y"), xml.number(node, "Z"));
  if (!node.attribute("TH")) {
    return X;
  }
  const double angle = geometric::radians(xml.number(node, "TH"));
  const Eigen::Vector3d axis(xml.number(node, "WX"), xml.number(node, "WY"),
                             xml.number(node, "WZ"));
  if (axis.norm() > 0.0) {
    X.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  } else if (angle != 0.0) {
    xml.refuse(node, "TH", "an angle about the axis (0, 0, 0)", "WX, WY, WZ that are not all 0");
  }
  return X;
}

}  // namespace handway::import_kautham
