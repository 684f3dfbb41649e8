/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sizes asked and placed, over the diameter: cumulative curves by mass and by number, and below
 * them both histograms, of a mixture component by component. */
#include <math.h>
#include <stdlib.h>
#include "panel.h"
#include "picture.h"

enum {
  WIDTH = 1000,
  HEIGHT = 1000,
  LEFT = 92,
  RIGHT = 30,
  TOP = 66,
  SPLIT = 560,    /* where the curves end, */
  BELOW = 656,    /* and the histograms begin */
  BOTTOM = 74,    /* below all */
  GAP = 92,       /* between the histograms */
  LEGEND = 30,    /* above a panel */
  POINTS = 501,   /* of each curve */
  BINS = 31,      /* of each histogram */
  COMPONENTS = 64 /* told apart; all others are the last */
};

typedef struct plot {
  const pack *p;
  canvas sheet;
  panel curves;
  size_t components;
  double *r;    /* radii placed, rising */
  double *mass; /* of the particles up to each */
} plot;

static int rising(const void *a, const void *b)
{
  const double p = *(const double *)a, q = *(const double *)b;
  return p < q ? -1 : p > q;
}

static double mass_of(const plot *g, double r)
{
  return g->p->spec->dim == 2 ? r * r : r * r * r;
}

static packing_status sort_radii(plot *g)
{
  const size_t count = g->p->view.count;
  g->r = malloc((count + 1) * sizeof *g->r);
  g->mass = malloc((count + 1) * sizeof *g->mass);
  if (!g->r || !g->mass)
    return PACKING_ERR_NOMEM;
  for (size_t i = 0; i < count; i++)
    g->r[i] = pack_radius(g->p, i);
  qsort(g->r, count, sizeof *g->r, rising);
  double sum = 0;
  for (size_t i = 0; i < count; i++) {
    sum += mass_of(g, g->r[i]);
    g->mass[i] = sum;
  }
  return PACKING_OK;
}

/* The share of the particles placed with radius up to r. */
static double placed(const plot *g, packing_by by, double r)
{
  size_t lo = 0, hi = g->p->view.count;
  const double all = (double)hi;
  if (hi == 0)
    return 0;
  while (lo < hi) {
    const size_t middle = lo + (hi - lo) / 2;
    if (g->r[middle] <= r)
      lo = middle + 1;
    else
      hi = middle;
  }
  if (by == PACKING_BY_NUMBER || lo == 0)
    return (double)lo / all;
  return g->mass[lo - 1] / g->mass[g->p->view.count - 1];
}

static double share(const plot *g, packing_by by, int asked, double diameter)
{
  const double r = 0.5 * diameter;
  return 100 * (asked ? packing_psd_cdf(g->p->psd, by, r) : placed(g, by, r));
}

/* ---- the curves ---- */

/* Asked: a broad pale line; placed: a thin strong one upon it. */
static rgb colour_of(packing_by by, int asked)
{
  const rgb strong = by == PACKING_BY_MASS ? PANEL_BLUE : PANEL_ORANGE;
  return asked ? rgb_mix(strong, (rgb){1, 1, 1}, 0.6) : strong;
}

static double width_of(int asked)
{
  return asked ? 8 : 2;
}

static void draw_curve(const plot *g, packing_by by, int asked)
{
  double d[POINTS], percent[POINTS];
  for (int k = 0; k < POINTS; k++) {
    d[k] = axis_value(&g->curves.x, (double)k / (POINTS - 1));
    percent[k] = share(g, by, asked, d[k]);
  }
  panel_curve(&g->curves, d, percent, POINTS, colour_of(by, asked), width_of(asked));
}

static void draw_curves_legend(plot *g)
{
  static const struct {
    const char *text;
    packing_by by;
    int asked;
  } rows[] = {{"by mass, asked", PACKING_BY_MASS, 1},
              {"by mass, placed", PACKING_BY_MASS, 0},
              {"by number, asked", PACKING_BY_NUMBER, 1},
              {"by number, placed", PACKING_BY_NUMBER, 0}};
  double x = LEFT + 4;
  for (int k = 0; k < 4; k++)
    if (g->p->psd || !rows[k].asked)
      x = panel_legend(&g->sheet, x, TOP - LEGEND + 6,
                       colour_of(rows[k].by, rows[k].asked), width_of(rows[k].asked),
                       rows[k].text);
}

static void draw_curves(plot *g)
{
  panel_grid(&g->curves, "diameter", "smaller, %");
  panel_clip(&g->curves);
  for (int asked = g->p->psd != NULL; asked >= 0; asked--)
    for (int by = PACKING_BY_NUMBER; by <= PACKING_BY_MASS; by++)
      draw_curve(g, (packing_by)by, asked);
  panel_unclip(&g->curves);
  panel_frame(&g->curves);
  draw_curves_legend(g);
}

/* ---- the histograms ---- */

typedef struct histogram {
  packing_by by;
  panel where;
  double edge[BINS + 1]; /* diameters */
  double (*got)[BINS];   /* of each component, in percent of all */
  double asked[BINS];
} histogram;

static size_t bin_of(const histogram *h, double diameter)
{
  const double at = ceil(BINS * axis_place(&h->where.x, diameter)) - 1;
  return at <= 0 ? 0 : at >= BINS - 1 ? BINS - 1 : (size_t)at;
}

static void count_placed(const plot *g, histogram *h)
{
  const size_t count = g->p->view.count;
  const double all = h->by == PACKING_BY_NUMBER ? (double)count
                     : count                    ? g->mass[count - 1]
                                                : 1;
  for (size_t i = 0; i < count; i++) {
    const double r = pack_radius(g->p, i);
    const size_t k = pack_component(g->p, i);
    const double weight = h->by == PACKING_BY_NUMBER ? 1 : mass_of(g, r);
    h->got[k < g->components ? k : g->components - 1][bin_of(h, 2 * r)] +=
        100 * weight / all;
  }
}

static double fill_histogram(const plot *g, histogram *h)
{
  double highest = 0;
  for (int b = 0; b <= BINS; b++)
    h->edge[b] = axis_value(&g->curves.x, (double)b / BINS);
  count_placed(g, h);
  for (int b = 0; b < BINS; b++) {
    double sum = 0;
    for (size_t k = 0; k < g->components; k++)
      sum += h->got[k][b];
    h->asked[b] =
        g->p->psd ? share(g, h->by, 1, h->edge[b + 1]) - share(g, h->by, 1, h->edge[b])
                  : 0;
    highest = fmax(highest, fmax(sum, h->asked[b]));
  }
  return highest;
}

static rgb bar_colour(const plot *g, const histogram *h, size_t component)
{
  return g->components > 1 ? colours_category(component)
                           : rgb_mix(colour_of(h->by, 0), (rgb){1, 1, 1}, 0.25);
}

static void draw_bars(const plot *g, const histogram *h)
{
  for (int b = 0; b < BINS; b++) {
    double low = 0;
    for (size_t k = 0; k < g->components; k++) {
      const double high = low + h->got[k][b];
      if (high > low)
        panel_bar(&h->where, h->edge[b], h->edge[b + 1], low, high, bar_colour(g, h, k));
      low = high;
    }
  }
}

static void draw_asked_steps(const histogram *h)
{
  static const rgb black = {0.1, 0.1, 0.12};
  double x[2 * BINS + 2], y[2 * BINS + 2];
  size_t n = 0;
  for (int b = 0; b <= BINS; b++) {
    x[n] = x[n + 1] = h->edge[b];
    y[n] = b > 0 ? h->asked[b - 1] : 0;
    y[n + 1] = b < BINS ? h->asked[b] : 0;
    n += 2;
  }
  panel_curve(&h->where, x, y, n, black, 1.6);
}

static packing_status draw_histogram(plot *g, packing_by by, double left, double right)
{
  histogram h = {.by = by};
  h.got = calloc(g->components, sizeof *h.got);
  if (!h.got)
    return PACKING_ERR_NOMEM;
  h.where = (panel){.sheet = &g->sheet,
                    .x = g->curves.x,
                    .left = left,
                    .right = right,
                    .top = BELOW,
                    .bottom = HEIGHT - BOTTOM};
  axis_thin(&h.where.x);
  axis_init(&h.where.y, 0, fmax(1.06 * fill_histogram(g, &h), 1e-3), 0);
  panel_grid(&h.where, "diameter",
             by == PACKING_BY_MASS ? "share of the mass, %" : "share of the number, %");
  panel_clip(&h.where);
  draw_bars(g, &h);
  if (g->p->psd)
    draw_asked_steps(&h);
  panel_unclip(&h.where);
  panel_frame(&h.where);
  free(h.got);
  return PACKING_OK;
}

static packing_status draw_histograms(plot *g)
{
  const double middle = 0.5 * (LEFT + WIDTH - RIGHT);
  const packing_status status =
      draw_histogram(g, PACKING_BY_NUMBER, LEFT, middle - 0.5 * GAP);
  if (status != PACKING_OK)
    return status;
  return draw_histogram(g, PACKING_BY_MASS, middle + 0.5 * GAP, WIDTH - RIGHT);
}

/* The ends of the law and of what stands in the pack, a little wider. */
static void set_axes(plot *g)
{
  const size_t count = g->p->view.count;
  double lo = (double)INFINITY, hi = 0;
  if (g->p->psd) {
    lo = packing_psd_min_r(g->p->psd);
    hi = packing_psd_max_r(g->p->psd);
  }
  if (count > 0) {
    lo = fmin(lo, g->r[0]);
    hi = fmax(hi, g->r[count - 1]);
  }
  const double room = hi > lo ? pow(hi / lo, 0.03) : 1;
  if (hi > 0)
    axis_init(&g->curves.x, 2 * lo / room, 2 * hi * room, 1);
  else
    axis_init(&g->curves.x, 0, 1, 0);
  axis_init(&g->curves.y, 0, 100, 0);
}

static packing_status draw(plot *g, const packing_stream *stream, int svg)
{
  packing_status status = canvas_open(&g->sheet, stream, svg, WIDTH, HEIGHT);
  g->curves.sheet = &g->sheet;
  draw_curves(g);
  if (status == PACKING_OK)
    status = draw_histograms(g);
  const packing_status closed = canvas_close(&g->sheet);
  return status != PACKING_OK ? status : closed;
}

static packing_status write_plot(const pack *p, const packing_stream *stream, int svg)
{
  plot g = {
      .p = p,
      .curves = {.left = LEFT, .right = WIDTH - RIGHT, .top = TOP, .bottom = SPLIT}};
  g.components = pack_components(p);
  if (g.components > COMPONENTS)
    g.components = COMPONENTS;
  packing_status status = sort_radii(&g);
  if (status == PACKING_OK) {
    set_axes(&g);
    status = draw(&g, stream, svg);
  }
  free(g.mass);
  free(g.r);
  return status;
}

packing_status picture_write_sizes_png(const pack *p, const packing_stream *stream)
{
  return write_plot(p, stream, 0);
}

packing_status picture_write_sizes_svg(const pack *p, const packing_stream *stream)
{
  return write_plot(p, stream, 1);
}
