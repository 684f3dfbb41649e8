/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_SECTION_INTERNAL_H
#define PACKING_SECTION_INTERNAL_H

/* Sections as images and series of them need them. */

#include "measure/porosity_internal.h"

typedef struct packing_i_section {
  const packing_domain *domain;
  const packing_view *view;
  packing_i_plane plane;
  double tolerance;
} packing_i_section;

/* Reads and checks a plane, a domain and a view. */
packing_status packing_i_section_begin(packing_context *context,
                                       const packing_section_def *def,
                                       const packing_domain *domain,
                                       const packing_view *view, packing_view *copy,
                                       packing_i_section *section);

/* Fills everything but the struct's size, and at most `capacity` discs. */
packing_status packing_i_section_measure(packing_context *context,
                                         const packing_i_section *section,
                                         packing_section_disc *discs, size_t capacity,
                                         size_t *count, packing_section_report *report);

#endif
