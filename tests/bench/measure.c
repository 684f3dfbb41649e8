/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Seconds of wall clock for the measures of a million spheres, on one thread and on two: the
 * best and the median of five; then audit, coordination and fabric together, as a program asks
 * for them (the network of contacts made once), and the most bytes a particle that they hold
 * beside the pack. The packs are a cubic array shaken by a third of its spacing (at
 * a volume fraction of 0.25) and a face-centred one shaken a little (0.60), numbered in random
 * order as a random placement is, in a box with walls. */
#define _POSIX_C_SOURCE 200809L
#include "bench.h"
#include <math.h>

enum { RUNS = 5 };

typedef struct pack {
  const char *name;
  double tolerance; /* of contacts */
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
static void begin(pack *p, const char *name, size_t side, size_t each, double fraction,
                  double tolerance)
{
  packing_domain_box_def box;
  packing_psd_mono_def mono;
  p->tolerance = tolerance;
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
  def.tolerance = p->tolerance;
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

/* Bond order 4 and 6 together, of neighbours found once. */
static void run_bond_order(packing_context *context, const pack *p)
{
  packing_neighbours *neighbours = NULL;
  packing_bond_order_def def;
  packing_bond_order_report report;
  packing_bond_order_def_init(&def);
  packing_bond_order_report_init(&report);
  must(packing_neighbours_create(context, NULL, p->box, &p->view, &neighbours));
  for (def.l = 4; def.l <= 6; def.l += 2)
    must(packing_measure_bond_order(context, &def, neighbours, NULL, 0, &report));
  packing_neighbours_destroy(neighbours);
}

static void run_crystals(packing_context *context, const pack *p)
{
  packing_neighbours *neighbours = NULL;
  packing_common_neighbours_report report;
  packing_common_neighbours_report_init(&report);
  must(packing_neighbours_create(context, NULL, p->box, &p->view, &neighbours));
  must(packing_measure_common_neighbours(context, neighbours, NULL, 0, &report));
  packing_neighbours_destroy(neighbours);
}

/* As far as two diameters and a half. */
static void run_rdf(packing_context *context, const pack *p)
{
  packing_rdf_def def;
  packing_rdf_report report;
  packing_rdf_def_init(&def);
  def.r_max = 2.5;
  packing_rdf_report_init(&report);
  must(packing_measure_rdf(context, &def, p->box, &p->view, NULL, 0, &report));
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
                  {"sizes", run_sizes},
                  {"bond order", run_bond_order},
                  {"crystals", run_crystals},
                  {"rdf", run_rdf}};
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

/* Bytes held, now and at most. A block is preceded by its size. */
typedef struct tally {
  size_t held;
  size_t peak;
} tally;

static void *count_in(void *user, size_t size, size_t alignment)
{
  tally *t = user;
  char *block =
      aligned_alloc(alignment, (size + 2 * alignment - 1) / alignment * alignment);
  if (block == NULL)
    return NULL;
  *(size_t *)(void *)block = size;
  t->held += size;
  t->peak = t->held > t->peak ? t->held : t->peak;
  return block + alignment;
}

static void count_out(void *user, void *block)
{
  tally *t = user;
  char *start = (char *)block - 64; /* the library asks for 64 */
  t->held -= *(size_t *)(void *)start;
  free(start);
}

/* Audit, coordination and fabric of one run. */
static double run_bar(packing_context *context, const pack *p, double *seconds)
{
  packing_contacts_def def;
  packing_contacts *contacts = NULL;
  packing_coordination_report coordination;
  packing_fabric_report fabric;
  packing_contacts_def_init(&def);
  def.tolerance = p->tolerance;
  packing_coordination_report_init(&coordination);
  packing_fabric_report_init(&fabric);
  const double start = now();
  run_audit(context, p);
  const double audited = now();
  must(packing_contacts_create(context, &def, p->box, &p->view, &contacts));
  must(packing_contacts_coordination(contacts, &coordination));
  const double coordinated = now();
  must(packing_contacts_fabric(contacts, NULL, &fabric));
  packing_contacts_destroy(contacts);
  const double end = now();
  seconds[0] = audited - start;
  seconds[1] = coordinated - audited;
  seconds[2] = end - coordinated;
  return coordination.mean;
}

static void time_bar(const pack *p)
{
  tally t = {0, 0};
  double best[3] = {1e9, 1e9, 1e9}, sum = 1e9, mean = 0;
  packing_context_def def;
  packing_context *context = NULL;
  packing_context_def_init(&def);
  def.threads = 1;
  def.allocator.allocate = count_in;
  def.allocator.release = count_out;
  def.allocator.user = &t;
  must(packing_context_create(&def, &context));
  for (int k = 0; k < RUNS; k++) {
    double seconds[3];
    mean = run_bar(context, p, seconds);
    if (seconds[0] + seconds[1] + seconds[2] < sum) {
      sum = seconds[0] + seconds[1] + seconds[2];
      memcpy(best, seconds, sizeof best);
    }
  }
  packing_context_destroy(context);
  printf("bar, %s, %zu particles, %.2f contacts each, 1 thread: audit %.3f + "
         "coordination %.3f + "
         "fabric %.3f = %.3f s (at most 1.5), %.1f bytes a particle (at most 100)\n",
         p->name, p->count, mean, best[0], best[1], best[2], sum,
         (double)t.peak / (double)p->count);
}

int main(void)
{
  pack p;
  begin(&p, "loose, fraction 0.25", 100, 1, 0.25, 0.02);
  fill(&p, 1, 1.0 / 3);
  time_all(&p, 1);
  time_all(&p, 2);
  time_bar(&p);
  end(&p);
  begin(&p, "dense, fraction 0.60", 63, 4, 0.60, 0.075);
  fill(&p, 4, 0.05);
  time_all(&p, 1);
  time_all(&p, 2);
  time_bar(&p);
  end(&p);
  return 0;
}
