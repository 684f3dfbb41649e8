/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parts of the front's paper mode against slow obvious twins: places on rings, what stands near
 * a point, lists of members. */
#include "test.h"

#include "place/front_paper.h"

static packing_vec3 random_in(packing_rng *rng, double half)
{
  packing_vec3 p;
  p.x = half * (2 * packing_rng_uniform(rng) - 1);
  p.y = half * (2 * packing_rng_uniform(rng) - 1);
  p.z = half * (2 * packing_rng_uniform(rng) - 1);
  return p;
}

enum { MOST = 24 };

/* Spheres round a first one of radius 1 at the origin, none of which overlap. */
static size_t spheres(packing_rng *rng, int dim, packing_vec3 *p, double *r)
{
  size_t count = 0;
  for (int tries = 0; tries < 400 && count < MOST; tries++) {
    packing_vec3 q = random_in(rng, 3.5);
    const double size = 0.5 + packing_rng_uniform(rng);
    if (dim == 2)
      q.z = 0;
    int apart = packing_i_norm(q) >= 1 + size && packing_i_norm(q) < 1 + size + 1.6;
    for (size_t l = 0; l < count && apart; l++)
      apart = packing_i_norm(packing_i_sub(q, p[l])) >= size + r[l];
    if (apart) {
      p[count] = q;
      r[count++] = size;
    }
  }
  return count;
}

static int is_free(const packing_vec3 *p, const double *r, size_t count, packing_vec3 c,
                   double size)
{
  for (size_t l = 0; l < count; l++)
    if (packing_i_norm(packing_i_sub(c, p[l])) < size + r[l] - 1e-9)
      return 0;
  return 1;
}

/* The free places in contact with 0, j and k, by the library's contact method. */
static size_t twin(const packing_vec3 *p, const double *r, size_t count, int dim,
                   size_t j, double size)
{
  size_t found = 0;
  for (size_t k = dim == 2 ? j : 0; k < (dim == 2 ? j + 1 : count); k++) {
    if (dim == 3 && k == j)
      continue;
    const packing_vec3 origin = {0, 0, 0};
    packing_contact_task task;
    packing_vec3 c[2];
    packing_contact_task_init(&task);
    task.dim = dim;
    task.mobile = packing_body_sphere(origin, size);
    task.fixed[0] = packing_body_sphere(origin, 1);
    task.fixed[1] = packing_body_sphere(p[j], r[j]);
    task.fixed[2] = packing_body_sphere(p[k], r[k]);
    const int places = packing_contact_place(packing_contact_wrappers(), &task, c);
    for (int n = 0; n < places; n++)
      found += (size_t)is_free(p, r, count, c[n], size);
  }
  return found;
}

static size_t bits(unsigned sides)
{
  return (sides & 1) + (sides >> 1);
}

/* The ends of rings, those hidden left out, are the places that all triples give. */
static void rings_give_the_places_of_all_triples(void **state)
{
  (void)state;
  packing_rng *rng = NULL;
  size_t places = 0;
  assert_ok(packing_rng_create(NULL, 3, PACKING_PURPOSE_USER, 0, &rng));
  for (int pack = 0; pack < 400; pack++) {
    const int dim = 2 + pack % 2;
    const double size = 0.4 + 0.4 * packing_rng_uniform(rng);
    packing_vec3 p[MOST];
    double r[MOST];
    packing_i_ring_body body[MOST];
    packing_i_ring_bound bound[MOST];
    packing_i_ring_end end[MOST];
    const size_t count = spheres(rng, dim, p, r);
    for (size_t l = 0; l < count; l++)
      body[l] = packing_i_ring_body_of(p[l], r[l], size, 1 + size, 1e-13);
    for (size_t j = 0; j < count; j++) {
      packing_i_ring ring = packing_i_ring_flat();
      size_t bounding = 0, found = 0, from = 0;
      const int is_ring = dim == 2 || packing_i_ring_of(&body[j], &ring);
      if (is_ring && packing_i_ring_bounds(&ring, body, count, dim == 2 ? SIZE_MAX : j,
                                           bound, &bounding)) {
        size_t upto = bounding;
        if (dim == 2) {
          while (from < bounding && bound[from].body != j)
            from++;
          upto = from < bounding ? from + 1 : from;
        }
        const size_t ends = packing_i_ring_ends(body, bound, bounding, from, upto, end);
        for (size_t e = 0; e < ends; e++) {
          found += bits(end[e].sides);
          for (unsigned side = 1; side <= 2; side++) {
            if (!(end[e].sides & side))
              continue;
            const packing_i_ring_bound *b = &bound[end[e].bound];
            const packing_i_ring_body *k = &body[b->body];
            packing_vec3 q = packing_i_ring_at(&ring, b, side);
            q = dim == 2 ? packing_i_ring_polish(q, ring.n, 0, k->p, k->a)
                         : packing_i_ring_polish(q, body[j].p, body[j].a, k->p, k->a);
            const packing_vec3 c = packing_i_scale(q, 1 + size);
            assert_near(packing_i_norm(c), 1 + size, 1e-14);
            assert_near(packing_i_norm(packing_i_sub(c, p[b->body])), size + r[b->body],
                        1e-14);
            assert_near(packing_i_norm(packing_i_sub(c, p[j])), size + r[j], 1e-14);
          }
        }
      }
      assert_int_equal(found, twin(p, r, count, dim, j, size));
      places += found;
      for (size_t l = 0; l < count; l++)
        if (l != j && packing_i_ring_hides(&body[l], &body[j]))
          assert_int_equal(found, 0);
    }
  }
  assert_true(places > 1000);
  packing_rng_destroy(rng);
}

/* A particle is closed for another by what stands next to it when no triple has a place; else there
 * is one. */
static void closed_is_without_places(void **state)
{
  (void)state;
  packing_rng *rng = NULL;
  size_t closed_ones = 0, open_ones = 0;
  assert_ok(packing_rng_create(NULL, 5, PACKING_PURPOSE_USER, 0, &rng));
  for (int pack = 0; pack < 600; pack++) {
    const int dim = 2 + pack % 2;
    const double size = 2 + 18 * packing_rng_uniform(rng);
    packing_vec3 p[MOST];
    double r[MOST];
    packing_i_index_image image[MOST];
    packing_particles *store = test_store(dim);
    packing_i_paper paper = {0};
    packing_placer placer = {0};
    placer.method = &paper;
    placer.particles = store;
    paper.scan.r = size;
    paper.scan.r_i = 1;
    paper.scan.unit = 1 + size;
    paper.scan.near.at = image;
    const size_t all = spheres(rng, dim, p, r), few = 3 + (size_t)pack % 9;
    const size_t count = all < few ? all : few;
    for (size_t l = 0; l < count; l++)
      image[l] = (packing_i_index_image){p[l], r[l], l};
    paper.scan.near.count = count;
    int closed = -1;
    assert_ok(packing_i_paper_rings_closed(&placer, &closed));
    size_t places = 0;
    for (size_t j = 0; j < count; j++)
      places += twin(p, r, count, dim, j, size);
    assert_int_equal(closed, places == 0);
    *(closed ? &closed_ones : &open_ones) += 1;
    packing_i_free(packing_i_allocator(NULL), paper.scan.rows);
    packing_particles_destroy(store);
  }
  assert_true(closed_ones > 50 && open_ones > 50);
  packing_rng_destroy(rng);
}

/* All images near a point, in cells smaller than the reach too. */
static void near_finds_what_all_images_give(void **state)
{
  (void)state;
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(NULL, 4, PACKING_PURPOSE_USER, 0, &rng));
  for (unsigned periodic = 0; periodic < 8; periodic++)
    for (int size = 0; size < 3; size++) {
      const double l[3] = {2.7 + 6 * size, 3.1 + 2 * size, 2.9 + 3 * size};
      packing_domain *domain = test_box(l[0], l[1], l[2], periodic);
      packing_i_index index;
      packing_i_index_images near = {NULL, 0, 0};
      packing_i_index_init(&index, NULL, domain, 1.2, size == 1 ? 5 : 0);
      packing_vec3 p[60];
      double r[60];
      for (int i = 0; i < 60; i++) {
        p[i] = packing_i_vec(l[0] * packing_rng_uniform(rng),
                             l[1] * packing_rng_uniform(rng),
                             l[2] * packing_rng_uniform(rng));
        r[i] = 1.2 * pow(1e-2, packing_rng_uniform(rng));
        assert_ok(packing_i_index_reserve(&index, 1, r[i]));
        packing_i_index_insert(&index, p[i], r[i]);
      }
      for (int t = 0; t < 40; t++) {
        const packing_vec3 c = p[t];
        const double reach = 2.5 * packing_rng_uniform(rng);
        size_t images = 0;
        for (int i = 0; i < 60; i++)
          for (int a = -3; a <= 3; a++)
            for (int b = -3; b <= 3; b++)
              for (int d = -3; d <= 3; d++) {
                const int cell[3] = {a, b, d};
                int allowed = 1;
                for (int axis = 0; axis < 3; axis++)
                  allowed &= cell[axis] == 0 || (periodic >> axis & 1U);
                const packing_vec3 s =
                    packing_i_vec(p[i].x + a * l[0] - c.x, p[i].y + b * l[1] - c.y,
                                  p[i].z + d * l[2] - c.z);
                images += allowed && packing_i_norm(s) < reach + r[i];
              }
        assert_ok(packing_i_index_near(&index, c, reach, &near));
        assert_int_equal(near.count, images);
        for (size_t k = 0; k < near.count; k++) {
          const packing_vec3 q = packing_i_add(c, near.at[k].p);
          const packing_vec3 s =
              packing_domain_separation(domain, &q, &p[near.at[k].index]);
          assert_near(packing_i_norm(s), 0, 1e-14);
          assert_true(near.at[k].r == r[near.at[k].index]);
        }
      }
      packing_i_free(packing_i_allocator(NULL), near.at);
      packing_i_index_release(&index);
      packing_domain_destroy(domain);
    }
  packing_rng_destroy(rng);
}

/* Members come oldest first, youngest first, or any, each once. */
static void lists_give_members_in_order(void **state)
{
  (void)state;
  for (int select = 0; select < 3; select++) {
    packing_i_front_list list = {.select = (packing_front_select)select};
    packing_i_stream stream;
    packing_i_stream_open(&stream, 1, 2, 3, 4);
    size_t added = 0, taken = 0, last = 0;
    unsigned char seen[2000] = {0};
    while (taken < 2000) {
      for (int k = 0; k < 3 && added < 2000; k++) {
        assert_ok(packing_i_front_list_reserve(&list, NULL, 1));
        packing_i_front_list_add(&list, added++);
      }
      const size_t at = packing_i_front_list_select(&list, &stream);
      const size_t member = list.member[at];
      if (select == PACKING_FRONT_FIFO)
        assert_int_equal(member, taken);
      if (select == PACKING_FRONT_LIFO && added < 2000)
        assert_int_equal(member, added - 1);
      if (select == PACKING_FRONT_LIFO && added == 2000 && taken > 700)
        assert_true(member < last);
      last = member;
      assert_int_equal(seen[member]++, 0);
      packing_i_front_list_drop(&list, at);
      taken++;
      assert_int_equal(packing_i_front_list_count(&list), added - taken);
    }
    packing_i_free(packing_i_allocator(NULL), list.member);
  }
}

/* Directions and rotations are uniform: mean and second moments to 4.5 standard errors of 20000 draws
 * (each of 9 fails by chance with 7e-6). */
static void directions_are_uniform(void **state)
{
  (void)state;
  packing_i_stream stream;
  packing_i_stream_open(&stream, 9, 9, 9, 9);
  double mean[3] = {0, 0, 0}, square[3] = {0, 0, 0}, q2[4] = {0, 0, 0, 0};
  const int draws = 20000;
  for (int i = 0; i < draws; i++) {
    const packing_vec3 d = packing_i_front_direction(&stream, 3);
    double q[4];
    const double v[3] = {d.x, d.y, d.z};
    assert_near(packing_i_norm(d), 1, 1e-14);
    packing_i_front_turn(&stream, 3, q);
    assert_near(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-14);
    for (int k = 0; k < 3; k++) {
      mean[k] += v[k] / draws;
      square[k] += v[k] * v[k] / draws;
    }
    for (int k = 0; k < 4; k++)
      q2[k] += q[k] * q[k] / draws;
  }
  for (int k = 0; k < 3; k++) {
    assert_near(mean[k], 0, 4.5 * sqrt(1.0 / 3 / draws));
    assert_near(square[k], 1.0 / 3, 4.5 * sqrt(4.0 / 45 / draws));
  }
  for (int k = 0; k < 4; k++) /* var of x^2 on the 3-sphere: 1/8 - 1/16 */
    assert_near(q2[k], 0.25, 4.5 * sqrt(1.0 / 16 / draws));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rings_give_the_places_of_all_triples),
      cmocka_unit_test(closed_is_without_places),
      cmocka_unit_test(near_finds_what_all_images_give),
      cmocka_unit_test(lists_give_members_in_order),
      cmocka_unit_test(directions_are_uniform),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
