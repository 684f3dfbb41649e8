/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Short constructors, hashes and the slow obvious overlap check. */
#include "test.h"

packing_context *test_context(int threads, packing_isa isa)
{
  packing_context_def def;
  packing_context *context = NULL;
  packing_context_def_init(&def);
  def.threads = threads;
  def.isa = isa;
  assert_ok(packing_context_create(&def, &context));
  return context;
}

packing_context *test_team(size_t team)
{
  static const struct {
    int threads;
    packing_isa isa;
  } teams[TEST_TEAMS] = {{2, PACKING_ISA_BASELINE}, {2, PACKING_ISA_AVX2},
                         {2, PACKING_ISA_AVX512},   {1, PACKING_ISA_AVX512},
                         {3, PACKING_ISA_AVX2},     {4, PACKING_ISA_AVX512},
                         {8, PACKING_ISA_BASELINE}};
  packing_isa isa = teams[team].isa;
  while (!packing_isa_available(isa))
    isa = (packing_isa)((int)isa - 1);
  return test_context(teams[team].threads, isa);
}

uint64_t test_hash(uint64_t hash, const void *data, size_t size)
{
  const unsigned char *bytes = data;
  for (size_t i = 0; i < size; i++)
    hash = (hash ^ bytes[i]) * UINT64_C(1099511628211);
  return hash;
}

uint64_t test_hash_particles(const packing_particles *particles)
{
  packing_view v;
  packing_particles_view(particles, &v);
  uint64_t hash = test_hash(TEST_HASH_START, &v.count, sizeof v.count);
  const packing_column columns[] = {v.x, v.y, v.z, v.r};
  for (size_t c = 0; c < 4; c++)
    for (size_t i = 0; i < v.count; i++)
      hash = test_hash(hash, (const char *)columns[c].data + i * columns[c].stride,
                       sizeof(double));
  return hash;
}

packing_domain *test_box(double lx, double ly, double lz, unsigned periodic)
{
  packing_domain_box_def def;
  packing_domain *domain = NULL;
  packing_domain_box_def_init(&def);
  def.size.x = lx;
  def.size.y = ly;
  def.size.z = lz;
  def.periodic = periodic;
  assert_ok(packing_domain_create_box(NULL, &def, &domain));
  return domain;
}

packing_domain *test_rectangle(double lx, double ly, unsigned periodic)
{
  packing_domain_rectangle_def def;
  packing_domain *domain = NULL;
  packing_domain_rectangle_def_init(&def);
  def.size_x = lx;
  def.size_y = ly;
  def.periodic = periodic;
  assert_ok(packing_domain_create_rectangle(NULL, &def, &domain));
  return domain;
}

packing_psd *test_mono(double r)
{
  packing_psd_mono_def def;
  packing_psd *psd = NULL;
  packing_psd_mono_def_init(&def);
  def.r = r;
  assert_ok(packing_psd_create_mono(NULL, &def, &psd));
  return psd;
}

packing_psd *test_uniform(double min_r, double max_r)
{
  packing_psd_uniform_def def;
  packing_psd *psd = NULL;
  packing_psd_uniform_def_init(&def);
  def.min_r = min_r;
  def.max_r = max_r;
  assert_ok(packing_psd_create_uniform(NULL, &def, &psd));
  return psd;
}

packing_particles *test_store(int dim)
{
  packing_particles_def def;
  packing_particles *particles = NULL;
  packing_particles_def_init(&def);
  def.dim = dim;
  assert_ok(packing_particles_create(NULL, &def, &particles));
  return particles;
}

packing_placer_report test_run(packing_placer *placer)
{
  packing_placer_report report;
  packing_placer_report_init(&report);
  do
    assert_ok(packing_placer_step(placer, 100, &report));
  while (report.state == PACKING_PLACER_RUNNING);
  return report;
}

static double number(packing_column c, size_t i)
{
  return c.data == NULL
             ? 0.0
             : *(const double *)(const void *)((const char *)c.data + i * c.stride);
}

double test_brute_overlap(const packing_domain *domain, const packing_view *view)
{
  double most = 0;
  for (size_t i = 0; i < view->count; i++) {
    const packing_vec3 a = {number(view->x, i), number(view->y, i), number(view->z, i)};
    const double ri = number(view->r, i);
    for (size_t j = i + 1; j < view->count; j++) {
      const packing_vec3 b = {number(view->x, j), number(view->y, j), number(view->z, j)};
      const double rj = number(view->r, j);
      packing_vec3 s = {b.x - a.x, b.y - a.y, b.z - a.z};
      if (domain != NULL)
        s = packing_domain_separation(domain, &a, &b);
      const double overlap =
          (ri + rj - sqrt(s.x * s.x + s.y * s.y + s.z * s.z)) / (ri < rj ? ri : rj);
      if (overlap > most)
        most = overlap;
    }
  }
  return most;
}
