/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_RSA_CELLS_H
#define PACKING_RSA_CELLS_H

/* Cells over the region of centres, for particles of one radius: edge at least a diameter, so
 * that all that a new particle can touch is in 27 cells. Chains of 32-byte records: a dart reads
 * about 9 lines of cell heads and one record per neighbour. */

#include "place_internal.h"

typedef struct packing_i_rsa_record {
  double x, y, z;
  uint32_t next; /* index + 1 of the next record of the cell; 0: none */
  uint32_t cell;
} packing_i_rsa_record;

typedef struct packing_i_rsa_cells {
  packing_vec3 lo;       /* the region of centres begins here */
  packing_vec3 width;    /* and is so wide; 0 along z in two dimensions */
  packing_vec3 edge;     /* of a cell */
  packing_vec3 per_edge; /* 1 / edge, 0 where the region is flat */
  packing_vec3 period;   /* of the domain, 0 where not periodic */
  uint32_t n[3];         /* cells */
  double per_layer;      /* 1 / n[1]: rows to layers */
  double diameter;
  double diameter2;
  uint32_t *head; /* per cell: index + 1 of its first record; 0: empty */
  packing_i_rsa_record *record;
  size_t count;
  size_t capacity;
} packing_i_rsa_cells;

/* `expected` particles bound the number of cells, whatever the volume; 0: unknown. */
packing_status packing_i_rsa_cells_init(packing_i_rsa_cells *cells,
                                        packing_context *context,
                                        const packing_domain *domain, double r,
                                        size_t expected);
void packing_i_rsa_cells_release(packing_i_rsa_cells *cells, packing_context *context);

/* Makes room for one more record. */
packing_status packing_i_rsa_cells_reserve(packing_i_rsa_cells *cells,
                                           packing_context *context, size_t capacity);

/* The cell of a point; points outside the region go to the nearest. */
static inline uint32_t packing_i_rsa_cell_along(double x, double lo, double per_edge,
                                                uint32_t n)
{
  const double at = (x - lo) * per_edge;
  if (!(at > 0))
    return 0;
  return at < (double)n ? (uint32_t)at : n - 1;
}

static inline void packing_i_rsa_cells_locate(const packing_i_rsa_cells *c,
                                              packing_vec3 p, uint32_t at[3])
{
  at[0] = packing_i_rsa_cell_along(p.x, c->lo.x, c->per_edge.x, c->n[0]);
  at[1] = packing_i_rsa_cell_along(p.y, c->lo.y, c->per_edge.y, c->n[1]);
  at[2] = packing_i_rsa_cell_along(p.z, c->lo.z, c->per_edge.z, c->n[2]);
}

static inline uint32_t packing_i_rsa_cell_at(const packing_i_rsa_cells *c,
                                             const uint32_t at[3])
{
  return (at[2] * c->n[1] + at[1]) * c->n[0] + at[0];
}

static inline uint32_t packing_i_rsa_cell_of(const packing_i_rsa_cells *c, packing_vec3 p)
{
  uint32_t at[3];
  packing_i_rsa_cells_locate(c, p, at);
  return packing_i_rsa_cell_at(c, at);
}

/* Adds a centre; room was reserved. */
void packing_i_rsa_cells_insert(packing_i_rsa_cells *cells, packing_vec3 p);

/* Whether a particle at p would overlap none. */
int packing_i_rsa_cells_free(const packing_i_rsa_cells *cells, packing_vec3 p);

/* Away from the borders the cells around a cell are rows of three, without shifts. */
static inline int packing_i_rsa_cells_is_inner(const packing_i_rsa_cells *c,
                                               const uint32_t at[3])
{
  return at[0] > 0 && at[1] > 0 && at[2] > 0 && at[0] + 1 < c->n[0] &&
         at[1] + 1 < c->n[1] && at[2] + 1 < c->n[2];
}

/* Collects the heads above `least` (0: of all cells that are not empty) of an inner cell and the
 * cells around it. Without branches, which half-empty cells
 * would mislead. Returns how many. */
static inline size_t packing_i_rsa_cells_heads(const packing_i_rsa_cells *c,
                                               uint32_t cell, uint32_t least,
                                               uint32_t list[28])
{
  const size_t row = c->n[0], layer = (size_t)c->n[0] * c->n[1];
  const uint32_t *first = c->head + (cell - layer - row - 1);
  size_t count = 0;
  for (size_t k = 0; k < 3; k++)
    for (size_t j = 0; j < 3; j++) {
      const uint32_t *head = first + k * layer + j * row;
      for (size_t i = 0; i < 3; i++) {
        list[count] = head[i];
        count += list[count] > least;
      }
    }
  return count;
}

/* Has the heads of the nine rows of cells around a point fetched; addresses beyond the array do no
 * harm. */
static inline void packing_i_rsa_cells_fetch(const packing_i_rsa_cells *c, packing_vec3 p)
{
  const uintptr_t row = c->n[0] * sizeof *c->head, layer = row * c->n[1];
  const uintptr_t first =
      (uintptr_t)(c->head + packing_i_rsa_cell_of(c, p)) - layer - row;
  for (uintptr_t k = 0; k < 3; k++)
    for (uintptr_t j = 0; j < 3; j++)
      __builtin_prefetch((const void *)(first + k * layer + j * row));
}

/* One of the up to 27 cells around a cell, with the shift that moves its records next to it. */
typedef struct packing_i_rsa_near {
  uint32_t cell;
  packing_vec3 shift;
} packing_i_rsa_near;

/* Lists the cells around a cell, itself first; returns how many. */
size_t packing_i_rsa_cells_around(const packing_i_rsa_cells *cells, uint32_t cell,
                                  packing_i_rsa_near around[27]);

#endif
