/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random sequential addition: what was asked is placed, nothing overlaps or protrudes, saturation
 * is true, refusals are clear. */
#include "test.h"

static packing_placer *rsa(packing_context *context, const packing_rsa_def *def,
                           packing_domain *domain, packing_psd *psd,
                           packing_particles *particles)
{
  packing_placer *placer = NULL;
  assert_ok(packing_rsa_create(context, def, domain, psd, particles, &placer));
  return placer;
}

/* Runs to the end and checks that the pack is one. */
static packing_placer_report pack(const packing_rsa_def *def, packing_domain *domain,
                                  packing_psd *psd, packing_particles *particles)
{
  packing_view view;
  packing_placer *placer = rsa(NULL, def, domain, psd, particles);
  const packing_placer_report report = test_run(placer);
  packing_placer_destroy(placer);
  packing_particles_view(particles, &view);
  assert_true(test_brute_overlap(domain, &view) <= 1e-14);
  const double *x = view.x.data, *y = view.y.data, *z = view.z.data, *r = view.r.data;
  for (size_t i = 0; i < view.count; i++) {
    const packing_vec3 p = {x[i], y[i], z[i]};
    assert_true(packing_domain_signed_distance(domain, &p, NULL) >= r[i] * (1 - 1e-14));
  }
  return report;
}

static packing_domain *cylinder(double radius, double height)
{
  packing_domain_cylinder_def def;
  packing_domain *domain = NULL;
  packing_domain_cylinder_def_init(&def);
  def.radius = radius;
  def.height = height;
  assert_ok(packing_domain_create_cylinder(NULL, &def, &domain));
  return domain;
}

static void count_is_placed_in_every_container(void **state)
{
  (void)state;
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.count = 311;
  packing_domain *domains[] = {test_box(9.7, 8.3, 11.1, 0),
                               test_box(9.7, 8.3, 11.1, 7),
                               test_box(9.7, 8.3, 11.1, PACKING_PERIODIC_Y),
                               test_rectangle(31.5, 17.9, 0),
                               test_rectangle(31.5, 17.9, 3),
                               cylinder(5.3, 12.1)};
  for (size_t d = 0; d < sizeof domains / sizeof *domains; d++) {
    packing_psd *psds[] = {test_mono(0.53), test_uniform(0.21, 0.61)};
    for (size_t k = 0; k < 2; k++) {
      packing_particles *store = test_store(packing_domain_dim(domains[d]));
      const packing_placer_report report = pack(&def, domains[d], psds[k], store);
      assert_int_equal(report.state, PACKING_PLACER_DONE);
      assert_int_equal(report.placed, 311);
      assert_int_equal(packing_particles_count(store), 311);
      assert_true(report.attempts >= 311);
      assert_true(report.progress == 1);
      packing_particles_destroy(store);
      packing_psd_destroy(psds[k]);
    }
    packing_domain_destroy(domains[d]);
  }
}

static void volume_fraction_is_met_to_half_a_particle(void **state)
{
  (void)state;
  packing_domain *domain = test_box(10.3, 9.1, 8.7, 7);
  packing_psd *psds[] = {test_mono(0.47), test_uniform(0.13, 0.59)};
  for (size_t k = 0; k < 2; k++)
    for (int order = 0; order < 2; order++) {
      packing_particles *store = test_store(3);
      packing_rsa_def def;
      packing_rsa_def_init(&def);
      def.volume_fraction = 0.237;
      def.order = (packing_order)order;
      const packing_placer_report report = pack(&def, domain, psds[k], store);
      const double half = 2.0 / 3.0 * 3.14159265358979 *
                          pow(packing_psd_max_r(psds[k]), 3) /
                          packing_domain_volume(domain);
      assert_int_equal(report.state, PACKING_PLACER_DONE);
      assert_near(report.volume_fraction, 0.237, half);
      packing_particles_destroy(store);
    }
  packing_psd_destroy(psds[0]);
  packing_psd_destroy(psds[1]);
  packing_domain_destroy(domain);
}

/* No point of a fine lattice is free: an independent look at what the placer says it proved. */
static void check_saturated(packing_domain *domain, const packing_particles *store,
                            double r)
{
  packing_view v;
  packing_bounds b;
  packing_particles_view(store, &v);
  packing_domain_bounds(domain, &b);
  const double *x = v.x.data, *y = v.y.data, *z = v.z.data;
  const int n = 40, nz = packing_domain_dim(domain) == 2 ? 1 : n;
  for (int k = 0; k < nz; k++)
    for (int j = 0; j < n; j++)
      for (int i = 0; i < n; i++) {
        const packing_vec3 p = {b.lo.x + (b.hi.x - b.lo.x) * (i + 0.318) / n,
                                b.lo.y + (b.hi.y - b.lo.y) * (j + 0.571) / n,
                                b.lo.z + (b.hi.z - b.lo.z) * (k + 0.692) / n};
        int blocked = !packing_domain_holds(domain, &p, r);
        for (size_t q = 0; q < v.count && !blocked; q++) {
          const packing_vec3 c = {x[q], y[q], z[q]};
          const packing_vec3 s = packing_domain_separation(domain, &p, &c);
          blocked = s.x * s.x + s.y * s.y + s.z * s.z < 4 * r * r;
        }
        assert_true(blocked);
      }
}

static void saturation_leaves_no_hole(void **state)
{
  (void)state;
  packing_domain *domains[] = {test_box(7.3, 6.1, 5.9, 7),
                               test_box(7.3, 6.1, 5.9, 0),
                               cylinder(3.7, 6.2),
                               test_rectangle(23.1, 19.7, 3),
                               test_rectangle(23.1, 19.7, 0),
                               test_box(2.9, 1.7, 8.8, 7),
                               test_box(1.0, 6.0, 7.0, 0)};
  packing_psd *psd = test_mono(0.5);
  for (size_t d = 0; d < sizeof domains / sizeof *domains; d++) {
    packing_particles *store = test_store(packing_domain_dim(domains[d]));
    const packing_placer_report report = pack(NULL, domains[d], psd, store);
    assert_int_equal(report.state, PACKING_PLACER_SATURATED);
    check_saturated(domains[d], store, 0.5);
    packing_particles_destroy(store);
    packing_domain_destroy(domains[d]);
  }
  packing_psd_destroy(psd);
}

/* A container that holds exactly one particle, in one place, or along a line. */
static void tight_containers_take_what_fits(void **state)
{
  (void)state;
  packing_domain *one = test_box(1.0, 1.0, 1.0, 0), *line = test_box(1.0, 1.0, 7.3, 0);
  packing_psd *psd = test_mono(0.5);
  packing_particles *store = test_store(3);
  packing_placer_report report = pack(NULL, one, psd, store);
  assert_int_equal(report.state, PACKING_PLACER_SATURATED);
  assert_int_equal(report.placed, 1);
  packing_particles_truncate(store, 0);
  report = pack(NULL, line, psd, store);
  assert_int_equal(report.state, PACKING_PLACER_SATURATED);
  assert_true(report.placed >= 4 && report.placed <= 7);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(one);
  packing_domain_destroy(line);
}

/* The last particle asked for may be the last one that fits: the run is done all the same. */
static void all_that_was_asked_is_done(void **state)
{
  (void)state;
  packing_domain *domain = test_box(5.2, 5.2, 5.2, 0);
  packing_psd *psd = test_mono(1);
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  for (def.seed = 1; def.seed < 40; def.seed++)
    for (def.count = 5; def.count < 10; def.count++) {
      packing_particles *store = test_store(3);
      const packing_placer_report report = pack(&def, domain, psd, store);
      assert_int_equal(report.state, report.placed == def.count
                                         ? PACKING_PLACER_DONE
                                         : PACKING_PLACER_SATURATED);
      packing_particles_destroy(store);
    }
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

/* So many that room for all of them at once would exceed memory. */
static void absurd_counts_saturate(void **state)
{
  (void)state;
  packing_domain *domain = test_box(6, 6, 6, 0);
  const double r[] = {0.001, 1}, share[] = {0.5, 0.5};
  packing_psd_discrete_def two;
  packing_psd_discrete_def_init(&two);
  two.count = 2;
  two.r = r;
  two.share = share;
  two.by = PACKING_BY_NUMBER;
  packing_psd *psds[] = {test_mono(1), NULL};
  assert_ok(packing_psd_create_discrete(NULL, &two, &psds[1]));
  const size_t counts[] = {4000000000U, UINT32_MAX, SIZE_MAX};
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.max_failures = 1000;
  for (size_t k = 0; k < 6; k++) {
    packing_particles *store = test_store(3);
    def.count = counts[k / 2];
    const packing_placer_report report = pack(&def, domain, psds[k % 2], store);
    assert_int_equal(report.state,
                     k % 2 == 0 ? PACKING_PLACER_SATURATED : PACKING_PLACER_GAVE_UP);
    assert_true(packing_particles_bytes(store) < 1000000);
    packing_particles_destroy(store);
  }
  packing_psd_destroy(psds[0]);
  packing_psd_destroy(psds[1]);
  packing_domain_destroy(domain);
}

/* What holds for large periodic cells is no limit of small ones. */
static void a_tiny_periodic_cell_takes_one(void **state)
{
  (void)state;
  packing_domain *cells[] = {test_box(2.1, 2.1, 2.1, 7), test_rectangle(2.1, 2.1, 3)};
  packing_psd *psd = test_mono(1);
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.count = 1;
  for (int d = 0; d < 2; d++) {
    packing_particles *store = test_store(3 - d);
    const packing_placer_report report = pack(&def, cells[d], psd, store);
    assert_int_equal(report.state, PACKING_PLACER_DONE);
    assert_int_equal(report.placed, 1);
    packing_particles_destroy(store);
    packing_domain_destroy(cells[d]);
  }
  packing_psd_destroy(psd);
}

/* Gaps of exactly one diameter, wherever they are, whatever rounding makes of them. */
static void exact_gaps_take_particles(void **state)
{
  (void)state;
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.max_failures = 10000;
  for (int k = 1; k < 40; k++) {
    const double r = k * 0.013;
    packing_domain_cylinder_def cylinder_def;
    packing_domain_cylinder_def_init(&cylinder_def);
    cylinder_def.radius = 6 * r;
    cylinder_def.height = 2 * r;
    cylinder_def.base.z = 0.7 * k + 0.1;
    packing_domain_box_def box_def;
    packing_domain_box_def_init(&box_def);
    box_def.size.x = box_def.size.y = 12 * r;
    box_def.size.z = 2 * r * (k % 2 ? 1 : 1 - 1e-11);
    box_def.corner = cylinder_def.base;
    packing_domain *domains[2] = {NULL, NULL};
    assert_ok(packing_domain_create_cylinder(NULL, &cylinder_def, &domains[0]));
    assert_ok(packing_domain_create_box(NULL, &box_def, &domains[1]));
    const double sizes[] = {0.5 * r, r}, share[] = {0.5, 0.5};
    packing_psd_discrete_def two;
    packing_psd_discrete_def_init(&two);
    two.count = 2;
    two.r = sizes;
    two.share = share;
    two.by = PACKING_BY_NUMBER;
    packing_psd *psds[] = {test_mono(r), NULL};
    assert_ok(packing_psd_create_discrete(NULL, &two, &psds[1]));
    for (int i = 0; i < 4; i++) {
      packing_particles *store = test_store(3);
      def.count = i < 2 ? 0 : 8;
      packing_placer *placer = rsa(NULL, &def, domains[i % 2], psds[i / 2], store);
      const packing_placer_report report = test_run(placer);
      assert_int_equal(report.state,
                       i < 2 ? PACKING_PLACER_SATURATED : PACKING_PLACER_DONE);
      assert_true(report.placed >= 8);
      packing_view view;
      packing_particles_view(store, &view);
      packing_audit_report audit;
      packing_audit_report_init(&audit);
      assert_ok(packing_audit(NULL, NULL, domains[i % 2], &view, &audit));
      assert_int_equal(audit.passed, 1);
      packing_placer_destroy(placer);
      packing_particles_destroy(store);
    }
    for (int i = 0; i < 2; i++) {
      packing_psd_destroy(psds[i]);
      packing_domain_destroy(domains[i]);
    }
  }
}

/* Centres fit on a surface only: it ends, and does not call that a proof. */
static void a_gap_of_one_diameter_ends(void **state)
{
  (void)state;
  packing_domain_tube_def def;
  packing_domain *domain = NULL;
  packing_domain_tube_def_init(&def);
  def.inner_radius = 4;
  def.outer_radius = 6;
  def.height = 8;
  assert_ok(packing_domain_create_tube(NULL, &def, &domain));
  packing_psd *psd = test_mono(1);
  packing_particles *store = test_store(3);
  const packing_placer_report report = pack(NULL, domain, psd, store);
  assert_true(report.state == PACKING_PLACER_GAVE_UP ||
              report.state == PACKING_PLACER_SATURATED);
  assert_true(report.state == PACKING_PLACER_SATURATED || report.placed < 40);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

static void particles_that_stand_are_obstacles(void **state)
{
  (void)state;
  packing_domain *domain = test_box(8.1, 8.2, 8.3, PACKING_PERIODIC_X);
  packing_psd *first = test_uniform(0.4, 1.1), *second = test_mono(0.5);
  packing_particles *store = test_store(3);
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.count = 23;
  assert_int_equal(pack(&def, domain, first, store).state, PACKING_PLACER_DONE);
  def.count = 61;
  def.stream = 1;
  assert_int_equal(pack(&def, domain, second, store).state, PACKING_PLACER_DONE);
  assert_int_equal(packing_particles_count(store), 84);
  /* Equal sizes on equal sizes: the cells' way. */
  packing_particles_truncate(store, 0);
  assert_int_equal(pack(&def, domain, second, store).placed, 61);
  def.stream = 2;
  def.count = 0;
  assert_int_equal(pack(&def, domain, second, store).state, PACKING_PLACER_SATURATED);
  check_saturated(domain, store, 0.5);
  packing_particles_destroy(store);
  packing_psd_destroy(first);
  packing_psd_destroy(second);
  packing_domain_destroy(domain);
}

static void sizes_that_cannot_be_placed_are_counted(void **state)
{
  (void)state;
  packing_domain *domain = test_box(6.3, 6.4, 6.5, 7);
  packing_psd *psd = test_uniform(0.3, 0.9);
  packing_particles *store = test_store(3);
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.count = 5000;
  def.max_failures = 3000;
  packing_placer_report report = pack(&def, domain, psd, store);
  assert_int_equal(report.state, PACKING_PLACER_GAVE_UP);
  assert_int_equal(report.unplaced, 1);
  packing_particles_truncate(store, 0);
  def.order = PACKING_ORDER_DESCENDING;
  report = pack(&def, domain, psd, store);
  assert_int_equal(report.state, PACKING_PLACER_GAVE_UP);
  assert_int_equal(report.unplaced + report.placed, 5000);
  packing_view v;
  packing_particles_view(store, &v);
  const double *r = v.r.data;
  for (size_t i = 1; i < v.count; i++)
    assert_true(r[i] <= r[i - 1]);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

/* Far more than fits is asked: it ends, in memory for what could fit. */
static void absurd_counts_end(void **state)
{
  (void)state;
  packing_domain *domain = test_box(6.3, 6.4, 6.5, 7);
  packing_psd *psd = test_uniform(0.3, 0.9);
  for (int order = 0; order < 2; order++) {
    packing_particles *store = test_store(3);
    packing_rsa_def def;
    packing_rsa_def_init(&def);
    def.count = SIZE_MAX;
    def.max_failures = 1000;
    def.order = (packing_order)order;
    const packing_placer_report report = pack(&def, domain, psd, store);
    assert_int_equal(report.state, PACKING_PLACER_GAVE_UP);
    assert_true(report.placed > 20 && report.unplaced >= 1);
    packing_particles_destroy(store);
  }
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

static int by_value(const void *a, const void *b)
{
  const double x = *(const double *)a, y = *(const double *)b;
  return x < y ? -1 : x > y;
}

/* Both orders place the same radii: none is drawn again. */
static void orders_place_the_same_sizes(void **state)
{
  (void)state;
  packing_domain *domain = test_box(9.3, 9.4, 9.5, 7);
  packing_psd *psd = test_uniform(0.3, 0.9);
  double sizes[2][200];
  for (int order = 0; order < 2; order++) {
    packing_particles *store = test_store(3);
    packing_rsa_def def;
    packing_rsa_def_init(&def);
    def.count = 200;
    def.order = (packing_order)order;
    assert_int_equal(pack(&def, domain, psd, store).placed, 200);
    assert_ok(
        packing_particles_extract(store, PACKING_FIELD_R, sizes[order], sizeof(double)));
    qsort(sizes[order], 200, sizeof(double), by_value);
    packing_particles_destroy(store);
  }
  assert_memory_equal(sizes[0], sizes[1], sizeof sizes[0]);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

static void components_are_kept(void **state)
{
  (void)state;
  packing_psd *parts[] = {test_mono(0.6), test_uniform(0.2, 0.3)}, *mixture = NULL;
  const double share[] = {0.7, 0.3};
  packing_psd_mixture_def mix;
  packing_psd_mixture_def_init(&mix);
  mix.count = 2;
  mix.parts = parts;
  mix.share = share;
  assert_ok(packing_psd_create_mixture(NULL, &mix, &mixture));
  packing_domain *domain = test_box(9.3, 9.4, 9.5, 7);
  packing_particles *store = test_store(3);
  assert_ok(packing_particles_add_columns(store, PACKING_COLUMN_COMPONENT));
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.count = 150;
  def.order = PACKING_ORDER_DESCENDING;
  assert_int_equal(pack(&def, domain, mixture, store).placed, 150);
  packing_view v;
  packing_particles_view(store, &v);
  const double *r = v.r.data;
  const int32_t *component = v.component.data;
  for (size_t i = 0; i < v.count; i++)
    assert_int_equal(component[i], r[i] > 0.5 ? 0 : 1);
  packing_particles_destroy(store);
  packing_psd_destroy(mixture);
  packing_psd_destroy(parts[0]);
  packing_psd_destroy(parts[1]);
  packing_domain_destroy(domain);
}

static void refusals_name_the_field(void **state)
{
  (void)state;
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  packing_domain *cell = test_box(6, 6, 6, 7), *flat = test_rectangle(9, 9, 3);
  packing_psd *psd = test_mono(0.5), *large = test_mono(3.01),
              *mixed = test_uniform(1, 3.01);
  packing_particles *store = test_store(3);
  packing_placer *p = NULL;
  packing_rsa_def def;
  const double bad[] = {NAN, INFINITY, -INFINITY, -0.1, 1.0, 2.0};
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    packing_rsa_def_init(&def);
    def.volume_fraction = bad[i];
    assert_fails(c, packing_rsa_create(c, &def, cell, psd, store, &p),
                 isfinite(bad[i]) ? PACKING_ERR_RANGE : PACKING_ERR_INVALID,
                 "volume_fraction");
  }
  packing_rsa_def_init(&def);
  def.volume_fraction = 0.385;
  assert_fails(c, packing_rsa_create(c, &def, cell, psd, store, &p), PACKING_ERR_RANGE,
               "0.3841");
  packing_rsa_def_init(&def);
  def.volume_fraction = 5e-324;
  packing_domain *small = test_box(0.5, 0.5, 0.5, 0);
  packing_psd *dust = test_mono(0.01);
  assert_int_equal(pack(&def, small, dust, store).placed, 0);
  packing_psd_destroy(dust);
  packing_domain_destroy(small);
  packing_rsa_def_init(&def);
  def.count = 200;
  assert_fails(c, packing_rsa_create(c, &def, cell, psd, store, &p), PACKING_ERR_RANGE,
               "count");
  packing_rsa_def_init(&def);
  def.order = PACKING_ORDER_DESCENDING;
  assert_fails(c, packing_rsa_create(c, &def, cell, psd, store, &p), PACKING_ERR_INVALID,
               "order");
  def.order = (packing_order)7;
  assert_fails(c, packing_rsa_create(c, &def, cell, psd, store, &p), PACKING_ERR_RANGE,
               "order");
  packing_rsa_def_init(&def);
  def.max_failures = 0;
  assert_fails(c, packing_rsa_create(c, &def, cell, psd, store, &p), PACKING_ERR_RANGE,
               "max_failures");
  packing_rsa_def_init(&def);
  def.struct_size = 11;
  assert_fails(c, packing_rsa_create(c, &def, cell, psd, store, &p), PACKING_ERR_ABI,
               "struct_size");
  assert_fails(c, packing_rsa_create(c, NULL, cell, large, store, &p),
               PACKING_ERR_GEOMETRY, "psd");
  assert_fails(c, packing_rsa_create(c, NULL, cell, mixed, store, &p),
               PACKING_ERR_GEOMETRY, "psd");
  assert_fails(c, packing_rsa_create(c, NULL, flat, psd, store, &p), PACKING_ERR_RANGE,
               "dimensions");
  assert_fails(c, packing_rsa_create(c, NULL, NULL, psd, store, &p), PACKING_ERR_INVALID,
               "domain");
  assert_fails(c, packing_rsa_create(c, NULL, cell, NULL, store, &p), PACKING_ERR_INVALID,
               "psd");
  assert_fails(c, packing_rsa_create(c, NULL, cell, psd, NULL, &p), PACKING_ERR_INVALID,
               "particles");
  assert_fails(c, packing_rsa_create(c, NULL, cell, psd, store, NULL),
               PACKING_ERR_INVALID, "placer");
  assert_null(p);
  p = rsa(c, NULL, cell, psd, store);
  packing_placer_report report = {0};
  assert_int_equal(packing_placer_step(NULL, 1, NULL), PACKING_ERR_INVALID);
  assert_fails(c, packing_placer_step(p, 0, NULL), PACKING_ERR_RANGE, "budget");
  assert_fails(c, packing_placer_step(p, 1, &report), PACKING_ERR_ABI, "report");
  packing_placer_destroy(p);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_psd_destroy(large);
  packing_psd_destroy(mixed);
  packing_domain_destroy(cell);
  packing_domain_destroy(flat);
  packing_context_destroy(c);
}

/* The mean coordination of sequential inhibition is 0: all are rattlers. */
static void no_two_touch(void **state)
{
  (void)state;
  packing_domain *domain = test_box(9.3, 9.4, 9.5, 7);
  packing_psd *psds[] = {test_mono(0.5), test_uniform(0.3, 0.9)};
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.count = 200;
  for (size_t k = 0; k < 2; k++) {
    packing_particles *store = test_store(3);
    packing_coordination_report contacts;
    packing_view v;
    assert_int_equal(pack(&def, domain, psds[k], store).placed, 200);
    packing_particles_view(store, &v);
    packing_coordination_report_init(&contacts);
    assert_ok(packing_measure_coordination(NULL, NULL, domain, &v, &contacts));
    assert_true(contacts.mean == 0 && contacts.rattlers == 200);
    packing_particles_destroy(store);
    packing_psd_destroy(psds[k]);
  }
  packing_domain_destroy(domain);
}

static void states_have_names(void **state)
{
  (void)state;
  assert_string_equal(packing_placer_state_name(PACKING_PLACER_SATURATED), "saturated");
  assert_string_equal(packing_placer_state_name((packing_placer_state)9), "unknown");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(count_is_placed_in_every_container),
      cmocka_unit_test(volume_fraction_is_met_to_half_a_particle),
      cmocka_unit_test(saturation_leaves_no_hole),
      cmocka_unit_test(a_tiny_periodic_cell_takes_one),
      cmocka_unit_test(exact_gaps_take_particles),
      cmocka_unit_test(all_that_was_asked_is_done),
      cmocka_unit_test(absurd_counts_saturate),
      cmocka_unit_test(tight_containers_take_what_fits),
      cmocka_unit_test(a_gap_of_one_diameter_ends),
      cmocka_unit_test(particles_that_stand_are_obstacles),
      cmocka_unit_test(sizes_that_cannot_be_placed_are_counted),
      cmocka_unit_test(absurd_counts_end),
      cmocka_unit_test(orders_place_the_same_sizes),
      cmocka_unit_test(components_are_kept),
      cmocka_unit_test(refusals_name_the_field),
      cmocka_unit_test(no_two_touch),
      cmocka_unit_test(states_have_names),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
