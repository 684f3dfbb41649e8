/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_FRONT_POCKETS_H
#define PACKING_FRONT_POCKETS_H

/* The pocket front, modes fast and dense.
 *
 * A pocket is a triple of bodies, one of them a sphere (its owner), on one side, with the
 * interval of radii of the particles that touch all three and overlap nothing. Pockets are made
 * when a sphere is placed, shrink as others come, and are filled best match first: the pocket
 * whose largest fitting radius in the stock leaves the least room.
 *
 * Space is cut into tiles (front_grid.h). Work goes in rounds: tiles of one of eight colours,
 * far enough apart not to touch the same spheres, are shared out among lanes, which have stocks
 * and memory of their own; then what the lanes did is put together in the order of the lanes.
 * The lanes do not depend on the threads, so neither does the pack. */

#include "front_grid.h"
#include "front_internal.h"

#define PACKING_I_FRONT_WALL UINT32_C(0x80000000)

enum {
  PACKING_I_LANES = 8,
  PACKING_I_LANE_QUOTA = 32, /* particles a lane places in a round */
  PACKING_I_POCKETS_SPARE =
      2048, /* pockets one particle may make, and walls its images */
  PACKING_I_BINS_SPARE = 64,
  PACKING_I_FRONT_PLANE = 0x7fffffff, /* wall number of the plane of discs */
  PACKING_I_POCKET_CHUNK = 4096,
  PACKING_I_FRONT_RATIO = 4,
  PACKING_I_POCKET_TRIES = 4,   /* times a curved wall may move a pocket */
  PACKING_I_FRONT_IMAGES = 125, /* of one sphere, in the smallest cell */
  PACKING_I_SEARCH_LEVELS = 60
};

/* Whether a body of a halo or pocket is a wall of the container. */
static inline int packing_i_front_is_wall(uint32_t id)
{
  return (id & PACKING_I_FRONT_WALL) != 0 &&
         id != (PACKING_I_FRONT_WALL | PACKING_I_FRONT_PLANE);
}

/* Three lines of cache; the first tells whether the others matter. */
typedef struct packing_i_pocket {
  float middle
      [3]; /* of a ball about all particles that count, from the owner's centre, in units */
  float extent;   /* its radius, in units */
  double key;     /* where in the order of growth */
  uint32_t owner; /* place of the sphere */
  uint32_t j, k;  /* places, or walls */
  uint32_t next;  /* of the owner */
  uint32_t home;  /* tile in whose list it is */
  uint32_t home_next;
  uint32_t version;
  float most; /* the largest radius that may fill it, in units */
  uint16_t zone;
  int8_t side;
  uint8_t alive;
  uint8_t walls; /* a wall is near */
  uint8_t tries;
  packing_i_front_curve curve;
  double lo;
  double exit[3];
} packing_i_pocket;

/* What a lane placed in a round. */
typedef struct packing_i_front_placed {
  packing_vec3 centre;
  double r;
  size_t component;
  uint32_t place;
  uint32_t tile; /* that holds it */
  int image;     /* of the one before that is none */
} packing_i_front_placed;

/* A sphere or periodic image of it, and a tile near it. */
typedef struct packing_i_front_image {
  packing_vec3 centre;
  uint32_t tile;
} packing_i_front_image;

typedef struct packing_i_front_entry {
  double score;
  uint32_t pocket;
  uint32_t version;
} packing_i_front_entry;

typedef struct packing_i_front_lane {
  packing_i_source *source;
  uint32_t free_pocket;
  size_t free_pockets;
  uint32_t free_bin;
  size_t free_bins;
  packing_i_front_halo halo;
  packing_i_front_caps caps;
  packing_i_front_candidates candidates;
  packing_i_front_curves curves;
  uint32_t *curve_pocket; /* whose curves they are */
  size_t curve_room;
  packing_i_front_entry *heap;
  size_t heap_count, heap_room;
  packing_i_front_placed *placed;
  size_t placed_count, placed_room;
  size_t collected; /* of them, taken over already */
  size_t particles; /* of them, images not counted */
  double volume;    /* theirs */
  uint32_t *outbox; /* new pockets at home in other tiles */
  size_t outbox_count, outbox_room;
  size_t delivered;   /* of them, brought home already */
  size_t quota;       /* this round */
  double volume_left; /* this round; infinite: no limit */
  uint32_t at_work;   /* the tile being worked on */
  uint32_t *todo;     /* tiles of this round */
  size_t todo_count, todo_room;
  size_t todo_next; /* the first that is not finished */
  int resumes;      /* the heap is that of this tile, left in the middle */
  int starved;      /* stopped for want of memory; 2: of a larger halo */
  int met;          /* the volume asked is reached */
  uint64_t attempts;
  void *block; /* all the arrays above */
} packing_i_front_lane;

/* 2^level tiles along each axis. */
typedef struct packing_i_front_block {
  int64_t at[3]; /* the lowest tile */
  int level;
} packing_i_front_block;

/* Where the search for places is (front_search.c). */
typedef struct packing_i_front_search {
  packing_i_front_block block[7 * PACKING_I_SEARCH_LEVELS + 1];
  size_t blocks;             /* 0: it is over */
  int64_t first[3], last[3]; /* tiles of the container */
  int cell;                  /* of the tile on top that comes next */
  int at_walls;              /* only places at walls */
} packing_i_front_search;

typedef struct packing_i_pockets {
  packing_i_front front; /* the head; its source is lane 0's */
  const packing_i_front_kernels *kernels;
  packing_placer *placer;
  packing_domain *domain;
  int dim;
  unsigned periodic;
  packing_bounds bounds;
  packing_vec3 period;
  int open_axis; /* of an open top; -1: none */
  int inward;

  /* lengths */
  double min_r, max_r, mean_r, reference_r;
  double unit, per_unit; /* a power of two near max_r: single precision counts in it */
  double cap;    /* exits count up to this times the largest radius of the pocket [1] */
  double body_r; /* largest radius there is or may be */
  double most_r; /* half the shortest period: larger ones meet themselves */
  double slack;  /* of rooms, in area */
  double touch;  /* overlap that is rounding */
  int curved;    /* walls are not flat */
  int wide;  /* sizes so different that small spheres do not see all that large ones do */
  int equal; /* one size */

  /* weights of the score */
  double second, third, order, balance;
  size_t litter; /* pockets a sphere may have at its birth */
  int exits;     /* how many of a pocket's exits count */

  double level, level_step;
  int colour;
  int idle_colours; /* in a row, of this level */
  int colours;
  size_t active;  /* lanes at work in this round */
  int owed;       /* what the lanes did is not taken over yet */
  uint32_t *live; /* tiles with pockets */
  size_t live_count, live_room;

  packing_i_front_grid grid;
  packing_i_pocket **chunk; /* pockets, so many in each; pocket 0 is none */
  size_t chunks, chunk_room;
  uint32_t free_pocket;
  size_t free_pockets;

  packing_i_front_lane *lane;
  size_t lanes;
  size_t halo_room;
  uint32_t ready;  /* a tile that is prepared; 0: none is known to be */
  size_t youngest; /* particles there were when the last of them was tried */
  size_t oldest;   /* the next to be tried in their order */
  int reseeds;     /* tried in vain, in a row */
  packing_i_front_search search;
  packing_i_stream turns; /* of the first group */
} packing_i_pockets;

static inline packing_i_pocket *packing_i_pocket_at(const packing_i_pockets *p,
                                                    uint32_t id)
{
  return p->chunk[id / PACKING_I_POCKET_CHUNK] + id % PACKING_I_POCKET_CHUNK;
}

/* The largest radius that the pockets of a sphere of radius r are made for: looking farther costs
 * the cube of the ratio. Larger particles come into pockets of larger spheres. */
static inline double packing_i_front_most(const packing_i_pockets *p, double r)
{
  return PACKING_I_FRONT_RATIO * r < p->max_r ? PACKING_I_FRONT_RATIO * r : p->max_r;
}

/* The largest radius that may fill a pocket. */
static inline double packing_i_pocket_most(const packing_i_pockets *p,
                                           const packing_i_pocket *pocket)
{
  return (double)pocket->most * p->unit;
}

/* ---- front_lane.c: memory of the lanes ---- */

packing_status packing_i_lane_init(packing_i_pockets *p, packing_i_front_lane *lane,
                                   size_t halo_room);
void packing_i_lane_release(packing_i_pockets *p, packing_i_front_lane *lane);
/* Fills the lane's free lists. */
packing_status packing_i_lane_stock_up(packing_i_pockets *p, packing_i_front_lane *lane);

/* ---- front_walls.c ---- */

/* The wall *number as a body about `origin`, as seen from the point c relative to it, where it is
 * touched by a particle of radius r. Where surfaces are made of many walls another one may have
 * taken its place there: that whose distance is nearest r. 0: no wall is near. */
int packing_i_front_wall_body(const packing_i_pockets *p, const packing_vec3 *origin,
                              packing_vec3 c, double r, uint32_t *number,
                              packing_i_front_body *body);
/* Adds the walls near origin + c to the halo. Returns 0 when there is no room. */
int packing_i_front_walls_gather(const packing_i_pockets *p, const packing_vec3 *origin,
                                 packing_vec3 c, double reach,
                                 packing_i_front_halo *halo);
/* Whether the domain holds a ball, rounding forgiven. */
int packing_i_front_holds(const packing_i_pockets *p, const packing_vec3 *c, double r);

/* ---- front_birth.c: pockets that come with a sphere ---- */

/* Makes the pockets of a sphere that stands in the grid at `place` near `tile`; lane->halo holds
 * the spheres around it. Pockets at home elsewhere than where the lane is at work go to the
 * outbox. */
void packing_i_pockets_born(packing_i_pockets *p, packing_i_front_lane *lane,
                            uint32_t tile, uint32_t place, const packing_vec3 *centre,
                            double r);

/* ---- front_shrink.c: pockets that a new sphere changes ---- */

/* lane->halo holds the spheres around the new one, of radius r. */
void packing_i_pockets_shrink(packing_i_pockets *p, packing_i_front_lane *lane, double r);

/* ---- front_choice.c ---- */

/* The score of a pocket with the lane's stock: smaller is better, infinite when nothing fits. */
double packing_i_pocket_score(const packing_i_pockets *p, packing_i_front_lane *lane,
                              const packing_i_pocket *pocket, size_t *index);
/* Puts a pocket into the lane's heap if it is due and fits; leaves it out when the heap is full:
 * the next visit finds it. */
void packing_i_pocket_offer(packing_i_pockets *p, packing_i_front_lane *lane,
                            uint32_t id);
/* The best pocket; 0: none. */
uint32_t packing_i_pocket_best(packing_i_pockets *p, packing_i_front_lane *lane,
                               size_t *index);

/* ---- front_place.c ---- */

/* Fills a pocket with radius `index` of the stock, or drops it. 0: the lane is starved. */
int packing_i_pocket_fill(packing_i_pockets *p, packing_i_front_lane *lane, uint32_t tile,
                          uint32_t id, size_t index);
/* Puts a sphere near `tile` where it is known to be free: grid, pockets, what the lane placed.
 * The lane has the room for it. 0: starved, and nothing is done. */
int packing_i_front_put(packing_i_pockets *p, packing_i_front_lane *lane, uint32_t tile,
                        const packing_vec3 *centre, double r, size_t component);
/* Whether the lane has room for one more particle and `images` images. */
int packing_i_front_has_room(const packing_i_front_lane *lane, size_t images);
/* Computes the ball about the particles of a pocket. */
void packing_i_pocket_measure(const packing_i_pockets *p, packing_i_pocket *pocket);
/* Takes a pocket out of its owner's list; its tile frees it. */
void packing_i_pocket_kill(packing_i_pockets *p, uint32_t id);

/* ---- front_images.c ---- */

/* A sphere near `tile` and all its periodic images that matter, itself (wrapped) first; returns
 * how many. */
size_t packing_i_front_images(const packing_i_pockets *p, uint32_t tile,
                              const packing_vec3 *centre,
                              packing_i_front_image image[PACKING_I_FRONT_IMAGES]);
/* Makes the tiles that images of spheres near `tile` may fall into. */
packing_status packing_i_front_prepare_images(packing_i_pockets *p, uint32_t tile);

/* ---- front_seed.c ---- */

/* Enters the particles of the store. */
packing_status packing_i_front_enter_store(packing_i_pockets *p);
/* Places the first particles, until there are pockets or nothing more can be placed. */
packing_status packing_i_front_seed(packing_i_pockets *p);
/* No pocket is left: places a particle beside one that stands, where there is room. *go_on: there
 * may be more to do. */
packing_status packing_i_front_reseed(packing_i_pockets *p, int *go_on);
/* Whether a sphere has room at c, which may be anywhere. */
packing_status packing_i_front_is_free(packing_i_pockets *p, const packing_vec3 *c,
                                       double r, int *free);
/* Three discs or four spheres about the innermost point; *placed tells whether they had room. */
packing_status packing_i_front_seed_group(packing_i_pockets *p, int *placed);
/* Puts radius r, which the stock of the zone holds, at c if it has room there; *placed tells. */
packing_status packing_i_front_seed_at(packing_i_pockets *p, const packing_vec3 *c,
                                       double r, size_t zone, int *placed);
/* Puts particles beside the last one until there are pockets or none has room. */
packing_status packing_i_front_seed_beside(packing_i_pockets *p);

/* ---- front_search.c ---- */

/* Starts to look for places that the front did not reach, maybe only those at walls. */
void packing_i_front_search_begin(packing_i_pockets *p, int at_walls);
/* Goes on for a while; *placed: the front begins anew. */
packing_status packing_i_front_search_on(packing_i_pockets *p, int *placed);

/* ---- front_round.c ---- */

/* One round; *done when there is nothing left to do. */
packing_status packing_i_front_round(packing_i_pockets *p, int *done);
/* Makes a tile and those around it ready to be worked on, images included. */
packing_status packing_i_front_prepare(packing_i_pockets *p, uint32_t tile);
/* Makes the tiles around one, and fills them. */
packing_status packing_i_front_prepare_tile(packing_i_pockets *p, uint32_t tile);
/* Takes over what a lane did; `stored`: its particle is index stored - 1 of the store, 0: its
 * particles are new. */
packing_status packing_i_front_collect(packing_i_pockets *p, packing_i_front_lane *lane,
                                       size_t stored);

/* Where a point is in the order of growth. */
double packing_i_front_key(const packing_i_pockets *p, const packing_vec3 *c);

#endif
