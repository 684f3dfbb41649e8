/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The area that a disc and a polygon have in common, in closed form.
 *
 * By Green's theorem it is half the sum of A x B over the pieces A B of edges within the disc,
 * seen from its centre, and r^2 / 2 times the angles of the arcs within the polygon. An arc runs
 * from where the border leaves the disc to where it next comes in, so the angles add up to
 *
 *     sum of those of entries - sum of those of exits  (mod 2 pi)
 *
 * and nothing needs sorting or storing; the area is known modulo that of the disc, and lies
 * between 0 and that. Which end is meant, where rounding alone is left of it, the distance of the
 * centre says. Whether
 * a vertex lies in the disc is asked of the vertex alone, so that both of its edges agree. Cost:
 * the edges in the disc, times log n. */
#include "polygon_internal.h"

typedef struct cut {
  double x, y, r;
  double sum;   /* of A x B */
  double angle; /* entries less exits */
} cut;

/* Vectors from the centre to the ends. */
typedef struct ends {
  double ax, ay, bx, by;
} ends;

/* The piece from the share s to the share t of the edge. */
static void add_piece(cut *c, const ends *e, double s, double t, double side)
{
  const double ux = e->bx - e->ax, uy = e->by - e->ay;
  c->sum += side * (t - s) * (e->ax * uy - e->ay * ux);
}

static double angle_at(const ends *e, double t)
{
  return atan2(e->ay + t * (e->by - e->ay), e->ax + t * (e->bx - e->ax));
}

static double clamp(double t)
{
  return t < 0 ? 0 : t > 1 ? 1 : t;
}

/* The edge seen as running with the inside on its left. */
static void add_edge(cut *c, const packing_i_edge *g)
{
  const ends e = {g->ax - c->x, g->ay - c->y, g->bx - c->x, g->by - c->y};
  const double ux = e.bx - e.ax, uy = e.by - e.ay;
  const double side = ux * g->ny - uy * g->nx > 0 ? 1 : -1;
  const double out_a = e.ax * e.ax + e.ay * e.ay - c->r * c->r;
  const double out_b = e.bx * e.bx + e.by * e.by - c->r * c->r;
  const double length2 = ux * ux + uy * uy, along = -(e.ax * ux + e.ay * uy);
  const double high = g->nx * e.ax + g->ny * e.ay; /* of the line over the centre */
  const double half2 = (c->r - high) * (c->r + high) / length2;
  const double half = half2 > 0 ? sqrt(half2) : 0, middle = along / length2;
  if (out_a >= 0 && out_b >= 0 && !(half > 0 && middle > 0 && middle < 1))
    return;
  const double s = out_a < 0 ? 0 : clamp(middle - half);
  const double t = out_b < 0 ? 1 : clamp(middle + half);
  add_piece(c, &e, s, t, side);
  if (out_a >= 0)
    c->angle += side * angle_at(&e, s);
  if (out_b >= 0)
    c->angle -= side * angle_at(&e, t);
}

double packing_i_polygon_disc(const packing_i_polygon_data *data, double x, double y,
                              double r)
{
  packing_i_node stack[PACKING_I_TREE_DEPTH] = {{1, 0, data->count}};
  cut c = {x, y, r, 0, 0};
  const double disc = packing_i_ball_volume(2, r);
  for (int waiting = 1; waiting > 0;) {
    const packing_i_node n = stack[--waiting];
    if (packing_i_rect_distance2(&data->box[n.node], x, y) >= r * r)
      continue;
    if (!packing_i_is_leaf(n)) {
      stack[waiting++] = packing_i_child(n, 1);
      stack[waiting++] = packing_i_child(n, 0);
      continue;
    }
    for (int i = n.from; i < n.to; i++)
      add_edge(&c, &data->edge[i]);
  }
  const double area = fmod(0.5 * (c.sum + r * r * c.angle), disc);
  if (fabs(area) < 1e-13 * disc || fabs(area) > (1 - 1e-13) * disc)
    return packing_i_polygon_distance(data, x, y, NULL) > 0.5 * r ? disc : 0;
  return area < 0 ? area + disc : area;
}
