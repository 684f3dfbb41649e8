/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_WRITERS_INTERNAL_H
#define PACKING_WRITERS_INTERNAL_H

/* What the formats behind packing_write_pack() share. A format is one file with one descriptor
 * and one line in the table of write_formats.c; it gets a pack whose every field was checked. */

#include "io_internal.h"
#include "view.h"
#include <packing/writers.h>

/* A pack to be written. */
typedef struct packing_i_pack {
  packing_write_def
      def; /* domain, bonds and texts are the caller's; periodic is resolved */
  packing_deck_def deck; /* decks only: no name is NULL, `down` is a unit vector */
  packing_view view;
  packing_bounds box; /* of formats that need one */
} packing_i_pack;

/* What is to be made ready for a format. */
typedef enum packing_i_write_needs {
  PACKING_I_NEEDS_NOTHING = 0,
  PACKING_I_NEEDS_BOX = 1,
  PACKING_I_NEEDS_DECK = 2, /* and types of 1 and above */
  PACKING_I_NEEDS_IDS = 4   /* different, 0 .. 2^31 - 1 */
} packing_i_write_needs;

typedef struct packing_i_write_format {
  packing_write_format about;
  unsigned needs; /* a sum of packing_i_write_needs */
  packing_status (*write)(packing_context *context, const packing_i_pack *pack,
                          const packing_stream *stream);
} packing_i_write_format;

extern const packing_i_write_format packing_i_write_csv;
extern const packing_i_write_format packing_i_write_vtp;
extern const packing_i_write_format packing_i_write_vtu;
extern const packing_i_write_format packing_i_write_lammps;
extern const packing_i_write_format packing_i_write_lammps_deck;
extern const packing_i_write_format packing_i_write_dump;
extern const packing_i_write_format packing_i_write_liggghts;
extern const packing_i_write_format packing_i_write_liggghts_deck;
extern const packing_i_write_format packing_i_write_yade;
extern const packing_i_write_format packing_i_write_yade_pack;
extern const packing_i_write_format packing_i_write_geo;
extern const packing_i_write_format packing_i_write_xyz;
extern const packing_i_write_format packing_i_write_pov;
extern const packing_i_write_format packing_i_write_stl;
extern const packing_i_write_format packing_i_write_stl_ascii;
extern const packing_i_write_format packing_i_write_pfc;
extern const packing_i_write_format packing_i_write_neper_coo;
extern const packing_i_write_format packing_i_write_neper_weight;
extern const packing_i_write_format packing_i_write_mercury;

/* All of them, NULL at the end (write_formats.c). */
extern const packing_i_write_format *const packing_i_write_formats[];

/* The title, or ours, without an end of line. */
void packing_i_put_title(packing_i_writer *w, const packing_i_pack *pack);
void packing_i_put_vec(packing_i_writer *w, char separator, packing_vec3 v);
/* x, y, z and r, each behind a separator but the first. */
void packing_i_put_sphere(packing_i_writer *w, char separator, const packing_view *view,
                          size_t i);

/* Texts of one line. */
packing_status packing_i_check_line(packing_context *context, const char *field,
                                    const char *text);

/* The container as triangles (mesh.c): corners counter-clockwise seen from outside the
 * container. `facets` pieces of a full circle. */
typedef void (*packing_i_triangle_function)(void *user, const packing_vec3 corner[3]);
int packing_i_mesh_exists(const packing_domain *domain);
packing_status packing_i_mesh_check_facets(packing_context *context, unsigned facets);
/* Refuses what has no mesh, and NULL. */
packing_status packing_i_mesh_check(packing_context *context,
                                    const packing_domain *domain, unsigned facets);
void packing_i_mesh_visit(const packing_domain *domain, unsigned facets,
                          packing_i_triangle_function visit, void *user);

/* A container's walls one by one, each taken as far as its surface goes on (walls.c). */
typedef enum packing_i_surface_kind {
  PACKING_I_SURFACE_PLANE,    /* across `axis` at `position`, the inside above or below */
  PACKING_I_SURFACE_CYLINDER, /* about `axis` through `centre`, of `radius` */
  PACKING_I_SURFACE_CONE,     /* the same, radius[k] at height[k] */
  PACKING_I_SURFACE_SPHERE    /* round `centre`, of `radius` */
} packing_i_surface_kind;

typedef struct packing_i_surface {
  packing_i_surface_kind kind;
  int axis;
  int outside; /* 1: the container is outside a cylinder, cone; below a plane */
  double position;
  packing_vec3 centre;
  double radius[2], height[2]; /* of a cone; of cylinder and sphere radius[0] */
} packing_i_surface;

enum { PACKING_I_SURFACES = 6 };

/* The walls of the pack's container, or of its box where it has none. Cones go on by `margin`
 * beyond the container, if they do not end before. */
packing_status packing_i_surfaces(packing_context *context, const packing_i_pack *pack,
                                  double margin,
                                  packing_i_surface surfaces[PACKING_I_SURFACES],
                                  int *count);

/* What both decks share (write_deck.c). */
packing_status packing_i_deck_read(packing_context *context, packing_i_pack *pack);
int32_t packing_i_largest_type(const packing_view *view);
double packing_i_deck_timestep(const packing_i_pack *pack);
void packing_i_put_deck_head(packing_i_writer *w, const packing_i_pack *pack,
                             const char *command, const char *atom_style);
void packing_i_put_deck_gravity(packing_i_writer *w, const packing_i_pack *pack);
void packing_i_put_deck_run(packing_i_writer *w, const packing_i_pack *pack);

#endif
