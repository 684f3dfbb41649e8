/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_READERS_H
#define PACKING_READERS_H

/** \file packing/readers.h
 *  Packs from other programs. Every count that a file claims is held against what stands in
 *  it before memory is asked for; a refusal names the line (in binary parts the byte) and
 *  leaves the store empty; nothing is repaired. */

#include <packing/io.h>
#include <packing/mesh.h>

PACKING_BEGIN_DECLS

/** The bonds that a file holds. One owner, as packing_particles. */
typedef struct packing_bonds packing_bonds;

/** Makes an empty list.
 *  \param context NULL is fine
 *  \param[out] bonds the list
 *  \return PACKING_OK; PACKING_ERR_INVALID (NULL); PACKING_ERR_NOMEM */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_bonds_create(packing_context *context, packing_bonds **bonds);

/** Destroys a list.
 *  \param bonds NULL is fine */
PACKING_API void packing_bonds_destroy(packing_bonds *bonds);

/** The number of bonds.
 *  \param bonds the list; NULL has none
 *  \return count */
PACKING_API size_t packing_bonds_count(const packing_bonds *bonds);

/** The bonds, in the order of the file; `i` and `j` are indices in the store read with them.
 *  \param bonds the list; NULL has none
 *  \return packing_bonds_count() bonds, valid until the list is next read into or destroyed;
 *          NULL where there are none */
PACKING_API const packing_bond *packing_bonds_data(const packing_bonds *bonds);

/** The last frame of a file, for packing_read_def.frame. */
#define PACKING_FRAME_LAST (-1)

/** Options of packing_read_pack(). */
typedef struct packing_read_def {
  size_t struct_size; /**< set by packing_read_def_init() */
  int64_t frame;      /**< which frame of a dump or extended XYZ, from 0;
            #PACKING_FRAME_LAST (default). What has no frames has one. */
  int sort; /**< 1: particles in the order of their ids, which the file must have;
               0 (default): in that of the file */
  const char *radius_name;   /**< VTK: the point array of radii; NULL (default): `radius`,
        or YADE's `radii`, or half of `diameter` */
  const char *diameter_name; /**< VTK: the point array of diameters; NULL (default): see
      radius_name; one of both at most */
  packing_bonds *bonds; /**< takes the bonds of the file, those it held are dropped; NULL
   (default): they are checked and left out */
} packing_read_def;

/** Writes the defaults; called through packing_read_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_read_def_fill(packing_read_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_read_def_init(packing_read_def *def)
{
  packing_read_def_fill(def, sizeof *def);
}

/** What a file tells beside its particles. */
typedef struct packing_read_info {
  size_t struct_size; /**< set by packing_read_info_init() */
  int dim;     /**< 2: a table without z, `Dimension 2D`, or every z is 0; else 3 */
  int has_box; /**< 1: the file has a box */
  packing_bounds box; /**< the box, its tilt left out [L] */
  packing_vec3 tilt; /**< x: xy, y: xz, z: yz, as LAMMPS names them; 0: a right box [L] */
  int has_periodic;  /**< 1: the file tells which directions are periodic */
  unsigned periodic; /**< sum of PACKING_PERIODIC_ */
  int has_density;   /**< 1: each particle has a density, and all have the same */
  double density;    /**< that density [M L^-3] */
  int has_time;      /**< 1: the frame has a time or the number of a time step */
  double time;       /**< the time where the file has one, else the time step */
  size_t particles;  /**< read */
  size_t bonds;      /**< read, or left out */
  size_t frames;     /**< in the file, at least 1 */
  size_t frame;      /**< the one read, from 0 */
} packing_read_info;

/** Makes an empty report.
 *  \param[out] info zeroed, its size noted: the library fills no more than that */
static inline void packing_read_info_init(packing_read_info *info)
{
  memset(info, 0, sizeof *info);
  info->struct_size = sizeof *info;
}

/** Reads a pack.
 *
 *  | format | what | taken over |
 *  | --- | --- | --- |
 *  | csv | packing_read_csv() | all columns |
 *  | vtp, vtu | VTK XML PolyData or UnstructuredGrid, ascii, binary, appended, zlib | id, type, component, velocity, spin, orientation |
 *  | lammps, liggghts | data of `atom_style sphere`, or of `hybrid sphere bond` | id, type, velocity, spin, bonds |
 *  | dump | text dumps of LAMMPS and LIGGGHTS | id, type, velocity, spin |
 *  | yade | rows for YADE's `ymport.text` | id, matId as type |
 *  | yade-pack | rows of YADE's `pack.SpherePack` | |
 *  | geo | ESyS-Particle | id, tag as type, bonds |
 *  | xyz | extended XYZ | id, type, velocity, spin, orientation |
 *  | xyzd | packing-generation, rows of four doubles | |
 *
 *  Text formats are read through gzip too, where the library was built with zlib. Text is
 *  read in constant memory beside the store (32 bytes a particle for what goes by id); VTK
 *  takes the file's size beside it.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param format a name of the table
 *  \param stream where from
 *  \param[in,out] particles an empty store; of two dimensions, every z of the file must be 0;
 *         of three, z is 0 where the file has none. Columns of the file are added. Empty again on
 *         failure
 *  \param[out] info what else the file tells; NULL is fine
 *  \return PACKING_OK; PACKING_ERR_FORMAT (message and log name the line, or the byte);
 *          PACKING_ERR_INVALID (NULL, an unknown format, options that contradict each other);
 *          PACKING_ERR_RANGE (the store is not empty, a frame that is not there, `sort`);
 *          PACKING_ERR_UNSUPPORTED (clumps; compressed in a library built without zlib); what
 *          the stream returns; PACKING_ERR_NOMEM; PACKING_ERR_ABI. Linear time */
PACKING_API PACKING_WARN_UNUSED packing_status packing_read_pack(
    packing_context *context, const packing_read_def *def, const char *format,
    const packing_stream *stream, packing_particles *particles, packing_read_info *info);

/** The names of the formats that packing_read_pack() knows.
 *  \param index from 0
 *  \return a constant string; NULL behind the last. Thread-safe. */
PACKING_API const char *packing_read_format(size_t index);

/** Whose format it is, for help texts.
 *  \param format a name
 *  \return a constant string without a newline, NULL for an unknown name. Thread-safe. */
PACKING_API const char *packing_read_format_about(const char *format);

/** The format that the extension of a file name stands for; a `.gz` behind that of a text
 *  format is passed over.
 *  \param path a file name
 *  \return a constant string, NULL where the extension is that of no format. Thread-safe. */
PACKING_API const char *packing_read_format_of(const char *path);

/** Formats of meshes. */
typedef enum packing_mesh_format {
  PACKING_MESH_FORMAT_AUTO = 0,   /**< what the content looks like */
  PACKING_MESH_FORMAT_STL_TEXT,   /**< STL, text */
  PACKING_MESH_FORMAT_STL_BINARY, /**< STL, binary, least byte first */
  PACKING_MESH_FORMAT_OBJ,        /**< Wavefront OBJ */
  PACKING_MESH_FORMAT_PLY /**< PLY 1.0: ascii, binary_little_endian, binary_big_endian */
} packing_mesh_format;

/** Options of packing_read_mesh(). */
typedef struct packing_read_mesh_def {
  size_t struct_size;         /**< set by packing_read_mesh_def_init() */
  packing_mesh_format format; /**< default: by content */
  double merge;               /**< see packing_mesh_def; default 0: same place only */
  double scale;               /**< see packing_mesh_def; default 1 */
  packing_vec3 shift;         /**< see packing_mesh_def; default 0 [L] */
} packing_read_mesh_def;

/** Writes the defaults; called through packing_read_mesh_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_read_mesh_def_fill(packing_read_mesh_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_read_mesh_def_init(packing_read_mesh_def *def)
{
  packing_read_mesh_def_fill(def, sizeof *def);
}

/** Reads a mesh, as it stands in the file: packing_mesh_check() says whether it is sound.
 *
 *  | format | what | passed over |
 *  | --- | --- | --- |
 *  | STL | facets; several solids are one mesh | normals, names, attributes, colours |
 *  | OBJ | `v`, `f` with positive or negative indices | `vt`, `vn`, groups, materials, lines, weights |
 *  | PLY | elements `vertex` (x, y, z of any type) and `face` (vertex_indices or vertex_index) | other properties and elements |
 *
 *  Faces of more than three corners are cut into triangles from their first corner on, so they
 *  must be convex and flat; packing_mesh_check() finds those that are not where it matters.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param stream where from
 *  \param[out] mesh the mesh
 *  \return PACKING_OK; PACKING_ERR_FORMAT (message and log name the line, or the byte);
 *          PACKING_ERR_UNSUPPORTED (OBJ curves and surfaces); PACKING_ERR_RANGE (more than 2^28
 *          triangles or vertices); what the stream and packing_mesh_create() return;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI. Linear time; memory goes with what was read, not
 *          with what the file claims */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_read_mesh(packing_context *context, const packing_read_mesh_def *def,
                  const packing_stream *stream, packing_mesh **mesh);

/** The same from a file.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param path the file
 *  \param[out] mesh the mesh
 *  \return as packing_read_mesh(); PACKING_ERR_IO */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_read_mesh_file(packing_context *context, const packing_read_mesh_def *def,
                       const char *path, packing_mesh **mesh);

PACKING_END_DECLS

#endif
