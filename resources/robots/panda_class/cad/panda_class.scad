// Meshes of a seven-axis arm with the lengths of a Franka Emika Panda (333, 316, 82.5, 384, 88, 107
// mm), one part at a time:
//   openscad --export-format binstl -D 'part="base_casing"' -o base_casing.stl panda_class.scad
// Frames: of the link in the URDF, in line with the base at zero, where the arm stands up and the
// flange points down; odd joints turn about z, even ones about y through the origin.
use <../../cad/solids.scad>
use <../../cad/hinges.scad>

part = "base_casing";

tube = 57;
drum_radius = 55;
width = 66;
slender = 50;           // from the elbow on
wrist_radius = 43;
wrist_width = 54;
slit = 6;
shoulder = 333;
upper_arm = 316;
elbow = 82.5;           // the elbow's axis is that far in front
forearm = 384;
wrist = 88;             // the flange's axis is that far in front of the wrist
flange = 107;
link_1_bottom = -190;   // under joint 2
link_3_bottom = -118;   // under joint 4
link_5_bottom = -262;   // under joint 6

module base_casing() {
  hull() {
    drum(tube + 3, 90, shoulder + link_1_bottom - 1, 0, 0);
    block([-95, -62, 0], [45, 62, 70], 14);
  }
  block([-150, -60, 0], [-70, 60, 62], 12);
  hull() {
    block([20, -75, 0], [68, 75, 14], 6);
    block([-60, -75, 0], [-40, 75, 14], 6);
  }
}

module base_covers() {
  for (x = [-48, 48], y = [-66, 66]) translate([x, y, 13]) drum(5, 0, 5, 0, 2, $fn = 12);
  block([-154, -40, 14], [-140, 40, 48], 4);
}

module link_1_casing() left() hinge(drum_radius, width, tube, -98, link_1_bottom + slit);
module link_1_covers() {
  ring(tube - 3, link_1_bottom, slit + 1);
  left() hinge_lid(38, width);
}

module link_2_casing() upwards() hinge(drum_radius, width, tube, -98, 1 - upper_arm - link_3_bottom);
module link_2_covers() hinge_lid(38, width);

module link_3_casing() {
  drum(tube, link_3_bottom + slit, -62, 0, 14);
  hull() {
    translate([elbow, 1, 0]) along_y() drum(48, 0, width - 6, 0, 16);
    translate([0, 1, 0]) half_drum(tube - 1, link_3_bottom + slit + 20, -62);
    translate([0, 1, 0]) half_drum(tube - 12, -62, -10);
  }
}
module link_3_covers() {
  ring(tube - 3, link_3_bottom, slit + 1);
  translate([elbow, 0, 0]) hinge_lid(34, width - 5);
}

// To the forearm's axis, which is behind the elbow.
module link_4_casing() left() {
  hull() {
    translate([0, 1, 0]) along_y() drum(48, 0, width - 6, 0, 16);
    translate([-elbow, 1, 0]) half_drum(slender, 62, forearm + link_5_bottom - 20);
    translate([-elbow, 1, 0]) half_drum(slender - 10, 10, 62);
  }
  translate([-elbow, 0, 0]) mirror([0, 0, 1])
    drum(slender, 1 - forearm - link_5_bottom, -62, 0, 14);
}
module link_4_covers() left() hinge_lid(34, width - 5);

module link_5_casing() {
  hull() {
    translate([0, 1, 0]) along_y() drum(wrist_radius, 0, wrist_width, 0, 16);
    translate([0, 1, 0]) half_drum(43, link_5_bottom + 60, -170);
  }
  hull() {
    drum(slender, link_5_bottom + slit, -180, 0, 0);
    drum(slender - 8, -190, -100, 0, 12);
  }
}
module link_5_covers() {
  ring(slender - 3, link_5_bottom, slit + 1);
  hinge_lid(32, wrist_width);
}

module link_6_casing() left() {
  hull() {
    translate([0, 1, 0]) along_y() drum(wrist_radius, 0, wrist_width, 0, 16);
    translate([wrist, 6, 0]) drum(42, -34, 36, 0, 12);
  }
  translate([wrist, 0, 0]) drum(47, -38, 36, 2, 14);
}
module link_6_covers() {
  left() hinge_lid(32, wrist_width);
  translate([wrist, 0, 0]) drum(30, 34, 39, 0, 3);
}

module flange_casing() {
  drum(40, 46 - flange, -12, 0, 6);
  drum(31.5, -14, 0, 0, 1);
}
module flange_covers() {
  drum(37, 39 - flange, 48 - flange);
  rotate(45) translate([40, 0, -36]) along_x() drum(11, -6, 6, 0, 2, $fn = 24);
}

module part_of(name) if (part == name) children();

// Casing and covers of a link, and what it collides with.
module link(name) {
  part_of(str(name, "_casing")) {
    $fn = 56;
    $cover = 0;
    children(0);
  }
  part_of(str(name, "_covers")) {
    $fn = 56;
    $cover = 0;
    children(1);
  }
  part_of(str(name, "_collision")) {
    $fn = 20;
    $cover = 0.5;
    children(0);
    children(1);
  }
}

link("base") { base_casing(); base_covers(); }
link("link_1") { link_1_casing(); link_1_covers(); }
link("link_2") { link_2_casing(); link_2_covers(); }
link("link_3") { link_3_casing(); link_3_covers(); }
link("link_4") { link_4_casing(); link_4_covers(); }
link("link_5") { link_5_casing(); link_5_covers(); }
link("link_6") { link_6_casing(); link_6_covers(); }
link("flange") { flange_casing(); flange_covers(); }
