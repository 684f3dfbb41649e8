/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The readers of packs with every allocation failing in turn, over the samples of tests/data. */
#include "reading.h"

static struct {
  const char *format, *name;
  int sort, zlib;
} const samples[] = {
    {"lammps", "lammps_sphere.data", 1, 0},
    {"lammps", "lammps_hybrid.data", 0, 0},
    {"lammps", "lammps_sphere.data.gz", 0, 1},
    {"dump", "lammps.dump", 1, 0},
    {"yade", "yade_id.txt", 1, 0},
    {"yade-pack", "yade_periodic.txt", 0, 0},
    {"geo", "gengeo.geo", 1, 0},
    {"xyz", "ase.xyz", 1, 0},
    {"xyzd", "packing.xyzd", 0, 0},
    {"vtp", "vtk_binary_zlib.vtp", 1, 1},
    {"vtu", "vtk_ascii.vtu", 0, 0},
    {"vtu", "vtk_base64.vtu", 0, 0},
    {"vtu", "gengeo.vtu", 0, 0},
};

static size_t at; /* of samples */

static packing_status scenario(packing_context *context, uint64_t *hash)
{
  packing_particles *particles = NULL;
  packing_bonds *bonds = NULL;
  packing_read_def def;
  test_buffer buffer = {0};
  buffer.data = (char *)reading_file(TEST_DATA, samples[at].name, &buffer.size);
  const packing_stream stream = test_buffer_stream(&buffer);
  packing_read_def_init(&def);
  def.sort = samples[at].sort;
  packing_status status = packing_particles_create(context, NULL, &particles);
  if (status == PACKING_OK)
    status = packing_bonds_create(context, &bonds);
  def.bonds = bonds;
  if (status == PACKING_OK)
    status =
        packing_read_pack(context, &def, samples[at].format, &stream, particles, NULL);
  if (status == PACKING_OK) {
    *hash = test_hash_particles(particles);
    for (size_t b = 0; b < packing_bonds_count(bonds); b++) {
      const packing_bond *bond = &packing_bonds_data(bonds)[b];
      *hash = test_hash(*hash, &bond->i, sizeof bond->i);
      *hash = test_hash(*hash, &bond->j, sizeof bond->j);
    }
  } else if (bonds != NULL) {
    assert_int_equal(packing_particles_count(particles), 0);
    assert_int_equal(packing_bonds_count(bonds), 0);
  }
  packing_bonds_destroy(bonds);
  packing_particles_destroy(particles);
  test_buffer_free(&buffer);
  return status;
}

static void readers(void **state)
{
  (void)state;
  for (at = 0; at < sizeof samples / sizeof samples[0]; at++)
    if (PACKING_I_HAVE_ZLIB || !samples[at].zlib)
      assert_true(test_every_allocation(scenario) >= 4);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(readers)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
