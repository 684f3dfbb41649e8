/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contact network of packs whose contacts are known. */
#include "test.h"

enum { MOST = 64 };

typedef struct pack {
  double x[MOST], y[MOST], z[MOST], r[MOST];
  packing_view view;
} pack;

static pack *new_pack(void)
{
  pack *p = calloc(1, sizeof *p);
  assert_non_null(p);
  packing_view_init_arrays(&p->view, 0, p->x, p->y, p->z, p->r);
  return p;
}

static void add(pack *p, double x, double y, double z, double r)
{
  const size_t i = p->view.count++;
  p->x[i] = x;
  p->y[i] = y;
  p->z[i] = z;
  p->r[i] = r;
}

static packing_contacts *find(const pack *p, packing_domain *domain, double tolerance,
                              double gap, int walls)
{
  packing_contacts_def def;
  packing_contacts *contacts = NULL;
  packing_contacts_def_init(&def);
  def.tolerance = tolerance;
  def.gap = gap;
  def.walls = walls;
  assert_ok(packing_contacts_create(NULL, &def, domain, &p->view, &contacts));
  return contacts;
}

static size_t list_all(const packing_contacts *contacts, packing_contact *list)
{
  size_t count = 0;
  assert_ok(packing_contacts_list(contacts, 0, MOST, list, &count));
  assert_int_equal(count, packing_contacts_count(contacts) +
                              packing_contacts_wall_count(contacts));
  return count;
}

static void assert_contact(const packing_contact *c, size_t i, size_t j, int wall,
                           double gap)
{
  assert_int_equal(c->i, i);
  assert_int_equal(c->j, j);
  assert_int_equal(c->wall, wall);
  assert_near(c->gap, gap, 1e-14);
}

static void assert_normal(const packing_contact *c, double x, double y, double z)
{
  assert_near(c->normal.x, x, 1e-14);
  assert_near(c->normal.y, y, 1e-14);
  assert_near(c->normal.z, z, 1e-14);
}

static void normals_point_from_the_lower_index_outwards(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_contact list[MOST];
  add(p, 2.6, 3.8, 1, 1.5); /* (3, 4) / 5 from the next, which it overlaps by 0.25 */
  add(p, 0.5, 1, 1, 2.25);
  add(p, 0.5, 1, 4, 0.75);
  add(p, 9, 9, 9, 0.5);
  packing_contacts *c = find(p, NULL, 1e-9, 0, 1);
  assert_int_equal(packing_contacts_particles(c), 4);
  assert_int_equal(packing_contacts_count(c), 2);
  assert_int_equal(list_all(c, list), 2);
  assert_contact(&list[0], 0, 1, -1, -0.25);
  assert_normal(&list[0], -0.6, -0.8, 0);
  assert_contact(&list[1], 1, 2, -1, 0);
  assert_normal(&list[1], 0, 0, 1);
  packing_contacts_destroy(c);
  free(p);
}

static void a_gap_makes_bonds(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_contact list[MOST];
  add(p, 0, 0, 0, 1);
  add(p, 2.125, 0, 0, 1);
  add(p, 2.125, 3.25, 0, 2);
  struct {
    double tolerance, gap;
    size_t count;
  } cases[] = {{0, 0.124, 0},        {0, 0.125, 1},      {0, 0.249, 1},  {0, 0.25, 2},
               {0.0624, 0, 0},       {0.0625, 0, 1},     {0.0833, 0, 1}, {0.0834, 0, 2},
               {0.03125, 0.0625, 1}, {0.0416, 0.1253, 2}};
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    packing_contacts *c = find(p, NULL, cases[k].tolerance, cases[k].gap, 1);
    assert_int_equal(list_all(c, list), cases[k].count);
    if (cases[k].count == 2)
      assert_contact(&list[1], 1, 2, -1, 0.25);
    packing_contacts_destroy(c);
  }
  free(p);
}

static void images_are_told(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_contact list[MOST];
  packing_domain *cell = test_box(10, 2, 10, 7);
  add(p, 9.5, 1, 5, 1);
  add(p, 11.5 + 20, 1, 5, 1); /* at 1.5 once wrapped: the image of it at 11.5 */
  packing_contacts *c = find(p, cell, 1e-9, 0, 1);
  assert_int_equal(list_all(c, list), 3);
  assert_contact(&list[0], 0, 0, -1, 0);
  assert_normal(&list[0], 0, 1, 0);
  assert_true(list[0].image[0] == 0 && list[0].image[1] == 1 && list[0].image[2] == 0);
  assert_contact(&list[1], 0, 1, -1, 0);
  assert_normal(&list[1], 1, 0, 0);
  assert_true(list[1].image[0] == 1 && list[1].image[1] == 0 && list[1].image[2] == 0);
  assert_contact(&list[2], 1, 1, -1, 0);
  size_t degrees[2];
  assert_ok(packing_contacts_degrees(c, degrees, NULL));
  assert_true(degrees[0] == 3 && degrees[1] == 3);
  packing_contacts_destroy(c);
  packing_domain_destroy(cell);
  free(p);
}

static void walls_are_told_one_by_one(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_contact list[MOST];
  packing_domain *box = test_box(8, 8, 8, 0);
  add(p, 4, 4, 7.25, 0.75);  /* top */
  add(p, 4, 4, 4, 1);        /* none */
  add(p, 1, 1, 1, 1);        /* a corner */
  add(p, 7.5, 4, 0.25, 0.5); /* an edge, into the floor */
  packing_contacts *c = find(p, box, 1e-9, 0, 1);
  assert_int_equal(packing_contacts_count(c), 0);
  assert_int_equal(packing_contacts_wall_count(c), 6);
  assert_int_equal(list_all(c, list), 6);
  assert_contact(&list[0], 0, PACKING_NO_INDEX, 5, 0);
  assert_normal(&list[0], 0, 0, 1);
  assert_contact(&list[1], 2, PACKING_NO_INDEX, 0, 0);
  assert_normal(&list[1], -1, 0, 0);
  assert_contact(&list[2], 2, PACKING_NO_INDEX, 2, 0);
  assert_contact(&list[3], 2, PACKING_NO_INDEX, 4, 0);
  assert_normal(&list[3], 0, 0, -1);
  assert_contact(&list[4], 3, PACKING_NO_INDEX, 1, 0);
  assert_contact(&list[5], 3, PACKING_NO_INDEX, 4, -0.25);
  size_t degrees[4], walls[4];
  assert_ok(packing_contacts_degrees(c, degrees, walls));
  assert_true(walls[0] == 1 && walls[1] == 0 && walls[2] == 3 && walls[3] == 2);
  assert_true(degrees[0] == 0 && degrees[3] == 0);
  packing_contacts_destroy(c);
  c = find(p, box, 1e-9, 0, 0);
  assert_int_equal(packing_contacts_wall_count(c), 0);
  packing_contacts_destroy(c);
  p->z[0] -= 0.125;
  c = find(p, box, 0, 0.125, 1);
  assert_int_equal(packing_contacts_wall_count(c), 6);
  packing_contacts_destroy(c);
  c = find(p, box, 0.166, 0, 1); /* of one radius */
  assert_int_equal(packing_contacts_wall_count(c), 5);
  packing_contacts_destroy(c);
  c = find(p, box, 0.167, 0, 1);
  assert_int_equal(packing_contacts_wall_count(c), 6);
  packing_contacts_destroy(c);
  packing_domain_destroy(box);
  free(p);
}

static void round_walls_are_walls(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_contact list[MOST];
  packing_domain_cylinder_def def;
  packing_domain_annulus_def ring;
  packing_domain *domain = NULL;
  packing_domain_cylinder_def_init(&def);
  def.radius = 5;
  def.height = 20;
  assert_ok(packing_domain_create_cylinder(NULL, &def, &domain));
  add(p, 2.4, 3.2, 1, 1);
  packing_contacts *c = find(p, domain, 1e-9, 0, 1);
  assert_int_equal(list_all(c, list), 2);
  const int side = list[0].normal.z == 0 ? 0 : 1;
  assert_normal(&list[side], 0.6, 0.8, 0);
  assert_normal(&list[1 - side], 0, 0, -1);
  assert_true(list[0].wall < list[1].wall);
  packing_contacts_destroy(c);
  packing_domain_destroy(domain);
  packing_domain_annulus_def_init(&ring);
  ring.inner_radius = 3;
  ring.outer_radius = 5;
  assert_ok(packing_domain_create_annulus(NULL, &ring, &domain));
  c = find(p, domain, 1e-9, 0, 1);
  assert_int_equal(list_all(c, list), 2);
  assert_contact(&list[0], 0, PACKING_NO_INDEX, 0, 0);
  assert_normal(&list[0], 0.6, 0.8, 0);
  assert_normal(&list[1], -0.6, -0.8, 0);
  packing_contacts_destroy(c);
  packing_domain_destroy(domain);
  free(p);
}

/* A box full of touching spheres, numbered backwards. */
static void any_part_of_the_list_is_that_of_the_whole(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *box = test_box(3, 3, 3, 1);
  for (int i = 26; i >= 0; i--)
    add(p, 0.5 + i % 3, 0.5 + i / 3 % 3, 0.5 + i / 9, 0.5);
  packing_contacts *c = find(p, box, 1e-9, 0, 1);
  const size_t pairs = 27 + 18 + 18, all = pairs + 36;
  assert_int_equal(packing_contacts_count(c), pairs);
  assert_int_equal(packing_contacts_wall_count(c), 36);
  packing_contact whole[27 * 6], part[27 * 6];
  size_t count = 0;
  assert_ok(packing_contacts_list(c, 0, sizeof whole / sizeof *whole, whole, &count));
  assert_int_equal(count, all);
  for (size_t k = 1; k < all; k++) {
    const packing_contact *a = &whole[k - 1], *b = &whole[k];
    if (k == pairs)
      assert_true(a->wall == -1 && b->wall >= 0);
    else
      assert_true(a->i < b->i || (a->i == b->i && (a->j < b->j || a->wall < b->wall)));
  }
  for (size_t first = 0; first <= all + 2; first++)
    for (size_t capacity = 0; capacity < 50; capacity += 7) {
      memset(part, 0x5a, sizeof part);
      assert_ok(packing_contacts_list(c, first, capacity, part, &count));
      const size_t left = first < all ? all - first : 0;
      assert_int_equal(count, capacity < left ? capacity : left);
      assert_memory_equal(part, whole + (count > 0 ? first : 0), count * sizeof *part);
      assert_int_equal(part[count].wall, 0x5a5a5a5a);
    }
  assert_ok(packing_contacts_list(c, 5, 0, NULL, &count));
  assert_int_equal(count, 0);
  packing_contacts_destroy(c);
  packing_domain_destroy(box);
  free(p);
}

static void two_centres_in_one_have_no_normal(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_contact list[MOST];
  packing_fabric_report f;
  add(p, 1, 2, 3, 1);
  add(p, 1, 2, 3, 0.5);
  add(p, 1, 2, 5, 1);
  packing_contacts *c = find(p, NULL, 1e-9, 0, 1);
  assert_int_equal(list_all(c, list), 2);
  assert_contact(&list[0], 0, 1, -1, -1.5);
  assert_normal(&list[0], 0, 0, 0);
  packing_fabric_report_init(&f);
  assert_ok(packing_contacts_fabric(c, NULL, &f));
  assert_true(f.count == 1 && f.tensor[2][2] == 1);
  packing_contacts_destroy(c);
  free(p);
}

static void coordination_is_that_of_measure(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_coordination_report a, b;
  packing_coordination_def def;
  packing_domain *box = test_box(4, 4, 4, 0);
  for (int i = 0; i < 63; i++) /* a cube without its last corner */
    add(p, 0.5 + i % 4, 0.5 + i / 4 % 4, 0.5 + i / 16, 0.5);
  packing_contacts *c = find(p, box, 1e-9, 0, 1);
  packing_coordination_report_init(&a);
  packing_coordination_report_init(&b);
  packing_coordination_def_init(&def);
  assert_ok(packing_contacts_coordination(c, &a));
  assert_ok(packing_measure_coordination(NULL, &def, box, &p->view, &b));
  assert_memory_equal(&a, &b, sizeof a);
  assert_int_equal(a.contacts, 3 * 48 - 3);
  assert_true(a.rattlers > 0);
  packing_contacts_destroy(c);
  packing_domain_destroy(box);
  free(p);
}

/* The network needs neither the caller's context nor container nor arrays. */
static void a_network_stands_alone(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_domain *box = test_box(4, 2, 2, 0);
  pack *p = new_pack();
  packing_contacts *c = NULL;
  packing_contact list[MOST];
  add(p, 1, 1, 1, 1);
  add(p, 3, 1, 1, 1);
  assert_ok(packing_contacts_create(context, NULL, box, &p->view, &c));
  packing_context_destroy(context);
  packing_domain_destroy(box);
  free(p);
  assert_int_equal(list_all(c, list), 11);
  assert_contact(&list[0], 0, 1, -1, 0);
  packing_contacts_destroy(c);
  packing_contacts_destroy(NULL);
}

static void an_empty_pack_has_no_contacts(void **state)
{
  (void)state;
  packing_view v;
  packing_contacts *c = NULL;
  packing_contact list[MOST];
  packing_coordination_report r;
  packing_classes_report s;
  packing_fabric_report f;
  packing_domain *box = test_box(1, 1, 1, 1);
  packing_view_init(&v);
  assert_ok(packing_contacts_create(NULL, NULL, box, &v, &c));
  assert_int_equal(list_all(c, list), 0);
  packing_coordination_report_init(&r);
  packing_classes_report_init(&s);
  packing_fabric_report_init(&f);
  assert_ok(packing_contacts_coordination(c, &r));
  assert_ok(packing_contacts_classes(c, NULL, &s));
  assert_ok(packing_contacts_fabric(c, NULL, &f));
  assert_true(isnan(r.mean) && isnan(s.firm_share) && isnan(f.tensor[0][0]));
  assert_true(f.count == 0 && isnan(f.sd) && isnan(f.noise_floor));
  assert_ok(packing_contacts_degrees(c, NULL, NULL));
  packing_contacts_destroy(c);
  packing_domain_destroy(box);
}

static void flat_packs_without_a_container_have_no_z(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_contacts *c = NULL;
  packing_contacts_def def;
  packing_contact list[MOST];
  add(p, 0, 0, 7, 1);
  add(p, 2, 0, -5, 1);
  packing_contacts_def_init(&def);
  assert_ok(packing_contacts_create(NULL, &def, NULL, &p->view, &c));
  assert_int_equal(list_all(c, list), 0);
  packing_contacts_destroy(c);
  def.dim = 2;
  assert_ok(packing_contacts_create(NULL, &def, NULL, &p->view, &c));
  assert_int_equal(list_all(c, list), 1);
  assert_normal(&list[0], 1, 0, 0);
  packing_contacts_destroy(c);
  free(p);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(normals_point_from_the_lower_index_outwards),
      cmocka_unit_test(a_gap_makes_bonds),
      cmocka_unit_test(images_are_told),
      cmocka_unit_test(walls_are_told_one_by_one),
      cmocka_unit_test(round_walls_are_walls),
      cmocka_unit_test(any_part_of_the_list_is_that_of_the_whole),
      cmocka_unit_test(two_centres_in_one_have_no_normal),
      cmocka_unit_test(coordination_is_that_of_measure),
      cmocka_unit_test(a_network_stands_alone),
      cmocka_unit_test(flat_packs_without_a_container_have_no_z),
      cmocka_unit_test(an_empty_pack_has_no_contacts),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
