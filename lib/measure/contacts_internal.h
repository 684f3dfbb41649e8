/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_CONTACTS_INTERNAL_H
#define PACKING_CONTACTS_INTERNAL_H

/* The contact network. Contacts are kept in the order of the grid, whose places lie close in
 * memory when particles lie close in space, and are worked out anew whenever they are asked for:
 * the grid holds the centres. */

#include "domain/domain_internal.h"
#include "measure/images.h"
#include "measure/measure_internal.h"
#include <packing/contacts.h>

struct packing_contacts {
  packing_context *context;
  const packing_allocator *allocator;
  packing_domain *domain; /* NULL: none */
  packing_i_images *images;
  const packing_grid *grid; /* that of images */
  double tolerance;
  double gap;
  int dim;
  size_t count; /* of contacts between particles */
  size_t
      *start; /* those that the particle in place p owns: start[p] .. start[p + 1] - 1 */
  uint32_t *other;     /* place of the other particle of each */
  int16_t (*image)[3]; /* of the other particle; NULL: the nearest */
  size_t wall_count;
  size_t wall_places;
  uint32_t *wall_place; /* particles that touch a wall */
};

/* From the particle in place `own` to the image of the other that it touches. */
packing_vec3 packing_i_contacts_vector(const packing_contacts *contacts, size_t own,
                                       size_t contact);

/* The walls that the particle in a place touches. */
int packing_i_contacts_walls(const packing_contacts *contacts, size_t place,
                             packing_i_near_wall near[PACKING_I_NEAR_WALLS]);

/* Contacts with particles of each place. */
void packing_i_contacts_count_degrees(const packing_contacts *contacts, uint32_t *degree);

/* A unit vector, or 0. */
static inline packing_vec3 packing_i_contacts_unit(packing_vec3 d)
{
  const double length = packing_i_norm(d);
  return length > 0 ? packing_i_vec(d.x / length, d.y / length, d.z / length) : d;
}

packing_status packing_i_contacts_check_of(packing_context *context,
                                           packing_contacts_of of);

/* A sum of n n^T: xx, yy, zz, xy, xz, yz. */
typedef struct packing_i_fabric {
  packing_i_sum sum[6];
  size_t count;
} packing_i_fabric;

/* Adds the directions of `count` vectors of one particle, and their number. */
void packing_i_fabric_add(packing_i_fabric *fabric, const double sum[6], size_t count);

/* d d^T / d^2 is added to sum; returns 0 where d is 0. */
static inline size_t packing_i_fabric_direct(double sum[6], packing_vec3 d)
{
  const double square = packing_i_dot(d, d);
  if (!(square > 0))
    return 0;
  const double s = 1.0 / square;
  sum[0] += d.x * d.x * s;
  sum[1] += d.y * d.y * s;
  sum[2] += d.z * d.z * s;
  sum[3] += d.x * d.y * s;
  sum[4] += d.x * d.z * s;
  sum[5] += d.y * d.z * s;
  return 1;
}

/* Sums up the parts in their order and fills all of the report but its size. */
void packing_i_fabric_report(const packing_i_fabric *parts, size_t count, int dim,
                             packing_fabric_report *report);

/* Eigenvalues, falling, and eigenvectors (the rows of `vectors`) of a symmetric matrix, which is
 * destroyed. */
void packing_i_eigen(double matrix[3][3], double values[3], double vectors[3][3]);

#endif
