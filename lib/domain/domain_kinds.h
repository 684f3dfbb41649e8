/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_DOMAIN_KINDS_H
#define PACKING_DOMAIN_KINDS_H

/* What the kinds of containers share; nobody outside lib/domain needs it. */

#include "domain_internal.h"

/* The start of every packing_domain_create_<kind>(): neither pointer may be NULL. */
packing_status packing_i_domain_begin(packing_context *context, const void *def,
                                      packing_domain **domain);

/* A body without walls, periodic directions and open top. */
packing_i_domain_body packing_i_domain_body_new(const packing_i_domain_ops *ops, int dim);

/* The end of it: a handle over *body, whose volume must be a positive number. `field` is to
 * blame where it is not. */
packing_status packing_i_domain_finish(packing_context *context,
                                       const packing_i_domain_body *body,
                                       const char *field, packing_domain **domain);

/* Checks of fields that several kinds have. */
packing_status packing_i_domain_check_flat(packing_context *context, const char *field,
                                           double z);
packing_status packing_i_domain_check_ring(packing_context *context, double inner,
                                           double outer);

/* Box and rectangle: intervals along `dim` axes. */
typedef struct packing_i_planar_def {
  packing_vec3 size;
  packing_vec3 corner;
  unsigned periodic;
  int open_top; /* the high side of the last axis */
  const char *size_fields[3];
} packing_i_planar_def;

packing_status packing_i_planar_create(packing_context *context,
                                       const packing_i_domain_ops *ops, int dim,
                                       const packing_i_planar_def *def,
                                       packing_domain **domain);
double packing_i_planar_signed_distance(const packing_i_domain_body *body,
                                        const packing_vec3 *point, packing_vec3 *normal);
int packing_i_planar_holds(const packing_i_domain_body *body, const packing_vec3 *centre,
                           double r);
int packing_i_planar_near_walls(const packing_i_domain_body *body,
                                const packing_vec3 *point, double reach,
                                packing_i_near_wall near[PACKING_I_NEAR_WALLS]);
packing_status packing_i_planar_inset(packing_context *context,
                                      packing_i_domain_body *body, double d);
int packing_i_planar_sphere_volume(const packing_i_domain_body *body,
                                   const packing_vec3 *centre, double r, double tolerance,
                                   double *volume, double *error);

/* The part of a ball of radius r that a plane cuts off at the height h. */
double packing_i_cap(int dim, double r, double h);

/* x - sin(x), without cancellation. */
double packing_i_minus_sin(double x);

/* What balls of radii p and q at distance d share. */
double packing_i_lens(int dim, double p, double q, double d);

/* The part of a ball round 0 within lo <= u <= hi (infinite entries are fine), and a bound of
 * its error. */
double packing_i_cut_planes(int dim, double r, const double lo[3], const double hi[3],
                            double *error);

/* What a ball and an endless cylinder share whose axis passes at distance d; the error grows with
 * radius / r, so with more than these of them slices do better. */
enum { PACKING_I_CYLINDER_RADII = 1000 };
double packing_i_ball_cylinder(double r, double radius, double d, double *error);

/* A disc in the plane. */
typedef struct packing_i_disc {
  double u, v, r;
} packing_i_disc;

enum { PACKING_I_DISCS = 3 };

/* The area that up to PACKING_I_DISCS discs and a rectangle (infinite entries are fine where
 * there is a disc) have in common, to some roundings of the smallest of them. */
double packing_i_discs_area(int count, const packing_i_disc discs[], const double lo[2],
                            const double hi[2]);

/* How much of the line start + t direction (a unit vector), least <= t <= most, lies in the
 * container. Of a periodic cell, in the cell. Not for custom containers. */
double packing_i_chord(const packing_i_domain_body *body, const packing_vec3 *start,
                       const packing_vec3 *direction, double least, double most);

/* How often intervals are halved. */
typedef struct packing_i_depths {
  int least, most; /* at most PACKING_I_DEEPEST */
} packing_i_depths;

enum { PACKING_I_DEEPEST = 40 };

/* The integral of f over [h[0], h[1]], analytic inside and with half-integer powers at its
 * ends. The tolerance is absolute; *error grows by the estimated error. */
double packing_i_integrate(double (*f)(const void *arg, double h), const void *arg,
                           const double h[2], packing_i_depths depths, double tolerance,
                           double *error);

/* Cylinder, tube, cone and silo: the polygon's corners, counter-clockwise in (rho, h) and
 * beginning at the bottom; corners in one place are fine, the axis is no wall. */
typedef struct packing_i_revolution_def {
  packing_vec3 base;
  packing_axis axis;
  int open_top; /* the wall at `height` is left out */
  double height;
  int corners;
  double rho[PACKING_I_WALLS + 1], h[PACKING_I_WALLS + 1];
} packing_i_revolution_def;

packing_status packing_i_revolution_create(packing_context *context,
                                           const packing_i_domain_ops *ops,
                                           const packing_i_revolution_def *def,
                                           packing_domain **domain);
double packing_i_revolution_signed_distance(const packing_i_domain_body *body,
                                            const packing_vec3 *point,
                                            packing_vec3 *normal);
int packing_i_revolution_holds(const packing_i_domain_body *body,
                               const packing_vec3 *centre, double r);
int packing_i_revolution_near_walls(const packing_i_domain_body *body,
                                    const packing_vec3 *point, double reach,
                                    packing_i_near_wall near[PACKING_I_NEAR_WALLS]);
packing_status packing_i_revolution_inset(packing_context *context,
                                          packing_i_domain_body *body, double d);
int packing_i_revolution_sphere_volume(const packing_i_domain_body *body,
                                       const packing_vec3 *centre, double r,
                                       double tolerance, double *volume, double *error);

/* rho and h of a point, and the direction of rho (an axis where rho is 0). */
void packing_i_revolution_local(const packing_i_revolution *p, const packing_vec3 *point,
                                double *rho, double *h, packing_vec3 *radial);

/* Sphere, circle and annulus. */
packing_status packing_i_round_create(packing_context *context,
                                      const packing_i_domain_ops *ops, int dim,
                                      const packing_i_round *def,
                                      packing_domain **domain);
double packing_i_round_signed_distance(const packing_i_domain_body *body,
                                       const packing_vec3 *point, packing_vec3 *normal);
int packing_i_round_near_walls(const packing_i_domain_body *body,
                               const packing_vec3 *point, double reach,
                               packing_i_near_wall near[PACKING_I_NEAR_WALLS]);
packing_status packing_i_round_inset(packing_context *context,
                                     packing_i_domain_body *body, double d);
int packing_i_round_sphere_volume(const packing_i_domain_body *body,
                                  const packing_vec3 *centre, double r, double tolerance,
                                  double *volume, double *error);

/* An error that is small enough: at most absolute + relative * volume. */
typedef struct packing_i_tolerance {
  double absolute, relative;
} packing_i_tolerance;

/* The volume of the points with a distance >= 0 within the bounds and, when r > 0, within a
 * ball, by subdivision until the estimated error is small enough or some `calls` distances
 * were asked for. -1: a distance was no number. */
int packing_i_subdivide(const packing_i_domain_body *body, const packing_vec3 *centre,
                        double r, packing_i_tolerance tolerance, size_t calls,
                        double *volume, double *error);

/* The same with the cheaper function of the body, where it has one. */
int packing_i_subdivide_sides(const packing_i_domain_body *body,
                              const packing_vec3 *centre, double r,
                              packing_i_tolerance tolerance, size_t calls, double *volume,
                              double *error);

/* The volume inside of a ball whose centre is at a distance d, |d| < r, from a wall with that
 * normal, and an estimate of its error. 0: it is above `enough`, or there is another wall, and
 * *volume is for nothing. Some 200 distances, of a bent wall up to 2000. */
int packing_i_cut_columns(const packing_i_domain_body *body, const packing_vec3 *centre,
                          double r, double d, packing_vec3 normal, double enough,
                          double *volume, double *error);

/* Custom containers and those that do as they do: the volume, by subdivision to a relative
 * tolerance; and an inset whose distance has been taken off already. */
packing_status packing_i_custom_volume(packing_context *context,
                                       packing_i_domain_body *body, double tolerance);
packing_status packing_i_custom_inset(packing_context *context,
                                      packing_i_domain_body *body, double d,
                                      double tolerance);
extern const packing_i_domain_ops packing_i_custom_ops;

/* Distances asked for at most: some seconds for a volume, some hundredths for one ball. */
enum { PACKING_I_CALLS_FOR_VOLUME = 1 << 24, PACKING_I_CALLS_FOR_BALL = 1 << 21 };

/* Puts a wall into a list that keeps the nearest ones, nearest first. */
void packing_i_keep_nearest(packing_i_near_wall near[PACKING_I_NEAR_WALLS], int *count,
                            packing_i_near_wall wall);

/* Unions and differences: what is additive, from what it is in both containers and in what they
 * share. -1 as soon as a measure fails. */
typedef int (*packing_i_measure)(const packing_domain *domain, const void *arg,
                                 double *value, double *error);
int packing_i_has_parts(const packing_i_domain_body *body);
int packing_i_by_parts(const packing_domain *domain, packing_i_measure measure,
                       const void *arg, double *value, double *error);

/* NULL where the body is none of these. */
const packing_i_polygon *packing_i_domain_polygon(const packing_i_domain_body *body);
const packing_i_combination *
packing_i_domain_combination(const packing_i_domain_body *body);

#endif
