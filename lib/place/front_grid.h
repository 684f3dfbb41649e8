/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_FRONT_GRID_H
#define PACKING_FRONT_GRID_H

/* The space around the front. It is cut into tiles of equal size, and each tile into cells, which
 * hold the spheres. Tiles exist where the front has come, found by hashing, so that memory goes
 * with particles and not with volume; behind the front a tile gives its cells up and keeps the
 * indices of its particles only, from which it is filled again should anything come near. */

#include "front_kernels.h"
#include "place_internal.h"

enum {
  PACKING_I_TILE_AROUND = 27, /* a tile and its neighbours; 13 is itself */
  PACKING_I_TILE_ITSELF = 13,
  PACKING_I_TILE_MOST = 32, /* cells along an edge */
  PACKING_I_LIST_LENGTH = 62,
  PACKING_I_BIN_CHUNK = 2048
};

/* Indices of particles of a tile. */
typedef struct packing_i_front_list {
  uint32_t next, count;
  uint32_t index[PACKING_I_LIST_LENGTH];
} packing_i_front_list;

typedef struct packing_i_front_tile {
  int64_t at[3];   /* in tiles */
  packing_vec3 lo; /* its lowest corner */
  /* First bin of each cell, x fastest, its highest bit set where that has a next; 0: empty. NULL: not
   * resident. */
  uint32_t *cell;
  uint32_t around[PACKING_I_TILE_AROUND]; /* tiles; 0: not made yet */
  uint32_t list;                          /* first list of indices */
  uint32_t pockets;                       /* first pocket at home here; 0: none */
  double next_key;                        /* no pocket with work has a smaller one */
  int pinned;                             /* holds periodic images: never emptied */
  int stays;                              /* levels before it may be emptied */
  int live;                               /* in the list of tiles with pockets */
  int surrounded;                         /* all tiles around are made */
  int judged;                             /* `clear` is known */
  int clear; /* no wall is within reach of any sphere that starts here */
} packing_i_front_tile;

typedef struct packing_i_front_grid {
  const packing_allocator *allocator;
  packing_vec3 origin;
  packing_vec3 edge;          /* of a tile [L] */
  int n[3];                   /* cells along the edges of a tile */
  packing_vec3 per_edge;      /* cells over length */
  packing_i_front_tile *tile; /* [0] is none */
  size_t tiles, tile_room;
  uint32_t *standing; /* tiles that have cells */
  size_t standings, standing_room;
  uint32_t *slot; /* hash table of tiles */
  size_t slots;
  packing_i_front_bin **chunk; /* bins, so many in each; bin 0 is none */
  size_t chunks, chunk_room;
  uint32_t free_bin;
  packing_i_front_list *list; /* [0] is none */
  size_t lists, list_room;
} packing_i_front_grid;

void packing_i_front_grid_init(packing_i_front_grid *grid,
                               const packing_allocator *allocator, packing_vec3 origin,
                               packing_vec3 edge, const int n[3]);
void packing_i_front_grid_release(packing_i_front_grid *grid);

/* In which tile a point lies. */
void packing_i_front_grid_at(const packing_i_front_grid *grid, const packing_vec3 *p,
                             int64_t at[3]);

/* The tile at a place; 0: there is none. */
uint32_t packing_i_front_tile_find(const packing_i_front_grid *grid, const int64_t at[3]);

/* The tile at a place, made when it is not there. 0: out of memory. */
uint32_t packing_i_front_tile_at(packing_i_front_grid *grid, const int64_t at[3]);

/* The same for all tiles around one. */
packing_status packing_i_front_tile_surround(packing_i_front_grid *grid, uint32_t tile);

/* A chunk of bins for the free list; 0: out of memory. */
int packing_i_front_grid_reserve_bins(packing_i_front_grid *grid);

/* Notes a particle of the store in the list of the tile. */
packing_status packing_i_front_tile_note(packing_i_front_grid *grid, uint32_t tile,
                                         uint32_t index);

/* Takes the last note of the tile back. */
void packing_i_front_tile_forget(packing_i_front_grid *grid, uint32_t tile);

/* Adds a sphere to its cell near *tile, taking a bin from *free_bin if need be (which holds
 * one); returns its place, and in *tile the tile of the cell. The tiles around exist. */
uint32_t packing_i_front_grid_insert(packing_i_front_grid *grid, uint32_t *tile,
                                     const packing_vec3 *p, double r, uint32_t *free_bin);

/* Makes the cells of a tile, and fills them from its list. */
packing_status packing_i_front_tile_fill(packing_i_front_grid *grid, uint32_t tile,
                                         const packing_particles *store);

/* Gives the bins and cells of a tile back. */
void packing_i_front_tile_empty(packing_i_front_grid *grid, uint32_t tile);

static inline packing_i_front_bin *
packing_i_front_bin_at(const packing_i_front_grid *grid, uint32_t bin)
{
  return grid->chunk[bin / PACKING_I_BIN_CHUNK] + bin % PACKING_I_BIN_CHUNK;
}

/* A sphere's record by its place. */
static inline packing_i_front_bin *
packing_i_front_bin_of(const packing_i_front_grid *grid, uint32_t place, unsigned *lane)
{
  *lane = place % PACKING_I_FRONT_WIDTH;
  return packing_i_front_bin_at(grid, place / PACKING_I_FRONT_WIDTH);
}

static inline packing_vec3 packing_i_front_centre(const packing_i_front_grid *grid,
                                                  uint32_t place, double *r)
{
  unsigned k;
  const packing_i_front_bin *bin = packing_i_front_bin_of(grid, place, &k);
  *r = bin->r[k];
  return packing_i_vec(bin->x[k], bin->y[k], bin->z[k]);
}

/* Finds all spheres within `reach` (surface) of a centre near `tile`; radii are at most max_r.
 * Returns 0 when the halo has no room for them. */
int packing_i_front_grid_gather(const packing_i_front_grid *grid,
                                const packing_i_front_kernels *kernels, uint32_t tile,
                                const packing_vec3 *centre, double reach, double max_r,
                                packing_i_front_halo *halo);

#endif
