/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_FRONT_PAPER_H
#define PACKING_FRONT_PAPER_H

/* The paper's engine inside: Pseudocode 2. See front_paper.c. */

#include "domain/domain_internal.h"
#include "front_internal.h"
#include "front_paper_list.h"
#include "front_paper_ring.h"
#include "place_index.h"
#include "ranks.h"

/* The next particle of a zone, all but its centre. It stays until it is placed. */
typedef struct packing_i_paper_pending {
  double r; /* 0: none is drawn */
  size_t component;
  double volume;
  double orientation[4];
} packing_i_paper_pending;

/* What a particle of the front offers to the pending one: step 2.2, which may take several
 * steps. */
typedef struct packing_i_paper_scan {
  int selected; /* `at`, `i` and `centre` are set */
  int gathered; /* the rest is */
  size_t at;    /* in the list of the front */
  size_t i;     /* the particle P_i */
  packing_vec3 centre;
  double r_i;
  double room; /* from the centre to the nearest wall */
  size_t zone;
  double r;                    /* of the pending particle */
  double unit;                 /* r_i + r */
  packing_i_index_images near; /* its neighbours; without itself */

  void *rows;                /* one block for the arrays that follow */
  size_t capacity;           /* entries of each */
  packing_i_ring_body *body; /* twice as many: to sort */
  packing_i_rank *rank;      /* twice as many: to sort by */
  packing_i_ring_bound *bound;
  packing_i_ring_end *end;
  uint32_t *outer; /* those that can be P_j, in the order asked */
  uint32_t *inner; /* by a method: those that can be P_k beside it */
  size_t outers, inners;
  size_t bodies;                /* closed forms: entries of `body` */
  packing_i_index_images local; /* near P_j, where P_i has many neighbours */

  packing_i_near_wall wall[PACKING_I_NEAR_WALLS];
  size_t walls;

  size_t next_outer; /* those before are done */
  size_t next_inner;
  int picked;       /* outer[next_outer] is chosen, and `inner` made */
  int picked_inner; /* inner[next_inner] is chosen */
} packing_i_paper_scan;

/* A cell of the container's bounds, to look for walls that no particle touches yet. */
typedef struct packing_i_paper_cell {
  packing_vec3 centre;
  double half;
} packing_i_paper_cell;

enum { PACKING_I_PAPER_CELLS = 512 };

typedef struct packing_i_paper_walk {
  packing_i_paper_cell cell[PACKING_I_PAPER_CELLS]; /* a stack */
  size_t cells;
  int seeded; /* 1: the first particle stands */
} packing_i_paper_walk;

typedef enum packing_i_paper_phase {
  PACKING_I_PAPER_START,
  PACKING_I_PAPER_WALLS, /* inward, step 3: one of the bodies touched is a wall */
  PACKING_I_PAPER_INSIDE
} packing_i_paper_phase;

/* How far the search is for what an outward front did not get to. */
typedef enum packing_i_paper_again {
  PACKING_I_PAPER_AGAIN_LATER,
  PACKING_I_PAPER_AGAIN_GROUPS, /* room for a first group */
  PACKING_I_PAPER_AGAIN_WALLS,  /* room for a particle far from all */
  PACKING_I_PAPER_AGAIN_NEVER
} packing_i_paper_again;

typedef struct packing_i_paper {
  packing_i_front front;
  packing_front_direction direction;
  packing_front_select select_neighbours;
  packing_contact_method contact;
  packing_contact_method wall_contact; /* exact */
  int closed_form;                     /* spheres by wrappers */
  packing_shape *shape;
  packing_i_stream choice; /* which particle, neighbour and place */
  packing_i_stream turns;  /* orientations */
  packing_i_index index;
  packing_i_front_list list;
  packing_i_paper_pending *pending; /* of each zone */
  unsigned char *seen;              /* zones: 1 to be tried, 2 tried */
  size_t zones;
  packing_i_paper_phase phase;
  packing_i_paper_scan scan;
  packing_i_paper_walk walk;
  packing_i_paper_pending first[4]; /* of a group being tried, of the zone below */
  size_t firsts, first_zone;
  packing_i_paper_again again;
  size_t before;   /* particles that stood in the store */
  double rounding; /* unit of the container's coordinates */
  uint64_t work;   /* done in this step, in some 10 ns */
} packing_i_paper;

/* The gap between two particles that counts as none, either way. */
static inline double packing_i_paper_slack(const packing_i_paper *paper, double r,
                                           double other_r)
{
  const double share = 5e-13 * (r < other_r ? r : other_r);
  return share > 2 * paper->rounding ? share : 2 * paper->rounding;
}

/* Answers of a scan. */
typedef enum packing_i_paper_answer {
  PACKING_I_PAPER_GOING,
  PACKING_I_PAPER_PLACED,
  PACKING_I_PAPER_NOWHERE
} packing_i_paper_answer;

/* Whether a particle would overlap its own periodic image. */
int packing_i_paper_meets_itself(const packing_placer *placer, double r);

/* Draws a particle, if one is still asked for after those of the tally; 0: none is, and r is 0. */
int packing_i_paper_draw(packing_placer *placer, size_t zone,
                         const packing_placer_report *tally,
                         packing_i_paper_pending *pending);

/* The pending particle of a zone, drawn when there is none; NULL: no more is asked for, the run has
 * ended. */
packing_i_paper_pending *packing_i_paper_next(packing_placer *placer, size_t zone);

/* Room for `count` particles of radius up to r: then packing_i_paper_put() cannot fail. */
packing_status packing_i_paper_reserve(packing_placer *placer, size_t count, double r);

/* Places the pending particle of a zone, adds it to the front. */
void packing_i_paper_put(packing_placer *placer, packing_vec3 centre, size_t zone);

/* The pending particle as a body. */
packing_body packing_i_paper_mobile(const packing_i_paper *paper, size_t zone,
                                    packing_vec3 centre);

/* A particle of the store as a body, at a centre that may be that of an image. */
packing_body packing_i_paper_body(const packing_placer *placer, size_t particle,
                                  packing_vec3 centre);

/* Whether the particle lies inside the container, and its centre in its zone. */
int packing_i_paper_inside(const packing_placer *placer, const packing_body *mobile,
                           size_t zone);

/* Whether the particle is free of all that stand. PACKING_ERR_NOMEM is the only failure. */
packing_status packing_i_paper_free(const packing_placer *placer,
                                    const packing_body *mobile,
                                    packing_i_index_images *near, int *is_free);

/* Room for `count` neighbours in the arrays of the scan; but for `outer`, what they hold is
 * lost. */
packing_status packing_i_paper_rows(const packing_placer *placer, size_t count);

enum { PACKING_I_PAPER_FEW = 96 }; /* neighbours all looked at for each P_j */

/* Sorts by r, equal ones in the order they had; r > 0 of more than a few. Memory for twice as many
 * ranks is there. */
void packing_i_paper_sort(packing_i_rank *rank, size_t count);

/* Fills `order` with [0, count), those first whose particle is to be taken first;
 * random: as they are. */
void packing_i_paper_order(packing_i_paper *paper, uint32_t *order, size_t count,
                           size_t (*particle)(const packing_i_paper_scan *scan,
                                              size_t entry));

/* Brings the entry to be taken next to `at`, of `count`. */
void packing_i_paper_pick(packing_i_paper *paper, uint32_t *order, size_t at,
                          size_t count);

/* Whether the neighbours gathered, not all there are, leave no place beside P_i already. */
packing_status packing_i_paper_rings_closed(packing_placer *placer, int *closed);

/* Steps 2.2 and 2.2.1 for spheres, in closed form. */
packing_status packing_i_paper_rings_begin(packing_placer *placer);
packing_status packing_i_paper_rings(packing_placer *placer,
                                     packing_i_paper_answer *answer);

/* The same by a contact method, for any shape, and with walls. */
packing_status packing_i_paper_pairs_begin(packing_placer *placer);
packing_status packing_i_paper_pairs(packing_placer *placer,
                                     packing_i_paper_answer *answer);

/* A sphere's centre near x from which the sphere touches up to three bodies, spheres and walls, by
 * the shortest steps; 0: none was found. */
int packing_i_paper_settle(const packing_i_paper *paper, double r,
                           const packing_body *body, size_t bodies, packing_vec3 *x);

/* A place beside P_i where there are not enough neighbours to touch. */
packing_status packing_i_paper_loose(packing_placer *placer,
                                     packing_i_paper_answer *answer);

/* Step 1, outward. *started 0: there is no room for it. On failure nothing has happened. */
packing_status packing_i_paper_start_outward(packing_placer *placer, int *started);

/* Step 1 once more: a group with the mean of its centres at a point; *room 0: there is none, what
 * was drawn is the next to be drawn again. On failure nothing has happened. */
packing_status packing_i_paper_start_at(packing_placer *placer, packing_vec3 at,
                                        int *room);

/* What is to be done when an outward front has run out. */
typedef enum packing_i_paper_search {
  PACKING_I_PAPER_SEARCHING, /* go on; perhaps there is a new front */
  PACKING_I_PAPER_AT_WALLS,  /* the walls are to be begun with */
  PACKING_I_PAPER_FULL
} packing_i_paper_search;

/* Looks into one more cell for a part of the container that the front did not get to. */
packing_status packing_i_paper_look(packing_placer *placer,
                                    packing_i_paper_search *search);

/* How far below an open top a point lies; infinity: there is none. */
double packing_i_paper_below_top(const packing_domain *domain, packing_vec3 p);

/* Parts a cell of the walk, the top of its stack; the lowest part is looked at first. */
void packing_i_paper_divide(packing_i_paper_walk *walk, int dim);

/* From the centre of a cell to its corners. */
double packing_i_paper_cell_reach(const packing_i_paper_cell *cell, int dim);

/* Whether a cell meets the bounds of the container. */
int packing_i_paper_cell_counts(const packing_placer *placer,
                                const packing_i_paper_cell *cell);

/* Step 1, inward, and the rest of the walls that the front did not reach: looks into one more
 * cell. *over 1: there is none left. */
void packing_i_paper_walk_begin(packing_placer *placer);
packing_status packing_i_paper_walk_on(packing_placer *placer, int *over);

#endif
