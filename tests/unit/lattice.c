/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lattices: known densities and coordination, the cut at a container, reference cells. */
#include "test.h"

typedef struct crystal {
  packing_lattice_kind kind;
  double cell[3]; /* in radii; z 0: two dimensions */
  double volume_fraction;
  double coordination;
} crystal;

/* Exact: pi/6, pi sqrt 3/8, pi/sqrt 18 twice, pi/(3 sqrt 3), pi/sqrt 12, pi/4. */
static const crystal crystals[] = {
    {PACKING_LATTICE_SC, {2, 2, 2}, 0.523598775598299, 6},
    {PACKING_LATTICE_BCC,
     {2.3094010767585030580, 2.3094010767585030580, 2.3094010767585030580},
     0.680174761587832,
     8},
    {PACKING_LATTICE_FCC,
     {2.8284271247461900976, 2.8284271247461900976, 2.8284271247461900976},
     0.740480489693061,
     12},
    {PACKING_LATTICE_HCP,
     {2, 3.4641016151377545871, 3.2659863237109041309},
     0.740480489693061,
     12},
    {PACKING_LATTICE_SIMPLE_HEXAGONAL,
     {2, 3.4641016151377545871, 2},
     0.604599788078073,
     8},
    {PACKING_LATTICE_HEXAGONAL, {2, 3.4641016151377545871, 0}, 0.906899682117109, 6},
    {PACKING_LATTICE_SQUARE, {2, 2, 0}, 0.785398163397448, 4},
};

static packing_particles *fill(const packing_lattice_def *def, packing_domain *domain,
                               packing_psd *psd, packing_placer_report *report)
{
  packing_placer *placer = NULL;
  packing_particles *store = test_store(packing_domain_dim(domain));
  assert_ok(packing_lattice_create(NULL, def, domain, psd, store, &placer));
  *report = test_run(placer);
  packing_placer_destroy(placer);
  return store;
}

static void crystals_are_exact_in_a_periodic_cell(void **state)
{
  (void)state;
  const double r = 0.37;
  packing_psd *psd = test_mono(r);
  for (size_t i = 0; i < sizeof crystals / sizeof *crystals; i++) {
    const crystal *c = &crystals[i];
    packing_domain *domain =
        c->cell[2] > 0
            ? test_box(c->cell[0] * r * 5, c->cell[1] * r * 4, c->cell[2] * r * 3, 7)
            : test_rectangle(c->cell[0] * r * 5, c->cell[1] * r * 4, 3);
    packing_lattice_def def;
    packing_placer_report report;
    packing_lattice_def_init(&def);
    def.kind = c->kind;
    packing_particles *store = fill(&def, domain, psd, &report);
    assert_int_equal(report.state, PACKING_PLACER_DONE);
    assert_close(report.volume_fraction, c->volume_fraction, 1e-12);
    packing_view v;
    packing_particles_view(store, &v);
    assert_true(test_brute_overlap(domain, &v) < 1e-12);
    packing_coordination_def about;
    packing_coordination_report contacts;
    packing_coordination_def_init(&about);
    packing_coordination_report_init(&contacts);
    about.dim = packing_domain_dim(domain);
    assert_ok(packing_measure_coordination(NULL, &about, domain, &v, &contacts));
    assert_near(contacts.mean, c->coordination, 0);
    packing_particles_destroy(store);
    packing_domain_destroy(domain);
  }
  packing_psd_destroy(psd);
}

static void a_box_of_ten_diameters_takes_ten(void **state)
{
  (void)state;
  const double r =
      0.1; /* not a binary fraction: sites fall beside the wall by rounding */
  packing_psd *psd = test_mono(r);
  packing_domain *domain = test_box(20 * r, 20 * r, 20 * r, 0);
  packing_lattice_def def;
  packing_placer_report report;
  packing_lattice_def_init(&def);
  def.kind = PACKING_LATTICE_SC;
  packing_particles *store = fill(&def, domain, psd, &report);
  assert_int_equal(report.placed, 1000);
  packing_view v;
  packing_particles_view(store, &v);
  const double *z = v.z.data;
  for (size_t i = 1; i < v.count; i++)
    assert_true(z[i] >= z[i - 1]); /* bottom first */
  packing_particles_destroy(store);
  def.count = 137;
  store = fill(&def, domain, psd, &report);
  assert_int_equal(report.state, PACKING_PLACER_DONE);
  assert_int_equal(packing_particles_count(store), 137);
  packing_particles_destroy(store);
  def.count = 1001;
  store = fill(&def, domain, psd, &report);
  assert_int_equal(report.state, PACKING_PLACER_SATURATED);
  assert_int_equal(report.placed, 1000);
  packing_particles_destroy(store);
  packing_domain_destroy(domain);
  packing_psd_destroy(psd);
}

/* A sphere cut out of face-centred cubic: every particle inside, and as many as lattice points
 * that a loop finds inside. */
static void a_curved_container_cuts_the_lattice(void **state)
{
  (void)state;
  packing_domain_sphere_def sphere;
  packing_domain *domain = NULL;
  packing_domain_sphere_def_init(&sphere);
  sphere.radius = 6.7;
  assert_ok(packing_domain_create_sphere(NULL, &sphere, &domain));
  packing_psd *psd = test_mono(0.5);
  packing_lattice_def def;
  packing_placer_report report;
  packing_lattice_def_init(&def);
  def.kind = PACKING_LATTICE_FCC;
  packing_particles *store = fill(&def, domain, psd, &report);
  const double half = sqrt(0.5), first = -6.7 + 0.5;
  size_t inside = 0;
  for (int k = 0; k < 40; k++)
    for (int j = 0; j < 40; j++)
      for (int i = (k + j) % 2; i < 40; i += 2) {
        const double x = first + i * half, y = first + j * half, z = first + k * half;
        inside += sqrt(x * x + y * y + z * z) <= 6.7 - 0.5 + 1e-12;
      }
  assert_int_equal(packing_particles_count(store), inside);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

static void lattice_goes_round_what_stands(void **state)
{
  (void)state;
  packing_domain *domain = test_box(8, 8, 8, 0);
  packing_psd *psd = test_mono(0.5);
  packing_particles *store = test_store(3);
  packing_placer *placer = NULL;
  const packing_vec3 centre = {4, 4, 4};
  packing_lattice_def def;
  packing_lattice_def_init(&def);
  def.kind = PACKING_LATTICE_SC;
  assert_ok(packing_particles_add(store, centre, 1.5, NULL));
  assert_ok(packing_lattice_create(NULL, &def, domain, psd, store, &placer));
  const packing_placer_report report = test_run(placer);
  packing_view v;
  packing_particles_view(store, &v);
  assert_true(report.placed < 512 && report.placed > 450);
  assert_true(test_brute_overlap(domain, &v) < 1e-12);
  packing_placer_destroy(placer);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

/* No overlap and no protrusion for any radii up to the largest. */
static void cells_never_overlap(void **state)
{
  (void)state;
  packing_domain_cylinder_def round;
  packing_domain *domains[3] = {test_box(12.3, 12.3, 25, 0), test_rectangle(17.2, 90, 0),
                                NULL};
  packing_domain_cylinder_def_init(&round);
  round.radius = 8.9;
  round.height = 25;
  assert_ok(packing_domain_create_cylinder(NULL, &round, &domains[2]));
  packing_psd *psd = test_uniform(0.11, 0.83);
  for (size_t d = 0; d < 3; d++)
    for (size_t count = 1; count < 400; count = count * 3 + 1) {
      packing_lattice_def def;
      packing_placer_report report;
      packing_lattice_def_init(&def);
      def.count = count;
      packing_particles *store = fill(&def, domains[d], psd, &report);
      packing_view v;
      packing_particles_view(store, &v);
      assert_int_equal(report.state, PACKING_PLACER_DONE);
      assert_int_equal(v.count, count);
      assert_true(test_brute_overlap(domains[d], &v) == 0);
      packing_audit_report audit;
      packing_audit_report_init(&audit);
      assert_ok(packing_audit(NULL, NULL, domains[d], &v, &audit));
      assert_true(audit.passed && audit.max_protrusion < 1e-12);
      packing_particles_destroy(store);
    }
  for (size_t d = 0; d < 3; d++)
    packing_domain_destroy(domains[d]);
  packing_psd_destroy(psd);
}

/* F18 by hand: a = 10, l = 2.5: 16 cells a layer; 40 particles take 3 layers, 7.5 high. */
static void cells_that_need_more_height_say_how_much(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_domain *tall = test_box(10, 10, 7.5, 0), *low = test_box(10, 10, 7.4, 0);
  packing_psd *psd = test_mono(0.5);
  packing_particles *store = test_store(3);
  packing_placer *placer = NULL;
  packing_lattice_def def;
  packing_lattice_def_init(&def);
  def.count = 40;
  def.cell = 2.5;
  assert_ok(packing_lattice_create(context, &def, tall, psd, store, &placer));
  packing_placer_destroy(placer);
  placer = NULL;
  assert_fails(context, packing_lattice_create(context, &def, low, psd, store, &placer),
               PACKING_ERR_RANGE, "7.5");
  /* The loosest cell under 7.4: two layers of 5 x 5 are enough, l = 2. */
  def.cell = 0;
  def.count = 50;
  assert_ok(packing_lattice_create(context, &def, low, psd, store, &placer));
  assert_int_equal(test_run(placer).placed, 50);
  packing_placer_destroy(placer);
  def.count = 701; /* 10 x 10 cells of one diameter, 7 layers */
  assert_fails(context, packing_lattice_create(context, &def, low, psd, store, &placer),
               PACKING_ERR_RANGE, "height of 8");
  def.cell = 0.9;
  assert_fails(context, packing_lattice_create(context, &def, low, psd, store, &placer),
               PACKING_ERR_RANGE, "cell");
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(tall);
  packing_domain_destroy(low);
  packing_context_destroy(context);
}

static void refusals_name_the_field(void **state)
{
  (void)state;
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  packing_domain *box = test_box(10, 10.3, 10, 7), *flat = test_rectangle(9, 9, 0);
  packing_domain *tiny = test_box(0.9, 9, 9, 0);
  packing_domain_sphere_def round;
  packing_domain *ball = NULL;
  packing_domain_sphere_def_init(&round);
  round.radius = 5;
  assert_ok(packing_domain_create_sphere(NULL, &round, &ball));
  packing_psd *psd = test_mono(0.5);
  packing_particles *store = test_store(3), *disc_store = test_store(2);
  packing_placer *p = NULL;
  packing_lattice_def def;
  packing_lattice_def_init(&def);
  assert_fails(c, packing_lattice_create(c, &def, box, psd, store, &p), PACKING_ERR_RANGE,
               "count");
  def.count = 5;
  assert_fails(c, packing_lattice_create(c, &def, ball, psd, store, &p),
               PACKING_ERR_UNSUPPORTED, "kind");
  def.kind = PACKING_LATTICE_SC;
  assert_fails(c, packing_lattice_create(c, &def, box, psd, store, &p),
               PACKING_ERR_GEOMETRY, "y period");
  assert_fails(c, packing_lattice_create(c, &def, flat, psd, disc_store, &p),
               PACKING_ERR_RANGE, "kind");
  assert_fails(c, packing_lattice_create(c, &def, tiny, psd, store, &p),
               PACKING_ERR_GEOMETRY, "psd");
  def.spacing_r = 0.4;
  assert_fails(c, packing_lattice_create(c, &def, box, psd, store, &p), PACKING_ERR_RANGE,
               "spacing_r");
  def.spacing_r = NAN;
  assert_fails(c, packing_lattice_create(c, &def, box, psd, store, &p),
               PACKING_ERR_INVALID, "spacing_r");
  packing_lattice_def_init(&def);
  def.kind = PACKING_LATTICE_END;
  assert_fails(c, packing_lattice_create(c, &def, box, psd, store, &p), PACKING_ERR_RANGE,
               "kind");
  packing_lattice_def_init(&def);
  def.cell = -1;
  assert_fails(c, packing_lattice_create(c, &def, box, psd, store, &p), PACKING_ERR_RANGE,
               "cell");
  assert_null(p);
  assert_null(packing_lattice_kind_name(PACKING_LATTICE_END));
  packing_particles_destroy(store);
  packing_particles_destroy(disc_store);
  packing_psd_destroy(psd);
  packing_domain_destroy(box);
  packing_domain_destroy(flat);
  packing_domain_destroy(tiny);
  packing_domain_destroy(ball);
  packing_context_destroy(c);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(crystals_are_exact_in_a_periodic_cell),
      cmocka_unit_test(a_box_of_ten_diameters_takes_ten),
      cmocka_unit_test(a_curved_container_cuts_the_lattice),
      cmocka_unit_test(lattice_goes_round_what_stands),
      cmocka_unit_test(cells_never_overlap),
      cmocka_unit_test(cells_that_need_more_height_say_how_much),
      cmocka_unit_test(refusals_name_the_field),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
