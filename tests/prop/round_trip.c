/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Any pack comes back from each format that is written and read, with the bits that the format
 * holds; its lengths times a power of two come back times that. */
#include "reading.h"

enum { MOST = 700 };

typedef struct pack {
  double x[MOST], y[MOST], z[MOST], r[MOST], v[3][MOST], w[3][MOST];
  int64_t id[MOST];
  int32_t type[MOST];
  packing_bond bonds[MOST];
  packing_view view;
} pack;

static uint64_t next_bits(uint64_t *state)
{
  *state ^= *state >> 12;
  *state ^= *state << 25;
  *state ^= *state >> 27;
  return *state * UINT64_C(2685821657736338717);
}

/* In (0, 1), all bits drawn. */
static double next_real(uint64_t *state)
{
  return ldexp((double)((next_bits(state) >> 11) | 1), -53);
}

static packing_column doubles(const double *data)
{
  const packing_column c = {data, sizeof *data};
  return c;
}

static void fill(pack *p, size_t count, double scale, uint64_t seed)
{
  packing_view *v = &p->view;
  for (size_t i = 0; i < count; i++) {
    p->x[i] = (next_real(&seed) - 0.5) * scale;
    p->y[i] = next_real(&seed) * scale;
    p->z[i] = (next_real(&seed) * 1e-3 + 5) * scale;
    p->r[i] = next_real(&seed) * 0.25 * scale;
    for (int k = 0; k < 3; k++) {
      p->v[k][i] = next_real(&seed) - 0.5;
      p->w[k][i] = (next_real(&seed) - 0.5) * 1e6;
    }
    /* each once, out of order, with gaps */
    p->id[i] = (int64_t)((i * 331) % MOST) * 3 + 1;
    p->type[i] = 1 + (int32_t)(i % 3);
    p->bonds[i].i = i;
    p->bonds[i].j = (i + 1) % count;
    p->bonds[i].type = 1 + (int32_t)(i % 2);
  }
  packing_view_init_arrays(v, count, p->x, p->y, p->z, p->r);
  v->id.data = p->id;
  v->id.stride = sizeof p->id[0];
  v->type.data = p->type;
  v->type.stride = sizeof p->type[0];
  v->vx = doubles(p->v[0]);
  v->vy = doubles(p->v[1]);
  v->vz = doubles(p->v[2]);
  v->wx = doubles(p->w[0]);
  v->wy = doubles(p->w[1]);
  v->wz = doubles(p->w[2]);
}

/* What of a pack a format brings back. */
typedef struct kept {
  const char *format;
  int ids, types, motion, bonds, compression;
} kept;

static const kept formats[] = {
    {"csv", 1, 1, 1, 0, 0},    {"vtp", 1, 1, 1, 0, 0},       {"vtp", 1, 1, 1, 0, 6},
    {"vtu", 1, 1, 1, 0, 0},    {"vtu", 1, 1, 1, 0, 6},       {"lammps", 1, 1, 1, 0, 0},
    {"lammps", 1, 1, 1, 1, 0}, {"liggghts", 1, 1, 1, 0, 0},  {"dump", 1, 1, 1, 0, 0},
    {"yade", 0, 0, 0, 0, 0},   {"yade-pack", 0, 0, 0, 0, 0}, {"geo", 1, 1, 0, 1, 0},
    {"xyz", 1, 1, 1, 0, 0},
};

static void assert_same(const kept *k, const pack *p, const reading *r, double scale)
{
  packing_view v;
  packing_particles_view(r->particles, &v);
  assert_int_equal(v.count, p->view.count);
  for (size_t i = 0; i < v.count; i++) {
    reading_is(r, i, p->x[i] * scale, p->y[i] * scale, p->z[i] * scale, p->r[i] * scale);
    if (k->ids)
      assert_int_equal(reading_id(r, i), p->id[i]);
    if (k->types)
      assert_int_equal(reading_type(r, i), p->type[i]);
    if (k->motion)
      assert_true(
          reading_at(&v.vx, i) == p->v[0][i] && reading_at(&v.vy, i) == p->v[1][i] &&
          reading_at(&v.vz, i) == p->v[2][i] && reading_at(&v.wx, i) == p->w[0][i] &&
          reading_at(&v.wy, i) == p->w[1][i] && reading_at(&v.wz, i) == p->w[2][i]);
  }
  assert_int_equal(r->info.bonds, k->bonds ? v.count : 0);
  for (size_t b = 0; b < r->info.bonds; b++) {
    const packing_bond *bond = &packing_bonds_data(r->bonds)[b];
    assert_true(bond->i == p->bonds[b].i && bond->j == p->bonds[b].j);
    assert_int_equal(bond->type, p->bonds[b].type);
  }
}

static void come_back(const kept *k, const pack *p, double scale)
{
  pack *scaled = malloc(sizeof *scaled);
  test_buffer buffer = {0};
  const packing_stream stream = test_buffer_stream(&buffer);
  packing_write_def def;
  reading r = reading_begin(NULL, 3);
  assert_non_null(scaled);
  packing_write_def_init(&def);
  def.compression = k->compression;
  def.bonds = k->bonds ? p->bonds : NULL;
  def.bond_count = k->bonds ? p->view.count : 0;
  fill(scaled, p->view.count, scale, 4711);
  const packing_status written =
      packing_write_pack(NULL, &def, k->format, &scaled->view, &stream);
  if (written != PACKING_OK && !(written == PACKING_ERR_UNSUPPORTED && k->compression))
    fail_msg("%s: %s", k->format, packing_status_string(written));
  if (written == PACKING_OK) {
    const packing_status status =
        packing_read_pack(NULL, &r.def, k->format, &stream, r.particles, &r.info);
    if (status != PACKING_OK)
      fail_msg("%s: %s", k->format, packing_status_string(status));
    assert_same(k, p, &r, scale);
  }
  reading_end(&r);
  test_buffer_free(&buffer);
  free(scaled);
}

static void packs_come_back(void **state)
{
  (void)state;
  pack *p = malloc(sizeof *p);
  assert_non_null(p);
  for (size_t k = 0; k < sizeof formats / sizeof formats[0]; k++) {
    fill(p, MOST, 1, 4711);
    come_back(&formats[k], p, 1);
    come_back(&formats[k], p, 1024);
    come_back(&formats[k], p, 0x1p-300);
  }
  free(p);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(packs_come_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
