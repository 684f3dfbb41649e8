/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Planar sections: the discs that a plane cuts out of the particles, and the areal porosity.
 *
 * Seed 001, equation 12: the binary occupation ratio of a section is BOR = black / (black +
 * white), where black is void: the areal porosity. Here it comes from areas, each disc cut
 * exactly at the container's section (domain/section.c), rather than from the pixels of a
 * picture (section_image.c). Its mean over all parallel sections, weighed by their areas, is
 * the porosity (Cavalieri, Delesse). Blocks of particles are gone through twice, to count and to
 * write. Linear in the particles. */
#include "measure/section_internal.h"

typedef struct part {
  packing_i_sum area;
  packing_i_sum error;
  size_t discs;
  int broken;
} part;

typedef struct work {
  const packing_i_section *section;
  part *parts;                 /* of each block */
  packing_section_disc *discs; /* NULL: only counting */
  size_t capacity;
} work;

void packing_section_def_fill(packing_section_def *def, size_t size)
{
  packing_section_def defaults = {0};
  defaults.normal.z = 1;
  defaults.tolerance = 1e-10;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

/* A ball wholly within the region, and the cell, has its disc there too. */
static int is_whole(const packing_domain *domain, packing_vec3 at, double r)
{
  const packing_i_domain_body *body = &domain->body;
  for (int k = 0; k < 3; k++) {
    const double x = packing_i_component(at, k);
    if (x - packing_i_component(body->bounds.lo, k) < r ||
        packing_i_component(body->bounds.hi, k) - x < r)
      return 0;
  }
  return packing_i_domain_keeps_whole(domain, &at, r);
}

/* 1: an image of particle i leaves a disc in the section. */
static int cut_image(const packing_i_section *s, packing_vec3 at, double r, part *p,
                     packing_section_disc *disc)
{
  const packing_vec3 from_origin = packing_i_sub(at, s->plane.origin);
  const double d = packing_i_dot(from_origin, s->plane.normal);
  double error = 0;
  if (!(fabs(d) < r))
    return 0;
  disc->u = packing_i_dot(from_origin, s->plane.u_axis);
  disc->v = packing_i_dot(from_origin, s->plane.v_axis);
  disc->r = sqrt((r - d) * (r + d));
  disc->area = packing_i_ball_volume(2, disc->r);
  if (!is_whole(s->domain, at, r) &&
      packing_i_domain_section_area(s->domain, &s->plane, disc->u, disc->v, disc->r,
                                    s->tolerance, &disc->area, &error))
    p->broken = 1;
  packing_i_sum_add(&p->error, error);
  return disc->area > 0;
}

/* The first disc of a block has the number `place`. */
static part cut_block(const work *w, size_t block, size_t place)
{
  const packing_i_section *s = w->section;
  part p = {{0, 0}, {0, 0}, 0, 0};
  const size_t end = packing_i_measure_block_end(block, s->view->count);
  for (size_t i = block * PACKING_I_MEASURE_BLOCK; i < end; i++) {
    const double r = packing_i_view_r(s->view, i);
    const packing_i_copies copies = packing_i_copies_of(
        s->domain, 7, &s->domain->body.bounds, packing_i_view_centre(s->view, i), r);
    for (size_t n = 0; n < packing_i_copies_count(&copies); n++) {
      packing_section_disc disc = {0, 0, 0, 0, i};
      if (!cut_image(s, packing_i_copy(&copies, n), r, &p, &disc))
        continue;
      packing_i_sum_add(&p.area, disc.area);
      if (w->discs != NULL && place + p.discs < w->capacity)
        w->discs[place + p.discs] = disc;
      p.discs++;
    }
  }
  return p;
}

static void count_block(void *arg, size_t block)
{
  const work *w = arg;
  w->parts[block] = cut_block(w, block, 0);
}

static void write_block(void *arg, size_t block)
{
  const work *w = arg;
  size_t place = 0;
  for (size_t b = 0; b < block; b++)
    place += w->parts[b].discs;
  if (place < w->capacity)
    (void)cut_block(w, block, place);
}

static packing_status cut_all(packing_context *context, work *w, size_t *count,
                              packing_section_report *report)
{
  const size_t blocks = packing_i_measure_blocks(w->section->view->count);
  packing_section_disc *discs = w->discs;
  packing_i_sum area = {0, 0}, error = {0, 0};
  int broken = 0;
  w->discs = NULL;
  packing_i_parallel(context, blocks, count_block, w);
  *count = 0;
  for (size_t b = 0; b < blocks; b++) {
    packing_i_sum_add(&area, packing_i_sum_value(&w->parts[b].area));
    packing_i_sum_add(&error, packing_i_sum_value(&w->parts[b].error));
    *count += w->parts[b].discs;
    broken |= w->parts[b].broken;
  }
  if (broken)
    return packing_i_porosity_misbehaves(context);
  w->discs = discs;
  if (w->capacity > 0)
    packing_i_parallel(context, blocks, write_block, w);
  report->solid_area = packing_i_sum_value(&area);
  report->error += packing_i_sum_value(&error);
  return PACKING_OK;
}

/* The container's section. */
static packing_status cut_container(packing_context *context, const packing_i_section *s,
                                    packing_section_report *report)
{
  double lo[2], hi[2];
  report->origin = s->plane.origin;
  report->u_axis = s->plane.u_axis;
  report->v_axis = s->plane.v_axis;
  report->normal = s->plane.normal;
  report->container_area = report->error = 0;
  report->lo_u = report->lo_v = report->hi_u = report->hi_v = 0;
  if (!packing_i_domain_section_window(s->domain, &s->plane, lo, hi))
    return PACKING_OK;
  report->lo_u = lo[0];
  report->lo_v = lo[1];
  report->hi_u = hi[0];
  report->hi_v = hi[1];
  if (packing_i_domain_section_area(s->domain, &s->plane, 0, 0, 0, s->tolerance,
                                    &report->container_area, &report->error))
    return packing_i_porosity_misbehaves(context);
  return PACKING_OK;
}

packing_status packing_i_section_measure(packing_context *context,
                                         const packing_i_section *section,
                                         packing_section_disc *discs, size_t capacity,
                                         size_t *count, packing_section_report *report)
{
  const packing_allocator *a = packing_i_allocator(context);
  PACKING_I_TRY(cut_container(context, section, report));
  work w = {section, NULL, discs, capacity};
  w.parts =
      packing_i_alloc(a, packing_i_measure_blocks(section->view->count), sizeof *w.parts);
  if (w.parts == NULL)
    return packing_i_nomem(context);
  const packing_status status = cut_all(context, &w, count, report);
  packing_i_free(a, w.parts);
  report->porosity = report->container_area > 0
                         ? 1 - report->solid_area / report->container_area
                         : (double)NAN;
  report->error = report->container_area > 0 ? report->error / report->container_area : 0;
  return status;
}

/* Axes that keep (u, v) the other coordinates where the plane lies across an axis. */
static packing_i_plane make_plane(packing_vec3 point, packing_vec3 normal)
{
  const double size[3] = {fabs(normal.x), fabs(normal.y), fabs(normal.z)};
  const int widest =
      size[0] > size[1] && size[0] > size[2] ? 0 : (size[1] > size[2] ? 1 : 2);
  packing_i_plane p;
  packing_vec3 u = {widest == 2, widest == 0, widest == 1};
  /* First by the largest entry: squares of the rest cannot leave the range of doubles. */
  p.normal = packing_i_scale(normal, 1 / size[widest]);
  p.normal = packing_i_scale(p.normal, 1 / packing_i_norm(p.normal));
  u = packing_i_sub(u, packing_i_scale(p.normal, packing_i_dot(u, p.normal)));
  p.u_axis = packing_i_scale(u, 1 / packing_i_norm(u));
  p.v_axis = packing_i_vec(p.normal.y * p.u_axis.z - p.normal.z * p.u_axis.y,
                           p.normal.z * p.u_axis.x - p.normal.x * p.u_axis.z,
                           p.normal.x * p.u_axis.y - p.normal.y * p.u_axis.x);
  p.origin = packing_i_scale(p.normal, packing_i_dot(point, p.normal));
  return p;
}

packing_status packing_i_section_begin(packing_context *context,
                                       const packing_section_def *def,
                                       const packing_domain *domain,
                                       const packing_view *view, packing_view *copy,
                                       packing_i_section *section)
{
  static const char *const point[] = {"point.x", "point.y", "point.z"};
  static const char *const normal[] = {"normal.x", "normal.y", "normal.z"};
  packing_section_def d;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_section, tolerance, def, &d));
  PACKING_I_TRY(packing_i_porosity_begin(context, d.tolerance, domain, view, copy));
  PACKING_I_TRY(packing_i_check_point(context, point, &d.point));
  PACKING_I_TRY(packing_i_check_point(context, normal, &d.normal));
  if (d.normal.x == 0 && d.normal.y == 0 && d.normal.z == 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "normal", PACKING_NO_INDEX,
                          "a vector of length 0 has no direction");
  if (domain->body.dim == 2)
    return packing_i_fail(context, PACKING_ERR_UNSUPPORTED, "domain", PACKING_NO_INDEX,
                          "a plane cuts containers of three dimensions only");
  section->domain = domain;
  section->view = copy;
  section->plane = make_plane(d.point, d.normal);
  section->tolerance = d.tolerance;
  return PACKING_OK;
}

packing_status packing_measure_section(packing_context *context,
                                       const packing_section_def *def,
                                       packing_domain *domain, const packing_view *view,
                                       packing_section_disc *discs, size_t capacity,
                                       size_t *count, packing_section_report *report)
{
  packing_view v;
  packing_i_section section;
  packing_section_report found;
  size_t found_count;
  PACKING_I_TRY(packing_i_section_begin(context, def, domain, view, &v, &section));
  PACKING_I_TRY(
      packing_i_porosity_list(context, "discs", discs, capacity, count, report));
  packing_section_report_init(&found);
  PACKING_I_TRY(packing_i_section_measure(context, &section, discs, capacity,
                                          &found_count, &found));
  *count = found_count;
  return packing_i_report_write(context, report, &found, sizeof found);
}
