/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_WRITERS_H
#define PACKING_WRITERS_H

/** \file packing/writers.h
 *  One door to all formats that a pack is written in: a table of formats by name and extension,
 *  one struct of what may be said of a pack beside its particles, one function. Also the
 *  container as a mesh (STL) and the list of a time series (PVD).
 *
 *  A format that cannot hold what the struct asks for leaves it out, as a spreadsheet leaves out
 *  bonds; packing_write_format.holds says what is kept. A format that would then tell a falsehood
 *  refuses (PACKING_ERR_UNSUPPORTED), as YADE's cell does, which is periodic in all directions or
 *  in none. Nothing is repaired: what a program would not load is refused, with the particle's
 *  index. */

#include <packing/io.h>

PACKING_BEGIN_DECLS

/** A format that packs are written in. */
typedef struct packing_write_format {
  size_t struct_size; /**< of the struct that the library has */
  const char *name;   /**< as in `--out NAME:FILE` */
  const char
      *extensions;     /**< with the dot, separated by blanks; "" where none is its own */
  const char *holds;   /**< what of a pack is in it, in a line */
  const char *program; /**< what reads it, with the release it was tried with */
  int verified; /**< 1: a test loads it into that program; 0: written as documented only */
} packing_write_format;

/** The formats in the order of their table.
 *  \param index from 0
 *  \return constant; NULL past the end. Thread-safe */
PACKING_API const packing_write_format *packing_write_format_at(size_t index);

/** The format of a name.
 *  \param name as in packing_write_format.name; NULL is none
 *  \return constant; NULL: there is none. Thread-safe, linear in the formats */
PACKING_API const packing_write_format *packing_write_format_find(const char *name);

/** The format that a file's extension stands for.
 *  \param path of which the end is looked at; NULL has none
 *  \return constant; NULL: no format has this extension. Thread-safe, linear in the formats */
PACKING_API const packing_write_format *packing_write_format_of(const char *path);

/** What a deck does with the pack that it loads: grains of one material (Hertz's contact with
 *  Mindlin's friction and damping by restitution) under gravity between walls of the same
 *  material. Any consistent units, since the deck says `units si` of numbers as they are. Bonds
 *  are loaded by LAMMPS's deck and bear no force. Names of files are plain: letters, digits and
 *  `._-/+=,@~:`. */
typedef struct packing_deck_def {
  size_t struct_size;    /**< set by packing_deck_def_init() */
  const char *data_name; /**< file with the pack; default "pack.data" */
  const char *mesh_name; /**< file with the container as STL, for LIGGGHTS's deck where
       simple walls do not do; default "container.stl" */
  const char *dump_name; /**< file that the run writes; default "run.dump" */
  double youngs_modulus; /**< [M L^-1 T^-2], > 0; default 1e7 */
  double poisson_ratio;  /**< [1], in [0, 0.5); default 0.3 */
  double friction;       /**< [1], >= 0; default 0.5 */
  double restitution;    /**< [1], in [0.05, 1]; default 0.5 */
  double gravity;        /**< magnitude [L T^-2], >= 0; default 9.81; the deck's variable
       `gravity`: `lmp -in in.pack -var gravity 0` */
  packing_vec3 down;     /**< direction of gravity, any length; default 0: -z, 2D -y */
  double timestep; /**< [T]; default 0: a fifth of Rayleigh's time of the smallest */
  uint64_t steps;  /**< of the run, the deck's variable `steps`; default 10000 */
} packing_deck_def;

/** Writes the defaults; called through packing_deck_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_deck_def_fill(packing_deck_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_deck_def_init(packing_deck_def *def)
{
  packing_deck_def_fill(def, sizeof *def);
}

/** What may be said of a pack beside its particles. All of it has a default. */
typedef struct packing_write_def {
  size_t struct_size; /**< set by packing_write_def_init() */
  int dim;            /**< 3 (default) or 2 */
  packing_bounds box; /**< the cell [L]; all zeros (default): that of `domain`, wider
       where particles stand out of it (not in periodic directions); without a domain around
       the particles. 2D: one largest diameter thick */
  unsigned periodic;  /**< sum of PACKING_PERIODIC_; default 0: those of `domain` */
  const packing_domain *domain; /**< the container: walls of decks, shape in scenes, mesh;
       NULL (default): none, decks put walls on the box */
  double density;               /**< of the particles [M L^-3], > 0; default 1000 */
  const packing_bond *bonds;    /**< `bond_count` pairs of the view's indices, or NULL */
  size_t bond_count;            /**< default 0 */
  const char *title;            /**< a line, for formats with comments; NULL: ours */
  size_t note_count;            /**< "# key: value" lines of a CSV; default 0 */
  const char *const *keys;      /**< note_count strings without newline or colon */
  const char *const *values;    /**< note_count strings without newline */
  double time;                  /**< of the pack, where a format has one [T]; default 0 */
  int compression;              /**< of vtp and vtu, 0 (default) to 9 */
  unsigned facets;              /**< of meshes, see packing_stl_def; default 64 */
  const packing_deck_def *deck; /**< for decks; NULL (default): its defaults */
} packing_write_def;

/** Writes the defaults; called through packing_write_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_write_def_fill(packing_write_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_write_def_init(packing_write_def *def)
{
  packing_write_def_fill(def, sizeof *def);
}

/** Writes a pack in a format: csv, vtp, vtu, lammps, lammps-deck, dump, liggghts, liggghts-deck,
 *  yade, yade-pack, geo, xyz, pov, stl, stl-ascii, pfc, neper-coo, neper-weight, mercury. Nothing is
 *  written before all is checked.
 *
 *  The decks are input scripts that load the file `deck.data_name` (written as lammps or
 *  liggghts from the same view and def), put the container's walls and run. stl and stl-ascii
 *  are the container alone. LAMMPS's deck makes walls of all built-in containers, LIGGGHTS's of planes and
 *  of cylinders along an axis itself, of the others from `deck.mesh_name`.
 *  \param context NULL is fine
 *  \param def what goes with the particles, or NULL for the defaults
 *  \param format a name from the table
 *  \param view the pack
 *  \param stream where to
 *  \return PACKING_OK; PACKING_ERR_INVALID (an unknown format, a field that makes no sense, a
 *          text with a newline, a bond of a particle that is not there or with itself);
 *          PACKING_ERR_RANGE (a number out of its range, also of the deck; a centre outside the box,
 *          an empty box, ids or types that the format cannot hold, more bonds than 2^31 - 1, a
 *          particle too large for PFC's domain); PACKING_ERR_UNSUPPORTED (what the format cannot
 *          say truly; a custom container as mesh or wall; compression without zlib); what the
 *          stream returns; PACKING_ERR_NOMEM; PACKING_ERR_ABI. Linear in particles and bonds */
PACKING_API PACKING_WARN_UNUSED packing_status packing_write_pack(
    packing_context *context, const packing_write_def *def, const char *format,
    const packing_view *view, const packing_stream *stream);

/** Options of packing_write_stl(). */
typedef struct packing_stl_def {
  size_t struct_size; /**< set by packing_stl_def_init() */
  int ascii; /**< 0 (default): binary, single precision; 1: text, the exact numbers */
  unsigned facets; /**< pieces of a full circle, 3 to 4096; default 64 */
  const char
      *title; /**< name of the solid, without newline; NULL (default): a word of ours */
} packing_stl_def;

/** Writes the defaults; called through packing_stl_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_stl_def_fill(packing_stl_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_stl_def_init(packing_stl_def *def)
{
  packing_stl_def_fill(def, sizeof *def);
}

/** Writes a container's walls as triangles. Normals point out of the container, by the order of
 *  the corners too. Edges meet exactly, so the surface is closed unless a top is open or a
 *  direction periodic: there are no triangles there.
 *
 *  Round walls become flat pieces that touch them from behind: polygons around outer and inside
 *  inner circles. So no particle of the container overlaps a triangle by more than it overlaps
 *  the wall; a circle's area grows by about (pi / facets)^2 / 3 of it.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param domain a container of three dimensions, not custom
 *  \param stream where to
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE (facets; a container so far off that
 *          its corners coincide; binary: a number beyond single precision);
 *          PACKING_ERR_UNSUPPORTED (two dimensions, custom, or no wall at all); what the stream
 *          returns; PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_write_stl(packing_context *context, const packing_stl_def *def,
                  const packing_domain *domain, const packing_stream *stream);

/** One file of a time series. */
typedef struct packing_pvd_entry {
  const char *file; /**< name as seen from the collection's folder, without newline */
  double time;      /**< [T] */
  int part;         /**< 0, or a number for each file of one time: particles, walls ... */
} packing_pvd_entry;

/** Writes a ParaView collection (.pvd): VTP, VTU files and their times.
 *  \param context NULL is fine
 *  \param entries `count` files
 *  \param count of files, 0 is fine
 *  \param stream where to
 *  \return PACKING_OK; PACKING_ERR_INVALID (no name, a control character in it, a time that is
 *          not finite, a part below 0); what the stream returns; PACKING_ERR_NOMEM */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_write_pvd(packing_context *context, const packing_pvd_entry *entries,
                  size_t count, const packing_stream *stream);

PACKING_END_DECLS

#endif
