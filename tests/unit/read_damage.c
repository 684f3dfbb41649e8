/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Each sample cut short at every byte, and with each byte replaced: it is read, or refused with
 * a reason, the store empty; and never takes more memory than its size accounts for. */
#include "reading.h"

static const struct {
  const char *format, *name;
} samples[] = {
    {"lammps", "lammps_sphere.data"},
    {"lammps", "lammps_hybrid.data"},
    {"lammps", "lammps_sphere.data.gz"},
    {"dump", "lammps_triclinic.dump"},
    {"dump", "liggghts.dump"},
    {"yade", "yade_id.txt"},
    {"yade-pack", "yade_periodic.txt"},
    {"geo", "gengeo.geo"},
    {"xyz", "ase.xyz"},
    {"xyzd", "packing.xyzd"},
    {"vtp", "vtk_binary_zlib.vtp"},
    {"vtu", "vtk_raw_zlib.vtu"},
    {"vtu", "vtk_base64.vtu"},
    {"vtu", "vtk_ascii.vtu"},
};

enum { SAMPLES = sizeof samples / sizeof samples[0], MOST_MEMORY = 1 << 20 };

static void try_bytes(packing_context *c, test_allocator *memory, const char *format,
                      const unsigned char *data, size_t size)
{
  reading r = reading_begin(c, 3);
  memory->peak = memory->bytes;
  const packing_status status = reading_bytes(&r, format, data, size, 0);
  assert_true(memory->peak < MOST_MEMORY);
  if (status == PACKING_OK) {
    assert_int_equal(packing_particles_count(r.particles), r.info.particles);
    assert_int_equal(packing_bonds_count(r.bonds), r.info.bonds);
  } else {
    assert_true(status == PACKING_ERR_FORMAT || status == PACKING_ERR_UNSUPPORTED);
    assert_int_equal(packing_particles_count(r.particles), 0);
    assert_int_equal(packing_bonds_count(r.bonds), 0);
    assert_true(strlen(packing_context_message(c)) > 5);
    assert_null(strchr(packing_context_message(c), '\n'));
  }
  reading_end(&r);
}

static void cut_short(void **state)
{
  (void)state;
  for (size_t k = 0; k < SAMPLES; k++) {
    test_allocator memory = {0};
    packing_context *c = test_allocator_context(&memory);
    size_t size;
    unsigned char *data = reading_file(TEST_DATA, samples[k].name, &size);
    const size_t step = 1 + size / 400;
    for (size_t cut = 0; cut <= size; cut += step)
      try_bytes(c, &memory, samples[k].format, data, cut);
    free(data);
    packing_context_destroy(c);
  }
}

static void bytes_replaced(void **state)
{
  (void)state;
  static const unsigned char others[] = {0, ' ', '\n', '9', '-', '<', '"', 0xff};
  for (size_t k = 0; k < SAMPLES; k++) {
    test_allocator memory = {0};
    packing_context *c = test_allocator_context(&memory);
    size_t size;
    unsigned char *data = reading_file(TEST_DATA, samples[k].name, &size);
    for (size_t i = 0; i < size; i += 1 + size / 600) {
      const unsigned char kept = data[i];
      data[i] = others[(i + k) % sizeof others];
      try_bytes(c, &memory, samples[k].format, data, size);
      data[i] = kept;
    }
    free(data);
    packing_context_destroy(c);
  }
}

/* Any file through any reader. */
static void taken_for_another(void **state)
{
  (void)state;
  test_allocator memory = {0};
  packing_context *c = test_allocator_context(&memory);
  for (size_t k = 0; k < SAMPLES; k++) {
    size_t size;
    unsigned char *data = reading_file(TEST_DATA, samples[k].name, &size);
    for (size_t f = 0; packing_read_format(f) != NULL; f++)
      try_bytes(c, &memory, packing_read_format(f), data, size);
    free(data);
  }
  packing_context_destroy(c);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cut_short),
      cmocka_unit_test(bytes_replaced),
      cmocka_unit_test(taken_for_another),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
