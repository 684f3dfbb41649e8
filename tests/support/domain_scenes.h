/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_TEST_DOMAIN_SCENES_H
#define PACKING_TEST_DOMAIN_SCENES_H

/* One container of each built-in kind, and the same region said the plain way: as pieces of the
 * lines along the container's axis. Header only: several test programs share it. */
#include "test.h"

#define TEST_PI 3.14159265358979323846

enum scene_kind {
  SCENE_BOX,
  SCENE_CYLINDER,
  SCENE_TUBE,
  SCENE_CONE,
  SCENE_SILO,
  SCENE_SPHERE,
  SCENE_RECTANGLE,
  SCENE_CIRCLE,
  SCENE_ANNULUS,
  SCENE_END
};

/* a .. d: box LX LY LZ; cylinder R H; tube RI RO H; cone R0 R1 H; silo R H ROUT HCONE; sphere R;
 * rectangle LX LY; circle R; annulus RI RO. `at` is the corner, base or centre. */
typedef struct scene {
  enum scene_kind kind;
  double a, b, c, d;
  packing_vec3 at;
  int axis; /* bodies of revolution; else the last axis of the container */
  int open;
  unsigned periodic;
} scene;

static inline packing_domain *scene_make(const scene *s)
{
  packing_domain *domain = NULL;
#define SCENE_MAKE(kind, ...)                                                            \
  do {                                                                                   \
    packing_domain_##kind##_def def;                                                     \
    packing_domain_##kind##_def_init(&def);                                              \
    __VA_ARGS__;                                                                         \
    assert_ok(packing_domain_create_##kind(NULL, &def, &domain));                        \
  } while (0)
#define SCENE_AXIS                                                                       \
  (def.base = s->at, def.axis = (packing_axis)s->axis, def.open_top = s->open)
  switch (s->kind) {
  case SCENE_BOX:
    SCENE_MAKE(box,
               (def.size.x = s->a, def.size.y = s->b, def.size.z = s->c,
                def.corner = s->at, def.open_top = s->open, def.periodic = s->periodic));
    break;
  case SCENE_CYLINDER:
    SCENE_MAKE(cylinder, (def.radius = s->a, def.height = s->b, SCENE_AXIS));
    break;
  case SCENE_TUBE:
    SCENE_MAKE(tube, (def.inner_radius = s->a, def.outer_radius = s->b, def.height = s->c,
                      SCENE_AXIS));
    break;
  case SCENE_CONE:
    SCENE_MAKE(cone, (def.bottom_radius = s->a, def.top_radius = s->b, def.height = s->c,
                      SCENE_AXIS));
    break;
  case SCENE_SILO:
    SCENE_MAKE(silo, (def.radius = s->a, def.height = s->b, def.outlet_radius = s->c,
                      def.hopper_height = s->d, SCENE_AXIS));
    break;
  case SCENE_SPHERE:
    SCENE_MAKE(sphere, (def.radius = s->a, def.centre = s->at));
    break;
  case SCENE_RECTANGLE:
    SCENE_MAKE(rectangle, (def.size_x = s->a, def.size_y = s->b, def.corner = s->at,
                           def.open_top = s->open, def.periodic = s->periodic));
    break;
  case SCENE_CIRCLE:
    SCENE_MAKE(circle, (def.radius = s->a, def.centre = s->at));
    break;
  case SCENE_ANNULUS:
    SCENE_MAKE(annulus,
               (def.inner_radius = s->a, def.outer_radius = s->b, def.centre = s->at));
    break;
  case SCENE_END:
    break;
  }
#undef SCENE_AXIS
#undef SCENE_MAKE
  return domain;
}

static inline int scene_dim(const scene *s)
{
  return s->kind >= SCENE_RECTANGLE ? 2 : 3;
}

/* A representative of each kind; the sizes have nothing in common. */
static inline scene scene_of(enum scene_kind kind)
{
  static const scene all[SCENE_END] = {
      {SCENE_BOX, 1.3, 0.9, 1.7, 0, {0.21, -0.43, 0.11}, 2, 0, 0},
      {SCENE_CYLINDER, 0.83, 1.7, 0, 0, {0.21, -0.43, 0.11}, 2, 0, 0},
      {SCENE_TUBE, 0.41, 1.13, 1.2, 0, {0.21, -0.43, 0.11}, 2, 0, 0},
      {SCENE_CONE, 0.37, 1.21, 1.4, 0, {0.21, -0.43, 0.11}, 2, 0, 0},
      {SCENE_SILO, 0.93, 2.1, 0.27, 0.71, {0.21, -0.43, 0.11}, 2, 0, 0},
      {SCENE_SPHERE, 1.07, 0, 0, 0, {0.21, -0.43, 0.11}, 2, 0, 0},
      {SCENE_RECTANGLE, 1.3, 0.9, 0, 0, {0.21, -0.43, 0}, 1, 0, 0},
      {SCENE_CIRCLE, 1.07, 0, 0, 0, {0.21, -0.43, 0}, 1, 0, 0},
      {SCENE_ANNULUS, 0.41, 1.13, 0, 0, {0.21, -0.43, 0}, 1, 0, 0},
  };
  return all[kind];
}

/* One piece of a line along the axis, counted with a sign. */
typedef struct scene_piece {
  double lo, hi, sign;
} scene_piece;

static inline double scene_coordinate(packing_vec3 p, int axis)
{
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/* p from (along the axis, the next, the one after), cyclically. */
static inline packing_vec3 scene_point(int axis, double h, double u, double v)
{
  double c[3] = {0, 0, 0};
  c[axis] = h;
  c[(axis + 1) % 3] = u;
  c[(axis + 2) % 3] = v;
  packing_vec3 p = {c[0], c[1], c[2]};
  return p;
}

static inline double scene_half(double radius, double rho2)
{
  return radius * radius > rho2 ? sqrt(radius * radius - rho2) : 0;
}

/* The region on the line through (u, v) across the axis, in absolute coordinates; rectangle,
 * circle and annulus lie in the plane z = 0 and have axis y, u = z and v = x. Returns the number
 * of pieces. */
static inline int scene_pieces(const scene *s, double u, double v, scene_piece piece[2])
{
  const double h = scene_coordinate(s->at, s->axis);
  const double du =
      scene_dim(s) == 2 ? 0 : u - scene_coordinate(s->at, (s->axis + 1) % 3);
  const double dv = v - scene_coordinate(s->at, (s->axis + 2) % 3);
  const double rho2 = du * du + dv * dv, rho = sqrt(rho2);
  piece[0] = piece[1] = (scene_piece){0, 0, 0};
  switch (s->kind) {
  case SCENE_BOX:
    if (((s->periodic & 1) || (du >= 0 && du <= s->a)) &&
        ((s->periodic & 2) || (dv >= 0 && dv <= s->b)))
      piece[0] = s->periodic & 4 ? (scene_piece){-HUGE_VAL, HUGE_VAL, 1}
                                 : (scene_piece){h, h + s->c, 1};
    return 1;
  case SCENE_CYLINDER:
    if (rho <= s->a)
      piece[0] = (scene_piece){h, h + s->b, 1};
    return 1;
  case SCENE_TUBE:
    if (rho >= s->a && rho <= s->b)
      piece[0] = (scene_piece){h, h + s->c, 1};
    return 1;
  case SCENE_CONE:
    if (s->b >= s->a && rho <= s->b)
      piece[0] = (scene_piece){h + (rho > s->a ? s->c * (rho - s->a) / (s->b - s->a) : 0),
                               h + s->c, 1};
    if (s->b < s->a && rho <= s->a)
      piece[0] = (scene_piece){
          h, h + (rho > s->b ? s->c * (s->a - rho) / (s->a - s->b) : s->c), 1};
    return 1;
  case SCENE_SILO:
    if (rho <= s->a)
      piece[0] = (scene_piece){h + (rho > s->c ? s->d * (rho - s->c) / (s->a - s->c) : 0),
                               h + s->b, 1};
    return 1;
  case SCENE_RECTANGLE:
    if ((s->periodic & 1) || (dv >= 0 && dv <= s->a))
      piece[0] = s->periodic & 2 ? (scene_piece){-HUGE_VAL, HUGE_VAL, 1}
                                 : (scene_piece){h, h + s->b, 1};
    return 1;
  case SCENE_SPHERE:
  case SCENE_CIRCLE:
    piece[0] = (scene_piece){h - scene_half(s->a, rho2), h + scene_half(s->a, rho2), 1};
    return 1;
  case SCENE_ANNULUS:
    piece[0] = (scene_piece){h - scene_half(s->b, rho2), h + scene_half(s->b, rho2), 1};
    piece[1] = (scene_piece){h - scene_half(s->a, rho2), h + scene_half(s->a, rho2), -1};
    return 2;
  case SCENE_END:
    break;
  }
  return 0;
}

/* Whether a point lies in the region (the border may go either way). */
static inline int scene_inside(const scene *s, packing_vec3 p)
{
  scene_piece piece[2];
  const double h = scene_coordinate(p, s->axis);
  const int n = scene_pieces(s, scene_coordinate(p, (s->axis + 1) % 3),
                             scene_coordinate(p, (s->axis + 2) % 3), piece);
  double in = 0;
  for (int i = 0; i < n; i++)
    if (h > piece[i].lo && h < piece[i].hi)
      in += piece[i].sign;
  return in > 0;
}

/* Repeatable numbers in [0, 1). */
static inline double scene_random(uint64_t *state)
{
  uint64_t z = (*state += UINT64_C(0x9E3779B97F4A7C15));
  z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
  return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/* A point in the bounds grown on all sides by `margin` times their size. */
static inline packing_vec3 scene_random_point(uint64_t *state,
                                              const packing_domain *domain, double margin)
{
  packing_bounds b;
  packing_domain_bounds(domain, &b);
  packing_vec3 p;
  p.x = b.lo.x + (b.hi.x - b.lo.x) * ((1 + 2 * margin) * scene_random(state) - margin);
  p.y = b.lo.y + (b.hi.y - b.lo.y) * ((1 + 2 * margin) * scene_random(state) - margin);
  p.z = b.lo.z + (b.hi.z - b.lo.z) * ((1 + 2 * margin) * scene_random(state) - margin);
  return p;
}

/* A scene with lengths multiplied. */
static inline scene scene_scaled(scene s, double by)
{
  s.a *= by;
  s.b *= by;
  s.c *= by;
  s.d *= by;
  s.at.x *= by;
  s.at.y *= by;
  s.at.z *= by;
  return s;
}

#endif
