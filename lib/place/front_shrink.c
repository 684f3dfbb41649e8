/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pockets that a new sphere changes: it is one more body that bounds their radii. Only owners
 * within reach of it have such pockets. Cost: some thirty pockets a sphere. */
#include "front_pockets.h"

void packing_i_pocket_kill(packing_i_pockets *p, uint32_t id)
{
  packing_i_pocket *pocket = packing_i_pocket_at(p, id);
  unsigned k;
  packing_i_front_bin *bin = packing_i_front_bin_of(&p->grid, pocket->owner, &k);
  uint32_t *link = bin->pockets + k;
  while (*link != id)
    link = &packing_i_pocket_at(p, *link)->next;
  *link = pocket->next;
  pocket->alive = 0;
  pocket->version++;
}

/* The curve between its ends is taken for straight, with a margin: a pocket that is passed over
 * wrongly keeps a radius too large, and is found out when it is filled. */
void packing_i_pocket_measure(const packing_i_pockets *p, packing_i_pocket *pocket)
{
  const double exit = pocket->exit[p->exits - 1];
  const double cap = p->cap * packing_i_pocket_most(p, pocket);
  const double far = exit < cap ? exit : cap;
  packing_vec3 a, b;
  if (!packing_i_front_curve_at(&pocket->curve, pocket->lo, &a) ||
      !packing_i_front_curve_at(&pocket->curve, far, &b)) {
    pocket->extent = HUGE_VALF;
    pocket->middle[0] = pocket->middle[1] = pocket->middle[2] = 0;
    return;
  }
  const packing_vec3 half = packing_i_scale(packing_i_sub(b, a), 0.5);
  pocket->middle[0] = (float)((a.x + half.x) * p->per_unit);
  pocket->middle[1] = (float)((a.y + half.y) * p->per_unit);
  pocket->middle[2] = (float)((a.z + half.z) * p->per_unit);
  pocket->extent = (float)((far + packing_i_norm(half)) * 1.01 * p->per_unit);
}

/* Column n of the curves: a pocket, and the new sphere as a body about its owner. */
static void load(packing_i_front_lane *lane, size_t n, const packing_i_pocket *pocket,
                 const packing_i_front_body *body, uint32_t id)
{
  const packing_i_front_curve *curve = &pocket->curve;
  packing_i_front_curves *c = &lane->curves;
  c->base[0][n] = curve->base.x;
  c->base[1][n] = curve->base.y;
  c->base[2][n] = curve->base.z;
  c->slope[0][n] = curve->slope.x;
  c->slope[1][n] = curve->slope.y;
  c->slope[2][n] = curve->slope.z;
  c->side[0][n] = curve->side.x;
  c->side[1][n] = curve->side.y;
  c->side[2][n] = curve->side.z;
  for (int k = 0; k < 3; k++)
    c->s2[k][n] = curve->s2[k];
  c->lo[n] = pocket->lo;
  c->x[n] = body->p.x;
  c->y[n] = body->p.y;
  c->z[n] = body->p.z;
  c->a[n] = body->a;
  c->b[n] = body->b;
  lane->curve_pocket[n] = id;
}

static void meet(packing_i_pocket *pocket, double r)
{
  double *e = pocket->exit;
  if (r < e[0]) {
    e[2] = e[1];
    e[1] = e[0];
    e[0] = r;
  } else if (r < e[1]) {
    e[2] = e[1];
    e[1] = r;
  } else if (r < e[2]) {
    e[2] = r;
  }
}

static void apply(packing_i_pockets *p, packing_i_front_lane *lane, size_t n)
{
  const uint32_t id = lane->curve_pocket[n];
  packing_i_pocket *pocket = packing_i_pocket_at(p, id);
  const double room = lane->curves.room[n], first = lane->curves.first[n],
               second = lane->curves.second[n];
  if (room < -p->slack) {
    if (!(first < pocket->exit[0]) || first > p->max_r) {
      packing_i_pocket_kill(p, id);
      return;
    }
    pocket->lo = first;
    meet(pocket, second);
  } else {
    if (!(first < pocket->exit[p->exits - 1]))
      return;
    meet(pocket, first);
  }
  if (pocket->exit[0] < pocket->lo || pocket->exit[0] < p->min_r) {
    packing_i_pocket_kill(p, id);
    return;
  }
  packing_i_pocket_measure(p, pocket);
  packing_i_pocket_offer(p, lane, id);
}

static void flush(packing_i_pockets *p, packing_i_front_lane *lane, size_t count)
{
  p->kernels->bounds(&lane->curves, count);
  for (size_t n = 0; n < count; n++)
    apply(p, lane, n);
}

void packing_i_pockets_shrink(packing_i_pockets *p, packing_i_front_lane *lane, double r)
{
  const packing_i_front_halo *halo = &lane->halo;
  size_t n = 0;
  for (size_t t = 0; t < halo->count; t++) { /* far in memory from one another */
    unsigned k;
    const packing_i_front_bin *bin = packing_i_front_bin_of(&p->grid, halo->id[t], &k);
    __builtin_prefetch(packing_i_pocket_at(p, bin->pockets[k]));
  }
  for (size_t t = 0; t < halo->count; t++) {
    unsigned k;
    const packing_i_front_bin *bin = packing_i_front_bin_of(&p->grid, halo->id[t], &k);
    if (bin->pockets[k] == 0)
      continue;
    const packing_vec3 from = packing_i_vec(-halo->x[t], -halo->y[t], -halo->z[t]);
    const packing_i_front_body body = packing_i_front_sphere(from, r, halo->r[t]);
    for (uint32_t id = bin->pockets[k]; id != 0; id = packing_i_pocket_at(p, id)->next) {
      const packing_i_pocket *pocket = packing_i_pocket_at(p, id);
      __builtin_prefetch(packing_i_pocket_at(p, pocket->next));
      const double x = from.x * p->per_unit - (double)pocket->middle[0],
                   y = from.y * p->per_unit - (double)pocket->middle[1],
                   z = from.z * p->per_unit - (double)pocket->middle[2],
                   near = (double)pocket->extent + r * p->per_unit;
      if (x * x + y * y + z * z >= near * near)
        continue;
      load(lane, n++, packing_i_pocket_at(p, id), &body, id);
      if (n == lane->curve_room) {
        /* Killing a pocket leaves its own link, which is where we go on from. */
        flush(p, lane, n);
        n = 0;
      }
    }
  }
  flush(p, lane, n);
}
