// Meshes of the right Schunk Anthropomorphic Hand (SAH), one part at a time:
//   openscad --export-format binstl -D 'part="palm_shell"' -o palm_shell.stl sah_right.scad
// Main dimensions: the joints' places as in sah_right.urdf; outer sizes of the real hand
// to a few millimetres, slimmer at the fingers' joints to keep neighbours apart.
use <palm.scad>
use <thumb_base.scad>
use <abduction.scad>
use <proximal.scad>
use <medial.scad>
use <distal.scad>

part = "palm_shell";

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

if (part == "palm_shell") visual(48) palm_shell();
if (part == "palm_metal") visual(48) palm_metal();
if (part == "palm_pads") visual(24) palm_pads();
if (part == "thumb_base_shell") visual(40) thumb_base_shell();
if (part == "thumb_base_metal") visual(40) thumb_base_metal();
if (part == "abduction_metal") visual(40) abduction_metal();
if (part == "proximal_metal") visual(32) proximal_metal();
if (part == "proximal_shell") visual(24) proximal_shell();
if (part == "proximal_pads") visual(24) proximal_pads();
if (part == "medial_metal") visual(32) medial_metal();
if (part == "medial_pads") visual(24) medial_pads();
if (part == "distal_shell") visual(32) distal_shell();
if (part == "distal_pads") visual(32) distal_pads();

if (part == "palm_collision") collision(8) palm_collision();
if (part == "thumb_base_collision") collision(12) thumb_base_collision();
if (part == "abduction_collision") collision(12) abduction_collision();
if (part == "proximal_collision") collision(10) proximal_collision();
if (part == "medial_collision") collision(10) medial_collision();
if (part == "distal_collision") collision(10) distal_collision();
