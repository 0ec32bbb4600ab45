// Meshes of a six-axis arm with the lengths of a UR5e (162.5, 425, 392.2, 133.3, 99.7, 99.6 mm), one
// part at a time:
//   openscad --export-format binstl -D 'part="base_casing"' -o base_casing.stl ur5e_class.scad
// Frames: of the link in the URDF, all in line with the base at zero: the arm lies along -x, the
// joints of shoulder, elbow and first wrist turn about -y, the flange points to -y.
use <../../cad/solids.scad>

part = "base_casing";

shoulder = 162.5;
upper_arm = 425;
forearm = 392.2;
wrist_1 = 133.3;
wrist_2 = 99.7;
large = 59;             // radius of base and shoulder
middle = 51;            // of the elbow
small = 40;             // of the wrists
side = -72;             // y of the plane between shoulder and upper arm, and at the elbow
upper_arm_y = -138;
wrist_side = -88;       // y of the plane between forearm and first wrist
lid = 4;

module drum_y(r, from, to, edge0 = 0, edge1 = 0) along_y() drum(r, from, to, edge0, edge1);
module tube_x(r, from, to) along_x() drum(r, from, to);

// Lid at the end of a drum about y, towards +y or -y.
module lid_up(r, y) drum_y(r - 5, y - 2, y + lid, 0, 3);
module lid_down(r, y) mirror([0, 1, 0]) lid_up(r, -y);

module base_casing() {
  drum(75, 0, 16, 0, 5);
  hull() {
    drum(68, 10, 30, 0, 4);
    drum(large + 2, 60, shoulder - 63, 0, 2);
  }
  translate([0, 0, 45]) drum_y(14, 0, 72, 0, 3);
}

module base_covers() {
  for (a = [45 : 90 : 315]) rotate(a) translate([67, 0, 14]) drum(5, 0, 7, 0, 2, $fn = 12);
  translate([0, 0, 45]) drum_y(10, 70, 82, 0, 2);
}

module link_1_casing() {
  drum(large, -58, 4);
  drum_y(large, side + 1, 60, 0, 8);
}
module link_1_covers() {
  drum(large - 4, -63, -50);
  lid_up(large, 60);
}

module link_2_casing() {
  drum_y(large, -198, side - 5, 8, 0);
  translate([0, upper_arm_y, 0]) tube_x(46, -upper_arm, 0);
  translate([-upper_arm, 0, 0]) drum_y(middle, -192, side - 5, 8, 0);
}
module link_2_covers() {
  drum_y(large - 4, side - 12, side - 1);
  lid_down(large, -198);
  translate([-upper_arm, 0, 0]) lid_down(middle, -192);
}

module link_3_casing() {
  drum_y(middle, side + 5, 48, 0, 8);
  translate([0, -12, 0]) along_x() frustum(37, 40, -forearm, 0);
  translate([-forearm, 0, 0]) drum_y(small, wrist_side + 1, 30, 0, 6);
}
module link_3_covers() {
  drum_y(middle - 4, side, side + 12);
  lid_up(middle, 48);
  translate([-forearm, 0, 0]) lid_up(small, 30);
}

module link_4_casing() {
  drum_y(small, -wrist_1 - 45, wrist_side - 4, 6, 0);
  translate([0, -wrist_1, 0]) drum(small, -51, 2);
}
module link_4_covers() {
  drum_y(small - 3, wrist_side - 10, wrist_side - 1);
  lid_down(small, -wrist_1 - 45);
}

module link_5_casing() {
  drum(small, -wrist_2 - 45, -56, 6, 0);
  translate([0, 0, -wrist_2]) drum_y(small, -52, 2);
}
module link_5_covers() {
  drum(small - 3, -62, -52);
  translate([0, 0, -wrist_2 - 45]) mirror([0, 0, 1]) drum(small - 5, -2, lid, 0, 3);
}

module flange_casing() {
  drum(37.5, -43, -10, 0, 3);
  drum(31.5, -12, 0, 0, 1);
}
module flange_covers() {
  drum(35, -47, -40);
  along_x() translate([0, 0, 30]) translate([25, 0, 0]) drum(8, 0, 12, 0, 2, $fn = 20);
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
link("flange") { flange_casing(); flange_covers(); }
