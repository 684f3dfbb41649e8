/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_TANGENCY_H
#define PACKING_TANGENCY_H

/** \file packing/tangency.h
 *  Placing a particle in contact with others by moving it without turning: Problem 1 of
 *  the seed paper (section 3.4). Two bodies are given in the plane, three in space;
 *  there are two places, one or none. First comes the one from which bodies 0, 1 and 2
 *  turn counter-clockwise; in the plane, the one to the right of the way from body 0 to
 *  body 1.
 *
 *  A method is a descriptor; those of the library are packing_contact_method_named(). A
 *  host may make its own. */

#include <packing/shape.h>

PACKING_BEGIN_DECLS

/** A particle to be placed, and what it shall touch. */
typedef struct packing_contact_task {
  size_t struct_size;    /**< set by packing_contact_task_init() */
  int dim;               /**< 2 or 3: so many bodies are to be touched */
  packing_body mobile;   /**< its centre does not count */
  packing_body fixed[3]; /**< particles or walls, at least one of them a particle; in
       periodic cells the images that are meant; in two dimensions z is 0 */
} packing_contact_task;

/** Makes an empty task.
 *  \param[out] task zeroed, three dimensions, its size noted */
static inline void packing_contact_task_init(packing_contact_task *task)
{
  memset(task, 0, sizeof *task);
  task->struct_size = sizeof *task;
  task->dim = 3;
}

/** A way to place a particle in contact. */
typedef struct packing_contact_method {
  const char *name;      /**< as in "wrappers" */
  const char *reference; /**< paper and section */
  int exact; /**< 1: every body of the task is touched; 0: at least one, none overlapped */
  /** Finds the places. `user` is the one below. Returns how many, 0 to 2, in an order
   *  that depends on the task alone. Thread-safe. */
  int (*place)(void *user, const packing_contact_task *task, packing_vec3 centre[2]);
  void *user; /**< passed to the function */
} packing_contact_method;

/** Intersects the wrappers: the surfaces on which the centre lies while the particle
 *  touches one body (section 3.4.1). Exact, gaps are 0 to rounding; spheres, discs and
 *  walls. A particle that just fits between the bodies has one place.
 *  \return a constant */
PACKING_API const packing_contact_method *packing_contact_wrappers(void);

/** Minimises the sizes of the gaps (section 3.4.2, equation 2), from starts on either
 *  side. Exact, gaps are at most 1e-12 of the particle's radius (or 8 rounding units of
 *  the coordinates); every shape.
 *  \return a constant */
PACKING_API const packing_contact_method *packing_contact_potential(void);

/** Bisects along the line through the middle of the bodies (section 3.4.3, equation 3).
 *  Every shape; at least one body is touched, to 2^-40 of the particle's radius, and none
 *  is overlapped. With walls the line runs along them.
 *  \return a constant */
PACKING_API const packing_contact_method *packing_contact_binary(void);

/** Moves along the same line by the least directional distance (section 3.4.3, equations
 *  4 to 10). Every shape; at least one body is touched.
 *  \return a constant */
PACKING_API const packing_contact_method *packing_contact_direct(void);

/** A method by name.
 *  \param name wrappers, potential, binary or direct
 *  \return a constant; NULL for other names. Thread-safe */
PACKING_API const packing_contact_method *packing_contact_method_named(const char *name);

/** Places a particle. Nothing is allocated.
 *  \param method the method
 *  \param task what is asked
 *  \param[out] centre up to two places [L]
 *  \return how many, 0 to 2; 0 also for a method that cannot do the shapes, and for NULL.
 *          Thread-safe */
PACKING_API int packing_contact_place(const packing_contact_method *method,
                                      const packing_contact_task *task,
                                      packing_vec3 centre[2]);

PACKING_END_DECLS

#endif
