/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The triangulation of a periodic pack. Its cells are those of the particles and of their copies
 * within a margin of the periodic cell, if no copy farther out reaches into their orthogonal
 * spheres, which is checked: else the margin grows. Of each cell and its images that one is kept
 * whose first corner (lowest particle, then image) stands in the periodic cell.
 *
 * Coordinates and periods are rounded to multiples of one quantum, some 1e-16 of the extent, so that
 * copies are exact translations. The triangulation breaks ties by position only, so it is then as
 * periodic as the pack, also where lattices leave it a choice. In a container with walls the check
 * is made for cells whose orthogonal sphere is centred inside it: others have no bound. */
#include "measure/pores_internal.h"
#include "vec.h"
#include "view.h"

static double *axis_of(packing_i_pore_network *n, int axis)
{
  return axis == 0 ? n->x : axis == 1 ? n->y : n->z;
}

/* Room for copies; what there is is kept. */
static packing_status grow(packing_i_pore_network *n, size_t room)
{
  double **const columns[] = {&n->x, &n->y, &n->z, &n->r};
  for (size_t c = 0; c < 4; c++) {
    double *block =
        packing_i_regrow(n->allocator, *columns[c], n->copies, room, sizeof *block);
    if (block == NULL)
      return packing_i_nomem(n->context);
    *columns[c] = block;
  }
  uint32_t *particle =
      packing_i_regrow(n->allocator, n->particle, n->copies, room, sizeof *particle);
  if (particle == NULL)
    return packing_i_nomem(n->context);
  n->particle = particle;
  int32_t *image =
      packing_i_regrow(n->allocator, n->image, n->copies, room, sizeof *image);
  if (image == NULL)
    return packing_i_nomem(n->context);
  n->image = image;
  n->room = room;
  return PACKING_OK;
}

/* The particles as they stand in the periodic cell, relative to its corner. */
static void take_particles(packing_i_pore_network *n, const packing_view *view)
{
  n->r_max = 0;
  for (size_t i = 0; i < n->count; i++) {
    packing_vec3 p = packing_i_view_centre(view, i);
    if (n->domain != NULL)
      packing_domain_wrap(n->domain, &p);
    n->x[i] = p.x - n->origin.x;
    n->y[i] = p.y - n->origin.y;
    n->z[i] = n->dim == 2 ? 0 : p.z - n->origin.z;
    n->r[i] = packing_i_view_r(view, i);
    n->r_max = n->r[i] > n->r_max ? n->r[i] : n->r_max;
    n->particle[i] = (uint32_t)i;
    n->image[i] = 0;
  }
  n->copies = n->count;
}

static double length(const packing_bounds *b, int axis)
{
  return packing_i_component(b->hi, axis) - packing_i_component(b->lo, axis);
}

/* Rounds what is periodic to a quantum that leaves room for sums over the margin. */
static void round_periods(packing_i_pore_network *n, double margin)
{
  double extent = 0;
  int exponent;
  for (int axis = 0; axis < 3; axis++)
    if (n->periodic >> axis & 1U)
      extent = fmax(extent, 4 * (length(&n->box, axis) + margin));
  (void)frexp(extent, &exponent);
  const double magic = ldexp(1.5, exponent); /* its last bit is 2^(exponent - 52) */
  for (int axis = 0; axis < 3; axis++) {
    if (!(n->periodic >> axis & 1U))
      continue;
    double *x = axis_of(n, axis);
    n->period[axis] = (length(&n->box, axis) + magic) - magic;
    for (size_t i = 0; i < n->count; i++)
      x[i] = (x[i] + magic) - magic;
  }
}

/* Adds copies of what there is along one axis, as far as they stand within the margin. */
static packing_status copy_axis(packing_i_pore_network *n, int axis, double margin)
{
  const double period = n->period[axis];
  const int reach = (int)ceil(margin / period);
  const size_t count = n->copies;
  int step[3] = {0, 0, 0};
  step[axis] = 1;
  const int32_t code = packing_i_image_code(step);
  for (int k = -reach; k <= reach; k++)
    for (size_t i = 0; i < count; i++) {
      const double at = axis_of(n, axis)[i] + k * period;
      if (k == 0 || at < -margin || at > period + margin)
        continue;
      if (n->copies == n->room)
        PACKING_I_TRY(grow(n, n->room + n->room / 2 + 64));
      const size_t c = n->copies++;
      n->x[c] = n->x[i];
      n->y[c] = n->y[i];
      n->z[c] = n->z[i];
      n->r[c] = n->r[i];
      axis_of(n, axis)[c] = at;
      n->particle[c] = n->particle[i];
      n->image[c] = n->image[i] + k * code;
    }
  return PACKING_OK;
}

static packing_status make_copies(packing_i_pore_network *n, double margin)
{
  n->copies = n->count;
  for (int axis = 0; axis < 3 && n->count > 0; axis++)
    if (n->periodic >> axis & 1U)
      PACKING_I_TRY(copy_axis(n, axis, margin));
  return PACKING_OK;
}

/* Corners by (particle, image), neighbours with them. */
static void sort_corners(const packing_i_pore_network *n, packing_i_pore_cell *c)
{
  for (int i = 1; i <= n->dim; i++)
    for (int j = i; j > 0; j--) {
      const uint32_t a = c->corner[j - 1], b = c->corner[j], k = c->neighbour[j];
      if (n->particle[a] < n->particle[b] ||
          (n->particle[a] == n->particle[b] && n->image[a] < n->image[b]))
        break;
      c->corner[j] = a;
      c->corner[j - 1] = b;
      c->neighbour[j] = c->neighbour[j - 1];
      c->neighbour[j - 1] = k;
    }
}

/* Cell `i` of the triangulation, with neighbours as there. */
static packing_i_pore_cell read_cell(const packing_i_pore_network *n,
                                     const packing_i_delaunay *t, uint32_t i)
{
  packing_i_pore_cell c = {0};
  for (int k = 0; k <= n->dim; k++) {
    c.corner[k] = packing_i_delaunay_vertex(t, i, k);
    c.neighbour[k] = t->cell[i].n[k];
  }
  sort_corners(n, &c);
  return c;
}

/* Homes: cells that are kept, found by their corners. */
typedef struct homes {
  uint32_t *of;    /* of each cell of the triangulation; NONE */
  uint32_t *table; /* open addressing; NONE */
  size_t mask;
} homes;

static size_t hash_corners(const packing_i_pore_network *n, const packing_i_pore_cell *c)
{
  uint64_t h = 0;
  for (int k = 0; k <= n->dim; k++) {
    const uint32_t image = (uint32_t)(n->image[c->corner[k]] - n->image[c->corner[0]]);
    h = (h ^ n->particle[c->corner[k]] ^ (uint64_t)image << 32) *
        UINT64_C(0x9E3779B97F4A7C15);
    h ^= h >> 29;
  }
  return (size_t)h;
}

/* Whether two cells are images of each other. */
static int is_image(const packing_i_pore_network *n, const packing_i_pore_cell *a,
                    const packing_i_pore_cell *b)
{
  const int32_t shift = n->image[a->corner[0]] - n->image[b->corner[0]];
  for (int k = 0; k <= n->dim; k++)
    if (n->particle[a->corner[k]] != n->particle[b->corner[k]] ||
        n->image[a->corner[k]] - n->image[b->corner[k]] != shift)
      return 0;
  return 1;
}

/* Where a cell, or one of its images, stands in the table, or where it would. */
static size_t find_slot(const packing_i_pore_network *n, const homes *h,
                        const packing_i_pore_cell *c)
{
  size_t slot = hash_corners(n, c) & h->mask;
  while (h->table[slot] != PACKING_I_PORES_NONE &&
         !is_image(n, &n->cell[h->table[slot]], c))
    slot = (slot + 1) & h->mask;
  return slot;
}

/* Replaces neighbours of the triangulation by homes and shifts. */
static void link_home(const packing_i_pore_network *n, const packing_i_delaunay *t,
                      const homes *h, packing_i_pore_cell *c)
{
  for (int k = 0; k <= n->dim; k++) {
    const uint32_t other = c->neighbour[k];
    c->shift[k] = 0;
    if (!packing_i_delaunay_is_real(t, other)) {
      c->neighbour[k] = PACKING_I_PORES_NONE;
    } else if (h->of[other] != PACKING_I_PORES_NONE || h->mask == 0) {
      c->neighbour[k] = h->of[other];
    } else {
      const packing_i_pore_cell away = read_cell(n, t, other);
      c->neighbour[k] = h->table[find_slot(n, h, &away)];
      c->shift[k] = n->image[away.corner[0]];
    }
  }
}

/* Room for all cells: those kept are counted first. */
static packing_status keep_homes(packing_i_pore_network *n, const packing_i_delaunay *t,
                                 homes *h)
{
  h->of = packing_i_alloc(n->allocator, t->real, sizeof *h->of);
  if (h->of == NULL)
    return packing_i_nomem(n->context);
  n->cells = 0;
  for (uint32_t i = 0; i < t->real; i++) {
    const packing_i_pore_cell c = read_cell(n, t, i);
    h->of[i] = n->image[c.corner[0]] == 0 ? n->cells++ : PACKING_I_PORES_NONE;
  }
  n->cell = packing_i_alloc(n->allocator, n->cells, sizeof *n->cell);
  if (n->cell == NULL)
    return packing_i_nomem(n->context);
  for (uint32_t i = 0; i < t->real; i++)
    if (h->of[i] != PACKING_I_PORES_NONE)
      n->cell[h->of[i]] = read_cell(n, t, i);
  return PACKING_OK;
}

static packing_status fill_table(packing_i_pore_network *n, homes *h)
{
  size_t size = 2;
  while (size < 2 * (size_t)n->cells)
    size *= 2;
  h->mask = size - 1;
  h->table = packing_i_alloc(n->allocator, size, sizeof *h->table);
  if (h->table == NULL)
    return packing_i_nomem(n->context);
  for (size_t i = 0; i < size; i++)
    h->table[i] = PACKING_I_PORES_NONE;
  for (uint32_t i = 0; i < n->cells; i++)
    h->table[find_slot(n, h, &n->cell[i])] = i;
  return PACKING_OK;
}

static packing_status list_cells(packing_i_pore_network *n, const packing_i_delaunay *t)
{
  homes h = {NULL, NULL, 0};
  packing_i_free(n->allocator, n->cell);
  n->cell = NULL;
  packing_status status = keep_homes(n, t, &h);
  if (status == PACKING_OK && n->periodic != 0)
    status = fill_table(n, &h);
  for (uint32_t i = 0; status == PACKING_OK && i < n->cells; i++)
    link_home(n, t, &h, &n->cell[i]);
  packing_i_free(n->allocator, h.of);
  packing_i_free(n->allocator, h.table);
  return status;
}

/* How far beyond the periodic cell a copy could reach into the cell's orthogonal sphere; 0 where
 * that is centred outside the container. */
static double margin_needed(const packing_i_pore_network *n, const packing_i_pore_cell *c)
{
  packing_vec3 p[4];
  double r[4], need = 0;
  packing_i_tangency t;
  for (int k = 0; k <= n->dim; k++) {
    p[k] = packing_i_pores_copy(n, c->corner[k]);
    r[k] = n->r[c->corner[k]];
  }
  if (!packing_i_tangency_set(&t, n->dim + 1, p, r) || t.height <= n->def.tolerance)
    return 0;
  const packing_vec3 centre = packing_i_add(t.origin, t.u);
  if (packing_i_pores_wall(n, centre) <= 0)
    return 0;
  const double length2 = packing_i_dot(t.u, t.u) - t.r * t.r + n->r_max * n->r_max;
  const double reach = sqrt(fmax(length2, 0));
  for (int axis = 0; axis < 3; axis++) {
    const double at = packing_i_component(centre, axis);
    if (n->periodic >> axis & 1U)
      need = fmax(need, fmax(reach - at, at + reach - n->period[axis]));
  }
  return need;
}

static double largest_margin(const packing_i_pore_network *n)
{
  double need = 0;
  for (uint32_t i = 0; i < n->cells; i++)
    need = fmax(need, margin_needed(n, &n->cell[i]));
  return need;
}

/* The third root from x^4 = s x, by square roots: those round alike everywhere. */
static double third_root(double s)
{
  double x = 1;
  for (int k = 0; k < 40; k++)
    x = sqrt(sqrt(s * x));
  return x;
}

/* Some spacings of the particles, to begin with; `most` is what no empty sphere needs. */
static double first_margin(const packing_i_pore_network *n, double *most)
{
  double edge = 0, share = 1, diagonal = 0;
  for (int axis = 0; axis < n->dim; axis++)
    edge = fmax(edge, length(&n->box, axis));
  for (int axis = 0; axis < n->dim; axis++) {
    const double relative = length(&n->box, axis) / edge;
    share *= relative;
    diagonal += relative * relative;
  }
  share /= (double)n->count;
  *most = 2 * edge * sqrt(diagonal) + 8 * n->r_max;
  return 2 * n->r_max + 2 * edge * (n->dim == 3 ? third_root(share) : sqrt(share));
}

static packing_status triangulate_once(packing_i_pore_network *n, double margin)
{
  packing_i_delaunay *t = NULL;
  PACKING_I_TRY(make_copies(n, margin));
  const packing_i_delaunay_source source = {n->dim, n->copies, n->x, n->y, n->z, n->r};
  PACKING_I_TRY(packing_i_delaunay_create(n->context, &source, &t));
  n->hidden = 0;
  for (uint32_t i = 0; i < t->count && t->spanned == n->dim; i++)
    n->hidden += t->where[i] == PACKING_I_DELAUNAY_NONE && t->input[i] < n->count;
  const packing_status status = list_cells(n, t);
  packing_i_delaunay_destroy(t);
  return status;
}

static packing_status check_margin(packing_i_pore_network *n, double margin)
{
  for (int axis = 0; axis < 3; axis++)
    if ((n->periodic >> axis & 1U) &&
        !(4 * margin / n->period[axis] < PACKING_I_PORES_MOST_IMAGES))
      return packing_i_fail(n->context, PACKING_ERR_RANGE, "domain", PACKING_NO_INDEX,
                            "its period %g along axis %d is too short for a void of %g",
                            n->period[axis], axis, margin);
  return PACKING_OK;
}

packing_status packing_i_pores_take(packing_i_pore_network *n, const packing_view *view)
{
  if (view->count >= UINT32_MAX / 8)
    return packing_i_fail(n->context, PACKING_ERR_RANGE, "count", PACKING_NO_INDEX,
                          "%zu particles are too many", view->count);
  n->count = view->count;
  PACKING_I_TRY(grow(n, n->count));
  take_particles(n, view);
  return PACKING_OK;
}

packing_status packing_i_pores_triangulate(packing_i_pore_network *n)
{
  double most = 0;
  if (n->periodic == 0 || n->count == 0)
    return triangulate_once(n, 0);
  double margin = first_margin(n, &most);
  for (;;) {
    round_periods(n, margin);
    PACKING_I_TRY(check_margin(n, margin));
    PACKING_I_TRY(triangulate_once(n, margin));
    const double need = largest_margin(n);
    if (need <= margin || margin >= most)
      return PACKING_OK;
    margin = fmin(fmin(1.0625 * need, 2 * margin), most);
  }
}
