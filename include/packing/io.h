/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_IO_H
#define PACKING_IO_H

/** \file packing/io.h
 *  Readers and writers. All go through a packing_stream, the user's or that of a
 *  packing_file. Numbers are written with 17 significant digits, so they read back as the
 *  same bits, and with a point in every locale. Readers refuse and name the line; they never
 *  repair. A stream or file is used by one thread at a time; time goes with the bytes. */

#include <packing/domain.h>
#include <packing/particles.h>
#include <packing/psd.h>

PACKING_BEGIN_DECLS

/** Where bytes come from or go to. */
typedef struct packing_stream {
  /** Reads up to `capacity` bytes; `*count` 0 with PACKING_OK is the end. NULL: write-only. */
  packing_status (*read)(void *user, void *buffer, size_t capacity, size_t *count);
  /** Writes all of `count` bytes, or fails. NULL: read-only. */
  packing_status (*write)(void *user, const void *data, size_t count);
  void *user; /**< passed through */
} packing_stream;

/** A file being read, or being written to appear whole or not at all. */
typedef struct packing_file packing_file;

/** Opens a file for reading.
 *  \param context NULL is fine
 *  \param path "-" is not special
 *  \param[out] file the file
 *  \return PACKING_OK; PACKING_ERR_IO (message: the system's reason); PACKING_ERR_INVALID
 *          (NULL); PACKING_ERR_NOMEM */
PACKING_API PACKING_WARN_UNUSED packing_status packing_file_open(packing_context *context,
                                                                 const char *path,
                                                                 packing_file **file);

/** Starts a file beside its place, under a temporary name.
 *  \param context NULL is fine
 *  \param path where it will appear; a link to a file is followed; a device (/dev/full, a pipe)
 *         is written in place
 *  \param[out] file the file
 *  \return PACKING_OK; PACKING_ERR_IO; PACKING_ERR_INVALID (NULL); PACKING_ERR_NOMEM */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_file_create(packing_context *context, const char *path, packing_file **file);

/** The stream of a file.
 *  \param file the file
 *  \return valid as long as the file */
PACKING_API packing_stream *packing_file_stream(packing_file *file);

/** Writes what is buffered, syncs, renames to the final name and closes: from here on the
 *  file stands whole, also after a power cut.
 *  \param file made by packing_file_create(); closed in any case, nothing left on failure
 *  \return PACKING_OK; PACKING_ERR_IO (also one that an earlier write had met);
 *          PACKING_ERR_INVALID (NULL, or opened for reading) */
PACKING_API PACKING_WARN_UNUSED packing_status packing_file_commit(packing_file *file);

/** Closes a file; one being written is thrown away.
 *  \param file NULL is fine */
PACKING_API void packing_file_close(packing_file *file);

/** Options of packing_write_csv(). */
typedef struct packing_csv_def {
  size_t struct_size;        /**< set by packing_csv_def_init() */
  int dim;                   /**< 3 (default); 2: no z column */
  size_t note_count;         /**< "# key: value" lines; default 0 */
  const char *const *keys;   /**< note_count strings without newline or colon */
  const char *const *values; /**< note_count strings without newline */
} packing_csv_def;

/** Writes the defaults; called through packing_csv_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_csv_def_fill(packing_csv_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_csv_def_init(packing_csv_def *def)
{
  packing_csv_def_fill(def, sizeof *def);
}

/** Writes a table: notes, a header line, a row a particle with the columns of the view.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param view the pack
 *  \param stream where to
 *  \return PACKING_OK; PACKING_ERR_INVALID; what the stream returns; PACKING_ERR_NOMEM */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_write_csv(packing_context *context, const packing_csv_def *def,
                  const packing_view *view, const packing_stream *stream);

/** Reads a table as packing_write_csv() makes it: `#` lines skipped, one header line, columns
 *  by name in any order; x, y, r needed, z in three dimensions; id, type, component, vx .. vz,
 *  wx .. wz, qw .. qz known, others refused. Their columns are added to the store. A vector
 *  comes whole; in two dimensions vx, vy and wz are enough. A line has at most 8192 bytes, a
 *  number at most 1024; a UTF-8 byte order mark is skipped.
 *  \param context NULL is fine
 *  \param stream where from
 *  \param[in,out] particles an empty store, of the table's dimension (2 if it has no z); empty
 *         again on failure
 *  \return PACKING_OK; PACKING_ERR_FORMAT (message and log name the line);
 *          PACKING_ERR_RANGE (the store is not empty, or of another dimension); what the
 *          stream returns; PACKING_ERR_NOMEM */
PACKING_API PACKING_WARN_UNUSED packing_status packing_read_csv(
    packing_context *context, const packing_stream *stream, packing_particles *particles);

/** Options of packing_write_vtp(). */
typedef struct packing_vtp_def {
  size_t struct_size;        /**< set by packing_vtp_def_init() */
  int compression;           /**< 0 (default): raw; 1 to 9: zlib */
  const packing_bond *bonds; /**< `bond_count` pairs of the view's indices, or NULL */
  size_t bond_count;         /**< default 0 */
} packing_vtp_def;

/** Writes the defaults; called through packing_vtp_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_vtp_def_fill(packing_vtp_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_vtp_def_init(packing_vtp_def *def)
{
  packing_vtp_def_fill(def, sizeof *def);
}

/** Writes VTK XML PolyData (.vtp): points, vertices, point data `radius` and the optional
 *  columns of the view; bonds as lines, with cell data `bond`, their type (0 on vertices). In ParaView: Glyph with sphere, scaled by radius, factor 2. Compression
 *  runs on the context's threads; the bytes are the same for any number of them.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param view the pack
 *  \param stream where to
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_UNSUPPORTED (compression in a library
 *          built without zlib); what the stream returns; PACKING_ERR_NOMEM */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_write_vtp(packing_context *context, const packing_vtp_def *def,
                  const packing_view *view, const packing_stream *stream);

/** Options of packing_write_lammps(). */
typedef struct packing_lammps_def {
  size_t struct_size; /**< set by packing_lammps_def_init() */
  int dim;            /**< 3 (default) or 2 */
  double density;     /**< of the particles [M L^-3], > 0; default 1000 */
  packing_bounds
      box;           /**< the simulation box; all zeros (default): around the particles */
  const char *title; /**< first line, without newline; NULL: a word of ours */
  const packing_bond *bonds; /**< `bond_count` pairs of the view's indices, or NULL */
  size_t bond_count;         /**< default 0 */
} packing_lammps_def;

/** Writes the defaults; called through packing_lammps_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_lammps_def_fill(packing_lammps_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_lammps_def_init(packing_lammps_def *def)
{
  packing_lammps_def_fill(def, sizeof *def);
}

/** Writes LAMMPS data for `atom_style sphere`, which LIGGGHTS reads too: id, type, diameter,
 *  density, x, y, z; velocities where the view has them. Ids are index + 1 unless the view has
 *  ids. In two dimensions the box is one largest diameter thick around z = 0. With bonds it is
 *  data for `atom_style hybrid sphere bond` (LAMMPS only): id, type, x, y, z, diameter, density,
 *  molecule, and a section Bonds; particles that hold together are one molecule, 0 is none.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param view the pack
 *  \param stream where to
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE (density; a centre outside the
 *          box, an empty box; an id not in 1 .. 2^31 - 1; more particles than that; a type
 *          below 1, also of a bond); PACKING_ERR_INVALID also for an id that stands twice and a
 *          bond of a particle that is not there or with itself; what the stream returns;
 *          PACKING_ERR_NOMEM */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_write_lammps(packing_context *context, const packing_lammps_def *def,
                     const packing_view *view, const packing_stream *stream);

/** Options of packing_write_yade(). */
typedef struct packing_yade_def {
  size_t struct_size; /**< set by packing_yade_def_init() */
  int header;         /**< 1: a first line `#format x_y_z_r`, for ymport.text() only; 0
       (default): rows only, for ymport.text() and pack.SpherePack().load() both */
  packing_vec3
      period; /**< cell of SpherePack, written as a first line `##PERIODIC::`; all 0
       (default): none. Goes without `header` */
} packing_yade_def;

/** Writes the defaults; called through packing_yade_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_yade_def_fill(packing_yade_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_yade_def_init(packing_yade_def *def)
{
  packing_yade_def_fill(def, sizeof *def);
}

/** Writes YADE text: rows `x y z r`, tab-separated, no blank line.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param view the pack
 *  \param stream where to
 *  \return PACKING_OK; PACKING_ERR_INVALID (also a header and a period); PACKING_ERR_RANGE (a
 *          period with a side that is not above 0); what the stream returns; PACKING_ERR_NOMEM */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_write_yade(packing_context *context, const packing_yade_def *def,
                   const packing_view *view, const packing_stream *stream);

/** Options of packing_write_xyz(). */
typedef struct packing_xyz_def {
  size_t struct_size; /**< set by packing_xyz_def_init() */
  packing_bounds
      box; /**< the cell; all zeros (default): around the particles; lo.z = hi.z:
       one largest diameter thick around z = 0 */
  unsigned periodic; /**< sum of PACKING_PERIODIC_ */
  double time;       /**< of the frame [T], default 0 */
} packing_xyz_def;

/** Writes the defaults; called through packing_xyz_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_xyz_def_fill(packing_xyz_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_xyz_def_init(packing_xyz_def *def)
{
  packing_xyz_def_fill(def, sizeof *def);
}

/** Writes extended XYZ, as OVITO and ASE read it: count, a line of properties with the cell,
 *  rows `X x y z r id`, then type, velocity, spin and orientation (x, y, z, w) where the view has
 *  them. Ids are index + 1 unless the view has ids.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param view the pack
 *  \param stream where to
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE (an empty box); what the stream returns; PACKING_ERR_NOMEM */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_write_xyz(packing_context *context, const packing_xyz_def *def,
                  const packing_view *view, const packing_stream *stream);

/** Options of packing_read_curve(). */
typedef struct packing_read_curve_def {
  size_t struct_size; /**< set by packing_read_curve_def_init() */
  packing_by by;      /**< what the shares count; default mass */
  int dim;            /**< 3 (default) or 2, see packing_psd_curve_def */
  double scale;       /**< multiplies the diameters [1], > 0; default 1 */
} packing_read_curve_def;

/** Writes the defaults; called through packing_read_curve_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_read_curve_def_fill(packing_read_curve_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_read_curve_def_init(packing_read_curve_def *def)
{
  packing_read_curve_def_fill(def, sizeof *def);
}

/** Reads a grading curve: `#` lines skipped, a header `diameter,percent_passing` (0 to 100) or
 *  `diameter,passing` (0 to 1), rising rows from 0 to 100 or 1.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param stream where from
 *  \param[out] psd the distribution, of kind "curve"
 *  \return PACKING_OK; PACKING_ERR_FORMAT (malformed, descending or truncated; message and log
 *          name the line); PACKING_ERR_INVALID; PACKING_ERR_RANGE; what the stream returns;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_read_curve(packing_context *context, const packing_read_curve_def *def,
                   const packing_stream *stream, packing_psd **psd);

/** Options of packing_read_polygon(). */
typedef struct packing_read_polygon_def {
  size_t struct_size;  /**< set by packing_read_polygon_def_init() */
  double scale;        /**< multiplies the coordinates [1], > 0; default 1 */
  packing_vec3 offset; /**< is added to them then [L], z = 0; default 0 */
} packing_read_polygon_def;

/** Writes the defaults; called through packing_read_polygon_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_read_polygon_def_fill(packing_read_polygon_def *def,
                                               size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_read_polygon_def_init(packing_read_polygon_def *def)
{
  packing_read_polygon_def_fill(def, sizeof *def);
}

/** Reads a polygon with holes: `#` lines skipped, a header with `x` and `y` and perhaps `ring`
 *  and `hole`, then a vertex a row. A blank line ends a ring, and so does another number under
 *  `ring`; a last vertex equal to the first one of its ring is dropped. `hole` is 1 in rings
 *  that are to be holes, else 0. At most 1e7 vertices.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param stream where from
 *  \param[out] domain the container, see packing_domain_create_polygon()
 *  \return PACKING_OK; PACKING_ERR_FORMAT (malformed; message and log name the line);
 *          PACKING_ERR_GEOMETRY (no polygon: rings cross, ...); PACKING_ERR_INVALID;
 *          PACKING_ERR_RANGE; what the stream returns; PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_read_polygon(packing_context *context, const packing_read_polygon_def *def,
                     const packing_stream *stream, packing_domain **domain);

/** Options of packing_read_sample(). */
typedef struct packing_read_sample_def {
  size_t struct_size; /**< set by packing_read_sample_def_init() */
  packing_by by;      /**< what each radius counts; default number */
  int dim;            /**< 3 (default) or 2, see packing_psd_sample_def */
  double bandwidth;   /**< see packing_psd_sample_def; default 0 */
  double scale;       /**< multiplies the radii [1], > 0; default 1 */
} packing_read_sample_def;

/** Writes the defaults; called through packing_read_sample_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_read_sample_def_fill(packing_read_sample_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_read_sample_def_init(packing_read_sample_def *def)
{
  packing_read_sample_def_fill(def, sizeof *def);
}

/** Reads a list of radii, one a line; `#` lines and blank lines skipped.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param stream where from
 *  \param[out] psd the distribution, of kind "sample"
 *  \return as packing_read_curve() */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_read_sample(packing_context *context, const packing_read_sample_def *def,
                    const packing_stream *stream, packing_psd **psd);

PACKING_END_DECLS

#endif
