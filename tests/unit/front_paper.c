/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The advancing front in paper mode, outward: the worked example, the start, contacts, goals. */
#include "cluster.h"
#include "front_scenes.h"
#include "solids.h"

static packing_vec3 at(double x, double y, double z)
{
  const packing_vec3 p = {x, y, z};
  return p;
}

/* Figure 2: a disc of the front has no room beside it and is dropped; the next one takes the
 * pending disc. Disc 0 stands in a ring of six equal ones. */
static packing_particles *ring_of_seven(void)
{
  packing_particles *store = test_store(2);
  const double h = sqrt(3.0);
  const packing_vec3 centre[7] = {{15, 15, 0},     {17, 15, 0}, {16, 15 + h, 0},
                                  {14, 15 + h, 0}, {13, 15, 0}, {14, 15 - h, 0},
                                  {16, 15 - h, 0}};
  for (int i = 0; i < 7; i++)
    assert_ok(packing_particles_add(store, centre[i], i == 0 ? 0.9 : 0.99, NULL));
  return store;
}

static void figure_2(packing_front_select particle, packing_front_select neighbours,
                     size_t touched, size_t second)
{
  packing_domain *domain = test_rectangle(30, 30, 0);
  packing_psd *psd = test_mono(1.25);
  packing_particles *store = ring_of_seven();
  packing_placer *placer = NULL;
  packing_front_def def = front_paper();
  def.count = 1;
  def.select_particle = particle;
  def.select_neighbours = neighbours;
  assert_ok(packing_front_create(NULL, &def, domain, psd, store, &placer));
  /* The ring stands at the innermost point: no group has room there, the front goes on from it. */
  assert_int_equal(test_run(placer).state, PACKING_PLACER_DONE);
  assert_int_equal(packing_particles_count(store), 8);
  assert_near(front_gap(domain, store, 7, touched), 0, 1e-12);
  assert_near(front_gap(domain, store, 7, second), 0, 1e-12);
  size_t member[16], count = 0;
  assert_ok(packing_front_members(placer, 16, member, &count));
  int centre_is_member = 0;
  for (size_t k = 0; k < count; k++) {
    centre_is_member |= member[k] == 0;
    assert_true(k == 0 || member[k] > member[k - 1]);
  }
  assert_int_equal(centre_is_member, particle == PACKING_FRONT_LIFO);
  assert_int_equal(count, particle == PACKING_FRONT_LIFO ? 8 : 7);
  packing_placer_destroy(placer);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

static void a_disc_without_room_is_dropped_and_the_next_takes_the_pending(void **state)
{
  (void)state;
  figure_2(PACKING_FRONT_FIFO, PACKING_FRONT_FIFO, 1, 2);
  figure_2(PACKING_FRONT_FIFO, PACKING_FRONT_LIFO, 1, 6);
  figure_2(PACKING_FRONT_LIFO, PACKING_FRONT_FIFO, 6, 1);
  figure_2(PACKING_FRONT_LIFO, PACKING_FRONT_LIFO, 6, 5);
}

/* Three discs or four spheres in mutual contact, the mean of the centres at the innermost point. */
static void start(const scene *s, packing_vec3 innermost, uint64_t seed)
{
  packing_domain *domain = scene_make(s);
  const int dim = packing_domain_dim(domain);
  packing_psd *psd = test_uniform(0.7, 1.3);
  packing_particles *store = test_store(dim);
  packing_front_def def = front_paper();
  def.count = (size_t)dim + 1;
  def.seed = seed;
  const packing_placer_report report = front_pack(&def, domain, psd, store);
  assert_int_equal(report.state, PACKING_PLACER_DONE);
  assert_int_equal(report.placed, def.count);
  packing_vec3 mean = {0, 0, 0};
  for (size_t i = 0; i < def.count; i++) {
    const packing_vec3 p = front_centre(store, i);
    mean = at(mean.x + p.x / (double)def.count, mean.y + p.y / (double)def.count,
              mean.z + p.z / (double)def.count);
    for (size_t j = 0; j < i; j++)
      assert_near(front_gap(domain, store, i, j), 0, 4e-15 * 10);
  }
  assert_near(mean.x, innermost.x, 1e-14);
  assert_near(mean.y, innermost.y, 1e-14);
  assert_near(mean.z, innermost.z, 1e-14);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

static void the_start_touches_itself_at_the_innermost_point(void **state)
{
  (void)state;
  const scene ball = {SCENE_SPHERE, 7.3, 0, 0, 0, {0.5, -0.25, 0.125}, 2, 0, 0};
  const scene cube = {SCENE_BOX, 9, 9, 9, 0, {-4, -4, -4}, 2, 0, 0};
  const scene square = {SCENE_RECTANGLE, 9, 9, 0, 0, {-4, -4, 0}, 1, 0, 0};
  const scene disc = {SCENE_CIRCLE, 7.3, 0, 0, 0, {0.5, -0.25, 0}, 1, 0, 0};
  for (uint64_t seed = 1; seed < 20; seed++) {
    start(&ball, ball.at, seed);
    start(&cube, at(0.5, 0.5, 0.5), seed);
    start(&square, at(0.5, 0.5, 0), seed);
    start(&disc, disc.at, seed);
  }
}

/* A sphere smaller than the hole between three others touches two of them. */
static void a_start_of_very_unequal_spheres(void **state)
{
  (void)state;
  packing_domain *domain = test_box(20, 20, 20, 0);
  packing_front_class classes[2] = {{2.0, 3}, {0.1, 1}};
  packing_particles *store = test_store(3);
  packing_front_def def = front_paper();
  def.classes = classes;
  def.class_count = 2;
  const packing_placer_report report = front_pack(&def, domain, NULL, store);
  assert_int_equal(report.state, PACKING_PLACER_DONE);
  assert_int_equal(report.placed, 4);
  assert_int_equal(front_contacts(domain, store), 5);
  packing_particles_destroy(store);
  packing_domain_destroy(domain);
}

static size_t at_walls(packing_domain *domain, packing_particles *store)
{
  size_t touching = 0;
  for (size_t i = 0; i < packing_particles_count(store); i++)
    touching += front_wall_gap(domain, store, i) <= 1e-10;
  return touching;
}

/* Each particle after the start touches dim others: 3 N - 6 contacts in space, 2 N - 3 in the
 * plane; mean coordination 6 - 12 / N and 4 - 6 / N. No wall is touched, but where the youngest are
 * taken first in the narrow tube (the front of two seeds of three runs out in a corner there, and
 * begins again at the walls). */
static void contacts_follow_the_law(void **state)
{
  (void)state;
  for (size_t k = 0; k < FRONT_ROOMS; k++)
    for (int select = 0; select < 9; select++) {
      packing_domain *domain = scene_make(&front_rooms[k]);
      const size_t dim = (size_t)packing_domain_dim(domain);
      packing_psd *psd = test_uniform(0.7, 1.3);
      packing_particles *store = test_store((int)dim);
      packing_front_def def = front_paper();
      def.select_particle = (packing_front_select)(select / 3);
      def.select_neighbours = (packing_front_select)(select % 3);
      def.seed = 5 + k;
      const packing_placer_report report = front_pack(&def, domain, psd, store);
      assert_int_equal(report.state, PACKING_PLACER_SATURATED);
      assert_true(report.volume_fraction > (dim == 2 ? 0.6 : 0.3));
      assert_int_equal(report.unplaced, 1);
      const size_t n = packing_particles_count(store);
      const int again = has_walls(domain) && at_walls(domain, store) > 0;
      if (!again)
        assert_int_equal(front_contacts(domain, store), dim * n - (dim == 3 ? 6 : 3));
      assert_true(!again || (select >= 6 && front_rooms[k].kind == SCENE_TUBE));
      packing_particles_destroy(store);
      packing_psd_destroy(psd);
      packing_domain_destroy(domain);
    }
}

/* Every contact method gives a pack; the exact ones the same law. */
static void contact_methods(void **state)
{
  (void)state;
  const char *const names[] = {"wrappers", "potential", "binary", "direct"};
  for (int m = 0; m < 4; m++)
    for (int dim = 2; dim <= 3; dim++)
      for (int direction = 0; direction < 2; direction++) {
        packing_domain *domain =
            dim == 2 ? test_rectangle(13, 11, 0) : test_box(8, 7, 6.5, 0);
        packing_psd *psd = test_uniform(0.7, 1.1);
        packing_particles *store = test_store(dim);
        packing_front_def def = front_paper();
        def.contact = packing_contact_method_named(names[m]);
        def.direction = (packing_front_direction)direction;
        const packing_placer_report report = front_pack(&def, domain, psd, store);
        const size_t n = report.placed, d = (size_t)dim;
        const size_t contacts = front_contacts(domain, store);
        assert_true(report.volume_fraction > (dim == 2 ? 0.5 : 0.2));
        if (direction == PACKING_FRONT_OUTWARD && def.contact->exact)
          assert_int_equal(contacts, d * n - (dim == 3 ? 6 : 3));
        if (direction == PACKING_FRONT_OUTWARD) /* each touches one at least */
          assert_true(contacts >= n - 1);
        packing_particles_destroy(store);
        packing_psd_destroy(psd);
        packing_domain_destroy(domain);
      }
}

/* Clusters of two spheres: no overlap, nothing outside, turned, more than the bounding spheres
 * would allow contacts between. */
static void clusters_of_two_spheres(void **state)
{
  (void)state;
  const char *const names[] = {"potential", "binary", "direct"};
  packing_shape *shape = test_cluster(0.6, 1);
  for (int m = 0; m < 3; m++)
    for (int dim = 2; dim <= 3; dim++)
      for (int direction = 0; direction < 2; direction++) {
        packing_domain *domain =
            dim == 2 ? test_rectangle(13, 11, 0) : test_box(6.1, 5.7, 5.3, 0);
        packing_psd *psd = test_uniform(0.7, 1.1);
        packing_particles *store = test_store(dim);
        packing_front_def def = front_paper();
        def.contact = packing_contact_method_named(names[m]);
        def.direction = (packing_front_direction)direction;
        def.shape = shape;
        def.count = 30;
        const packing_placer_report report = front_pack(&def, domain, psd, store);
        assert_true(report.placed > 8);
        packing_view v;
        packing_particles_view(store, &v);
        packing_body body[64];
        double volume = 0;
        for (size_t i = 0; i < report.placed; i++) {
          const double q[4] = {
              ((const double *)v.qw.data)[i], ((const double *)v.qx.data)[i],
              ((const double *)v.qy.data)[i], ((const double *)v.qz.data)[i]};
          const double r = front_radius(store, i);
          assert_near(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-14);
          body[i] = test_cluster_body(shape, front_centre(store, i), r, q);
          volume += packing_shape_volume(shape, r, dim);
          assert_true(packing_body_clearance(&body[i], domain, NULL) >= -1e-12 * r);
          double least = INFINITY;
          for (size_t j = 0; j < i; j++) {
            const double gap = packing_body_gap(&body[i], &body[j]);
            assert_true(gap >= -1e-12 * fmin(r, body[j].r));
            least = fmin(least, gap);
          }
          /* By bisection a touch is short of 2^-40 of the radius. */
          if (direction == PACKING_FRONT_OUTWARD && i > 0)
            assert_true(least <= 1e-11);
        }
        assert_close(report.solid_volume, volume, 1e-13);
        packing_particles_destroy(store);
        packing_psd_destroy(psd);
        packing_domain_destroy(domain);
      }
  packing_shape_destroy(shape);
  assert_int_equal(test_clusters_alive(), 0);
}

/* Count and volume end the run; the volume is met to half a particle. */
static void goals(void **state)
{
  (void)state;
  packing_domain *domain = test_box(20, 20, 20, 0);
  packing_psd *psd = test_uniform(0.7, 1.3);
  for (size_t count = 1; count < 40; count += 1 + count / 3) {
    packing_particles *store = test_store(3);
    packing_front_def def = front_paper();
    def.count = count;
    const packing_placer_report report = front_pack(&def, domain, psd, store);
    assert_int_equal(report.state, PACKING_PLACER_DONE);
    assert_int_equal(report.placed, count);
    assert_int_equal(report.unplaced, 0);
    packing_particles_destroy(store);
  }
  packing_particles *store = test_store(3);
  packing_front_def def = front_paper();
  def.volume_fraction = 0.3;
  const packing_placer_report report = front_pack(&def, domain, psd, store);
  assert_int_equal(report.state, PACKING_PLACER_DONE);
  assert_near(report.solid_volume, 0.3 * 8000, 0.5 * 4.19 * 1.3 * 1.3 * 1.3);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

/* An exact list is placed as it is; what does not fit is counted by class. */
static void exact_lists(void **state)
{
  (void)state;
  const packing_front_class classes[3] = {{1.1, 20}, {0.7, 50}, {0.9, 30}};
  packing_domain *wide = test_box(14, 14, 14, 0), *narrow = test_box(6, 6, 6, 0);
  packing_front_def def = front_paper();
  def.classes = classes;
  def.class_count = 3;
  packing_particles *store = test_store(3);
  assert_ok(packing_particles_add_columns(store, PACKING_COLUMN_COMPONENT));
  assert_int_equal(front_pack(&def, wide, NULL, store).state, PACKING_PLACER_DONE);
  assert_int_equal(packing_particles_count(store), 100);
  packing_view v;
  packing_particles_view(store, &v);
  size_t placed[3] = {0, 0, 0};
  for (size_t i = 0; i < 100; i++) {
    const int32_t c = ((const int32_t *)v.component.data)[i];
    assert_true(front_radius(store, i) == classes[c].r);
    placed[c]++;
  }
  for (int c = 0; c < 3; c++)
    assert_int_equal(placed[c], classes[c].count);
  packing_particles_truncate(store, 0);
  packing_placer *placer = NULL;
  size_t left[3] = {0, 0, 0};
  assert_ok(packing_front_create(NULL, &def, narrow, NULL, store, &placer));
  const packing_placer_report report = test_run(placer);
  assert_int_equal(report.state, PACKING_PLACER_SATURATED);
  assert_ok(packing_front_unplaced(placer, left));
  assert_int_equal(left[0] + left[1] + left[2], 100 - report.placed);
  assert_int_equal(report.unplaced, 100 - report.placed);
  for (int c = 0; c < 3; c++) {
    size_t stands = 0;
    for (size_t i = 0; i < report.placed; i++)
      stands += front_radius(store, i) == classes[c].r;
    assert_int_equal(stands + left[c], classes[c].count);
  }
  packing_placer_destroy(placer);
  packing_particles_destroy(store);
  packing_domain_destroy(wide);
  packing_domain_destroy(narrow);
}

static size_t halves(void *user, const packing_vec3 *centre)
{
  (void)user;
  return centre->x < 12 ? 0 : 1;
}

/* Each centre has a size of its region. */
static void regions(void **state)
{
  (void)state;
  packing_domain *domain = test_box(24, 12, 12, 0);
  packing_domain_box_def half;
  packing_domain_box_def_init(&half);
  half.size = at(12, 12, 12);
  half.corner = at(12, 0, 0);
  packing_domain *right = NULL;
  assert_ok(packing_domain_create_box(NULL, &half, &right));
  packing_psd *coarse = test_uniform(1.1, 1.3), *fine = test_uniform(0.6, 0.7);
  packing_particles *stores[2];
  for (int way = 0; way < 2; way++) {
    const packing_front_region region = {way == 0 ? right : NULL, fine};
    packing_front_def def = front_paper();
    def.regions = &region;
    def.region_count = 1;
    def.choose = way == 0 ? NULL : halves;
    stores[way] = test_store(3);
    front_pack(&def, domain, coarse, stores[way]);
    size_t small = 0, large = 0;
    for (size_t i = 0; i < packing_particles_count(stores[way]); i++) {
      const int is_small = front_radius(stores[way], i) < 1;
      assert_int_equal(is_small, front_centre(stores[way], i).x >= 12);
      *(is_small ? &small : &large) += 1;
    }
    assert_true(small > 300 && large > 80);
    for (def.count = 5; def.count < 60; def.count += 7) { /* and no more than asked for */
      packing_particles *few = test_store(3);
      const packing_placer_report report = front_pack(&def, domain, coarse, few);
      assert_int_equal(report.state, PACKING_PLACER_DONE);
      assert_int_equal(report.placed, def.count);
      packing_particles_destroy(few);
    }
  }
  assert_true(test_hash_particles(stores[0]) == test_hash_particles(stores[1]));
  for (int way = 0; way < 2; way++)
    packing_particles_destroy(stores[way]);
  packing_psd_destroy(coarse);
  packing_psd_destroy(fine);
  packing_domain_destroy(right);
  packing_domain_destroy(domain);
}

/* Particles of the store are obstacles and front: what is placed touches three, and nothing of what
 * stood has moved. */
static void on_what_stands(void **state)
{
  (void)state;
  packing_domain *domain = test_box(16, 16, 16, 0);
  packing_psd *psd = test_uniform(0.7, 1.3);
  for (int many = 0; many < 2; many++) {
    packing_particles *store = test_store(3);
    assert_ok(packing_particles_add(store, at(8, 8, 8), 3.1, NULL));
    if (many)
      assert_ok(packing_particles_add(store, at(3, 3, 3), 1.7, NULL));
    packing_front_def def = front_paper();
    const packing_placer_report report = front_pack(&def, domain, psd, store);
    assert_true(report.placed > 250);
    assert_true(front_radius(store, 0) == 3.1 && front_centre(store, 0).x == 8);
    assert_true(front_contacts(domain, store) > 2 * report.placed);
    packing_particles_destroy(store);
  }
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

/* Containers too small or thin for the start: as many as there is room for, none outside. */
static void where_the_start_has_no_room(void **state)
{
  (void)state;
  const scene rooms[] = {
      {SCENE_CYLINDER, 1.2, 40, 0, 0, {0, 0, 0}, 2, 0, 0},
      {SCENE_CYLINDER, 1.0, 2, 0, 0, {0, 0, 0}, 2, 0, 0},
      {SCENE_BOX, 2, 2, 2, 0, {0, 0, 0}, 2, 0, 0},
      {SCENE_BOX, 2, 2, 2, 0, {0, 0, 0}, 2, 0, 7},
      {SCENE_BOX, 2.1, 2.1, 30, 0, {0, 0, 0}, 2, 0, 3},
      {SCENE_BOX, 30, 30, 2.2, 0, {0, 0, 0}, 2, 0, 0},
      {SCENE_BOX, 3.1, 3.1, 3.1, 0, {0, 0, 0}, 2, 0, 7},
      {SCENE_SPHERE, 2.05, 0, 0, 0, {0, 0, 0}, 2, 0, 0},
      {SCENE_RECTANGLE, 40, 2.1, 0, 0, {0, 0, 0}, 1, 0, 0},
      {SCENE_TUBE, 5, 7.1, 9, 0, {0, 0, 0}, 2, 0, 0},
  };
  const size_t least[] = {12, 1, 1, 1, 8, 100, 1, 2, 14, 40};
  for (size_t k = 0; k < sizeof rooms / sizeof *rooms; k++) {
    packing_domain *domain = scene_make(&rooms[k]);
    packing_psd *psd = test_mono(1);
    packing_particles *store = test_store(packing_domain_dim(domain));
    const packing_front_def def = front_paper();
    const packing_placer_report report = front_pack(&def, domain, psd, store);
    assert_int_equal(report.state, PACKING_PLACER_SATURATED);
    assert_true(report.placed >= least[k]);
    if (k == 3) /* four are drawn, one is placed */
      assert_int_equal(report.placed + report.unplaced, 4);
    packing_particles_destroy(store);
    packing_psd_destroy(psd);
    packing_domain_destroy(domain);
  }
}

/* Where a group has room but the front that it begins soon runs out, because next to nothing touches
 * three and lies inside, the walls are begun with. Without that these hold 3 to 100 particles, the
 * foils less than 4 % of their volume. */
static void a_front_that_runs_out_begins_again_at_the_walls(void **state)
{
  (void)state;
  const scene rooms[] = {{SCENE_TUBE, 2, 4, 8, 0, {0, 0, 0}, 2, 0, 0},
                         {SCENE_BOX, 14, 14, 2.4, 0, {0, 0, 0}, 2, 0, 0},
                         {SCENE_RECTANGLE, 20, 2.4, 0, 0, {0, 0, 0}, 1, 0, 0}};
  for (size_t k = 0; k < sizeof rooms / sizeof *rooms; k++)
    for (int select = 0; select < 3; select++)
      for (uint64_t seed = 1; seed <= 4; seed++) {
        packing_domain *domain = scene_make(&rooms[k]);
        packing_psd *psd = test_uniform(0.4, 0.6);
        packing_particles *store = test_store(packing_domain_dim(domain));
        packing_front_def def = front_paper();
        def.seed = seed;
        def.select_particle = def.select_neighbours = (packing_front_select)select;
        const packing_placer_report report = front_pack(&def, domain, psd, store);
        assert_int_equal(report.state, PACKING_PLACER_SATURATED);
        assert_true(report.volume_fraction > 0.3);
        packing_particles_destroy(store);
        packing_psd_destroy(psd);
        packing_domain_destroy(domain);
      }
}

/* Chambers that the front cannot get to: a group in each, 3 N - 6 contacts for each. */
static void each_chamber_begins_with_a_group(void **state)
{
  (void)state;
  for (int dim = 2; dim <= 3; dim++)
    for (int chambers = 1; chambers <= 4; chambers++) {
      packing_domain *domain = NULL;
      for (int c = 0; c < chambers; c++) {
        packing_domain *one = dim == 2 ? solid_rectangle(17, 15, 20 * c, 3)
                                       : solid_box(9, 8, 10, 12 * c, 1, -5);
        domain = domain == NULL ? one : solid_of(PACKING_UNION, domain, one);
      }
      packing_psd *psd = test_uniform(0.7, 1.1);
      packing_particles *store = test_store(dim);
      const packing_front_def def = front_paper();
      const packing_placer_report report = front_pack(&def, domain, psd, store);
      const size_t n = report.placed, d = (size_t)dim, groups = (size_t)chambers;
      assert_int_equal(report.state, PACKING_PLACER_SATURATED);
      assert_int_equal(front_contacts(domain, store),
                       d * n - groups * (dim == 3 ? 6 : 3));
      assert_int_equal(at_walls(domain, store), 0);
      for (int c = 0; c < chambers; c++) {
        size_t here = 0;
        for (size_t i = 0; i < n; i++)
          here += floor(front_centre(store, i).x / (dim == 2 ? 20 : 12)) == c;
        assert_true(here > (dim == 2 ? 45 : 60));
      }
      packing_particles_destroy(store);
      packing_psd_destroy(psd);
      packing_domain_destroy(domain);
    }
}

/* Two chambers, x < 14 and x > 20; a sphere stands in the first, where the innermost point is, and
 * leaves room for nothing of radius 1.92. */
static packing_domain *obstructed(packing_particles *store)
{
  assert_ok(packing_particles_add(store, at(7, 7, 7), 6.9, NULL));
  return solid_of(PACKING_UNION, solid_box(14, 14, 14, 0, 0, 0),
                  solid_box(13, 13, 13, 20, 0, 0));
}

/* The first group of a list has no room, one of it waits for a place, and the second group has room
 * elsewhere: all of the list is placed or told. */
static void a_group_without_room_is_not_lost(void **state)
{
  (void)state;
  for (uint64_t seed = 1; seed < 9; seed++)
    for (size_t count = 10; count < 300; count += 190) {
      const packing_front_class classes[2] = {{2, 2}, {1.95, count - 2}};
      packing_particles *store = test_store(3);
      packing_domain *domain = obstructed(store);
      packing_placer *placer = NULL;
      packing_front_def def = front_paper();
      size_t left[2];
      def.classes = classes;
      def.class_count = 2;
      def.seed = seed;
      assert_ok(packing_front_create(NULL, &def, domain, NULL, store, &placer));
      const packing_placer_report report = test_run(placer);
      assert_ok(packing_front_unplaced(placer, left));
      assert_int_equal(report.placed + left[0] + left[1], count);
      assert_int_equal(report.placed + report.unplaced, count);
      assert_int_equal(report.state,
                       count == 10 ? PACKING_PLACER_DONE : PACKING_PLACER_SATURATED);
      assert_true(report.placed >= 10 && report.placed < 50);
      assert_int_equal(front_contacts(domain, store), 3 * report.placed - 6);
      packing_placer_destroy(placer);
      packing_particles_destroy(store);
      packing_domain_destroy(domain);
    }
}

static size_t chamber(void *user, const packing_vec3 *centre)
{
  (void)user;
  return centre->x < 17 ? 0 : 1;
}

/* What waits in a region without room does not keep a group from another region. */
static void each_region_begins_with_a_group_of_its_own(void **state)
{
  (void)state;
  packing_psd *coarse = test_mono(2), *fine = test_mono(1.5);
  const packing_front_region region = {NULL, fine};
  for (uint64_t seed = 1; seed < 5; seed++) {
    packing_particles *store = test_store(3);
    packing_domain *domain = obstructed(store);
    packing_front_def def = front_paper();
    def.regions = &region;
    def.region_count = 1;
    def.choose = chamber;
    def.seed = seed;
    const packing_placer_report report = front_pack(&def, domain, coarse, store);
    assert_int_equal(report.state, PACKING_PLACER_SATURATED);
    assert_true(report.placed > 30);
    for (size_t i = 1; i <= report.placed; i++)
      assert_true(front_centre(store, i).x > 20 && front_radius(store, i) == 1.5);
    assert_int_equal(front_contacts(domain, store), 3 * report.placed - 6);
    assert_int_equal(report.unplaced,
                     5); /* four of the first region, one of the second */
    packing_particles_destroy(store);
    packing_domain_destroy(domain);
  }
  packing_psd_destroy(coarse);
  packing_psd_destroy(fine);
}

/* A list whose end comes after the volume asked for: what the goal refused is still there. */
static void a_goal_leaves_the_rest_of_a_list(void **state)
{
  (void)state;
  const packing_front_class classes[2] = {{1.1, 30}, {0.7, 30}};
  packing_domain *domain = test_box(14, 14, 14, 0);
  for (double fraction = 0.0005; fraction < 0.03; fraction *= 1.4)
    for (uint64_t seed = 1; seed < 5; seed++) {
      packing_particles *store = test_store(3);
      packing_placer *placer = NULL;
      packing_front_def def = front_paper();
      size_t left[2];
      def.classes = classes;
      def.class_count = 2;
      def.volume_fraction = fraction;
      def.seed = seed;
      assert_ok(packing_front_create(NULL, &def, domain, NULL, store, &placer));
      const packing_placer_report report = test_run(placer);
      assert_int_equal(report.state, PACKING_PLACER_DONE);
      assert_ok(packing_front_unplaced(placer, left));
      assert_int_equal(report.placed + left[0] + left[1], 60);
      packing_placer_destroy(placer);
      packing_particles_destroy(store);
    }
  packing_domain_destroy(domain);
}

/* Sizes up to 20 to 1, no two equal and most of them small: the law holds, and the list is placed to
 * its end. */
static void wide_gradings_follow_the_law(void **state)
{
  (void)state;
  enum { RADII = 1200 };
  static packing_front_class classes[RADII];
  for (int i = 0; i < RADII; i++) {
    const double u = fmod(0.6180339887498949 * (i + 1), 1);
    classes[i] = (packing_front_class){0.1 * pow(20, u * u * u * u), 1};
  }
  for (int dim = 2; dim <= 3; dim++)
    for (int select = 0; select < 3; select++) {
      packing_domain *domain =
          dim == 2 ? test_rectangle(70, 70, 0) : test_box(16, 15, 17, 0);
      packing_particles *store = test_store(dim);
      packing_front_def def = front_paper();
      def.classes = classes;
      def.class_count = RADII;
      def.select_particle = def.select_neighbours = (packing_front_select)select;
      const packing_placer_report report = front_pack(&def, domain, NULL, store);
      assert_int_equal(report.state, PACKING_PLACER_DONE);
      assert_int_equal(report.placed, RADII);
      assert_int_equal(front_contacts(domain, store),
                       (size_t)dim * RADII - (dim == 3 ? 6 : 3));
      packing_particles_destroy(store);
      packing_domain_destroy(domain);
    }
}

/* A particle larger than the container stays pending, and is told. */
static void a_particle_that_cannot_fit(void **state)
{
  (void)state;
  const packing_front_class classes[2] = {{0.5, 10}, {4, 1}};
  packing_domain *domain = test_box(6, 6, 6, 0);
  packing_particles *store = test_store(3);
  packing_placer *placer = NULL;
  packing_front_def def = front_paper();
  size_t left[2];
  def.classes = classes;
  def.class_count = 2;
  assert_ok(packing_front_create(NULL, &def, domain, NULL, store, &placer));
  const packing_placer_report report = test_run(placer);
  assert_int_equal(report.state, PACKING_PLACER_SATURATED);
  assert_ok(packing_front_unplaced(placer, left));
  assert_int_equal(left[1], 1);
  assert_int_equal(left[0] + report.placed, 10);
  packing_placer_destroy(placer);
  packing_particles_destroy(store);
  packing_domain_destroy(domain);
}

/* Radii over three decades, about a large sphere: many neighbours of one particle. */
static void three_decades_of_radii(void **state)
{
  (void)state;
  packing_domain *domain = test_box(4, 4, 4, 0);
  packing_psd *psd = test_uniform(0.001, 0.0011);
  for (int select = 0; select < 2; select++) {
    packing_particles *store = test_store(3);
    packing_front_def def = front_paper();
    assert_ok(packing_particles_add(store, at(2, 2, 2), 1, NULL));
    assert_ok(packing_particles_add(store, at(2, 2, 3.0011), 0.0011, NULL));
    assert_ok(packing_particles_add(store, at(2.0021, 2, 3.0011), 0.001, NULL));
    def.count = 1500;
    def.select_neighbours = (packing_front_select)select;
    packing_view v;
    packing_audit_report audit;
    packing_placer *placer = NULL;
    packing_audit_report_init(&audit);
    assert_ok(packing_front_create(NULL, &def, domain, psd, store, &placer));
    assert_int_equal(test_run(placer).placed, 1500);
    packing_placer_destroy(placer);
    packing_particles_view(store, &v);
    assert_ok(packing_audit(NULL, NULL, domain, &v, &audit));
    assert_true(audit.max_overlap <= 1e-12 * 5); /* 8 rounding units of the box: 7e-12 */
    packing_particles_destroy(store);
  }
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

/* A container 1e7 radii long: memory goes with the particles. */
static void a_huge_container(void **state)
{
  (void)state;
  test_allocator a = {0};
  packing_context *context = test_allocator_context(&a);
  packing_domain *domain = test_box(1e7, 1e7, 1e7, 0);
  packing_psd *psd = test_uniform(0.7, 1.3);
  packing_particles *store = test_store(3);
  packing_placer *placer = NULL;
  packing_front_def def = front_paper();
  packing_audit_report audit;
  packing_view v;
  def.count = 5000;
  assert_ok(packing_front_create(context, &def, domain, psd, store, &placer));
  const packing_placer_report report = test_run(placer);
  assert_int_equal(report.placed, 5000);
  assert_true(report.attempts < 100000);
  assert_true(a.peak < 3000000);
  packing_placer_destroy(placer);
  packing_particles_view(store, &v);
  packing_audit_report_init(&audit);
  assert_ok(packing_audit(NULL, NULL, domain, &v, &audit));
  assert_true(audit.max_overlap <= 8 * 0x1p-52 * 1e7);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
  packing_context_destroy(context);
}

/* Between steps the store holds a valid pack, and stopping there is fine. */
static void stopping_between_steps(void **state)
{
  (void)state;
  packing_domain *domain = test_box(60, 60, 60, 0);
  packing_psd *psd = test_uniform(0.7, 1.3);
  packing_particles *store = test_store(3);
  packing_placer *placer = NULL;
  packing_front_def def = front_paper();
  packing_placer_report report;
  packing_placer_report_init(&report);
  assert_ok(packing_front_create(NULL, &def, domain, psd, store, &placer));
  double progress = 0;
  for (int k = 0; k < 8; k++) {
    packing_view v;
    packing_audit_report audit;
    packing_audit_report_init(&audit);
    assert_ok(packing_placer_step(placer, 1, &report));
    assert_int_equal(report.state, PACKING_PLACER_RUNNING);
    assert_true(report.progress > progress && report.progress < 1);
    progress = report.progress;
    packing_particles_view(store, &v);
    assert_int_equal(v.count, report.placed);
    assert_ok(packing_audit(NULL, NULL, domain, &v, &audit));
    assert_true(audit.passed);
  }
  packing_placer_destroy(placer);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_disc_without_room_is_dropped_and_the_next_takes_the_pending),
      cmocka_unit_test(the_start_touches_itself_at_the_innermost_point),
      cmocka_unit_test(a_start_of_very_unequal_spheres),
      cmocka_unit_test(contacts_follow_the_law),
      cmocka_unit_test(contact_methods),
      cmocka_unit_test(clusters_of_two_spheres),
      cmocka_unit_test(goals),
      cmocka_unit_test(exact_lists),
      cmocka_unit_test(regions),
      cmocka_unit_test(on_what_stands),
      cmocka_unit_test(where_the_start_has_no_room),
      cmocka_unit_test(a_front_that_runs_out_begins_again_at_the_walls),
      cmocka_unit_test(each_chamber_begins_with_a_group),
      cmocka_unit_test(a_group_without_room_is_not_lost),
      cmocka_unit_test(each_region_begins_with_a_group_of_its_own),
      cmocka_unit_test(a_goal_leaves_the_rest_of_a_list),
      cmocka_unit_test(wide_gradings_follow_the_law),
      cmocka_unit_test(a_particle_that_cannot_fit),
      cmocka_unit_test(three_decades_of_radii),
      cmocka_unit_test(a_huge_container),
      cmocka_unit_test(stopping_between_steps),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
