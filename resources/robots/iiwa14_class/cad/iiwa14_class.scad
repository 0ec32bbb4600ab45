// Meshes of a seven-axis arm with the lengths of an LBR iiwa 14 (360, 420, 400, 126 mm), one part
// at a time:
//   openscad --export-format binstl -D 'part="base_casing"' -o base_casing.stl iiwa14_class.scad
// Frames: of the link in the URDF; z along the arm as it stands straight, odd joints along z and
// even ones along y through the origin. Links lie at alternate sides of the even joints.
use <../../cad/solids.scad>
use <../../cad/hinges.scad>

part = "base_casing";

tube = 72;
drum_radius = 66;
width = 74;
slender = 61;           // from the elbow on
slender_drum = 55;
slender_width = 63;
slit = 6;               // ring at the odd joints
joint_1 = 157.5;
lower = 202.5;          // from joint 1 to 2
upper = 204.5;          // 2 to 3
elbow = 215.5;          // 3 to 4
above_elbow = 184.5;    // 4 to 5
wrist = 215.5;          // 5 to 6
flange = 126;           // 6 to the flange
lip = 122;
slender_lip = 104;
flange_bottom = 44;

module base_casing() {
  hull() {
    drum(tube, 60, joint_1 - 1, 0, 0);
    drum(88, 12, 60, 0, 6);
  }
  drum(106, 0, 14, 0, 5);
  block([-132, -42, 4], [-60, 42, 84], 8);
}

module base_covers() {
  for (a = [45 : 90 : 315]) rotate(a) translate([95, 0, 12]) drum(6, 0, 8, 0, 2, $fn = 12);
  for (y = [-22, 22]) translate([-128, y, 46]) along_x() mirror([0, 0, 1]) drum(12, 0, 11, 0, 2, $fn = 20);
}

// A link that turns about z and carries the joint about y that stands `length` above.
module carrier(r, drum_width, tube_radius, length, lip_below)
  translate([0, 0, length]) hinge(r, drum_width, tube_radius, -lip_below, slit - length);

// A link that turns about y and carries the joint about z that stands `length` above.
module swing(r, drum_width, tube_radius, length, lip_above)
  upwards() hinge(r, drum_width, tube_radius, -lip_above, 1 - length);

module link_1_casing() left() carrier(drum_radius, width, tube, lower, lip);
module link_1_covers() {
  ring(tube - 3, 0, slit + 1);
  translate([0, 0, lower]) left() hinge_lid(46, width);
}

module link_2_casing() swing(drum_radius, width, tube, upper, lip);
module link_2_covers() hinge_lid(46, width);

module link_3_casing() carrier(drum_radius, width, tube, elbow, lip);
module link_3_covers() {
  ring(tube - 3, 0, slit + 1);
  translate([0, 0, elbow]) hinge_lid(46, width);
}

module link_4_casing() left() hull() {
  translate([0, 1, 0]) along_y() drum(drum_radius, 0, width - 1, 0, 20);
  translate([0, 1, 0]) half_drum(slender, 100, above_elbow - 1);
}
module link_4_neck() drum(slender, lip, above_elbow - 1, 20, 0);
module link_4_covers() left() hinge_lid(46, width);

module link_5_casing() left() carrier(slender_drum, slender_width, slender, wrist, slender_lip);
module link_5_covers() {
  ring(slender - 3, 0, slit + 1);
  translate([0, 0, wrist]) left() hinge_lid(38, slender_width);
}

module link_6_casing() hull() {
  translate([0, 1, 0]) along_y() drum(slender_drum, 0, slender_width - 1, 0, 20);
  translate([0, 0, 0]) drum(44, 66, flange - flange_bottom - 1, 8, 0);
}
module link_6_covers() hinge_lid(38, slender_width);

module flange_metal() {
  drum(41, slit - flange_bottom, -9, 0, 3);
  drum(31.5, -10, 0, 0, 1);
  for (a = [0 : 360 / 7 : 359]) rotate(a) translate([36, 0, -9]) drum(2.6, -1, 1.5, 0, 0.7, $fn = 8);
}
module flange_covers() ring(38, -flange_bottom, slit + 1);

module visual(facets) {
  $fn = facets;
  $cover = 0;
  children();
}

module collision(facets) {
  $fn = facets;
  $cover = 0.5;
  children();
}

if (part == "base_casing") visual(64) base_casing();
if (part == "base_covers") visual(24) base_covers();
if (part == "base_collision") collision(20) { base_casing(); base_covers(); }
if (part == "link_1_casing") visual(64) link_1_casing();
if (part == "link_1_covers") visual(64) link_1_covers();
if (part == "link_1_collision") collision(20) { link_1_casing(); link_1_covers(); }
if (part == "link_2_casing") visual(64) link_2_casing();
if (part == "link_2_covers") visual(64) link_2_covers();
if (part == "link_2_collision") collision(20) { link_2_casing(); link_2_covers(); }
if (part == "link_3_casing") visual(64) link_3_casing();
if (part == "link_3_covers") visual(64) link_3_covers();
if (part == "link_3_collision") collision(20) { link_3_casing(); link_3_covers(); }
if (part == "link_4_casing") visual(64) { link_4_casing(); link_4_neck(); }
if (part == "link_4_covers") visual(64) link_4_covers();
if (part == "link_4_collision") collision(20) { link_4_casing(); link_4_neck(); link_4_covers(); }
if (part == "link_5_casing") visual(56) link_5_casing();
if (part == "link_5_covers") visual(56) link_5_covers();
if (part == "link_5_collision") collision(20) { link_5_casing(); link_5_covers(); }
if (part == "link_6_casing") visual(56) link_6_casing();
if (part == "link_6_covers") visual(56) link_6_covers();
if (part == "link_6_collision") collision(20) { link_6_casing(); link_6_covers(); }
if (part == "flange_metal") visual(56) flange_metal();
if (part == "flange_covers") visual(56) flange_covers();
if (part == "flange_collision") collision(24) { flange_metal(); flange_covers(); }
