/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Particle-steps per second of the stepper on settled beds of the 3D material of Campello and
 * Cassares (2016): r = 0.02, Hertz contact, continuous sliding, rotations, steps of 1e-4.
 *
 *   bench-dem                       8000 spheres on a base of 1 x 1 (the peers' input), each
 *                                   instruction set and number of threads; 100 000 on 4 x 4
 *   bench-dem START SETTLE TIMED    the spheres of a file of lines "x y z r" on a base of 1 x 1,
 *                                   one thread: one figure, for tests/bench/peers/compare.sh */
#define _POSIX_C_SOURCE 200809L
#include "bench.h"
#include <string.h>

enum { RUNS = 5, UNIT = 6250, TILES = 4 };

static const double R = 0.02;

static packing_context *context_of(int threads, packing_isa isa)
{
  packing_context_def def;
  packing_context *context = NULL;
  packing_context_def_init(&def);
  def.threads = threads;
  def.isa = isa;
  must(packing_context_create(&def, &context));
  return context;
}

static packing_domain *base_of(double edge, double height, int open_top)
{
  packing_domain_box_def def;
  packing_domain *domain = NULL;
  packing_domain_box_def_init(&def);
  def.size.x = def.size.y = edge;
  def.size.z = height;
  def.open_top = open_top;
  must(packing_domain_create_box(NULL, &def, &domain));
  return domain;
}

static packing_particles *store_of(size_t capacity)
{
  packing_particles_def def;
  packing_particles *store = NULL;
  packing_particles_def_init(&def);
  def.capacity = capacity;
  must(packing_particles_create(NULL, &def, &store));
  return store;
}

/* The peers' input holds damping coefficients, not rates: 0.1 stands for theirs. */
static packing_dem *stepper(packing_context *context, packing_domain *domain,
                            packing_particles *store)
{
  packing_material_def material;
  packing_materials *materials = NULL;
  packing_law_sliding_def sliding;
  packing_law *laws[2] = {NULL, NULL};
  packing_dem_def def;
  packing_dem *dem = NULL;
  packing_material_def_init(&material);
  material.density = 1000;
  material.young = 1e8;
  packing_law_sliding_def_init(&sliding);
  sliding.slip_velocity = 1e-3;
  packing_dem_def_init(&def);
  def.dt = 1e-4;
  def.gravity.z = -2;
  def.drag = 0.02;
  must(packing_materials_create(NULL, &materials));
  must(packing_materials_add(materials, &material, NULL));
  must(packing_law_create_hertz(NULL, NULL, &laws[0]));
  must(packing_law_create_sliding(NULL, &sliding, &laws[1]));
  must(packing_dem_create(context, &def, domain, materials, laws, 2, store, &dem));
  packing_law_destroy(laws[0]);
  packing_law_destroy(laws[1]);
  packing_materials_destroy(materials);
  return dem;
}

static void step(packing_context *context, packing_domain *domain,
                 packing_particles *store, uint64_t steps)
{
  packing_dem *dem = stepper(context, domain, store);
  must(packing_dem_step(dem, steps, NULL));
  packing_dem_destroy(dem);
}

/* `count` spheres at a volume fraction of 0.25, let fall. */
static packing_particles *settled(size_t count, uint64_t steps)
{
  const double height = (double)count * 4 / 3 * 3.14159265358979323846 * R * R * R / 0.25;
  packing_context *context = context_of(2, PACKING_ISA_AUTO);
  packing_domain *start = base_of(1, height, 0), *domain = base_of(1, height, 1);
  packing_particles *store = store_of(count);
  packing_placer *placer = NULL;
  packing_psd *psd = NULL;
  packing_psd_mono_def mono;
  packing_rsa_def rsa;
  packing_placer_report placed;
  packing_psd_mono_def_init(&mono);
  mono.r = R;
  packing_rsa_def_init(&rsa);
  rsa.count = count;
  packing_placer_report_init(&placed);
  must(packing_psd_create_mono(NULL, &mono, &psd));
  must(packing_rsa_create(context, &rsa, start, psd, store, &placer));
  do
    must(packing_placer_step(placer, 100, &placed));
  while (placed.state == PACKING_PLACER_RUNNING);
  packing_placer_destroy(placer);
  packing_psd_destroy(psd);
  packing_domain_destroy(start);
  step(context, domain, store, steps);
  packing_domain_destroy(domain);
  packing_context_destroy(context);
  return store;
}

/* Copies of a bed side by side, seen on a base of TILES x TILES. */
static packing_particles *tiled(const packing_particles *unit)
{
  packing_view view;
  packing_particles_view(unit, &view);
  packing_particles *store = store_of(view.count * TILES * TILES);
  const double *x = view.x.data, *y = view.y.data, *z = view.z.data;
  for (int row = 0; row < TILES; row++)
    for (int column = 0; column < TILES; column++)
      for (size_t i = 0; i < view.count; i++) {
        const packing_vec3 at = {x[i] + column, y[i] + row, z[i]};
        must(packing_particles_add(store, at, R, NULL));
      }
  return store;
}

static packing_particles *copy_of(const packing_particles *store)
{
  packing_view view;
  packing_particles_view(store, &view);
  packing_particles *copy = store_of(view.count);
  must(packing_particles_add_columns(copy, packing_particles_columns(store)));
  must(packing_particles_assign(copy, &view));
  return copy;
}

static int by_value(const void *a, const void *b)
{
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Particle-steps per second, the median of RUNS that go on from the bed given. */
static double time_bed(const char *name, packing_domain *domain,
                       const packing_particles *bed, int threads, packing_isa isa,
                       uint64_t steps)
{
  double rate[RUNS];
  packing_context *context = context_of(threads, isa);
  packing_particles *store = copy_of(bed);
  packing_dem *dem = stepper(context, domain, store);
  packing_dem_report report;
  packing_dem_report_init(&report);
  must(packing_dem_step(dem, 1, NULL)); /* the first list */
  for (int k = 0; k < RUNS; k++) {
    const double start = now();
    must(packing_dem_step(dem, steps, &report));
    rate[k] = (double)report.particles * (double)steps / (now() - start);
  }
  qsort(rate, RUNS, sizeof rate[0], by_value);
  printf("%-16s %6zu spheres, %d thread%s %-8s  median %.3g, best %.3g particle-steps/s;"
         "  %.2f contacts a particle, a list every %.0f steps, largest overlap %.1e\n",
         name, report.particles, threads, threads == 1 ? ", " : "s,",
         packing_isa_name(packing_context_isa(context)), rate[RUNS / 2], rate[RUNS - 1],
         (double)(report.contacts + report.wall_contacts) / (double)report.particles,
         (double)report.steps / (double)(report.rebuilds ? report.rebuilds : 1),
         report.max_overlap);
  packing_dem_destroy(dem);
  packing_particles_destroy(store);
  packing_context_destroy(context);
  return rate[RUNS / 2];
}

static void small_bed(void)
{
  static const packing_isa isas[] = {PACKING_ISA_BASELINE, PACKING_ISA_AVX2,
                                     PACKING_ISA_AVX512};
  packing_domain *domain = base_of(1, 2, 1);
  packing_particles *bed = settled(8000, 15000);
  for (int threads = 1; threads <= 2; threads++)
    time_bed("peers' bed", domain, bed, threads, PACKING_ISA_AUTO, 1000);
  for (size_t k = 0; k < sizeof isas / sizeof isas[0]; k++)
    if (packing_isa_available(isas[k]))
      time_bed("peers' bed", domain, bed, 1, isas[k], 1000);
  packing_particles_destroy(bed);
  packing_domain_destroy(domain);
}

static void large_bed(void)
{
  packing_domain *domain = base_of(TILES, 2, 1);
  packing_particles *unit = settled(UNIT, 15000), *bed = tiled(unit);
  packing_context *context = context_of(2, PACKING_ISA_AUTO);
  step(context, domain, bed, 2000); /* the seams settle */
  const double one = time_bed("large bed", domain, bed, 1, PACKING_ISA_AUTO, 400);
  const double two = time_bed("large bed", domain, bed, 2, PACKING_ISA_AUTO, 400);
  printf("large bed: 2 threads %.2f times one\n", two / one);
  packing_context_destroy(context);
  packing_particles_destroy(unit);
  packing_particles_destroy(bed);
  packing_domain_destroy(domain);
}

static packing_particles *read_start(const char *name)
{
  FILE *file = fopen(name, "r");
  packing_particles *store = store_of(8192);
  packing_vec3 at;
  double r;
  if (file == NULL) {
    perror(name);
    exit(1);
  }
  while (fscanf(file, "%lf %lf %lf %lf", &at.x, &at.y, &at.z, &r) == 4)
    must(packing_particles_add(store, at, r, NULL));
  (void)fclose(file);
  return store;
}

static void beside_peers(const char *start, uint64_t settle, uint64_t timed)
{
  packing_context *context = context_of(1, PACKING_ISA_AUTO);
  packing_domain *domain = base_of(1, 2, 1);
  packing_particles *store = read_start(start);
  packing_dem *dem = stepper(context, domain, store);
  packing_dem_report report;
  packing_dem_report_init(&report);
  must(packing_dem_step(dem, settle, NULL));
  const double begin = now();
  must(packing_dem_step(dem, timed, &report));
  const double seconds = now() - begin;
  printf(
      "%.4g particle-steps/s (%.2f s; kinetic energy %.3g, %.2f contacts a particle)\n",
      (double)report.particles * (double)timed / seconds, seconds, report.kinetic_energy,
      (double)(report.contacts + report.wall_contacts) / (double)report.particles);
  packing_dem_destroy(dem);
  packing_particles_destroy(store);
  packing_domain_destroy(domain);
  packing_context_destroy(context);
}

int main(int argc, char **argv)
{
  (void)setvbuf(stdout, NULL, _IOLBF, BUFSIZ); /* lines as they come, into a log too */
  if (argc == 4)
    beside_peers(argv[1], strtoull(argv[2], NULL, 10), strtoull(argv[3], NULL, 10));
  else if (argc == 1) {
    small_bed();
    large_bed();
  } else {
    (void)fprintf(stderr, "usage: bench-dem [START SETTLE TIMED]\n");
    return 2;
  }
  return 0;
}
