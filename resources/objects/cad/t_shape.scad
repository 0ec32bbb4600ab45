// T that stands on its stem: a square bar across the end of a round stem, as in the
// paper's problem of taking a T out of a shelf. Modelled in millimetres, written in
// metres; origin at the centre of the stem's end, bar along x.
bar = [200, 40, 40];
stem_radius = 20;
height = 310;

scale(0.001) union() {
  translate([-bar.x / 2, -bar.y / 2, height - bar.z]) cube(bar);
  cylinder(r = stem_radius, h = height - bar.z / 2, $fn = 48);
}
