// Tool flange of the TX90: disc with bolt circle, dowel hole and centring bore.
// Frame: flange_link, z out of the flange, mounting face at z = 0.
use <../../cad/solids.scad>

radius = 39;
thickness = 9;
bolt_circle = 25;
bolt_radius = 3;
bore_radius = 15.75;
hole_depth = 6;

module disc() drum(radius, -thickness, 0, 1, 1);

module hole(at, r) translate([at.x, at.y, -hole_depth]) cylinder(r = r, h = hole_depth + 1, $fn = 16);

module flange_metal() difference() {
  disc();
  for (a = [45 : 45 : 315]) hole(bolt_circle * [cos(a), sin(a)], bolt_radius);
  hole(bolt_circle * [1, 0], 2.5);
  translate([0, 0, -hole_depth]) cylinder(r = bore_radius, h = hole_depth + 1, $fn = 48);
}

module flange_collision() drum(radius, -thickness, 0);
