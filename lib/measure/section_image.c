/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The binary image of a section, and its occupation ratio BOR = black / (black + white) with
 * black for void (seed 001, equation 12, reconstructed). A pixel shows what lies at its centre,
 * so the ratio differs from the areal porosity (section.c) by about the length of the discs'
 * borders in pixels over the number of pixels, with random sign. Blocks of rows are drawn for
 * themselves, each looking at all discs. Linear in the particles, the pixels, the pixels of all
 * discs, and in the discs times the blocks. */
#include "measure/section_internal.h"

enum { ROWS_OF_BLOCK = 16 };

typedef struct image {
  const packing_i_section *section;
  packing_section_image_def def;
  const packing_section_disc *discs;
  size_t count;
  unsigned char *pixels;
} image;

void packing_section_image_def_fill(packing_section_image_def *def, size_t size)
{
  packing_section_image_def defaults = {0};
  defaults.rows = defaults.columns = 500;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static double u_of(const image *g, size_t column)
{
  const packing_section_image_def *d = &g->def;
  return d->lo_u + (d->hi_u - d->lo_u) * (((double)column + 0.5) / (double)d->columns);
}

static double v_of(const image *g, size_t row)
{
  const packing_section_image_def *d = &g->def;
  return d->hi_v - (d->hi_v - d->lo_v) * (((double)row + 0.5) / (double)d->rows);
}

static void draw_container(const image *g, size_t row)
{
  const packing_i_plane *p = &g->section->plane;
  unsigned char *pixel = g->pixels + row * g->def.columns;
  const packing_vec3 start =
      packing_i_add(p->origin, packing_i_scale(p->v_axis, v_of(g, row)));
  for (size_t column = 0; column < g->def.columns; column++) {
    const packing_vec3 at =
        packing_i_add(start, packing_i_scale(p->u_axis, u_of(g, column)));
    pixel[column] = packing_i_domain_contains(g->section->domain, &at)
                        ? PACKING_PIXEL_VOID
                        : PACKING_PIXEL_OUTSIDE;
  }
}

/* A column beyond which, or before which, no centre of a pixel lies at u. */
static size_t column_near(const image *g, double u)
{
  const packing_section_image_def *d = &g->def;
  const double k = floor((u - d->lo_u) / (d->hi_u - d->lo_u) * (double)d->columns);
  if (!(k > 0))
    return 0;
  return k < (double)d->columns ? (size_t)k : d->columns;
}

static void draw_disc(const image *g, size_t row, const packing_section_disc *disc)
{
  unsigned char *pixel = g->pixels + row * g->def.columns;
  const double dv = v_of(g, row) - disc->v;
  if (!(fabs(dv) <= disc->r))
    return;
  size_t end = column_near(g, disc->u + disc->r);
  end = end < g->def.columns ? end + 1 : end;
  for (size_t column = column_near(g, disc->u - disc->r); column < end; column++) {
    const double du = u_of(g, column) - disc->u;
    if (du * du + dv * dv <= disc->r * disc->r && pixel[column] == PACKING_PIXEL_VOID)
      pixel[column] = PACKING_PIXEL_SOLID;
  }
}

static void draw_rows(void *arg, size_t block)
{
  const image *g = arg;
  const size_t first = block * ROWS_OF_BLOCK;
  const size_t end =
      g->def.rows - first < ROWS_OF_BLOCK ? g->def.rows : first + ROWS_OF_BLOCK;
  const double top = v_of(g, first), bottom = v_of(g, end - 1);
  for (size_t row = first; row < end; row++)
    draw_container(g, row);
  for (size_t i = 0; i < g->count; i++)
    if (g->discs[i].v - g->discs[i].r <= top && g->discs[i].v + g->discs[i].r >= bottom)
      for (size_t row = first; row < end; row++)
        draw_disc(g, row, &g->discs[i]);
}

static void count_pixels(const image *g, packing_section_image_report *report)
{
  const packing_section_image_def *d = &g->def;
  for (size_t i = 0; i < d->rows * d->columns; i++) {
    report->black += g->pixels[i] == PACKING_PIXEL_VOID;
    report->white += g->pixels[i] == PACKING_PIXEL_SOLID;
    report->outside += g->pixels[i] == PACKING_PIXEL_OUTSIDE;
  }
  const size_t inside = report->black + report->white;
  report->occupation = inside > 0 ? (double)report->black / (double)inside : (double)NAN;
  report->rows = d->rows;
  report->columns = d->columns;
  report->lo_u = d->lo_u;
  report->lo_v = d->lo_v;
  report->hi_u = d->hi_u;
  report->hi_v = d->hi_v;
}

/* The discs of the section; the caller's to release. */
static packing_status collect(packing_context *context, const packing_i_section *section,
                              packing_section_disc **discs, size_t *count)
{
  const packing_allocator *a = packing_i_allocator(context);
  packing_section_report report;
  PACKING_I_TRY(packing_i_section_measure(context, section, NULL, 0, count, &report));
  *discs = packing_i_alloc(a, *count, sizeof **discs);
  if (*discs == NULL)
    return packing_i_nomem(context);
  return packing_i_section_measure(context, section, *discs, *count, count, &report);
}

static packing_status check_counts(packing_context *context,
                                   const packing_section_image_def *d, size_t capacity)
{
  if (d->rows == 0 || d->columns == 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, d->rows == 0 ? "rows" : "columns",
                          PACKING_NO_INDEX, "0, at least 1 is needed");
  if (d->columns > SIZE_MAX / 2 / d->rows)
    return packing_i_fail(context, PACKING_ERR_RANGE, "rows", PACKING_NO_INDEX,
                          "%zu makes more pixels than can be counted", d->rows);
  if (capacity > 0 && capacity < d->rows * d->columns)
    return packing_i_fail(context, PACKING_ERR_RANGE, "capacity", PACKING_NO_INDEX,
                          "%zu, but the image has %zu pixels", capacity,
                          d->rows * d->columns);
  return PACKING_OK;
}

static packing_status check_side(packing_context *context, const char *const field[2],
                                 double lo, double hi)
{
  PACKING_I_TRY(packing_i_check_finite(context, field[0], lo));
  PACKING_I_TRY(packing_i_check_finite(context, field[1], hi));
  if (!(lo < hi) || !isfinite(hi - lo))
    return packing_i_fail(context, PACKING_ERR_RANGE, field[1], PACKING_NO_INDEX,
                          "%g must be above %s, %g", hi, field[0], lo);
  return PACKING_OK;
}

/* The window: the caller's, or that of the container's section. */
static packing_status settle(packing_context *context, const packing_i_section *section,
                             packing_section_image_def *d)
{
  static const char *const u[] = {"lo_u", "hi_u"}, *const v[] = {"lo_v", "hi_v"};
  double lo[2], hi[2];
  if (d->lo_u == 0 && d->hi_u == 0 && d->lo_v == 0 && d->hi_v == 0) {
    if (!packing_i_domain_section_window(section->domain, &section->plane, lo, hi))
      return packing_i_fail(context, PACKING_ERR_RANGE, "point", PACKING_NO_INDEX,
                            "the plane misses the container");
    d->lo_u = lo[0];
    d->lo_v = lo[1];
    d->hi_u = hi[0];
    d->hi_v = hi[1];
  }
  PACKING_I_TRY(check_side(context, u, d->lo_u, d->hi_u));
  return check_side(context, v, d->lo_v, d->hi_v);
}

/* The image in memory of its own where the caller only asks for the report. */
static packing_status draw(packing_context *context, image *g,
                           packing_section_image_report *report)
{
  const packing_allocator *a = packing_i_allocator(context);
  packing_section_disc *discs = NULL;
  unsigned char *own = NULL;
  packing_status status = collect(context, g->section, &discs, &g->count);
  if (status != PACKING_OK)
    goto out;
  g->discs = discs;
  if (g->pixels == NULL)
    g->pixels = own = packing_i_alloc(a, g->def.rows, g->def.columns);
  if (g->pixels == NULL) {
    status = packing_i_nomem(context);
    goto out;
  }
  packing_i_parallel(context, (g->def.rows + ROWS_OF_BLOCK - 1) / ROWS_OF_BLOCK,
                     draw_rows, g);
  count_pixels(g, report);
out:
  packing_i_free(a, discs);
  packing_i_free(a, own);
  return status;
}

packing_status packing_measure_section_image(
    packing_context *context, const packing_section_def *section,
    const packing_section_image_def *def, packing_domain *domain,
    const packing_view *view, unsigned char *pixels, size_t capacity, size_t *count,
    packing_section_image_report *report)
{
  image g = {0};
  packing_view v;
  packing_i_section s;
  packing_section_image_report found;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_section_image, hi_v, def, &g.def));
  PACKING_I_TRY(check_counts(context, &g.def, capacity));
  PACKING_I_TRY(packing_i_section_begin(context, section, domain, view, &v, &s));
  PACKING_I_TRY(
      packing_i_porosity_list(context, "pixels", pixels, capacity, count, report));
  PACKING_I_TRY(settle(context, &s, &g.def));
  packing_section_image_report_init(&found);
  g.section = &s;
  g.pixels = capacity > 0 ? pixels : NULL;
  PACKING_I_TRY(draw(context, &g, &found));
  *count = g.def.rows * g.def.columns;
  return packing_i_report_write(context, report, &found, sizeof found);
}
