// Upper arm of the TX90: a flat, tapering beam beside the shoulder and the elbow.
// Frame: upper_arm_link, joint 2 along y through the origin, joint 3 425 mm above.
use <../../cad/solids.scad>

length = 425;
inner = 161;  // face towards shoulder and elbow
outer = 287;

module at_joint_3() translate([0, 0, length]) children();

module beam() hull() {
  along_y() drum(118, 176, outer - 12, 8, 30);
  at_joint_3() along_y() drum(89, 176, outer - 14, 8, 26);
}

module joint_drums() {
  along_y() drum(120, inner, 200, 3, 0);
  at_joint_3() along_y() drum(96, inner, 200, 3, 0);
}

module lids() {
  along_y() drum(84, outer - 16, outer - 9, 0, 3);
  at_joint_3() along_y() drum(58, outer - 18, outer - 11, 0, 3);
}

module upper_arm_casing() {
  beam();
  joint_drums();
}

module upper_arm_covers() lids();

module upper_arm_collision() {
  beam();
  joint_drums();
  lids();
}
