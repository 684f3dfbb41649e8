/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One sphere against every wall of every container: pulled straight into the wall, it comes to
 * rest where Hertz's force is its weight. A wall's curvature does not enter (r* = r). */
#include "dem_scenes.h"

static const double radius = 0.01, density = 1000, young = 1e8, poisson = 0.25, pull = 2;

static double weight(void)
{
  return dem_mass(density, radius) * pull;
}

/* A point of a wall and the unit normal there, into the container. */
typedef struct spot {
  packing_vec3 at, n;
} spot;

static packing_vec3 plus(packing_vec3 a, double by, packing_vec3 b)
{
  return dem_vec(a.x + by * b.x, a.y + by * b.y, a.z + by * b.z);
}

static double dot(packing_vec3 a, packing_vec3 b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* Near `base`, in cylinder coordinates about `axis`: rho and h, and the normal's parts. Some angle
 * that favours no axis. */
static spot around(packing_vec3 base, packing_axis axis, double rho, double h,
                   double n_rho, double n_h)
{
  const double c = 0.8, s = -0.6;
  const double at[3] = {h, rho * c, rho * s}, n[3] = {n_h, n_rho * c, n_rho * s};
  double p[3], q[3];
  for (int k = 0; k < 3; k++) {
    p[((int)axis + k) % 3] = at[k];
    q[((int)axis + k) % 3] = n[k];
  }
  const spot out = {plus(base, 1, dem_vec(p[0], p[1], p[2])), dem_vec(q[0], q[1], q[2])};
  return out;
}

static void made(dem_scene *s, packing_domain *domain, double damping, double friction)
{
  dem_scene_init(s, domain);
  dem_material(s, density, young, poisson, damping, friction);
  dem_hertz(s, 0);
  s->def.dt = 1e-5;
}

/* Lets a sphere fall in from slightly above; returns its overlap with the wall's tangent plane,
 * on whose normal it must stay. */
static double settled(dem_scene *s, spot wall)
{
  const dem_body b = {.x = plus(wall.at, radius * 1.00001, wall.n), .r = radius};
  dem_add(s, &b);
  s->def.gravity = plus(dem_vec(0, 0, 0), -pull, wall.n);
  dem_start(s);
  const packing_dem_report report = dem_run(s, 25000);
  assert_int_equal(report.wall_contacts, 1);
  const packing_vec3 off = plus(dem_get(s, 0).x, -1, wall.at);
  const packing_vec3 beside = plus(off, -dot(off, wall.n), wall.n);
  assert_near(sqrt(dot(beside, beside)), 0, 1e-13);
  return radius - dot(off, wall.n);
}

/* Rounding of positions near 1, 1e-16, in an overlap of 7e-7. The container is used up. */
static void rests_at(packing_domain *domain, spot wall)
{
  dem_scene s;
  made(&s, domain, 0.1, 0.2);
  assert_close(settled(&s, wall),
               dem_static_overlap(weight(), radius, dem_rigid_young(young, poisson)),
               3e-9);
  dem_scene_free(&s);
}

static void box_faces(void **state)
{
  (void)state;
  for (int face = 0; face < 6; face++) {
    const double side = face % 2, n = side > 0 ? -1 : 1, edge[3] = {1, 1.5, 0.75};
    double at[3] = {0.4, 0.3, 0.2}, normal[3] = {0, 0, 0};
    at[face / 2] = side * edge[face / 2];
    normal[face / 2] = n;
    const spot wall = {dem_vec(at[0], at[1], at[2]),
                       dem_vec(normal[0], normal[1], normal[2])};
    rests_at(test_box(edge[0], edge[1], edge[2], 0), wall);
  }
}

static void rectangle_edges(void **state)
{
  (void)state;
  for (int edge = 0; edge < 4; edge++) {
    const double side = edge % 2, n = side > 0 ? -1 : 1, size[2] = {1, 0.75};
    double at[2] = {0.4, 0.3}, normal[2] = {0, 0};
    at[edge / 2] = side * size[edge / 2];
    normal[edge / 2] = n;
    const spot wall = {dem_vec(at[0], at[1], 0), dem_vec(normal[0], normal[1], 0)};
    rests_at(test_rectangle(size[0], size[1], 0), wall);
  }
}

static const packing_vec3 base = {0.125, -0.25, 0.375};

static packing_domain *cylinder(packing_axis axis)
{
  packing_domain_cylinder_def def;
  packing_domain *domain = NULL;
  packing_domain_cylinder_def_init(&def);
  def.radius = 0.5;
  def.height = 1;
  def.base = base;
  def.axis = axis;
  assert_ok(packing_domain_create_cylinder(NULL, &def, &domain));
  return domain;
}

static void cylinder_walls(void **state)
{
  (void)state;
  for (int k = 0; k < 3; k++) {
    const packing_axis axis = (packing_axis)k;
    rests_at(cylinder(axis), around(base, axis, 0.5, 0.3, -1, 0));
    rests_at(cylinder(axis), around(base, axis, 0.2, 0, 0, 1));
    rests_at(cylinder(axis), around(base, axis, 0.2, 1, 0, -1));
  }
}

static packing_domain *tube(packing_axis axis)
{
  packing_domain_tube_def def;
  packing_domain *domain = NULL;
  packing_domain_tube_def_init(&def);
  def.inner_radius = 0.3;
  def.outer_radius = 0.8;
  def.height = 1;
  def.base = base;
  def.axis = axis;
  assert_ok(packing_domain_create_tube(NULL, &def, &domain));
  return domain;
}

/* The inner wall bulges: the sphere balances on it. */
static void tube_walls(void **state)
{
  (void)state;
  for (int k = 0; k < 3; k++) {
    const packing_axis axis = (packing_axis)k;
    rests_at(tube(axis), around(base, axis, 0.3, 0.3, 1, 0));
    rests_at(tube(axis), around(base, axis, 0.8, 0.3, -1, 0));
    rests_at(tube(axis), around(base, axis, 0.5, 0, 0, 1));
    rests_at(tube(axis), around(base, axis, 0.5, 1, 0, -1));
  }
}

static packing_domain *cone(packing_axis axis, double bottom, double top)
{
  packing_domain_cone_def def;
  packing_domain *domain = NULL;
  packing_domain_cone_def_init(&def);
  def.bottom_radius = bottom;
  def.top_radius = top;
  def.height = 0.4;
  def.base = base;
  def.axis = axis;
  assert_ok(packing_domain_create_cone(NULL, &def, &domain));
  return domain;
}

/* Slopes of 3 : 4, so that the normals are (.8, .6). */
static void cone_walls(void **state)
{
  (void)state;
  for (int k = 0; k < 3; k++) {
    const packing_axis axis = (packing_axis)k;
    rests_at(cone(axis, 0.2, 0.5), around(base, axis, 0.35, 0.2, -0.8, 0.6));
    rests_at(cone(axis, 0.5, 0.2), around(base, axis, 0.35, 0.2, -0.8, -0.6));
    rests_at(cone(axis, 0.2, 0.5), around(base, axis, 0.1, 0, 0, 1));
    rests_at(cone(axis, 0.2, 0.5), around(base, axis, 0.1, 0.4, 0, -1));
  }
}

static packing_domain *silo(packing_axis axis)
{
  packing_domain_silo_def def;
  packing_domain *domain = NULL;
  packing_domain_silo_def_init(&def);
  def.radius = 0.5;
  def.height = 1;
  def.outlet_radius = 0.1;
  def.hopper_height = 0.3;
  def.base = base;
  def.axis = axis;
  assert_ok(packing_domain_create_silo(NULL, &def, &domain));
  return domain;
}

static void silo_walls(void **state)
{
  (void)state;
  for (int k = 0; k < 3; k++) {
    const packing_axis axis = (packing_axis)k;
    rests_at(silo(axis), around(base, axis, 0.5, 0.7, -1, 0));
    rests_at(silo(axis), around(base, axis, 0.3, 0.15, -0.6, 0.8));
    rests_at(silo(axis), around(base, axis, 0.05, 0, 0, 1));
    rests_at(silo(axis), around(base, axis, 0.3, 1, 0, -1));
  }
}

static void sphere_wall(void **state)
{
  (void)state;
  packing_domain_sphere_def def;
  packing_domain *domain = NULL;
  packing_domain_sphere_def_init(&def);
  def.radius = 0.5;
  def.centre = base;
  assert_ok(packing_domain_create_sphere(NULL, &def, &domain));
  const packing_vec3 out = {2.0 / 7, -3.0 / 7, 6.0 / 7};
  const spot wall = {plus(base, 0.5, out), plus(dem_vec(0, 0, 0), -1, out)};
  rests_at(domain, wall);
}

static void round_walls_in_the_plane(void **state)
{
  (void)state;
  packing_domain_circle_def circle;
  packing_domain_annulus_def annulus;
  packing_domain *domain = NULL;
  packing_domain_circle_def_init(&circle);
  packing_domain_annulus_def_init(&annulus);
  circle.radius = 0.5;
  circle.centre = annulus.centre = dem_vec(base.x, base.y, 0);
  annulus.inner_radius = 0.3;
  annulus.outer_radius = 0.8;
  const packing_vec3 centre = circle.centre;
  assert_ok(packing_domain_create_circle(NULL, &circle, &domain));
  rests_at(domain, around(centre, PACKING_AXIS_Z, 0.5, 0, -1, 0));
  assert_ok(packing_domain_create_annulus(NULL, &annulus, &domain));
  rests_at(domain, around(centre, PACKING_AXIS_Z, 0.3, 0, 1, 0));
  assert_ok(packing_domain_create_annulus(NULL, &annulus, &domain));
  rests_at(domain, around(centre, PACKING_AXIS_Z, 0.8, 0, -1, 0));
}

/* A wedge of two planes, z >= |x| / 2 tilted, under a lid. */
static double wedge(void *user, const packing_vec3 *p, packing_vec3 *normal)
{
  const spot *walls = user;
  double least = HUGE_VAL;
  for (int k = 0; k < 3; k++) {
    const double d = dot(plus(*p, -1, walls[k].at), walls[k].n);
    if (d < least && normal != NULL)
      *normal = walls[k].n;
    least = fmin(least, d);
  }
  return least;
}

static void walls_of_the_user(void **state)
{
  (void)state;
  static spot planes[3] = {
      {{0, 0, 0}, {0.6, 0, 0.8}}, {{0, 0, 0}, {-0.6, 0, 0.8}}, {{0, 0, 1}, {0, 0, -1}}};
  for (int k = 0; k < 3; k++) {
    packing_domain_custom_def def;
    packing_domain *domain = NULL;
    packing_domain_custom_def_init(&def);
    def.signed_distance = wedge;
    def.user = planes;
    def.bounds.lo = dem_vec(-2, -1, 0);
    def.bounds.hi = dem_vec(2, 1, 1);
    def.volume = 1;
    assert_ok(packing_domain_create_custom(NULL, &def, &domain));
    const packing_vec3 away[3] = {{-0.4, 0, 0.3}, {0.4, 0, 0.3}, {0, 0, 1}};
    const spot wall = {away[k], planes[k].n};
    rests_at(domain, wall);
  }
}

/* Beside and above an open top the walls go on; the top itself is none. */
static void open_tops(void **state)
{
  (void)state;
  packing_domain_box_def def;
  packing_domain *domain = NULL;
  packing_domain_box_def_init(&def);
  def.size = dem_vec(1, 1, 1);
  def.open_top = 1;
  assert_ok(packing_domain_create_box(NULL, &def, &domain));
  const spot high = {{1, 0.5, 1.5}, {-1, 0, 0}};
  rests_at(domain, high);
  dem_scene s;
  assert_ok(packing_domain_create_box(NULL, &def, &domain));
  made(&s, domain, 0.1, 0.2);
  const dem_body b = {.x = {0.5, 0.5, 0.95}, .v = {0, 0, 10}, .r = radius};
  dem_add(&s, &b);
  dem_start(&s);
  assert_int_equal(dem_run(&s, 1000).wall_contacts, 0);
  assert_close(dem_get(&s, 0).x.z, 1.05, 1e-12);
  dem_scene_free(&s);
}

/* Three walls at once, each with its share of the weight; in all eight corners. */
static void box_corners(void **state)
{
  (void)state;
  for (int corner = 0; corner < 8; corner++) {
    dem_scene s;
    const double g[3] = {1, 2, 3};
    double start[3], at[3];
    made(&s, test_box(1, 1, 1, 0), 0.1, 0.2);
    for (int k = 0; k < 3; k++)
      start[k] = corner >> k & 1 ? 1 - radius : radius;
    const dem_body b = {.x = {start[0], start[1], start[2]}, .r = radius};
    dem_add(&s, &b);
    s.def.gravity = dem_vec(corner & 1 ? g[0] : -g[0], corner & 2 ? g[1] : -g[1],
                            corner & 4 ? g[2] : -g[2]);
    dem_start(&s);
    assert_int_equal(dem_run(&s, 25000).wall_contacts, 3);
    const dem_body seen = dem_get(&s, 0);
    at[0] = seen.x.x;
    at[1] = seen.x.y;
    at[2] = seen.x.z;
    for (int k = 0; k < 3; k++)
      assert_close(radius - (corner >> k & 1 ? 1 - at[k] : at[k]),
                   dem_static_overlap(dem_mass(density, radius) * g[k], radius,
                                      dem_rigid_young(young, poisson)),
                   3e-9);
    dem_scene_free(&s);
  }
}

/* The floor and the mantle of a cylinder, where they meet. */
static void cylinder_edge(void **state)
{
  (void)state;
  dem_scene s;
  made(&s, cylinder(PACKING_AXIS_Z), 0.1, 0);
  const dem_body b = {.x = {base.x + 0.5 - radius, base.y, base.z + radius}, .r = radius};
  dem_add(&s, &b);
  s.def.gravity = dem_vec(3, 0, -4);
  dem_start(&s);
  assert_int_equal(dem_run(&s, 25000).wall_contacts, 2);
  const packing_vec3 x = dem_get(&s, 0).x;
  const double m = dem_mass(density, radius), e = dem_rigid_young(young, poisson);
  assert_close(radius - (base.x + 0.5 - x.x), dem_static_overlap(3 * m, radius, e), 3e-9);
  assert_close(radius - (x.z - base.z), dem_static_overlap(4 * m, radius, e), 3e-9);
  dem_scene_free(&s);
}

/* E* of both materials: for the same one, half that of a rigid wall. */
static void walls_of_a_material(void **state)
{
  (void)state;
  for (int other = 0; other < 2; other++) {
    dem_scene s;
    const spot wall = {{0.5, 0.5, 0}, {0, 0, 1}};
    made(&s, test_box(1, 1, 1, 0), 0.1, 0.2);
    dem_material(&s, 1, 3e7, 0.4, 0.1, 0.2);
    s.def.wall_material = (size_t)other;
    const double e = other ? dem_pair_young(young, poisson, 3e7, 0.4)
                           : dem_rigid_young(young, poisson) / 2;
    assert_close(settled(&s, wall), dem_static_overlap(weight(), radius, e), 3e-9);
    dem_scene_free(&s);
  }
}

/* Damping and friction at the wall: the particle's own at a rigid wall, the mean with a material
 * wall, and what is set for the pair in place of either. */
static void damping_and_friction_of_walls(void **state)
{
  (void)state;
  static const struct {
    int material, set;
    double damping, friction;
  } cases[] = {{0, 0, 0.1, 0.2}, {1, 0, 0.2, 0.5}, {0, 1, 0.4, 0.7}, {1, 1, 0.4, 0.7}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    dem_scene s;
    made(&s, test_box(4, 4, 4, 0), 0.1, 0.2);
    dem_material(&s, 1, young, poisson, 0.3, 0.8);
    dem_sliding(&s, 1e-4);
    const size_t wall = cases[k].material ? 1 : PACKING_MATERIAL_RIGID;
    s.def.wall_material = wall;
    if (cases[k].set)
      assert_ok(packing_materials_set_pair(s.materials, 0, wall, 0.4, 0.7));
    s.def.rotations = 0;
    s.def.dt = 1e-7;
    const dem_body b = {.x = {2, 2, radius}, .v = {3, 0, -1}, .r = radius};
    dem_add(&s, &b);
    dem_start(&s);
    dem_run(&s, 10000);
    const packing_vec3 v = dem_get(&s, 0).v;
    const double e = packing_hertz_restitution(cases[k].damping, 0);
    /* Some 5000 steps in the collision: 1e-4. */
    assert_near(v.z, e, 3e-4);
    assert_close(v.x, 3 - cases[k].friction * (1 + e), 3e-4);
    dem_scene_free(&s);
  }
}

/* Pressed against a mantle, a sphere that may not spin slides along it and slows by mu g, and one
 * that may ends up rolling at 5/7. */
static void friction_along_a_mantle(void **state)
{
  (void)state;
  for (int spins = 0; spins < 2; spins++) {
    dem_scene s;
    packing_domain_tube_def def;
    packing_domain *domain = NULL;
    packing_domain_tube_def_init(&def);
    def.inner_radius = 0.3;
    def.outer_radius = 0.8;
    def.height = 2;
    assert_ok(packing_domain_create_tube(NULL, &def, &domain));
    dem_scene_init(&s, domain);
    dem_material(&s, density, 1e10, poisson, 0.1, 0.3);
    dem_hertz(&s, 0);
    dem_sliding(&s, 2e-4);
    const double sunk = dem_static_overlap(dem_mass(density, radius) * 9.81, radius,
                                           dem_rigid_young(1e10, poisson));
    const dem_body b = {.x = {0.8 - radius + sunk, 0, 0.5}, .v = {0, 0, 1}, .r = radius};
    dem_add(&s, &b);
    s.def.gravity.x = 9.81;
    s.def.rotations = spins;
    s.def.dt = 5e-6;
    dem_start(&s);
    dem_run_for(&s, spins ? 0.2 : 0.1);
    const dem_body seen = dem_get(&s, 0);
    assert_close(seen.v.z, spins ? 5.0 / 7 : 1 - 0.3 * 9.81 * 0.1, 1e-4);
    /* It touches at +x: to go to +z it turns about +y. */
    if (spins)
      assert_close(seen.w.y * radius, 5.0 / 7, 1e-4);
    dem_scene_free(&s);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(box_faces),
      cmocka_unit_test(rectangle_edges),
      cmocka_unit_test(cylinder_walls),
      cmocka_unit_test(tube_walls),
      cmocka_unit_test(cone_walls),
      cmocka_unit_test(silo_walls),
      cmocka_unit_test(sphere_wall),
      cmocka_unit_test(round_walls_in_the_plane),
      cmocka_unit_test(walls_of_the_user),
      cmocka_unit_test(open_tops),
      cmocka_unit_test(box_corners),
      cmocka_unit_test(cylinder_edge),
      cmocka_unit_test(walls_of_a_material),
      cmocka_unit_test(damping_and_friction_of_walls),
      cmocka_unit_test(friction_along_a_mantle),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
