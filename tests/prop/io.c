/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Any pack comes back from CSV with the same bits, however the bytes are cut; a power of two
 * on all lengths is one on all that is written and read. */
#include "test.h"

static uint64_t next_bits(uint64_t *state)
{
  *state ^= *state >> 12;
  *state ^= *state << 25;
  *state ^= *state >> 27;
  return *state * UINT64_C(2685821657736338717);
}

/* A finite number of any size, some of them 0, -0 and denormals. */
static double any_number(uint64_t *state)
{
  uint64_t bits = next_bits(state);
  double v;
  switch (next_bits(state) >> 61) {
  case 0:
    return bits >> 63 != 0 ? -0.0 : 0.0;
  case 1:
    bits &= ~(UINT64_C(0x7ff) << 52); /* denormal */
    break;
  default:
    break;
  }
  memcpy(&v, &bits, sizeof v);
  return isfinite(v) ? v : 2.385;
}

enum { REALS = 13, MOST = 3000 }; /* x y z vx vy vz wx wy wz qw qx qy qz */

typedef struct pack {
  double real[REALS][MOST], r[MOST];
  int64_t id[MOST];
  int32_t type[MOST], component[MOST];
  packing_view view;
} pack;

static packing_column doubles(const double *data)
{
  const packing_column c = {data, sizeof *data};
  return c;
}

/* A pack with the optional columns of `columns`. */
static void fill(pack *p, size_t count, unsigned columns, uint64_t *state)
{
  packing_view *v = &p->view;
  for (size_t i = 0; i < count; i++) {
    for (int k = 0; k < REALS; k++)
      p->real[k][i] = any_number(state);
    do
      p->r[i] = fabs(any_number(state));
    while (p->r[i] == 0);
    p->id[i] = (int64_t)next_bits(state);
    p->type[i] = (int32_t)(next_bits(state) >> 32);
    p->component[i] = (int32_t)(next_bits(state) >> 40);
  }
  packing_view_init_arrays(v, count, p->real[0], p->real[1], p->real[2], p->r);
  if (columns & PACKING_COLUMN_ID) {
    v->id.data = p->id;
    v->id.stride = sizeof p->id[0];
  }
  if (columns & PACKING_COLUMN_TYPE) {
    v->type.data = p->type;
    v->type.stride = sizeof p->type[0];
  }
  if (columns & PACKING_COLUMN_COMPONENT) {
    v->component.data = p->component;
    v->component.stride = sizeof p->component[0];
  }
  packing_column *const optional[] = {&v->vx, &v->vy, &v->vz, &v->wx, &v->wy,
                                      &v->wz, &v->qw, &v->qx, &v->qy, &v->qz};
  for (int k = 0; k < REALS - 3; k++)
    if (columns & (k < 3   ? PACKING_COLUMN_VELOCITY
                   : k < 6 ? PACKING_COLUMN_SPIN
                           : PACKING_COLUMN_ORIENTATION))
      *optional[k] = doubles(p->real[k + 3]);
}

static void assert_same_column(packing_column a, packing_column b, size_t size,
                               size_t count)
{
  assert_int_equal(a.data == NULL, b.data == NULL);
  for (size_t i = 0; a.data != NULL && i < count; i++)
    assert_memory_equal((const char *)a.data + i * a.stride,
                        (const char *)b.data + i * b.stride, size);
}

static void assert_same(const packing_view *a, const packing_view *b)
{
  const packing_column *const from = &a->x, *const to = &b->x;
  const packing_column *const end = &a->qz + 1;
  assert_int_equal(a->count, b->count);
  for (ptrdiff_t c = 0; from + c < end; c++)
    assert_same_column(from[c], to[c],
                       &from[c] == &a->type || &from[c] == &a->component ? sizeof(int32_t)
                                                                         : sizeof(double),
                       a->count);
}

static void any_pack_comes_back(void **state)
{
  (void)state;
  pack *p = malloc(sizeof *p);
  uint64_t stream_of_bits = 31415926;
  assert_non_null(p);
  for (int round = 0; round < 128; round++) {
    /* batches of the reader hold 1024 rows: around one and two of them too */
    const size_t count =
        round % 4 == 0 ? (size_t)(1023 + round / 4 % 3) * (size_t)(1 + round % 8 / 4)
                       : (size_t)round % 50;
    test_buffer buffer = {0};
    const packing_stream stream = test_buffer_stream(&buffer);
    packing_particles *particles = test_store(3);
    packing_view back;
    fill(p, count, (unsigned)round % 64, &stream_of_bits);
    assert_ok(packing_write_csv(NULL, NULL, &p->view, &stream));
    buffer.chunk = count < 60 ? (size_t)round % 5 : 0;
    assert_ok(packing_read_csv(NULL, &stream, particles));
    packing_particles_view(particles, &back);
    assert_int_equal(packing_particles_columns(particles), round % 64);
    if (count > 0)
      assert_same(&p->view, &back);
    else
      assert_int_equal(back.count, 0);
    packing_particles_destroy(particles);
    test_buffer_free(&buffer);
  }
  free(p);
}

/* Bytes do not depend on how the host's arrays are laid out. */
static void strides_do_not_show(void **state)
{
  (void)state;
  struct {
    double r, pad, z, y, x;
  } rows[50];
  double x[50], y[50], z[50], r[50];
  uint64_t bits = 7;
  packing_view a, b;
  test_buffer first = {0}, second = {0};
  const packing_stream to_first = test_buffer_stream(&first),
                       to_second = test_buffer_stream(&second);
  for (int i = 0; i < 50; i++) {
    rows[i].x = x[i] = any_number(&bits);
    rows[i].y = y[i] = any_number(&bits);
    rows[i].z = z[i] = any_number(&bits);
    rows[i].r = r[i] = 1 + i;
  }
  packing_view_init_arrays(&a, 50, x, y, z, r);
  packing_view_init_arrays(&b, 50, &rows[0].x, &rows[0].y, &rows[0].z, &rows[0].r);
  b.x.stride = b.y.stride = b.z.stride = b.r.stride = sizeof rows[0];
  assert_ok(packing_write_csv(NULL, NULL, &a, &to_first));
  assert_ok(packing_write_csv(NULL, NULL, &b, &to_second));
  assert_ok(packing_write_vtp(NULL, NULL, &a, &to_first));
  assert_ok(packing_write_vtp(NULL, NULL, &b, &to_second));
  assert_int_equal(first.size, second.size);
  assert_memory_equal(first.data, second.data, first.size);
  test_buffer_free(&first);
  test_buffer_free(&second);
}

/* The automatic box of LAMMPS and extended XYZ: scaling by 2^10 scales each number in it. */
static void boxes_scale_bit_for_bit(void **state)
{
  (void)state;
  double at[40], r[40];
  uint64_t bits = 99;
  for (int i = 0; i < 40; i++) {
    at[i] = ldexp((double)(next_bits(&bits) >> 11), -53) - 0.5;
    r[i] = ldexp((double)((next_bits(&bits) >> 11) + 1), -58);
  }
  double sides[2][3];
  for (int round = 0; round < 2; round++) {
    packing_view view;
    test_buffer buffer = {0};
    const packing_stream stream = test_buffer_stream(&buffer);
    packing_view_init_arrays(&view, 40, at, at, at, r);
    assert_ok(packing_write_lammps(NULL, NULL, &view, &stream));
    const char *line = strstr(buffer.data, "atom types\n\n") + 12;
    assert_int_equal(sscanf(line, "%lf %lf xlo", &sides[round][0], &sides[round][1]), 2);
    test_buffer_free(&buffer);
    test_buffer second = {0};
    const packing_stream to_second = test_buffer_stream(&second);
    assert_ok(packing_write_xyz(NULL, NULL, &view, &to_second));
    assert_int_equal(
        sscanf(strstr(second.data, "Lattice"), "Lattice=\"%lf", &sides[round][2]), 1);
    test_buffer_free(&second);
    for (int i = 0; i < 40; i++) {
      at[i] *= 1024;
      r[i] *= 1024;
    }
  }
  for (int k = 0; k < 3; k++)
    assert_true(sides[1][k] == 1024 * sides[0][k]);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(any_pack_comes_back),
      cmocka_unit_test(strides_do_not_show),
      cmocka_unit_test(boxes_scale_bit_for_bit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
