/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The advancing front: rate, volume fraction inside and as a whole, sizes and largest overlap
 * together, for only together do they mean something.
 *
 *   bench-front                 a million spheres, radii U[0.7, 1.3], in a cube; the cylinder of
 *                               the seed paper's Table 2 (R 31.762, H 2 R, radii N(1, 0.1) cut to
 *                               [0.7, 1.3]); equal spheres with their order; discs. One thread
 *   bench-front table4          15 864 150 spheres of Table 4 on two threads, fast and dense
 *   bench-front exponent        1e5 to 1e7 spheres: how the time grows with their number
 *   bench-front periodic [...]  the same in periodic cells
 *
 * Bytes a sphere are the most that store and placer held together. */
#define _POSIX_C_SOURCE 200809L
#include "bench.h"
#include <math.h>
#include <stdatomic.h>
#include <stdint.h>
#include <string.h>

/* ---- memory ---- */

typedef struct counted {
  atomic_size_t now, most;
} counted;

typedef struct block_head {
  void *whole;
  size_t size;
} block_head;

static void *take(void *user, size_t size, size_t alignment)
{
  counted *c = user;
  char *whole = malloc(size + sizeof(block_head) + alignment);
  if (!whole)
    return NULL;
  const uintptr_t start = (uintptr_t)whole + sizeof(block_head) + alignment - 1;
  char *block = whole + (start / alignment * alignment - (uintptr_t)whole);
  const block_head head = {whole, size};
  memcpy(block - sizeof head, &head, sizeof head);
  const size_t held = atomic_fetch_add(&c->now, size) + size;
  size_t most = atomic_load(&c->most);
  while (held > most && !atomic_compare_exchange_weak(&c->most, &most, held))
    ;
  return block;
}

static void give_back(void *user, void *block)
{
  counted *c = user;
  block_head head;
  memcpy(&head, (char *)block - sizeof head, sizeof head);
  atomic_fetch_sub(&c->now, head.size);
  free(head.whole);
}

static packing_context *context_of(int threads, counted *memory)
{
  packing_context_def def;
  packing_context *context = NULL;
  packing_context_def_init(&def);
  def.threads = threads;
  if (memory)
    def.allocator = (packing_allocator){take, give_back, memory};
  must(packing_context_create(&def, &context));
  return context;
}

/* ---- inputs ---- */

typedef enum job_shape { CUBE, SQUARE, CYLINDER } job_shape;
typedef enum job_sizes { UNIFORM, EQUAL, NORMAL } job_sizes;

typedef struct job {
  const char *name;
  job_shape shape;
  job_sizes sizes;
  packing_front_mode mode;
  double length; /* edge, or radius of a cylinder twice as high */
  size_t count;  /* 0: as many as fit */
  int threads;
  int periodic; /* along every axis; not of a cylinder */
} job;

static packing_domain *container(const job *j)
{
  packing_domain *domain = NULL;
  packing_domain_box_def box;
  packing_domain_rectangle_def square;
  packing_domain_cylinder_def cylinder;
  packing_domain_box_def_init(&box);
  packing_domain_rectangle_def_init(&square);
  packing_domain_cylinder_def_init(&cylinder);
  box.size.x = box.size.y = box.size.z = j->length;
  square.size_x = square.size_y = j->length;
  if (j->periodic) {
    square.periodic = PACKING_PERIODIC_X | PACKING_PERIODIC_Y;
    box.periodic = square.periodic | PACKING_PERIODIC_Z;
  }
  cylinder.radius = j->length;
  cylinder.height = 2 * j->length;
  if (j->shape == CUBE)
    must(packing_domain_create_box(NULL, &box, &domain));
  else if (j->shape == SQUARE)
    must(packing_domain_create_rectangle(NULL, &square, &domain));
  else
    must(packing_domain_create_cylinder(NULL, &cylinder, &domain));
  return domain;
}

static packing_psd *distribution(const job *j)
{
  packing_psd *psd = NULL;
  packing_psd_uniform_def uniform;
  packing_psd_mono_def equal;
  packing_psd_normal_def normal;
  packing_psd_uniform_def_init(&uniform);
  packing_psd_mono_def_init(&equal);
  packing_psd_normal_def_init(&normal);
  uniform.min_r = normal.min_r = 0.7;
  uniform.max_r = normal.max_r = 1.3;
  equal.r = normal.mean_r = 1;
  normal.sd_r = 0.1;
  uniform.dim = equal.dim = normal.dim = j->shape == SQUARE ? 2 : 3;
  if (j->sizes == UNIFORM)
    must(packing_psd_create_uniform(NULL, &uniform, &psd));
  else if (j->sizes == EQUAL)
    must(packing_psd_create_mono(NULL, &equal, &psd));
  else
    must(packing_psd_create_normal(NULL, &normal, &psd));
  return psd;
}

/* ---- one run ---- */

typedef struct result {
  double seconds, longest_step;
  size_t placed, bytes;
} result;

static packing_particles *store_of(packing_context *context, int dim)
{
  packing_particles_def def;
  packing_particles *store = NULL;
  packing_particles_def_init(&def);
  def.dim = dim;
  must(packing_particles_create(context, &def, &store));
  return store;
}

static result grow(const job *j, packing_context *context, packing_domain *domain,
                   packing_psd *psd, packing_particles *store)
{
  result out = {0};
  packing_front_def def;
  packing_placer *placer = NULL;
  packing_placer_report report;
  packing_front_def_init(&def);
  packing_placer_report_init(&report);
  def.mode = j->mode;
  def.count = j->count;
  const double begin = now();
  must(packing_front_create(context, &def, domain, psd, store, &placer));
  double last = now();
  do {
    must(packing_placer_step(placer, 1, &report));
    const double t = now();
    out.longest_step = fmax(out.longest_step, t - last);
    last = t;
  } while (report.state == PACKING_PLACER_RUNNING);
  out.seconds = last - begin;
  out.placed = report.placed;
  packing_placer_destroy(placer);
  return out;
}

/* ---- what it is worth ---- */

/* Beyond three largest radii from the walls. */
static void print_order(packing_context *context, packing_domain *domain,
                        const packing_view *view, int dim)
{
  packing_neighbours_def def;
  packing_bond_order_report bonds;
  packing_hexatic_report hexatic;
  packing_neighbours *neighbours = NULL;
  packing_neighbours_def_init(&def);
  packing_bond_order_report_init(&bonds);
  packing_hexatic_report_init(&hexatic);
  def.margin = 3;
  must(packing_neighbours_create(context, &def, domain, view, &neighbours));
  if (dim == 3) {
    must(packing_measure_bond_order(context, NULL, neighbours, NULL, 0, &bonds));
    printf("  Q6 %.4f (mean of each %.4f)", bonds.whole, bonds.mean);
  } else {
    must(packing_measure_hexatic(context, NULL, neighbours, NULL, 0, &hexatic));
    printf("  psi_6 %.4f (mean of each %.4f)", hexatic.whole, hexatic.mean);
  }
  packing_neighbours_destroy(neighbours);
}

static void print_result(const job *j, packing_context *context, packing_domain *domain,
                         packing_psd *psd, const packing_particles *store,
                         const result *r)
{
  packing_view view;
  packing_volume_report volume;
  packing_sizes_report radii;
  packing_audit_report audit;
  packing_volume_report_init(&volume);
  packing_sizes_report_init(&radii);
  packing_audit_report_init(&audit);
  packing_particles_view(store, &view);
  must(packing_measure_volume(context, NULL, domain, &view, &volume));
  must(packing_measure_sizes(context, psd, &view, &radii));
  must(packing_audit(context, NULL, domain, &view, &audit));
  printf(
      "%-22s %-5s %d thread%s %9zu in %7.2f s = %7.0f/s  inner %.4f  whole %.4f  KS "
      "%.5f of %.5f  overlap %.1e  outside %.1e  %.0f bytes each  longest step %.1f ms",
      j->name, packing_front_mode_name(j->mode), j->threads,
      j->threads == 1 ? ", " : "s,", r->placed, r->seconds,
      (double)r->placed / r->seconds, volume.inner_fraction, volume.volume_fraction,
      radii.ks, radii.ks_limit, audit.max_overlap, audit.max_protrusion,
      (double)r->bytes / (double)r->placed, 1e3 * r->longest_step);
  if (j->sizes == EQUAL)
    print_order(context, domain, &view, j->shape == SQUARE ? 2 : 3);
  printf("\n");
}

/* Counting costs next to nothing: memory is asked for in large pieces. */
static double run(const job *j)
{
  counted memory = {0};
  packing_context *counting = context_of(j->threads, &memory);
  packing_domain *domain = container(j);
  packing_psd *psd = distribution(j);
  packing_particles *store = store_of(counting, j->shape == SQUARE ? 2 : 3);
  result r = grow(j, counting, domain, psd, store);
  r.bytes = atomic_load(&memory.most);
  print_result(j, counting, domain, psd, store, &r);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
  packing_context_destroy(counting);
  return r.seconds / (double)r.placed;
}

/* ---- the cases ---- */

/* Edge of a cube for so many spheres of radii U[0.7, 1.3]. */
static double edge_for(double count, double fraction)
{
  const double ball = 4 * 3.14159265358979324 / 3 * 1.09; /* the mean of r^3 is 1.09 */
  return cbrt(count * ball / fraction);
}

static int usual(int periodic)
{
  const job jobs[] = {
      {"cube U[.7,1.3]", CUBE, UNIFORM, PACKING_FRONT_FAST, edge_for(1e6, 0.6), 0, 1, 0},
      {"cube U[.7,1.3]", CUBE, UNIFORM, PACKING_FRONT_DENSE, edge_for(1e6, 0.63), 0, 1,
       0},
      {"cylinder of Table 2", CYLINDER, NORMAL, PACKING_FRONT_FAST, 31.762, 0, 1, 0},
      {"cylinder of Table 2", CYLINDER, NORMAL, PACKING_FRONT_DENSE, 31.762, 0, 1, 0},
      {"equal spheres", CUBE, EQUAL, PACKING_FRONT_FAST, 190, 0, 1, 0},
      {"equal spheres", CUBE, EQUAL, PACKING_FRONT_DENSE, 190, 0, 1, 0},
      {"equal discs", SQUARE, EQUAL, PACKING_FRONT_FAST, 600, 0, 1, 0},
      {"equal discs", SQUARE, EQUAL, PACKING_FRONT_DENSE, 600, 0, 1, 0},
      {"discs U[.7,1.3]", SQUARE, UNIFORM, PACKING_FRONT_FAST, 600, 0, 1, 0},
      {"discs U[.7,1.3]", SQUARE, UNIFORM, PACKING_FRONT_DENSE, 600, 0, 1, 0},
  };
  for (size_t i = 0; i < sizeof jobs / sizeof *jobs; i++) {
    job j = jobs[i];
    j.periodic = periodic;
    if (!periodic || j.shape != CYLINDER)
      run(&j);
  }
  return 0;
}

static int table4(int periodic)
{
  const packing_front_mode modes[] = {PACKING_FRONT_FAST, PACKING_FRONT_DENSE};
  const double fractions[] = {0.59, 0.61};
  for (int m = 0; m < 2; m++) {
    const job j = {"Table 4", CUBE, UNIFORM, modes[m], edge_for(15864150, fractions[m]),
                   15864150,  2,    periodic};
    run(&j);
  }
  return 0;
}

/* The slope of the logarithms, by least squares. */
static int exponent(int periodic)
{
  static const packing_front_mode modes[] = {PACKING_FRONT_FAST, PACKING_FRONT_DENSE};
  static const double counts[] = {1e5, 3e5, 1e6, 3e6, 1e7};
  enum { COUNTS = sizeof counts / sizeof *counts };
  for (int m = 0; m < 2; m++) {
    double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
    for (int k = 0; k < COUNTS; k++) {
      const job j = {"cube U[.7,1.3]",          CUBE, UNIFORM, modes[m],
                     edge_for(counts[k], 0.62), 0,    1,       periodic};
      const double x = log(counts[k]), y = log(run(&j) * counts[k]);
      sum_x += x;
      sum_y += y;
      sum_xx += x * x;
      sum_xy += x * y;
    }
    printf("%s: time goes as N^%.4f\n", packing_front_mode_name(modes[m]),
           (COUNTS * sum_xy - sum_x * sum_y) / (COUNTS * sum_xx - sum_x * sum_x));
  }
  return 0;
}

int main(int argc, char **argv)
{
  setvbuf(stdout, NULL, _IOLBF, BUFSIZ); /* lines as they come, into a log too */
  const int periodic = argc > 1 && strcmp(argv[1], "periodic") == 0;
  const int words = argc - 1 - periodic;
  const char *word = words == 1 ? argv[1 + periodic] : "";
  if (words == 0)
    return usual(periodic);
  if (strcmp(word, "table4") == 0)
    return table4(periodic);
  if (strcmp(word, "exponent") == 0)
    return exponent(periodic);
  fprintf(stderr, "bench-front [periodic] [table4|exponent]\n");
  return 2;
}
