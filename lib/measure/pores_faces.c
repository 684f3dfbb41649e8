/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Constrictions. Spheres that touch the three particles of a face are centred on a curve through
 * the centres of the spheres on either side; the smallest of them is centred in the plane of the
 * three, and radii grow on both sides of it. So where the two centres are on their own sides of
 * that plane, the narrowest place between them is the sphere in the plane (equation 2 of the
 * sequential trilateration method); where both are on one side, the way only narrows towards the
 * smaller sphere, and that is the narrowest place. Like pores they are held against all particles
 * and walls. A face met twice, since a quadrangle is two triangles, is kept once. Linear. */
#include "measure/pores_internal.h"
#include "vec.h"

/* A face is listed from one of its sides: that of the lower cell, or of the image that comes first
 * where a cell is its own neighbour. */
static int is_listed(const packing_i_pore_network *n, uint32_t i, int k)
{
  const packing_i_pore_cell *c = &n->cell[i];
  const uint32_t j = c->neighbour[k];
  if (j == PACKING_I_PORES_NONE || n->node_of[i] == PACKING_I_PORES_NONE ||
      n->node_of[j] == PACKING_I_PORES_NONE)
    return 0;
  if (j < i || (j == i && c->shift[k] <= 0))
    return 0;
  return n->node_of[i] != n->node_of[j] ||
         c->shift[k] + n->node_shift[j] != n->node_shift[i];
}

/* Lists faces: a is the cell, b the facet for the time being. Without edges it only counts. */
static void list_faces(packing_i_pore_network *n)
{
  n->edges = 0;
  for (uint32_t i = 0; i < n->cells; i++)
    for (int k = 0; k <= n->dim; k++) {
      if (!is_listed(n, i, k))
        continue;
      if (n->edge != NULL) {
        n->edge[n->edges].a = i;
        n->edge[n->edges].b = (uint32_t)k;
      }
      n->edges++;
    }
}

/* The spheres at both ends of a face, and its corners. */
typedef struct face {
  packing_vec3 end[2];
  double radius[2];
  packing_vec3 apex; /* the cell's corner that is not in the face */
  packing_vec3 p[4];
  double r[4];
} face;

static face read_face(const packing_i_pore_network *n, packing_i_pore_edge *e)
{
  face f = {0};
  const packing_i_pore_cell *c = &n->cell[e->a];
  const uint32_t i = e->a, k = e->b, j = c->neighbour[k];
  const int32_t shift[2] = {n->node_shift[i], c->shift[k] + n->node_shift[j]};
  const uint32_t node[2] = {n->node_of[i], n->node_of[j]};
  for (int s = 0; s < 2; s++) {
    f.end[s] = packing_i_pores_shifted(n, n->node[node[s]].centre, shift[s]);
    f.radius[s] = n->node[node[s]].radius;
  }
  f.apex = packing_i_pores_copy(n, c->corner[k]);
  e->particle[2] = PACKING_I_PORES_NONE;
  for (uint32_t m = 0, v = 0; v <= (uint32_t)n->dim; v++)
    if (v != k) {
      f.p[m] = packing_i_pores_copy(n, c->corner[v]);
      f.r[m] = n->r[c->corner[v]];
      e->particle[m++] = n->particle[c->corner[v]];
    }
  e->a = node[0];
  e->b = node[1];
  e->image = shift[1] - shift[0];
  return f;
}

/* Where a sphere has moved, the particles that both spheres touch take the place of the face's, if
 * there are as many. */
static void use_shared(const packing_i_pore_network *n, packing_i_pore_edge *e, face *f)
{
  const packing_i_pore_cell *a = &n->cell[n->node[e->a].cell],
                            *b = &n->cell[n->node[e->b].cell];
  uint32_t shared[4], apex = PACKING_I_PORES_NONE;
  int count = 0;
  if (!a->moved && !b->moved)
    return;
  for (int i = 0; i <= n->dim; i++) {
    int both = 0;
    for (int j = 0; j <= n->dim; j++)
      both |= a->touch[i] == b->touch[j];
    if (both)
      shared[count++] = a->touch[i];
    else
      apex = a->touch[i];
  }
  if (count != n->dim)
    return;
  f->apex = packing_i_pores_image(n, apex, f->end[0]);
  for (int k = 0; k < count; k++) {
    f->p[k] = packing_i_pores_image(n, shared[k], f->end[0]);
    f->r[k] = n->r[shared[k]];
    e->particle[k] = shared[k];
  }
}

static double height_over(const packing_i_tangency *t, packing_vec3 p)
{
  return packing_i_dot(t->normal, packing_i_sub(p, t->origin));
}

static double smallest(const double *r, int count)
{
  double least = r[0];
  for (int i = 1; i < count; i++)
    least = fmin(least, r[i]);
  return least;
}

static void set_open(packing_i_pore_edge *e, const face *f)
{
  const int smaller = f->radius[1] < f->radius[0];
  e->centre = f->end[smaller];
  e->radius = f->radius[smaller];
  e->limit = PACKING_PORE_OPEN;
}

/* Shrinks the sphere to what else is near. */
static void limit_edge(const packing_i_pore_network *n, packing_i_pore_edge *e)
{
  const double wall = packing_i_pores_wall(n, e->centre);
  e->limit = PACKING_PORE_FREE;
  if (wall < e->radius * (1 - n->def.tolerance)) {
    e->radius = fmax(wall, 0);
    e->limit = PACKING_PORE_BY_WALL;
  }
  const double clear = packing_i_pores_clearance(n, e->centre, e->radius, NULL);
  if (clear < e->radius) {
    e->radius = fmax(clear, 0);
    e->limit = PACKING_PORE_BY_PARTICLE;
  }
}

/* Whether the way between two pores has no narrowest place in the face: its particles stand in
 * line, or both pores are on one side of its plane. */
static int is_beside(const packing_i_pore_network *n, const face *f,
                     packing_i_tangency *t)
{
  if (!packing_i_tangency_set(t, n->dim, f->p, f->r) || !(t->height > n->def.tolerance))
    return 1;
  const double up = height_over(t, f->apex);
  return height_over(t, f->end[0]) * up < 0 || height_over(t, f->end[1]) * up > 0;
}

static void fill_edge(const packing_i_pore_network *n, packing_i_pore_edge *e)
{
  packing_i_tangency t;
  double radii[2];
  const int32_t frame = n->node_shift[e->a];
  face f = read_face(n, e);
  use_shared(n, e, &f);
  const double least = fmin(f.radius[0], f.radius[1]) * (1 + n->def.tolerance);
  const int beside = is_beside(n, &f, &t);
  if (!beside && (packing_i_tangency_radii(&t, radii) == 0 ||
                  radii[0] <= n->def.tolerance * smallest(f.r, n->dim))) {
    e->radius = 0; /* particles that touch leave a gap of rounding errors */
  } else if (beside || radii[0] > least) {
    set_open(e, &f);
  } else {
    e->radius = radii[0];
    e->centre = packing_i_tangency_centre(&t, radii[0]);
    limit_edge(n, e);
  }
  e->centre = packing_i_pores_shifted(n, e->centre, -frame);
}

static void fill_block(void *arg, size_t block)
{
  packing_i_pore_network *n = arg;
  const size_t end = packing_i_measure_block_end(block, n->edges);
  for (size_t i = block * PACKING_I_MEASURE_BLOCK; i < end; i++)
    fill_edge(n, &n->edge[i]);
}

packing_status packing_i_pores_make_edges(packing_i_pore_network *n)
{
  list_faces(n);
  n->edge = packing_i_calloc(n->allocator, n->edges, sizeof *n->edge);
  if (n->edge == NULL)
    return packing_i_nomem(n->context);
  list_faces(n);
  packing_i_parallel(n->context, packing_i_measure_blocks(n->edges), fill_block, n);
  size_t kept = 0;
  for (size_t i = 0; i < n->edges; i++)
    if (n->edge[i].radius > 0)
      n->edge[kept++] = n->edge[i];
  n->closed_edges = n->edges - kept;
  n->edges = kept;
  return packing_i_pores_sort_edges(n);
}
