// Phalanges of fingers, shared by hands. Millimetres; see solids.scad.
// z runs along the finger from the joint that bends it, y along that joint, x towards the pads.
// Each has cheeks around the joint before and carries the next one by a tongue. A finger's
// measures are [half its depth, half its width, half the tongue's width, the tongue's radius].
use <solids.scad>

gap = 0.8;              // between cheek and tongue

// Facets around the edges of a body.
function rounding() = $fn > 14 ? 12 : 8;

module pin(finger) {
  edge = $fn > 14 ? 0.8 : 0;
  along_y() drum(0.42 * finger[0], -finger[1] - 0.9, finger[1] + 0.9, edge, edge, $fn = rounding());
}

module tongue(finger, length) {
  translate([0, 0, length]) {
    along_y() drum(finger[3], -finger[2], finger[2], 0.5, 0.5);
    pin(finger);
  }
}

module cheek(finger) hull() {
  along_y() drum(finger[0], finger[2] + gap, finger[1], 0, 0.15 * finger[0]);
  block([-finger[0], finger[2] + gap, 0.9 * finger[0]],
        [finger[0], finger[1], 1.75 * finger[0]], 0.15 * finger[0],
        $fn = rounding() - 4);
}

// Cheeks, and the body up to `end`.
module phalanx_shell(finger, end) {
  mirrored_y() cheek(finger);
  block([-finger[0], -finger[1], 1.17 * finger[0]], [finger[0], finger[1], end], 0.3 * finger[0],
        $fn = rounding());
}

module phalanx_metal(finger, length) {
  depth = min(0.77 * finger[0], finger[3]);
  tongue(finger, length);
  hull() {
    translate([0, 0, length]) along_y() drum(finger[3], -finger[2], finger[2], 0.5, 0.5);
    block([-depth, -finger[2], length - 1.75 * finger[0]], [depth, finger[2], length - finger[0]], 1,
          $fn = 4);
  }
}

module phalanx_pad(finger, end) block([0.75 * finger[0], -0.8 * finger[1], 1.38 * finger[0]],
  [1.17 * finger[0], 0.8 * finger[1], end - 0.21 * finger[0]], 0.2 * finger[0], $fn = 8);

// The last phalanx; its round pad of radius r ends at z = `end`.
module fingertip_shell(finger, end, r) {
  mirrored_y() cheek(finger);
  hull() {
    block([-finger[0], -finger[1], 1.17 * finger[0]], [finger[0], finger[1], 1.75 * finger[0]],
          0.25 * finger[0], $fn = rounding());
    drum(0.9 * r, 1.6 * finger[0], end - 1.67 * r, 0, 1);
  }
}

module fingertip_pad(end, r) hull() {
  ball_at([0, 0, end - r], r);
  drum(0.95 * r, end - 1.83 * r, end - 1.25 * r, 1, 0);
}

// Turns about z in its seat and carries the next joint at `height`.
module twisting_knuckle(finger, height) {
  hull() {
    drum(1.07 * finger[0], 0.6, 3, 0, 1);
    translate([0, 0, height]) along_y() drum(finger[3], -finger[2], finger[2], 0.5, 0.5);
  }
  tongue(finger, height);
}

module visual(facets) {
  $fn = facets;
  $cover = 0;
  children();
}

module collision(facets) {
  $fn = facets;
  $cover = 0.3;
  children();
}

module part_of(part, name) if (part == name) children();

// Shell, metal and pads of a phalanx, and what it collides with; its body ends `neck` times the
// half depth before the next joint.
module phalanx(part, name, finger, length, facets = 18, neck = 1.17) {
  end = length - neck * finger[0];
  part_of(part, str(name, "_shell")) visual(facets) phalanx_shell(finger, end);
  part_of(part, str(name, "_metal")) visual(facets) phalanx_metal(finger, length);
  part_of(part, str(name, "_pads")) visual(facets) phalanx_pad(finger, end);
  part_of(part, str(name, "_collision")) collision(12) {
    phalanx_shell(finger, end);
    phalanx_metal(finger, length);
    phalanx_pad(finger, end);
  }
}

module fingertip(part, name, finger, end, r, facets = 18) {
  part_of(part, str(name, "_shell")) visual(facets) fingertip_shell(finger, end, r);
  part_of(part, str(name, "_pads")) visual(4 / 3 * facets) fingertip_pad(end, r);
  part_of(part, str(name, "_collision")) collision(12) {
    fingertip_shell(finger, end, r);
    fingertip_pad(end, r, $fn = 16);
  }
}
