/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Seconds of wall clock for the measures of a million spheres, on one thread and on two: the
 * best and the median of five. The packs are a cubic array shaken by a third of its spacing (at
 * a volume fraction of 0.25) and a face-centred one shaken a little (0.60), numbered in random
 * order as a random placement is, in a box with walls. */
#define _POSIX_C_SOURCE 200809L
#include "bench.h"
#include <math.h>

enum { RUNS = 5 };

typedef struct pack {
  const char *name;
  size_t count;
  double edge;
  double *x, *y, *z, *r;
  size_t *order;
  packing_rng *rng;
  packing_domain *box;
  packing_psd *psd;
  packing_view view;
} pack;

static void *room(size_t count, size_t size)
{
  void *block = malloc(count * size);
  if (block == NULL)
    must(PACKING_ERR_NOMEM);
  return block;
}

/* `side`^3 cells of edge 1 with `each` spheres, random positions in the arrays. */
static void begin(pack *p, const char *name, size_t side, size_t each, double fraction)
{
  packing_domain_box_def box;
  packing_psd_mono_def mono;
  p->name = name;
  p->count = each * side * side * side;
  p->edge = (double)side;
  p->x = room(p->count, sizeof *p->x);
  p->y = room(p->count, sizeof *p->y);
  p->z = room(p->count, sizeof *p->z);
  p->r = room(p->count, sizeof *p->r);
  p->order = room(p->count, sizeof *p->order);
  must(packing_rng_create(NULL, 1, PACKING_PURPOSE_USER, 0, &p->rng));
  const double r = cbrt(fraction * 3 / (4 * 3.14159265358979323846) / (double)each);
  for (size_t i = 0; i < p->count; i++) {
    const size_t k = (size_t)packing_rng_below(p->rng, i + 1);
    p->order[i] = p->order[k];
    p->order[k] = i;
    p->r[i] = r;
  }
  packing_domain_box_def_init(&box);
  box.size.x = box.size.y = box.size.z = p->edge;
  must(packing_domain_create_box(NULL, &box, &p->box));
  packing_psd_mono_def_init(&mono);
  mono.r = r;
  must(packing_psd_create_mono(NULL, &mono, &p->psd));
  packing_view_init_arrays(&p->view, p->count, p->x, p->y, p->z, p->r);
}

static void put(pack *p, size_t k, const double *at, double shake)
{
  const size_t i = p->order[k];
  p->x[i] = at[0] + shake * (packing_rng_uniform(p->rng) - 0.5);
  p->y[i] = at[1] + shake * (packing_rng_uniform(p->rng) - 0.5);
  p->z[i] = at[2] + shake * (packing_rng_uniform(p->rng) - 0.5);
}

static void fill(pack *p, size_t each, double shake)
{
  static const double corner[4][3] = {
      {0.25, 0.25, 0.25}, {0.75, 0.75, 0.25}, {0.75, 0.25, 0.75}, {0.25, 0.75, 0.75}};
  const size_t side = (size_t)p->edge;
  for (size_t k = 0; k < p->count; k++) {
    const size_t cell = k / each;
    const double *c = corner[k % each];
    const double at[3] = {(double)(cell % side) + c[0],
                          (double)(cell / side % side) + c[1],
                          (double)(cell / side / side) + c[2]};
    put(p, k, at, shake);
  }
}

static void end(pack *p)
{
  packing_rng_destroy(p->rng);
  packing_domain_destroy(p->box);
  packing_psd_destroy(p->psd);
  free(p->x);
  free(p->y);
  free(p->z);
  free(p->r);
  free(p->order);
}

static void run_grid(packing_context *context, const pack *p)
{
  packing_grid *grid = NULL;
  must(packing_grid_create(context, NULL, p->box, &p->view, &grid));
  packing_grid_destroy(grid);
}

static void run_audit(packing_context *context, const pack *p)
{
  packing_audit_report report;
  packing_audit_report_init(&report);
  must(packing_audit(context, NULL, p->box, &p->view, &report));
}

static void run_coordination(packing_context *context, const pack *p)
{
  packing_coordination_report report;
  packing_coordination_def def;
  packing_coordination_def_init(&def);
  def.tolerance = 0.02;
  packing_coordination_report_init(&report);
  must(packing_measure_coordination(context, &def, p->box, &p->view, &report));
}

static void run_volume(packing_context *context, const pack *p)
{
  packing_volume_report report;
  packing_volume_report_init(&report);
  must(packing_measure_volume(context, NULL, p->box, &p->view, &report));
}

static void run_sizes(packing_context *context, const pack *p)
{
  packing_sizes_report report;
  packing_sizes_report_init(&report);
  must(packing_measure_sizes(context, p->psd, &p->view, &report));
}

static int by_value(const void *a, const void *b)
{
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static void time_all(const pack *p, int threads)
{
  static const struct {
    const char *name;
    void (*run)(packing_context *context, const pack *p);
  } measures[] = {{"grid", run_grid},
                  {"audit", run_audit},
                  {"coordination", run_coordination},
                  {"volume", run_volume},
                  {"sizes", run_sizes}};
  packing_context_def def;
  packing_context *context = NULL;
  packing_context_def_init(&def);
  def.threads = threads;
  must(packing_context_create(&def, &context));
  for (size_t m = 0; m < sizeof measures / sizeof measures[0]; m++) {
    double seconds[RUNS];
    for (int k = 0; k < RUNS; k++) {
      const double start = now();
      measures[m].run(context, p);
      seconds[k] = now() - start;
    }
    qsort(seconds, RUNS, sizeof seconds[0], by_value);
    printf("%-14s %-20s %7zu particles, %d threads: %.3f s (median %.3f s)\n",
           measures[m].name, p->name, p->count, threads, seconds[0], seconds[RUNS / 2]);
  }
  packing_context_destroy(context);
}

int main(void)
{
  pack p;
  begin(&p, "loose, fraction 0.25", 100, 1, 0.25);
  fill(&p, 1, 1.0 / 3);
  time_all(&p, 1);
  time_all(&p, 2);
  end(&p);
  begin(&p, "dense, fraction 0.60", 63, 4, 0.60);
  fill(&p, 4, 0.05);
  time_all(&p, 1);
  time_all(&p, 2);
  end(&p);
  return 0;
}
