/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_STEPPER_INTERNAL_H
#define PACKING_STEPPER_INTERNAL_H

/* The stepper: doc/methods/dem.md tells the method.
 *
 * Particles stand sorted into slabs along one axis, inside a slab by size class and cell. A slab
 * is at least one interaction distance thick, so the pairs of a slab's list touch its particles
 * and those of the next slab only. Slabs of even number work side by side, then those of odd
 * number: no two write to one particle, each particle gets its forces in an order that the input
 * alone fixes, and every pair is computed once. */

#include "dem_internal.h"
#include "domain/domain_internal.h"
#include "particles/particles_internal.h"
#include "vec.h"

enum {
  PACKING_I_SLABS = 128,  /* most */
  PACKING_I_CLASSES = 8,  /* of sizes, an octave each; the last holds all smaller ones */
  PACKING_I_POSITION = 4, /* doubles of a position record: x y z r */
  PACKING_I_MOTION = 8,   /* of a motion record: vx vy vz m, wx wy wz 0 */
  PACKING_I_FORCE = 8,    /* of a force record: fx fy fz 1/m, tx ty tz 1/J */
  PACKING_I_LIST_SLACK = 16,           /* entries after a list that may be read */
  PACKING_I_ROOM = PACKING_I_BATCH + 8 /* entries of a batch that may be written */
};

/* Periodic images: infinite where not periodic. */
typedef struct packing_i_images {
  int any;
  double period[3];
  double half[3];
} packing_i_images;

/* Pairs at work, and their kinematics. The numbers of one slab's batch fit a core's L1 cache. */
typedef struct packing_i_batch {
  _Alignas(64) double dx[PACKING_I_ROOM]; /* from i to j */
  double dy[PACKING_I_ROOM];
  double dz[PACKING_I_ROOM];
  double distance[PACKING_I_ROOM]; /* squared until packing_i_kernels.motion() */
  double ri[PACKING_I_ROOM];
  double rj[PACKING_I_ROOM];
  double share[PACKING_I_ROOM]; /* of the overlap, i's */
  double arm_i[PACKING_I_ROOM];
  double arm_j[PACKING_I_ROOM];
  double overlap[PACKING_I_ROOM];
  double reduced_r[PACKING_I_ROOM];
  double reduced_m[PACKING_I_ROOM];
  double approach[PACKING_I_ROOM];
  double ux[PACKING_I_ROOM];
  double uy[PACKING_I_ROOM];
  double uz[PACKING_I_ROOM];
  double normal[PACKING_I_ROOM];
  double fx[PACKING_I_ROOM];
  double fy[PACKING_I_ROOM];
  double fz[PACKING_I_ROOM];
  uint32_t pair[PACKING_I_ROOM]; /* of materials */
  uint32_t i[PACKING_I_ROOM];
  uint32_t j[PACKING_I_ROOM];
  uint32_t slot[PACKING_I_ROOM]; /* entry in the list */
  size_t count;
} packing_i_batch;

/* What moves particles; see integrate.c. */
typedef struct packing_i_advance {
  double *position, *motion, *force;
  const double *built;
  double dt[4];      /* dt, and 0 */
  double spin_dt[4]; /* dt, or 0 without rotations; and 0 */
  double keep[4];    /* 0, and 1 */
  double gravity[4];
  double flow[4]; /* of the fluid */
  double drag;
} packing_i_advance;

/* The vector work of an instruction set; all give the same bits. */
typedef struct packing_i_kernels {
  /* Appends the pairs first .. first + count - 1 of a list that are nearer than the sum of their
   * radii, or than `reach` where that is > 0. There must be room for `count` more. */
  void (*screen)(const double *position, const packing_i_images *images, double reach,
                 const uint32_t *list_i, const uint32_t *list_j, size_t first,
                 size_t count, packing_i_batch *batch);
  /* Distances become lengths, dx dy dz unit normals; the rest of the kinematics is filled in and
   * forces are cleared. Works up to the next multiple of 8: entries after the last must hold
   * valid ones. */
  void (*motion)(const double *motion, int touching, int arms_at_radius,
                 packing_i_batch *batch);
  /* Adds the forces to i and takes them from j. */
  void (*add)(double *force, const packing_i_batch *batch);
  /* Moves particles [first, end) and clears their forces. Returns a bound of the squared way since
   * the list was made, infinite when a position is not finite. */
  double (*advance)(const packing_i_advance *advance, size_t first, size_t end);
} packing_i_kernels;

const packing_i_kernels *packing_i_kernels_for(packing_isa isa);
extern const packing_i_kernels packing_i_kernels_baseline;
#if defined(__x86_64__) && defined(__GNUC__)
extern const packing_i_kernels packing_i_kernels_avx2;
extern const packing_i_kernels packing_i_kernels_avx512;
#endif

/* Cells of one size class; numbered (plane, row, column) inside a slab. */
typedef struct packing_i_class {
  double r_max;      /* of its particles */
  int cells[3];      /* planes of a slab, rows, columns */
  double inverse[3]; /* of a cell's edge */
  size_t cells_of_slab;
  size_t offset; /* of its first cell among those of a slab */
} packing_i_class;

/* How space is cut. axis[0] is across the slabs. */
typedef struct packing_i_cut {
  int axis[3];
  int slabs;
  int ring;                /* the last slab's next is the first */
  double lo[3], extent[3]; /* of axis[k] */
  double thickness;        /* of a slab */
  double inverse_thickness;
  int classes;
  packing_i_class of[PACKING_I_CLASSES]; /* coarse to fine */
  size_t cells_of_slab;                  /* of all classes */
} packing_i_cut;

/* Results of a slab's work. */
typedef struct packing_i_slab {
  size_t first, count; /* its particles */
  size_t list_first, list_room,
      list_count;    /* its pairs; `count` more than `room`: too many */
  size_t wall_count; /* its particles near walls, in near_wall from `first` on */
  double
      displaced2; /* largest squared way since the list was made; not finite after a failure */
  size_t contacts, wall_contacts;
  double max_overlap;
} packing_i_slab;

/* What laws remember; `size` 0: nothing, and no memory. */
typedef struct packing_i_history {
  size_t size;                                     /* numbers of a contact, of all laws */
  size_t offset[PACKING_I_LAWS];                   /* of each law's first */
  double swap[PACKING_I_LAWS * PACKING_I_HISTORY]; /* factor when i and j swap: 1 or -1 */
  size_t particles, pairs;                         /* that there is room for */
  int kept;                                        /* 0: there is nothing to carry over */
  double *work;                                    /* of the batches, by slab */
  double *value;                                   /* by entry of the list */
  uint64_t *mark;                                  /* of the last touch, likewise */
  double *wall_value;                              /* by entry of near_wall and wall */
  uint64_t *wall_mark;
  double *carried;      /* of living contacts, by the lower name */
  uint32_t *carried_id; /* the higher name of each */
  uint32_t *carried_at; /* where those of a lower name begin */
  size_t carried_room;
  double *wall_carried;
  uint64_t *wall_carried_mark;
  uint32_t *wall_carried_at; /* by name */
} packing_i_history;

/* How rounds of steps went with all threads and with one; see threads.c. */
typedef struct packing_i_threads {
  unsigned step;     /* of the round */
  unsigned round;    /* since the particles were loaded */
  int one;           /* 1: one thread is used */
  double start;      /* of the step */
  double took;       /* by the round so far */
  double seconds[2]; /* of a round, lately: with all, with one; 0: not tried yet */
} packing_i_threads;

/* 276 bytes a particle and 8 a listed pair (some 5 a particle in dense packs). */
struct packing_dem {
  packing_context *context;
  const packing_allocator *allocator;
  packing_domain *domain;
  packing_particles *particles;
  packing_dem_def def;
  double dt;
  packing_dem_advice advice;
  packing_i_pair_table *materials;
  packing_law *laws[PACKING_I_LAWS];
  packing_law_function work[PACKING_I_LAWS]; /* kernels of the laws */
  size_t law_count;
  double reach; /* largest of the laws of distance, 0: none */
  const packing_i_kernels *kernels;
  packing_i_images images;
  int dim;
  int loaded; /* 0: nothing to step */
  uint64_t steps, rebuilds;
  double time_before; /* when dt last changed, with the advice of a reload */
  uint64_t steps_before;

  size_t count, capacity;
  double *position;      /* PACKING_I_POSITION a particle */
  double *motion;        /* PACKING_I_MOTION a particle */
  double *force;         /* PACKING_I_FORCE a particle; zero between steps */
  double *built;         /* positions when the list was made */
  double *spare;         /* as long as `motion` */
  uint32_t *id;          /* index in the store */
  uint32_t *material;    /* of each */
  uint32_t *spare_index; /* as long as `id` */
  uint32_t *cell;        /* of each particle while sorting */
  int one_material;

  packing_i_cut cut;
  packing_i_slab slab[PACKING_I_SLABS];
  size_t contacts, wall_contacts; /* of the last step that was tallied */
  double max_overlap;
  uint32_t *cell_start; /* by slab and cell, one more at the end */
  size_t cell_capacity;

  uint32_t *list_i, *list_j; /* pairs; i in the slab, j in it or the next */
  size_t list_capacity;      /* of all */
  size_t list_share;         /* entries set aside for a particle */
  uint32_t *near_wall;       /* particles, by slab */
  packing_i_history history;
  packing_i_threads threads;
  double skin; /* pairs are listed up to this gap */
  double r_min, r_max;
};

/* How far apart the centres of two listed particles may be. */
static inline double packing_i_dem_range(const packing_dem *dem, double ri, double rj)
{
  const double touching = ri + rj;
  return (touching > dem->reach ? touching : dem->reach) + dem->skin;
}

/* Simulated time since creation. */
static inline double packing_i_dem_time(const packing_dem *dem)
{
  return dem->time_before + (double)(dem->steps - dem->steps_before) * dem->dt;
}

/* Column of the walls in a table of pairs. */
static inline size_t packing_i_dem_wall_column(const packing_dem *dem)
{
  return dem->def.wall_material == PACKING_MATERIAL_RIGID ? dem->materials->count
                                                          : dem->def.wall_material;
}

/* J over m r^2. */
static inline double packing_i_dem_inertia(const packing_dem *dem)
{
  return dem->dim == 2 && dem->def.disc_mass ? 0.5 : 0.4;
}

/* The nearest image of a difference along an axis. */
static inline double packing_i_dem_image(double d, double period, double half)
{
  if (d > half)
    return d - period;
  return d < -half ? d + period : d;
}

/* Which of n cells a coordinate falls into; the outermost hold what is beyond. */
static inline int packing_i_dem_cell(double x, double inverse, int n)
{
  const double c = x * inverse;
  return c >= n ? n - 1 : c > 0 ? (int)c : 0;
}

/* Sorts the particles into slabs and cells for a given skin. */
packing_status packing_i_dem_sort(packing_dem *dem);

/* Makes the lists of pairs and of particles near walls. */
packing_status packing_i_dem_list(packing_dem *dem);

/* The square of the largest speed. */
double packing_i_dem_max_speed2(const packing_dem *dem);

/* A new skin, sorting, lists. */
packing_status packing_i_dem_rebuild(packing_dem *dem);

/* Room for particles and for pairs. */
packing_status packing_i_dem_grow(packing_dem *dem, size_t count);
packing_status packing_i_dem_grow_list(packing_dem *dem, size_t entries);
void packing_i_dem_release_arrays(packing_dem *dem);
size_t packing_i_dem_room_bytes(const packing_dem *dem);

/* Around a step; and packing_i_parallel() with as many threads as pay. */
void packing_i_threads_begin(packing_dem *dem);
void packing_i_threads_end(packing_dem *dem);
void packing_i_dem_run(packing_dem *dem, size_t blocks, packing_block_function fn,
                       void *arg);

/* Puts a block of `count` entries in place of the pointer at `block`; its contents are lost. */
packing_status packing_i_dem_renew(packing_dem *dem, void *block, size_t count,
                                   size_t size);

/* Takes all from the store, and checks it. */
packing_status packing_i_dem_load(packing_dem *dem);

/* Writes positions, velocities and spins to the store. */
void packing_i_dem_save(const packing_dem *dem);

/* Forces of all contacts; `tally`: count them, too, into the stepper. */
void packing_i_dem_forces(packing_dem *dem, int tally);

/* Particles that touch walls, for a slab: adds their forces. */
void packing_i_dem_wall_forces(packing_dem *dem, packing_i_slab *slab,
                               packing_i_batch *batch, int tally);

/* Whole vectors are worked on: entries from `count` up to the next multiple of 8 repeat the last
 * one. */
void packing_i_batch_repeat(double *const *columns, size_t width, size_t count);

/* Lets laws add their forces to a batch whose kinematics are there: those of contacts, or `only`.
 * `table` is what pairs of materials index, or the one entry for all; `history` is that of
 * packing_i_history_fetch(). */
void packing_i_dem_apply(const packing_dem *dem, const packing_law *only,
                         const packing_pair_material *table, double *history,
                         packing_i_batch *b);

/* Memory of contacts: made with the laws; what lives is carried over a rebuild, which begins with
 * packing_i_history_carry() and ends with packing_i_history_restore(). */
packing_status packing_i_history_create(packing_dem *dem);
void packing_i_history_release(packing_dem *dem);
size_t packing_i_history_bytes(const packing_dem *dem);
packing_status packing_i_history_carry(packing_dem *dem);
packing_status packing_i_history_restore(packing_dem *dem);

/* The numbers of a batch of contacts of a slab (with walls: of walls), number c of contact k at
 * [c * PACKING_I_ROOM + k], NULL where laws remember nothing; and back. */
double *packing_i_history_fetch(const packing_dem *dem, size_t slab,
                                const packing_i_batch *b, int walls);
void packing_i_history_store(packing_dem *dem, const double *work,
                             const packing_i_batch *b, int walls);

/* Velocities and positions one step on, from the forces. */
void packing_i_dem_integrate(packing_dem *dem);

/* The limit of the step and the advice, from materials, sizes and def; checks dt. */
packing_status packing_i_dem_check_step(packing_dem *dem);

#endif
