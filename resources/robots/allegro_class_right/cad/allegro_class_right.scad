// Meshes of a right hand with the kinematics of an Allegro Hand, one part at a time:
//   openscad --export-format binstl -D 'part="palm_shell"' -o palm_shell.stl allegro_class_right.scad
// Frames: of the link in the URDF. Of a finger's links z runs along the finger, y along the joint
// that bends it, x towards the pads; three of the fingers are alike.
use <../../cad/solids.scad>
use <../../cad/fingers.scad>

part = "palm_shell";

finger = [9.8, 13.75, 6.2, 8.3];
wrist = 95;             // from the face that is mounted to the middle of the finger seats

// Palm ------------------------------------------------------------------------------------------

module at_fingers() {
  translate([0, 43.5, wrist - 1.542]) rotate([-5, 0, 0]) children();
  translate([0, 0, wrist + 0.7]) children();
  translate([0, -43.5, wrist - 1.542]) rotate([5, 0, 0]) children();
}

module at_thumb() translate([-18.2, 19.333, wrist - 45.987]) rotate([0, 0, -90])
  rotate([0, -95, 0]) children();

module heel() hull() {
  block([-31, -52, 8], [9, -3, 40], 7);
  block([-33, -57, 45], [11, -3, 74], 7);
}

module upper() hull() {
  block([-33, -57, 71], [11, 57, 86], 6);
  block([-31, -50, 76], [9, 50, 89], 5);
}

module seat() hull() {
  drum(12.5, -9, -0.6, 0, 1.5);
  block([-14, -15, -14], [11, 15, -6], 3, $fn = 12);
}

module foot() hull() {
  block([-30, -30, 3], [6, 38, 12], 4);
  drum(31, 3, 8, 0, 0);
}

module palm_shell() {
  heel();
  upper();
  foot();
}

module palm_metal() {
  drum(31.5, 0, 5, 0, 1);
  at_fingers() seat();
  at_thumb() along_x() drum(13, -40, -34, 0, 1);
  for (y = [-45 : 15 : -15]) translate([-33, y, 60]) along_x() mirror([0, 0, 1])
    drum(3, -2, 1.2, 0, 0.8, $fn = 12);
}

module palm_pads() {
  block([8, -50, 46], [14, -8, 72], 3);
  block([8, -50, 74], [14, 50, 85], 3);
}

// Thumb's base ----------------------------------------------------------------------------------
// x runs up along the joint (its axis is -x), z out to the thumb.

thumb_seat = [-27, 5, 39.9];

module thumb_base_shell() {
  along_x() drum(15, -33, 18, 2, 3);
  hull() {
    block([-33, -13, 0], [-6, 13, 18], 5);
    block([-39, -9, 20], [-14, 18, 34], 4);
  }
}

module thumb_base_metal() translate(thumb_seat) drum(12, -9, -0.6, 0, 1.5);

part_of(part, "palm_shell") visual(40) palm_shell();
part_of(part, "palm_metal") visual(32) palm_metal();
part_of(part, "palm_pads") visual(24) palm_pads();
part_of(part, "palm_collision") collision(16) {
  palm_shell();
  palm_metal();
  palm_pads();
}
part_of(part, "thumb_base_shell") visual(32) thumb_base_shell();
part_of(part, "thumb_base_metal") visual(32) thumb_base_metal();
part_of(part, "thumb_base_collision") collision(16) {
  thumb_base_shell();
  thumb_base_metal();
}
part_of(part, "abduction_metal") visual(24) twisting_knuckle(finger, 16.4);
part_of(part, "abduction_collision") collision(12) twisting_knuckle(finger, 16.4);
part_of(part, "thumb_abduction_metal") visual(24) twisting_knuckle(finger, 17.7);
part_of(part, "thumb_abduction_collision") collision(12) twisting_knuckle(finger, 17.7);
phalanx(part, "proximal", finger, 54);
phalanx(part, "medial", finger, 38.4);
phalanx(part, "thumb_proximal", finger, 51.4);
fingertip(part, "distal", finger, 38.7, 12);
fingertip(part, "thumb_distal", finger, 54.3, 12);
