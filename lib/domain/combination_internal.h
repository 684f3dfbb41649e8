/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_COMBINATION_INTERNAL_H
#define PACKING_COMBINATION_INTERNAL_H

/* Unions, intersections and differences, flattened: the parts are containers that are no
 * combinations themselves, and what lies outside the combination is a formula of "outside part
 * i", "inside part i", and, or. Its value at a point is positive where the point lies outside,
 * and changes no faster than the point moves. */

#include "domain_kinds.h"
#include <packing/solids.h>

/* The deeper branch of a formula stands first, so its stack is no deeper than log2 of the parts,
 * and one. */
enum {
  PACKING_I_PARTS = 64,
  PACKING_I_STEPS = 2 * PACKING_I_PARTS,
  PACKING_I_FORMULA_DEPTH = 8
};

/* A step of the formula, which stands in postfix order. */
typedef enum packing_i_step_kind {
  PACKING_I_STEP_OUTSIDE, /* of part `part` */
  PACKING_I_STEP_INSIDE,
  PACKING_I_STEP_AND,
  PACKING_I_STEP_OR
} packing_i_step_kind;

typedef struct packing_i_step {
  packing_i_step_kind kind;
  int part;
} packing_i_step;

typedef struct packing_i_combination_data {
  packing_allocator allocator;
  packing_domain *a, *b;
  packing_operation operation;
  int meet; /* 0: the bounds of a and b have nothing in common */
  int parts, steps, walls;
  int has_seams; /* 0: the formula is one of "or" alone */
  const packing_i_domain_body *part[PACKING_I_PARTS];
  int first_wall[PACKING_I_PARTS];
  int is_taken[PACKING_I_PARTS]; /* 1: taken away, the formula says "inside" */
  packing_i_step step[PACKING_I_STEPS];
  double blur; /* what rounding may move a wall by [L] */
} packing_i_combination_data;

const packing_i_domain_ops *packing_i_combination_ops(packing_operation operation);

/* What a and b have in common, as a container for packing_i_subdivide_sides() alone. */
void packing_i_shared_part(const packing_domain *a, const packing_domain *b,
                           packing_i_combination_data *data, packing_domain *shared);

/* The least or the most of the values of the parts, as the formula says, positive inside the
 * combination; which part decided. `distance` are those of the parts. */
double packing_i_formula(const packing_i_combination_data *data, const double distance[],
                         int *part);

/* Distances to all parts, positive inside. */
void packing_i_part_distances(const packing_i_combination_data *data,
                              const packing_vec3 *point, double distance[]);

/* The same of what subdivisions ask for. */
void packing_i_part_sides(const packing_i_combination_data *data,
                          const packing_vec3 *point, double distance[]);

/* Whether a wall of part `part` at a point is one of the combination: with it crossed the point
 * is outside, else inside, and neither hangs on rounding. */
int packing_i_is_wall_at(const packing_i_combination_data *data, int part,
                         const packing_vec3 *point);

/* A wall in a cell: what matters lies where normal . (x - centre of the cell) + value <= slack. */
typedef struct packing_i_bound {
  packing_vec3 normal;
  double value, slack;
  double curvature; /* at the centre; 0: a plane */
  int part, wall;   /* of the part; of a polygon the place of the edge */
  int surface;      /* walls of different kinds are never one surface */
  double sign;      /* -1: the part is taken away */
} packing_i_bound;

enum { PACKING_I_BOUNDS = 64, PACKING_I_TERM = 4, PACKING_I_TERMS = 24 };

/* Bounds that hold together; none: the whole cell. */
typedef struct packing_i_term {
  int count;
  int bound[PACKING_I_TERM];
} packing_i_term;

/* Within a cell everything outside the combination lies in one of the terms. */
typedef struct packing_i_cell_view {
  int dim;
  packing_vec3 centre;
  double reach; /* from the centre to the corners */
  double sides; /* the value of the formula at the centre */
  int bounds, terms;
  packing_i_bound bound[PACKING_I_BOUNDS];
  packing_i_term term[PACKING_I_TERMS];
} packing_i_cell_view;

/* The cube of half size `half` round *centre. */
void packing_i_view_cell(const packing_i_combination_data *data, int dim,
                         const packing_vec3 *centre, double half,
                         packing_i_cell_view *view);

/* The distance from a point to what up to all bounds of a term have in common, at least: of two
 * of them at a time. *foot is the nearest point. Infinity: nothing. */
double packing_i_term_distance(const packing_i_cell_view *view,
                               const packing_i_term *term, const packing_vec3 *point,
                               packing_vec3 *foot);

/* Linearises the bounds of a view anew round a point. 0: one of them has no value there. */
int packing_i_move_bounds(const packing_i_combination_data *data,
                          const packing_vec3 *centre, packing_i_cell_view *view,
                          const packing_i_term *term);

/* The distance from a point inside, or on a seam, to the outside: a bound from below, which no
 * cell of space refutes; *foot is a point of the outside near which it is attained, and the
 * function 1 where one was found. `half` is the half size of a cube that reaches outside; where
 * `known` is finite, *foot is a point of the outside at that distance already. Where `limit` is
 * finite the search ends once it is plain on which side of that the distance would come out. */
int packing_i_search(const packing_i_combination_data *data, int dim,
                     const packing_vec3 *point, double half, double known, double limit,
                     double *distance, packing_vec3 *foot);

#endif
