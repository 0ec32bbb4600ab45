// Meshes of a right hand with the kinematics of a LEAP Hand, one part at a time:
//   openscad --export-format binstl -D 'part="palm_shell"' -o palm_shell.stl leap_class_right.scad
// Frames: of the link in the URDF, at the middle of the finger. Of a finger's links z runs along
// the finger, y along the joints that bend it, x towards the pads; three of the fingers are alike.
// A finger bends first, then turns sideways: its motors are boxes between the joints.
use <../../cad/solids.scad>
use <../../cad/fingers.scad>

part = "palm_shell";

finger = [10.5, 13.5, 8.5, 8.8];
fingers = [45.45, 0, -45.45];  // y
proximal_joint = [6.7, 92.9];  // x, z
side_joint = [-12.2, 38.1];    // x, z in the proximal link
thumb_joint = [9.6, 35.7, 30.7];

// Palm ------------------------------------------------------------------------------------------

module at_fingers() for (y = fingers) translate([proximal_joint.x, y, proximal_joint.y]) children();

module palm_shell() {
  hull() {
    block([-28, -62, 42], [8, 62, 64], 8);
    block([-26, -65, 58], [6, 65, 74], 6);
  }
  hull() {
    block([-26, -50, 6], [8, 8, 30], 7);
    block([-28, -58, 38], [8, 14, 48], 5);
  }
  hull() {
    drum(31, 3, 8);
    block([-24, -30, 6], [4, 20, 14], 4);
  }
}

// Bearings of the finger joints, and the thumb's.
module palm_metal() {
  drum(31.5, 0, 5, 0, 1);
  at_fingers() for (side = [-1, 1]) hull() {
    translate([0, side * 16, 0]) along_y() drum(8.5, -1.8, 1.8, 0.5, 0.5);
    block([-9, side * 16 - 1.8, -24], [7, side * 16 + 1.8, -18], 0.8, $fn = 4);
  }
  for (z = [-1, 1]) hull() {
    translate([thumb_joint.x, thumb_joint.y, thumb_joint.z + z * 16]) drum(8.5, -1.8, 1.8, 0.5, 0.5);
    block([-6, 4, thumb_joint.z + z * 16 - 1.8], [8, 12, thumb_joint.z + z * 16 + 1.8], 0.8, $fn = 4);
  }
}

module palm_pads() block([4, -54, 42], [10.5, 54, 66], 3, $fn = 12);

// Fingers ---------------------------------------------------------------------------------------

// Bends in the palm's bearings; carries the motor that turns the finger sideways about x.
module proximal_shell() {
  along_y() drum(9.5, -13.5, 13.5, 1, 1);
  hull() {
    block([-9, -12, 4], [9, 12, 14], 2, $fn = 12);
    block([-27, -10.5, 20], [-2, 10.5, 28], 2, $fn = 12);
  }
  translate([side_joint.x, 0, side_joint.y]) along_x() drum(10.5, -15, -1, 2, 1);
  block([-27, -10.5, 20], [-13.5, 10.5, 40], 2, $fn = 12);
}

module proximal_metal() translate([side_joint.x, 0, side_joint.y]) along_x() drum(6, -2, 3, 0, 0.5);

// Turns about x at the origin; carries the joint at (13, 15).
module side_shell() {
  hull() {
    along_x() drum(10.5, 3.5, 12, 1, 0);
    translate([13, 0, 15]) along_y() drum(8.8, -8.5, 8.5, 0.5, 0.5);
  }
}

module side_metal() translate([13, 0, 15]) along_y() drum(4.4, -14.4, 14.4, 0.8, 0.8, $fn = 12);

// Thumb -----------------------------------------------------------------------------------------

// Turns about z at the origin; the next joint runs along y through (0, 14.3, -13).
module thumb_base_shell() hull() {
  drum(9, -13.5, 13.5, 1, 1);
  translate([0, 0, -6]) along_y() drum(11, 4, 13, 0, 1);
  translate([0, 14.3, -13]) along_y() drum(11, -8, -0.6, 0, 1);
}

// Turns about y at the origin; the next joint runs along x through y = 17.
module thumb_abduction_metal() {
  hull() {
    along_y() drum(11, 0.6, 3, 0, 1);
    translate([0, 17, 0]) along_x() drum(8.8, -8.5, 8.5, 0.5, 0.5);
  }
  translate([0, 17, 0]) along_x() drum(4.4, -14.4, 14.4, 0.8, 0.8, $fn = 12);
}

part_of(part, "palm_shell") visual(40) palm_shell();
part_of(part, "palm_metal") visual(24) palm_metal();
part_of(part, "palm_pads") visual(24) palm_pads();
part_of(part, "palm_collision") collision(14) {
  palm_shell();
  palm_metal();
  palm_pads();
}
part_of(part, "proximal_shell") visual(24) proximal_shell();
part_of(part, "proximal_metal") visual(24) proximal_metal();
part_of(part, "proximal_collision") collision(12) {
  proximal_shell();
  proximal_metal();
}
part_of(part, "side_shell") visual(24) side_shell();
part_of(part, "side_metal") visual(24) side_metal();
part_of(part, "side_collision") collision(12) {
  side_shell();
  side_metal();
}
part_of(part, "thumb_base_shell") visual(24) thumb_base_shell();
part_of(part, "thumb_base_collision") collision(14) thumb_base_shell();
part_of(part, "thumb_abduction_metal") visual(24) thumb_abduction_metal();
part_of(part, "thumb_abduction_collision") collision(14) thumb_abduction_metal();
phalanx(part, "medial", finger, 36.1);
fingertip(part, "distal", finger, 48, 12.5);
phalanx(part, "thumb_proximal", finger, 46.6);
fingertip(part, "thumb_distal", finger, 60, 12.5);
