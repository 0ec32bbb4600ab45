// Meshes of the Staubli TX90, one part at a time:
//   openscad --export-format binstl -D 'part="base_casing"' -o base_casing.stl tx90.scad
// Main dimensions: study figures of the arm (DH lengths 478, 50, 50, 425, 425, 100 mm).
use <base.scad>
use <shoulder.scad>
use <upper_arm.scad>
use <elbow.scad>
use <forearm.scad>
use <wrist.scad>
use <flange.scad>

part = "base_casing";

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
if (part == "base_collision") collision(24) base_collision();
if (part == "shoulder_casing") visual(80) shoulder_casing();
if (part == "shoulder_covers") visual(64) shoulder_covers();
if (part == "shoulder_collision") collision(20) shoulder_collision();
if (part == "upper_arm_casing") visual(80) upper_arm_casing();
if (part == "upper_arm_covers") visual(64) upper_arm_covers();
if (part == "upper_arm_collision") collision(20) upper_arm_collision();
if (part == "elbow_casing") visual(80) elbow_casing();
if (part == "elbow_covers") visual(64) elbow_covers();
if (part == "elbow_collision") collision(20) elbow_collision();
if (part == "forearm_casing") visual(64) forearm_casing();
if (part == "forearm_covers") visual(32) forearm_covers();
if (part == "forearm_collision") collision(20) forearm_collision();
if (part == "wrist_casing") visual(40) wrist_casing();
if (part == "wrist_covers") visual(40) wrist_covers();
if (part == "wrist_collision") collision(20) wrist_collision();
if (part == "flange_metal") visual(64) flange_metal();
if (part == "flange_collision") collision(32) flange_collision();
