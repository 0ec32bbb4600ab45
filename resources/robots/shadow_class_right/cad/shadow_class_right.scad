// Meshes of a right hand with the kinematics of a Shadow Dexterous Hand, one part at a time:
//   openscad --export-format binstl -D 'part="palm_shell"' -o palm_shell.stl shadow_class_right.scad
// Frames: of the link in the URDF. Of a finger's links z runs along the finger, y along the joint
// that bends it, x towards the pads; four of the fingers are alike.
use <../../cad/solids.scad>
use <../../cad/fingers.scad>

part = "palm_shell";

finger = [6.8, 7.4, 4, 6];
thumb = [8.5, 10, 6.2, 7.5];
wrist = [10, 0, 213.01];            // the first of its joints, along x, in the forearm
hand_joint = 34;                    // from there to the other one, along y
knuckles = [[33, 95], [11, 99], [-11, 95]];  // y, z in the palm
metacarpal = [0, -33, 20.71];       // its joint, in the palm, is turned by 55 degrees about x
little_knuckle = 65.9;              // above the metacarpal's joint
thumb_joint = [8.58, 34, 29];       // in the palm, turned by -45 degrees about x

// Forearm and wrist -----------------------------------------------------------------------------

module forearm_shell() {
  hull() {
    drum(64, 14, 40, 6, 0);
    drum(60, 80, 120, 0, 0);
    translate([8, 0, 0]) drum(40, 150, 176, 0, 10);
  }
}

module forearm_metal() {
  drum(50, 0, 18, 2, 0);
  drum(64.8, 48, 54, 0, 0);
  translate([wrist.x, 0, 0]) hull() {
    drum(34, 168, 180, 0, 2);
    drum(26, 180, 186, 0, 2);
  }
  for (side = [-1, 1]) hull() {
    translate([wrist.x + side * 18, 0, wrist.z]) along_x() drum(11, -2.2, 2.2, 0.5, 0.5);
    translate([wrist.x, 0, 0]) block([side * 18 - 2.2, -18, 176], [side * 18 + 2.2, 18, 184], 1, $fn = 8);
  }
}

module wrist_metal() {
  along_x() drum(10, -15, 15, 1, 1);
  hull() {
    block([-12, -9, 2], [12, 9, 10], 2, $fn = 8);
    translate([0, 0, hand_joint]) along_y() drum(9.5, -17, 17, 1, 1);
  }
  along_x() drum(4.5, -21.5, 21.5, 0.8, 0.8, $fn = 16);
  translate([0, 0, hand_joint]) along_y() drum(4.5, -25.5, 25.5, 0.8, 0.8, $fn = 16);
}

// Palm ------------------------------------------------------------------------------------------

module palm_shell() {
  mirrored_y() hull() {
    translate([0, 20.5, 0]) along_y() drum(11, -2.5, 2.5, 0.5, 0.5);
    block([-12, 18, 12], [7, 23, 20], 1, $fn = 8);
  }
  hull() {
    block([-14, -38, 13], [6, 12, 27], 5);
    block([-14, -21, 30], [6, 14, 46], 5);
  }
  hull() {
    block([-14, -21, 30], [6, 14, 46], 5);
    block([-14, -21, 62], [7, 41, 74], 5);
    block([-9, -18, 72], [6, 42, 80], 3);
  }
}

// Bearing behind a finger's first joint, which bends to the other side.
module bearing() hull() {
  translate([-11.8, 0, 0]) along_x() drum(6, -1.3, 1.3, 0.4, 0.4);
  block([-13.1, -5, -24], [-10.5, 5, -15], 0.6, $fn = 4);
}

module palm_metal() {
  for (k = knuckles) translate([0, k.x, k.y]) {
    bearing();
    block([-11, -7, -26], [7, 7, -18], 2, $fn = 8);
  }
  translate(thumb_joint) rotate([-45, 0, 0]) drum(13, -30, -17, 0, 1);
}

module palm_pads() {
  block([4, -18, 50], [9.5, 34, 72], 2.5, $fn = 12);
  block([3, -34, 15], [8.5, 2, 44], 2.5, $fn = 12);
}

module upright() rotate([-55, 0, 0]) children();

module metacarpal_shell() upright() hull() {
  block([-13, -9, 8], [8, 9, 20], 4, $fn = 12);
  block([-10, -9, 34], [7, 9, 48], 4, $fn = 12);
}
module metacarpal_metal() upright() translate([0, 0, little_knuckle]) {
  bearing();
  block([-10.5, -7.5, -25], [6.5, 7.5, -18], 2, $fn = 8);
}
module metacarpal_pads() upright() block([4, -7, 14], [10.5, 7, 44], 2.5, $fn = 12);

// Fingers ---------------------------------------------------------------------------------------

// Turns about x in its fork and carries the finger about y.
module knuckle_metal() {
  along_y() drum(finger[3], -finger[2], finger[2], 0.5, 0.5);
  pin(finger);
  along_x() drum(4.5, -10.3, 6, 0, 0);
}


module thumb_base_metal() {
  hull() {
    drum(11, -16.5, -13, 0, 1);
    along_y() drum(thumb[3], -thumb[2], thumb[2], 0.5, 0.5);
  }
  pin(thumb);
}

// Cross of the thumb's middle joints: about y towards the palm, about x beyond.
module thumb_hub_metal() {
  along_x() drum(thumb[3], -thumb[2], thumb[2], 0.5, 0.5);
  rotate(90) pin(thumb);
}

part_of(part, "forearm_shell") visual(48) forearm_shell();
part_of(part, "forearm_metal") visual(24) forearm_metal();
part_of(part, "forearm_collision") collision(20) {
  forearm_shell();
  forearm_metal();
}
part_of(part, "wrist_metal") visual(18) wrist_metal();
part_of(part, "wrist_collision") collision(14) wrist_metal();
part_of(part, "palm_shell") visual(28) palm_shell();
part_of(part, "palm_metal") visual(14) palm_metal();
part_of(part, "palm_pads") visual(20) palm_pads();
part_of(part, "palm_collision") collision(12) {
  palm_shell();
  palm_metal();
  palm_pads();
}
part_of(part, "metacarpal_shell") visual(20) metacarpal_shell();
part_of(part, "metacarpal_metal") visual(14) metacarpal_metal();
part_of(part, "metacarpal_pads") visual(20) metacarpal_pads();
part_of(part, "metacarpal_collision") collision(12) {
  metacarpal_shell();
  metacarpal_metal();
  metacarpal_pads();
}
part_of(part, "knuckle_metal") visual(12) knuckle_metal();
part_of(part, "knuckle_collision") collision(12) knuckle_metal();
part_of(part, "thumb_base_metal") visual(24) thumb_base_metal();
part_of(part, "thumb_base_collision") collision(12) thumb_base_metal();
part_of(part, "thumb_hub_metal") visual(20) thumb_hub_metal();
part_of(part, "thumb_hub_collision") collision(12) thumb_hub_metal();
phalanx(part, "proximal", finger, 45, 12);
phalanx(part, "medial", finger, 25, 12);
fingertip(part, "distal", finger, 26, 7, 12);
phalanx(part, "thumb_proximal", [8.5, 10, 5.5, 3.4], 38, 14, 1.5);
phalanx(part, "thumb_medial", thumb, 32, 14);
fingertip(part, "thumb_distal", thumb, 27.5, 9, 14);
