/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_PACK_H
#define EXAMPLES_PACK_H

/* A finished pack with all that the writers of files and pictures want to know of it. */

#include "spec.h"

typedef enum colour_by { COLOUR_RADIUS, COLOUR_COMPONENT, COLOUR_HEIGHT } colour_by;

/* "# key: value" lines of a table. */
typedef struct notes {
  const char **keys;
  char **values;
  size_t count;
} notes;

/* Adds a note; the key is borrowed. */
__attribute__((format(printf, 3, 4))) void notes_add(notes *all, const char *key,
                                                     const char *format, ...);
void notes_free(notes *all);

typedef struct pack {
  packing_context *context;
  const domain_spec *spec; /* of kind DOMAIN_NONE where there is no container */
  packing_domain *domain;  /* NULL: the same */
  const char *psd_text;    /* NULL: not asked for */
  packing_psd *psd;        /* NULL: the same */
  packing_view view;
  const packing_bond *bonds; /* pairs of the view's indices, or NULL */
  size_t bond_count;
  double density;         /* of the particles */
  double volume_fraction; /* NaN where unknown */
  colour_by colour;
  const unsigned char
      *marked;       /* not NULL: 1 for particles to be shown in red, all others in
       grey, whatever the colour says */
  const char *title; /* of a sheet of packs; NULL: their number and fractions */
  notes notes;
  const char *report; /* the JSON text */
  const void *own;    /* what a program's own writers want beside */
} pack;

/* The parts of the mixture; without one 1. */
size_t pack_components(const pack *p);

/* The smallest and the largest radius asked for, or else those there are; 0 of none. */
void pack_radii(const pack *p, double *lo, double *hi);

/* Around the container, or else around the particles. */
void pack_bounds(const pack *p, packing_bounds *bounds);

/* Numbers of particle i. */
static inline double pack_number(const packing_column *column, size_t i)
{
  return *(const double *)(const void *)((const char *)column->data + i * column->stride);
}

static inline size_t pack_component(const pack *p, size_t i)
{
  const packing_column *c = &p->view.component;
  if (!c->data)
    return 0;
  const int32_t part =
      *(const int32_t *)(const void *)((const char *)c->data + i * c->stride);
  return part < 0 ? 0 : (size_t)part;
}

static inline packing_vec3 pack_centre(const pack *p, size_t i)
{
  packing_vec3 c = {pack_number(&p->view.x, i), pack_number(&p->view.y, i), 0};
  if (p->view.z.data)
    c.z = pack_number(&p->view.z, i);
  return c;
}

static inline double pack_radius(const pack *p, size_t i)
{
  return pack_number(&p->view.r, i);
}

#endif
