#include "reference_names.h"

#include <map>

namespace handway::test {

std::string joint_name_of(const std::string& reference_name) {
  static const std::map<std::string, std::string> kWhole = {
      {"Shoulder", "joint_1"}, {"ForeArm", "joint_2"}, {"Elbow", "joint_3"},   {"Arm", "joint_4"},
      {"Wrist", "joint_5"},    {"Tcp", "joint_6"},     {"Thumb", "thumb_base"}};
  static const std::map<std::string, std::string> kFinger = {
      {"Thumb", "thumb"}, {"Index", "index"}, {"Mid", "middle"}, {"Ring", "ring"}};
  static const std::map<std::string, std::string> kJoint = {
      {"Base", "abduction"}, {"Prox", "proximal"}, {"Med", "medial"}, {"Dist", "distal"}};
  const auto dash = reference_name.find('-');
  if (dash == std::string::npos) {
    return kWhole.at(reference_name);
  }
  return kFinger.at(reference_name.substr(0, dash)) + "_" +
         kJoint.at(reference_name.substr(dash + 1));
}

}  // namespace handway::test
