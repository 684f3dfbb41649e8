/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Diagrams: sizes, radial distribution, coordination, porosity profiles. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "../common/panel.h"
#include "../common/picture.h"
#include "measure.h"

enum {
  WIDTH = 1000,
  LEFT = 100,
  RIGHT = 34,
  TOP = 92,
  TALL = 420,  /* of a panel */
  BELOW = 110, /* from one to the next */
  BOTTOM = 78
};

static const rgb GREY = {0.5, 0.5, 0.52};

packing_status plot_sizes(const pack *p, const packing_stream *stream)
{
  const measure_job *job = p->own;
  return job->asked->svg ? picture_write_sizes_svg(p, stream)
                         : picture_write_sizes_png(p, stream);
}

/* Panel `k` of a sheet. */
static panel panel_of(canvas *sheet, size_t k)
{
  const double top = TOP + (double)k * (TALL + BELOW);
  return (panel){.sheet = sheet,
                 .left = LEFT,
                 .right = WIDTH - RIGHT,
                 .top = top,
                 .bottom = top + TALL};
}

static packing_status open_sheet(canvas *sheet, const pack *p,
                                 const packing_stream *stream, size_t panels)
{
  const measure_job *job = p->own;
  const size_t height = TOP + panels * TALL + (panels - 1) * BELOW + BOTTOM;
  return canvas_open(sheet, stream, job->asked->svg, WIDTH, (int)height);
}

static packing_status close_sheet(canvas *sheet, packing_status status)
{
  const packing_status closed = canvas_close(sheet);
  return status != PACKING_OK ? status : closed;
}

/* What stands in a panel without data. */
static void draw_nothing(const panel *g, const char *why)
{
  cairo_set_source_rgb(g->sheet->cr, GREY.r, GREY.g, GREY.b);
  canvas_text(g->sheet, 0.5 * (g->left + g->right), 0.5 * (g->top + g->bottom), 20, 0,
              ALIGN_MIDDLE, why);
}

/* ---- radial distribution ---- */

static void draw_rdf_curve(const panel *g, const rdf_found *found, double *r, double *y)
{
  const size_t bins = found->report.bins;
  for (size_t k = 0; k < bins; k++) {
    r[k] = 0.5 * (found->bins[k].lo + found->bins[k].hi);
    y[k] = found->bins[k].g;
  }
  panel_clip(g);
  panel_level(g, 1, GREY);
  panel_curve(g, r, y, bins, PANEL_BLUE, 2.2);
  panel_unclip(g);
}

static double highest_g(const rdf_found *found)
{
  double most = 1.5;
  for (size_t k = 0; found->bins && k < found->report.bins; k++)
    if (found->bins[k].g > most)
      most = found->bins[k].g;
  return most;
}

static void title_rdf(canvas *sheet, const rdf_found *found)
{
  char below[160] = "", count[40];
  if (found->bins) {
    canvas_format_count(count, sizeof count, found->report.centres);
    snprintf(below, sizeof below, "%s centres, mean diameter %.6g; dashed: no order",
             count, found->report.mean_d);
  }
  panel_title(sheet, LEFT, 40, WIDTH - LEFT - RIGHT, "Radial distribution", below);
}

packing_status plot_rdf(const pack *p, const packing_stream *stream)
{
  const measure_job *job = p->own;
  const rdf_found *found = &job->rdf;
  const size_t bins = found->bins ? found->report.bins : 0;
  double *r = calloc(bins + 1, sizeof *r), *y = calloc(bins + 1, sizeof *y);
  canvas sheet;
  packing_status status = open_sheet(&sheet, p, stream, 1);
  panel g = panel_of(&sheet, 0);
  axis_init(&g.x, 0, bins ? found->r_max : 5, 0);
  axis_init(&g.y, 0, 1.06 * highest_g(found), 0);
  title_rdf(&sheet, found);
  panel_grid(&g, "distance / mean diameter", "g(r)");
  if (!r || !y)
    status = PACKING_ERR_NOMEM;
  else if (bins && found->report.centres > 0)
    draw_rdf_curve(&g, found, r, y);
  else
    draw_nothing(&g, job->view.count > 0 ? "no particle is far enough from the walls"
                                         : "no particles");
  panel_frame(&g);
  free(y);
  free(r);
  return close_sheet(&sheet, status);
}

/* ---- coordination ---- */

static size_t most_contacts(const report *r)
{
  size_t most = PACKING_COORDINATION_BINS;
  while (most > 1 && r->histogram[most - 1] == 0)
    most--;
  return most;
}

static double share_of(const report *r, size_t k)
{
  return 100 * (double)r->histogram[k] / (double)r->particles;
}

static void draw_degrees(const panel *g, const report *r)
{
  const rgb pale = rgb_mix(PANEL_BLUE, (rgb){1, 1, 1}, 0.3);
  panel_clip(g);
  for (size_t k = 0; k < PACKING_COORDINATION_BINS; k++)
    if (r->histogram[k] > 0)
      panel_bar(g, (double)k - 0.42, (double)k + 0.42, 0, share_of(r, k), pale);
  panel_upright(g, r->coordination_mean, PANEL_ORANGE);
  panel_unclip(g);
}

static void title_coordination(canvas *sheet, const measure_job *job)
{
  const report *r = &job->report;
  char below[240], text[COORDINATION_TEXT];
  snprintf(below, sizeof below,
           "mean %s; firm %.1f %%, stable %.1f %%, non stable %.1f %%",
           coordination_say(text, r), 100 * job->classes.firm_share,
           100 * job->classes.stable_share, 100 * job->classes.non_stable_share);
  panel_title(sheet, LEFT, 40, WIDTH - LEFT - RIGHT, "Contacts of a particle",
              job->contacts ? below : "");
}

packing_status plot_coordination(const pack *p, const packing_stream *stream)
{
  const measure_job *job = p->own;
  const report *r = &job->report;
  double most = 1;
  canvas sheet;
  const packing_status status = open_sheet(&sheet, p, stream, 1);
  panel g = panel_of(&sheet, 0);
  for (size_t k = 0; job->contacts && k < PACKING_COORDINATION_BINS; k++)
    most = fmax(most, share_of(r, k));
  axis_init(&g.x, -0.8, fmax(8, (double)most_contacts(r)) - 0.2, 0);
  axis_init(&g.y, 0, 1.06 * most, 0);
  title_coordination(&sheet, job);
  panel_grid(&g, "contacts with other particles (the dashed line: their mean)",
             "particles, %");
  if (job->contacts)
    draw_degrees(&g, r);
  else
    draw_nothing(&g, "no particles");
  panel_frame(&g);
  return close_sheet(&sheet, status);
}

/* ---- profiles ---- */

/* Steps: each bin is level. Bins outside the container are left open. */
static packing_status draw_steps(const panel *g, const profile_found *found)
{
  double *x = malloc(2 * found->count * sizeof *x),
         *y = malloc(2 * found->count * sizeof *y);
  if (x && y) {
    for (size_t k = 0; k < found->count; k++) {
      x[2 * k] = found->bins[k].from;
      x[2 * k + 1] = found->bins[k].to;
      y[2 * k] = y[2 * k + 1] = found->bins[k].porosity;
    }
    panel_clip(g);
    panel_level(g, found->report.porosity, GREY);
    panel_curve(g, x, y, 2 * found->count, PANEL_BLUE, 2.2);
    panel_unclip(g);
  }
  const packing_status status = x && y ? PACKING_OK : PACKING_ERR_NOMEM;
  free(y);
  free(x);
  return status;
}

static const char *profile_title(const profile_ask *ask)
{
  static char text[64];
  if (ask->kind == PACKING_PROFILE_SLABS)
    return axis_name(ask->axis);
  snprintf(text, sizeof text, "radius%s",
           ask->kind == PACKING_PROFILE_SPHERES ? " from the centre" : "");
  return text;
}

static packing_status draw_profile(canvas *sheet, size_t k, const profile_ask *ask,
                                   const profile_found *found)
{
  panel g = panel_of(sheet, k);
  axis_init(&g.x, found->report.from, found->report.to, 0);
  axis_init(&g.y, 0, 1, 0);
  panel_grid(&g, profile_title(ask), "porosity");
  const packing_status status = draw_steps(&g, found);
  panel_frame(&g);
  return status;
}

packing_status plot_profile(const pack *p, const packing_stream *stream)
{
  const measure_job *job = p->own;
  const size_t count = job->asked->profile_count;
  char below[120];
  canvas sheet;
  packing_status status = open_sheet(&sheet, p, stream, count);
  snprintf(below, sizeof below, "%zu bins; dashed: of all, %.4f", job->profiles[0].count,
           job->profiles[0].report.porosity);
  panel_title(&sheet, LEFT, 40, WIDTH - LEFT - RIGHT, "Porosity", below);
  for (size_t k = 0; k < count && status == PACKING_OK; k++)
    status = draw_profile(&sheet, k, &job->asked->profiles[k], &job->profiles[k]);
  return close_sheet(&sheet, status);
}
