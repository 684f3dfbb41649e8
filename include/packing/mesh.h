/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_MESH_H
#define PACKING_MESH_H

/** \file packing/mesh.h
 *  Triangle meshes: surfaces that containers are made of. A mesh is immutable,
 *  reference-counted and can be shared by threads and contexts. Files are read by
 *  packing_read_mesh() (packing/readers.h); packing_domain_create_mesh() (packing/domain.h) makes
 *  a container of a mesh that packing_mesh_check() finds sound. */

#include <packing/types.h>

PACKING_BEGIN_DECLS

/** A triangle mesh. */
typedef struct packing_mesh packing_mesh;

/** Lets go of a mesh; what was made from it keeps it.
 *  \param mesh NULL is fine. Thread-safe */
PACKING_API void packing_mesh_destroy(packing_mesh *mesh);

/** Takes one more hold of a mesh; each needs its packing_mesh_destroy().
 *  \param mesh the mesh
 *  \return mesh. Thread-safe */
PACKING_API packing_mesh *packing_mesh_retain(packing_mesh *mesh);

/** Options of packing_mesh_create(). */
typedef struct packing_mesh_def {
  size_t struct_size;     /**< set by packing_mesh_def_init() */
  size_t vertex_count;    /**< at least 3 */
  const double *vertices; /**< x, y, z of each vertex [L] */
  size_t triangle_count;  /**< at least 1; at most 2^28 */
  /** Three vertices of each triangle, counter-clockwise seen from outside; NULL: vertices 0, 1, 2
   *  are the first triangle, 3, 4, 5 the second ... */
  const uint32_t *triangles;
  /** Vertices at most this far from an earlier one, relative to the diagonal of the bounds [1],
   *  become that one, and triangles that lose a corner by it are left out. 0 (default): only
   *  vertices at the very same place become one, and no triangle is left out. At most 0.01. */
  double merge;
  double scale;       /**< multiplies the vertices [1], > 0; default 1 */
  packing_vec3 shift; /**< added after that [L]; default 0 */
} packing_mesh_def;

/** Writes the defaults; called through packing_mesh_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_mesh_def_fill(packing_mesh_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_mesh_def_init(packing_mesh_def *def)
{
  packing_mesh_def_fill(def, sizeof *def);
}

/** Makes a mesh of a copy of the arrays, and a tree over its triangles. It may have every defect
 *  that packing_mesh_check() knows. Vertices are merged (see packing_mesh_def), the rest keeps its
 *  order; vertices of no triangle are left out. Coordinates smaller than 2^-144 of the largest
 *  become 0.
 *  \param context NULL is fine
 *  \param def options; the arrays have no default
 *  \param[out] mesh the mesh
 *  \return PACKING_OK; PACKING_ERR_INVALID (NULL; a coordinate that is no finite number);
 *          PACKING_ERR_RANGE (an index that is no vertex; no triangles, or too many; lengths whose
 *          cubes a double does not hold); PACKING_ERR_GEOMETRY (merging left nothing);
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI. N log N time; some 150 bytes a triangle */
PACKING_API PACKING_WARN_UNUSED packing_status packing_mesh_create(
    packing_context *context, const packing_mesh_def *def, packing_mesh **mesh);

/** The arrays of a mesh. */
typedef struct packing_mesh_view {
  size_t struct_size;        /**< set by packing_mesh_view_init() */
  size_t vertex_count;       /**< vertices */
  const double *vertices;    /**< x, y, z of each [L]; 64-byte aligned */
  size_t triangle_count;     /**< triangles */
  const uint32_t *triangles; /**< three vertices of each; 64-byte aligned */
} packing_mesh_view;

/** Makes a view of nothing.
 *  \param[out] view zeroed, its size noted: the library fills no more than that */
static inline void packing_mesh_view_init(packing_mesh_view *view)
{
  memset(view, 0, sizeof *view);
  view->struct_size = sizeof *view;
}

/** Shows the arrays of a mesh.
 *  \param context NULL is fine
 *  \param mesh the mesh
 *  \param[out] view valid as long as the mesh
 *  \return PACKING_OK; PACKING_ERR_INVALID (NULL); PACKING_ERR_ABI (`view` is not initialised).
 *          Thread-safe where the context is */
PACKING_API PACKING_WARN_UNUSED packing_status packing_mesh_arrays(
    packing_context *context, const packing_mesh *mesh, packing_mesh_view *view);

/** The smallest box around a mesh.
 *  \param mesh the mesh
 *  \param[out] bounds [L]. Thread-safe */
PACKING_API void packing_mesh_bounds(const packing_mesh *mesh, packing_bounds *bounds);

/** The area of the surface.
 *  \param mesh the mesh
 *  \return sum over the triangles [L^2]. Thread-safe */
PACKING_API double packing_mesh_area(const packing_mesh *mesh);

/** The volume inside, by the divergence theorem.
 *  \param mesh the mesh
 *  \return positive where the triangles are counter-clockwise seen from outside; exact but for
 *          roundings where packing_mesh_check() finds the mesh sound [L^3]. Thread-safe */
PACKING_API double packing_mesh_volume(const packing_mesh *mesh);

/** What can be wrong with a mesh, in the order in which it is looked for. */
typedef enum packing_mesh_defect {
  PACKING_MESH_SOUND = 0,    /**< nothing */
  PACKING_MESH_DEGENERATE,   /**< a triangle without area: its corners lie on a line */
  PACKING_MESH_OPEN,         /**< an edge of one triangle only: the surface has a hole */
  PACKING_MESH_NON_MANIFOLD, /**< an edge of more than two triangles */
  PACKING_MESH_ORIENTATION,  /**< neighbours that disagree about where outside is */
  PACKING_MESH_PINCHED,      /**< a vertex in which several sheets of the surface meet */
  PACKING_MESH_ZERO_THICKNESS, /**< triangles that lie on each other, or fold back (below 1e-6
        rad) */
  PACKING_MESH_SELF_INTERSECTING, /**< triangles that cut or touch each other elsewhere than in
        what they share */
  PACKING_MESH_INVERTED /**< a closed part that faces the wrong way: inside out, or a part
               within another that is no cavity */
} packing_mesh_defect;

/** What packing_mesh_check() found. */
typedef struct packing_mesh_report {
  size_t struct_size;         /**< set by packing_mesh_report_init() */
  packing_mesh_defect defect; /**< the first kind that is there */
  size_t count;               /**< how many of that kind; 0: sound */
  size_t triangle;    /**< where the first is: a triangle; PACKING_NO_INDEX: sound */
  size_t other;       /**< the other triangle; PACKING_NO_INDEX where there is none */
  packing_vec3 point; /**< a point of it [L] */
  size_t parts;       /**< closed surfaces that do not hang together, cavities
         counted; 0 where there is a defect of edges or vertices */
} packing_mesh_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_mesh_report_init(packing_mesh_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Looks for what keeps a mesh from bounding a region. Decisions are exact (signs of determinants
 *  without roundings) but for that of folds.
 *  \param context NULL is fine
 *  \param mesh the mesh
 *  \param[out] report the finding; a defect is an answer, no failure
 *  \return PACKING_OK; PACKING_ERR_INVALID (NULL); PACKING_ERR_NOMEM; PACKING_ERR_ABI. Runs on the
 *          context's threads; N log N time for surfaces that do not fill space */
PACKING_API PACKING_WARN_UNUSED packing_status packing_mesh_check(
    packing_context *context, const packing_mesh *mesh, packing_mesh_report *report);

/** A defect in words.
 *  \param defect any value
 *  \return a constant string, as in "an open edge". Thread-safe */
PACKING_API const char *packing_mesh_defect_string(packing_mesh_defect defect);

PACKING_END_DECLS

#endif
