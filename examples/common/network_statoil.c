/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Statoil format. Pores are numbered from 1; -1 stands for the inlet, 0 for the outlet, each
 * joined by a throat of its own. A throat's length is that between the centres; each pore takes
 * its radius of it, the throat what is left, at least a hundredth. Shape factor: area over
 * perimeter squared, 1 / (4 pi) of a circle. */
#include <math.h>
#include <stdlib.h>
#include "network.h"
#include "network_lists.h"
#include "table.h"

static const double PI = 3.14159265358979323846;

typedef struct throat {
  long a, b; /* as numbered in the files */
  double radius, total, length_a, length_b, length;
} throat;

typedef struct statoil {
  network n;
  packing_bounds box;
  throat *throats;
  size_t count;
  size_t *start; /* throats of pore i: end[start[i]] .. end[start[i + 1] - 1] */
  size_t *end;
} statoil;

static double distance(packing_vec3 a, packing_vec3 b)
{
  return sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) +
              (a.z - b.z) * (a.z - b.z));
}

static void add_throat(statoil *s, throat t, double radius_a, double radius_b)
{
  const double least = 0.01 * t.total, rest = t.total - radius_a - radius_b;
  t.length = fmax(rest, least);
  const double share = (t.total - t.length) / (radius_a + radius_b);
  t.length_a = radius_a * share;
  t.length_b = radius_b * share;
  s->throats[s->count++] = t;
}

static void add_ends(statoil *s, double reach)
{
  for (size_t i = 0; i < s->n.pores; i++) {
    const packing_pore *p = &s->n.pore[i];
    const double low = p->centre.x - s->box.lo.x, high = s->box.hi.x - p->centre.x;
    const long number = (long)i + 1;
    if (low - p->radius <= reach)
      add_throat(s, (throat){-1, number, p->radius, fmax(low, p->radius), 0, 0, 0}, 0,
                 p->radius);
    if (high - p->radius <= reach)
      add_throat(s, (throat){number, 0, p->radius, fmax(high, p->radius), 0, 0, 0},
                 p->radius, 0);
  }
}

static packing_status list_throats(statoil *s, double reach)
{
  s->throats = calloc(s->n.ways + 2 * s->n.pores + 1, sizeof *s->throats);
  if (!s->throats)
    return PACKING_ERR_NOMEM;
  for (size_t i = 0; i < s->n.ways; i++) {
    const packing_constriction *c = &s->n.way[i];
    const packing_pore *a = &s->n.pore[c->a], *b = &s->n.pore[c->b];
    const double total = distance(a->centre, b->centre);
    if (!network_leaves(c) && total > 0)
      add_throat(s, (throat){(long)c->a + 1, (long)c->b + 1, c->radius, total, 0, 0, 0},
                 a->radius, b->radius);
  }
  add_ends(s, reach);
  return PACKING_OK;
}

static packing_status connect(statoil *s)
{
  s->start = calloc(s->n.pores + 2, sizeof *s->start);
  s->end = calloc(2 * s->count + 1, sizeof *s->end);
  if (!s->start || !s->end)
    return PACKING_ERR_NOMEM;
  for (size_t i = 0; i < s->count; i++) {
    s->start[s->throats[i].a > 0 ? s->throats[i].a : 0]++;
    s->start[s->throats[i].b > 0 ? s->throats[i].b : 0]++;
  }
  s->start[0] = 0;
  for (size_t i = 1; i < s->n.pores + 2; i++)
    s->start[i] += s->start[i - 1];
  for (size_t i = s->count; i-- > 0;) {
    if (s->throats[i].b > 0)
      s->end[--s->start[s->throats[i].b]] = i;
    if (s->throats[i].a > 0)
      s->end[--s->start[s->throats[i].a]] = i;
  }
  return PACKING_OK;
}

/* Pore `number`'s throats are [start[number], start[number + 1]): filling moved each start from
 * the end of its list to the beginning. */
static void put_node1(const statoil *s, table *t)
{
  table_print(t, "%zu %.17g %.17g %.17g\n", s->n.pores, s->box.hi.x - s->box.lo.x,
              s->box.hi.y - s->box.lo.y, s->box.hi.z - s->box.lo.z);
  for (size_t i = 0; i < s->n.pores; i++) {
    const packing_vec3 c = s->n.pore[i].centre;
    const size_t first = s->start[i + 1], last = s->start[i + 2];
    const long number = (long)i + 1;
    int inlet = 0, outlet = 0;
    table_print(t, "%ld %.17g %.17g %.17g %zu", number, c.x - s->box.lo.x,
                c.y - s->box.lo.y, c.z - s->box.lo.z, last - first);
    for (size_t k = first; k < last; k++) {
      const throat *e = &s->throats[s->end[k]];
      const long other = e->a == number ? e->b : e->a;
      inlet |= other == -1;
      outlet |= other == 0;
      table_print(t, " %ld", other);
    }
    table_print(t, " %d %d", inlet, outlet);
    for (size_t k = first; k < last; k++)
      table_print(t, " %zu", s->end[k] + 1);
    table_print(t, "\n");
  }
}

static void put_node2(const statoil *s, table *t)
{
  for (size_t i = 0; i < s->n.pores; i++) {
    const double r = s->n.pore[i].radius;
    table_print(t, "%zu %.17g %.17g %.17g 0\n", i + 1, 4.0 / 3 * PI * r * r * r, r,
                1 / (4 * PI));
  }
}

static void put_link1(const statoil *s, table *t)
{
  table_print(t, "%zu\n", s->count);
  for (size_t i = 0; i < s->count; i++) {
    const throat *e = &s->throats[i];
    table_print(t, "%zu %ld %ld %.17g %.17g %.17g\n", i + 1, e->a, e->b, e->radius,
                1 / (4 * PI), e->total);
  }
}

static void put_link2(const statoil *s, table *t)
{
  for (size_t i = 0; i < s->count; i++) {
    const throat *e = &s->throats[i];
    table_print(t, "%zu %ld %ld %.17g %.17g %.17g %.17g 0\n", i + 1, e->a, e->b,
                e->length_a, e->length_b, e->length,
                PI * e->radius * e->radius * e->length);
  }
}

packing_status network_write_statoil(const packing_pores *pores,
                                     const packing_bounds *box, double reach, int part,
                                     const packing_stream *stream)
{
  static void (*const parts[NETWORK_PARTS])(const statoil *, table *) = {
      put_node1, put_node2, put_link1, put_link2};
  statoil s = {0};
  s.box = *box;
  packing_status status = network_take(pores, &s.n);
  if (status == PACKING_OK)
    status = list_throats(&s, reach);
  if (status == PACKING_OK)
    status = connect(&s);
  if (status == PACKING_OK) {
    table t;
    table_open(&t, stream);
    parts[part](&s, &t);
    status = table_close(&t);
  }
  free(s.throats);
  free(s.start);
  free(s.end);
  network_drop(&s.n);
  return status;
}
