/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random sequential addition of a million particles, wall clock from creation to the last step,
 * on one thread and on two: the best and the median of five; the longest step of budget 1. */
#define _POSIX_C_SOURCE 200809L
#include "bench.h"
#include <math.h>

enum { RUNS = 5 };

typedef struct job {
  const char *name;
  int dim;
  double volume_fraction; /* 0: to saturation */
  double min_r;           /* below 1: sizes uniform in [min_r, 1], largest first */
  size_t count;
} job;

typedef struct result {
  double seconds, longest_step;
  packing_placer_report report;
} result;

static packing_domain *cell(const job *j)
{
  packing_domain *domain = NULL;
  const double limit = j->dim == 2 ? 0.5470735 : 0.3841307;
  const double phi = j->volume_fraction > 0 ? j->volume_fraction : limit;
  const double a = j->min_r, mean3 = a < 1 ? (1 - a * a * a * a) / (4 * (1 - a)) : 1;
  const double ball = (j->dim == 2 ? 1 : 4.0 / 3) * 3.14159265358979324 * mean3;
  const double edge = pow((double)j->count * ball / phi, 1.0 / j->dim);
  if (j->dim == 2) {
    packing_domain_rectangle_def def;
    packing_domain_rectangle_def_init(&def);
    def.size_x = def.size_y = edge;
    def.periodic = 3;
    must(packing_domain_create_rectangle(NULL, &def, &domain));
  } else {
    packing_domain_box_def def;
    packing_domain_box_def_init(&def);
    def.size.x = def.size.y = def.size.z = edge;
    def.periodic = 7;
    must(packing_domain_create_box(NULL, &def, &domain));
  }
  return domain;
}

static packing_psd *sizes(const job *j)
{
  packing_psd *psd = NULL;
  if (j->min_r < 1) {
    packing_psd_uniform_def def;
    packing_psd_uniform_def_init(&def);
    def.min_r = j->min_r;
    def.max_r = 1;
    must(packing_psd_create_uniform(NULL, &def, &psd));
  } else {
    packing_psd_mono_def def;
    packing_psd_mono_def_init(&def);
    def.r = 1;
    must(packing_psd_create_mono(NULL, &def, &psd));
  }
  return psd;
}

static result run(const job *j, packing_context *context, packing_domain *domain,
                  packing_psd *psd)
{
  result out = {0};
  packing_particles *store = NULL;
  packing_particles_def store_def;
  packing_placer *placer = NULL;
  packing_rsa_def def;
  packing_particles_def_init(&store_def);
  store_def.dim = j->dim;
  packing_rsa_def_init(&def);
  if (j->volume_fraction > 0)
    def.count = j->count;
  def.order = j->min_r < 1 ? PACKING_ORDER_DESCENDING : PACKING_ORDER_DRAWN;
  packing_placer_report_init(&out.report);
  must(packing_particles_create(context, &store_def, &store));
  const double begin = now();
  must(packing_rsa_create(context, &def, domain, psd, store, &placer));
  double last = now();
  do {
    must(packing_placer_step(placer, 1, &out.report));
    const double t = now();
    if (t - last > out.longest_step)
      out.longest_step = t - last;
    last = t;
  } while (out.report.state == PACKING_PLACER_RUNNING);
  out.seconds = last - begin;
  packing_placer_destroy(placer);
  packing_particles_destroy(store);
  return out;
}

static int by_seconds(const void *a, const void *b)
{
  const double x = ((const result *)a)->seconds, y = ((const result *)b)->seconds;
  return x < y ? -1 : x > y;
}

static void time_job(const job *j, int threads)
{
  packing_context_def def;
  packing_context *context = NULL;
  result runs[RUNS];
  packing_context_def_init(&def);
  def.threads = threads;
  must(packing_context_create(&def, &context));
  packing_domain *domain = cell(j);
  packing_psd *psd = sizes(j);
  for (int i = 0; i < RUNS; i++)
    runs[i] = run(j, context, domain, psd);
  qsort(runs, RUNS, sizeof *runs, by_seconds);
  const result *median = &runs[RUNS / 2];
  printf("%-34s %d thread%s %8zu placed, %-9s volume fraction %.5f  best %.3f s  median "
         "%.3f s  "
         "%.3g/s  longest step %.1f ms\n",
         j->name, threads, threads == 1 ? ", " : "s,", median->report.placed,
         packing_placer_state_name(median->report.state), median->report.volume_fraction,
         runs[0].seconds, median->seconds,
         (double)median->report.placed / median->seconds, 1e3 * median->longest_step);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
  packing_context_destroy(context);
}

int main(void)
{
  static const job jobs[] = {
      {"equal spheres to 0.25", 3, 0.25, 1, 1000000},
      {"equal spheres to 0.30", 3, 0.30, 1, 1000000},
      {"equal spheres to saturation", 3, 0, 1, 1000000},
      {"equal discs to saturation", 2, 0, 1, 1000000},
      {"radii 0.1 to 1, largest first, 0.30", 3, 0.30, 0.1, 300000}};
  setvbuf(stdout, NULL, _IOLBF, BUFSIZ); /* lines as they come, into a log too */
  for (size_t j = 0; j < sizeof jobs / sizeof *jobs; j++)
    for (int threads = 1; threads <= 2; threads++)
      time_job(&jobs[j], threads);
  return 0;
}
