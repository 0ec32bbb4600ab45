// Solids with rounded edges, shared by every robot part. Millimetres.
//
// Two special variables steer all of them, so that one description gives both
// meshes of a link:
//   $fn     facets of a full circle;
//   $cover  0: facets lie inside the true surface (visual mesh);
//           c > 0: facets lie outside the true surface grown by c (collision mesh).

// Radius of the polygon that stands for a circle of radius r.
function facet_radius(r) = $cover > 0 ? (r + $cover) / cos(180 / $fn) : r;

function polar(centre, r, angle) = centre + r * [cos(angle), sin(angle)];

// Points of a circular arc in n chords: inscribed, or circumscribed if covering.
function arc(centre, r, from, to, n) =
  let (step = (to - from) / n)
  $cover > 0
    ? concat([polar(centre, r, from)],
             [for (i = [0 : n - 1]) polar(centre, r / cos(step / 2), from + (i + 0.5) * step)],
             [polar(centre, r, to)])
    : [for (i = [0 : n]) polar(centre, r, from + i * step)];

function chords(edge, r) =
  $cover > 0 ? max(1, round($fn / 4 * min(1, edge / r))) : max(2, ceil($fn / 4 * min(1, edge / r)));

// Right-angled profile corner at (r, z), rounded by `edge`; side -1: bottom, +1: top.
function corner(r, z, edge, side) =
  edge <= 0
    ? [[r, z]]
    : side < 0 ? arc([r - edge, z + edge], edge, -90, 0, chords(edge, r))
               : arc([r - edge, z - edge], edge, 0, 90, chords(edge, r));

// Revolves a profile of (radius, z) points about z.
module revolve(profile) {
  stretch = $cover > 0 ? 1 / cos(180 / $fn) : 1;
  rotate_extrude() polygon([for (p = profile) [max(0, p.x) * stretch, p.y]]);
}

// Cylinder about z from z0 to z1 whose rims are rounded by edge0 and edge1.
module drum(r, z0, z1, edge0 = 0, edge1 = 0) {
  c = $cover;
  grown0 = edge0 > 0 ? edge0 + c : 0;
  grown1 = edge1 > 0 ? edge1 + c : 0;
  revolve(concat([[0, z0 - c]], corner(r + c, z0 - c, grown0, -1),
                 corner(r + c, z1 + c, grown1, 1), [[0, z1 + c]]));
}

// Cone frustum about z: radius r0 at z0, r1 at z1.
module frustum(r0, r1, z0, z1) {
  c = $cover;
  revolve([[0, z0 - c], [r0 + c, z0 - c], [r1 + c, z1 + c], [0, z1 + c]]);
}

module ball(r) drum(r, -r, r, r, r);

module ball_at(p, r) translate(p) ball(r);

// Box between two corners with edges rounded by `edge`.
module block(low, high, edge = 2) {
  c = $cover;
  assert(2 * edge <= min(high - low), "the edges need more room");
  if (c > 0) {
    cut = edge > 3 ? 0.586 * edge : 0;
    hull() for (axis = [0 : 2])
      let (shrink = [for (i = [0 : 2]) i == axis ? c : c - cut])
        translate(low - shrink) cube(high - low + 2 * shrink);
  } else {
    $fn = min(16, $fn);
    hull() for (x = [low.x + edge, high.x - edge], y = [low.y + edge, high.y - edge],
                z = [low.z + edge, high.z - edge]) ball_at([x, y, z], edge);
  }
}

// Turns what is built about z to stand about y or x: z becomes +y, +x.
module along_y() rotate([-90, 0, 0]) children();
module along_x() rotate([0, 90, 0]) children();

// Turns +z into `direction`.
module towards(direction) {
  d = direction / norm(direction);
  rotate([0, acos(d.z), atan2(d.y, d.x)]) children();
}

module mirrored_y() {
  children();
  mirror([0, 1, 0]) children();
}
