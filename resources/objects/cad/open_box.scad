// Box without a lid; a can and a hand find room in it. Modelled in millimetres, written
// in metres; origin at the centre of the bottom.
inside = [400, 250, 145];
wall = 15;
floor = 10;

module around(size, z) translate([-size.x / 2, -size.y / 2, z]) cube(size);

scale(0.001) difference() {
  around(inside + [2 * wall, 2 * wall, floor], 0);
  around(inside + [0, 0, 1], floor);
}
