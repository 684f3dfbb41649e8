/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Winding numbers: the triangles that a long segment crosses, counted with their orientation. A
 * crossing is five exact signs; where one is zero the segment touches a plane, an edge or a corner,
 * and another end is tried. */
#include "mesh_internal.h"

enum { TRIES = 64 };

typedef struct way {
  const packing_mesh *mesh;
  packing_i_mesh_point from, to;
  const uint32_t *part; /* NULL: all triangles count */
  uint32_t without;
  int winding, touched;
} way;

static int cross(void *user, uint32_t t)
{
  way *w = user;
  packing_i_mesh_point c[3];
  if (w->part != NULL && w->part[t] == w->without)
    return 1;
  for (int i = 0; i < 3; i++)
    c[i] = packing_i_mesh_place(w->mesh, packing_i_mesh_corner(w->mesh, t, i));
  const int from = packing_i_mesh_orient(&c[0], &c[1], &c[2], &w->from);
  const int to = packing_i_mesh_orient(&c[0], &c[1], &c[2], &w->to);
  if (from * to > 0)
    return 1;
  int s[3];
  for (int i = 0; i < 3; i++)
    s[i] = packing_i_mesh_orient(&w->from, &w->to, &c[i], &c[(i + 1) % 3]);
  const int beside =
      (s[0] > 0 || s[1] > 0 || s[2] > 0) && (s[0] < 0 || s[1] < 0 || s[2] < 0);
  if (beside)
    return 1;
  w->touched = from == 0 || to == 0 || s[0] == 0 || s[1] == 0 || s[2] == 0;
  /* the determinant is positive on the side that the normal shows to */
  w->winding += to;
  return !w->touched;
}

/* An end above the bounds and nearly above the start, so that few boxes are touched; another one
 * for each try. */
static void far_end(const packing_mesh *mesh, const double from[3], unsigned n,
                    double end[3])
{
  static const double step[] = {0.7548776662466927, 0.5698402909980532,
                                0.3247179572447460};
  for (int k = 0; k < 3; k++) {
    const double lo = packing_i_component(mesh->bounds.lo, k);
    const double hi = packing_i_component(mesh->bounds.hi, k);
    const double s = (n + 1) * step[k], along = s - floor(s);
    end[k] = k == 2 ? hi + (0.25 + along) * 0.5 * (hi - lo) + mesh->pad
                    : from[k] + (along - 0.5) * (hi - lo) * 0x1p-10;
  }
}

int packing_i_mesh_winding(const packing_mesh *mesh, const double from[3],
                           const uint32_t *part, uint32_t without)
{
  way w = {.mesh = mesh, .part = part, .without = without};
  w.from = packing_i_mesh_place(mesh, from);
  for (unsigned n = 0; n < TRIES; n++) {
    double end[3], lo[3], hi[3];
    far_end(mesh, from, n, end);
    for (int k = 0; k < 3; k++) {
      lo[k] = fmin(from[k], end[k]);
      hi[k] = fmax(from[k], end[k]);
    }
    w.to = packing_i_mesh_place(mesh, end);
    w.winding = w.touched = 0;
    packing_i_mesh_in_box(mesh, lo, hi, cross, &w);
    if (!w.touched)
      break;
  }
  return w.winding;
}
