/* SPDX-License-Identifier: GPL-3.0-or-later */
/* packing_write_pack(): what all formats would check is checked here, once, before the first
 * byte; then the format's own function writes. */
#include "vec.h"
#include "writers_internal.h"
#include <math.h>

enum { DEFAULT_FACETS = 64 };

void packing_write_def_fill(packing_write_def *def, size_t size)
{
  packing_write_def defaults = {.dim = 3, .density = 1000, .facets = DEFAULT_FACETS};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_i_check_line(packing_context *context, const char *field,
                                    const char *text)
{
  for (const char *at = text; at != NULL && *at != '\0'; at++)
    if ((unsigned char)*at < ' ' || *at == 0x7f)
      return packing_i_fail(context, PACKING_ERR_INVALID, field, PACKING_NO_INDEX,
                            "it holds a newline or another control character");
  return PACKING_OK;
}

void packing_i_put_title(packing_i_writer *w, const packing_i_pack *pack)
{
  packing_i_put_text(w, pack->def.title == NULL ? "pack written by libpacking"
                                                : pack->def.title);
}

void packing_i_put_vec(packing_i_writer *w, char separator, packing_vec3 v)
{
  const double rest[] = {v.y, v.z};
  packing_i_put_double(w, v.x);
  packing_i_put_doubles(w, separator, rest, 2);
}

void packing_i_put_sphere(packing_i_writer *w, char separator, const packing_view *view,
                          size_t i)
{
  const double r = packing_i_view_r(view, i);
  packing_i_put_vec(w, separator, packing_i_view_centre(view, i));
  packing_i_put_doubles(w, separator, &r, 1);
}

/* The directions of the def, or those of the domain. */
static packing_status check_periodic(packing_context *context, packing_write_def *d)
{
  const unsigned all = d->dim == 2
                           ? PACKING_PERIODIC_X | PACKING_PERIODIC_Y
                           : PACKING_PERIODIC_X | PACKING_PERIODIC_Y | PACKING_PERIODIC_Z;
  if ((d->periodic & ~all) != 0)
    return packing_i_fail(context, PACKING_ERR_INVALID, "periodic", PACKING_NO_INDEX,
                          "%u is no sum of directions", d->periodic);
  if (d->domain == NULL)
    return PACKING_OK;
  const unsigned periodic = packing_domain_periodic(d->domain);
  if (d->periodic != 0 && d->periodic != periodic)
    return packing_i_fail(context, PACKING_ERR_INVALID, "periodic", PACKING_NO_INDEX,
                          "%u, and the domain has %u", d->periodic, periodic);
  d->periodic = periodic;
  return PACKING_OK;
}

static packing_status check_def(packing_context *context, packing_write_def *d)
{
  if (d->dim != 2 && d->dim != 3)
    return packing_i_fail(context, PACKING_ERR_INVALID, "dim", PACKING_NO_INDEX,
                          "%d is neither 2 nor 3", d->dim);
  if (d->domain != NULL && packing_domain_dim(d->domain) != d->dim)
    return packing_i_fail(context, PACKING_ERR_INVALID, "domain", PACKING_NO_INDEX,
                          "of %d dimensions, the pack has %d",
                          packing_domain_dim(d->domain), d->dim);
  PACKING_I_TRY(check_periodic(context, d));
  PACKING_I_TRY(packing_i_check_positive(context, "density", d->density));
  PACKING_I_TRY(packing_i_check_finite(context, "time", d->time));
  PACKING_I_TRY(packing_i_mesh_check_facets(context, d->facets));
  return packing_i_check_line(context, "title", d->title);
}

static void join(double *lo, double *hi, double other_lo, double other_hi)
{
  *lo = other_lo < *lo ? other_lo : *lo;
  *hi = other_hi > *hi ? other_hi : *hi;
}

/* The bounds of the domain, wider where particles stand out of walls or an open top. */
static packing_bounds around_domain(const packing_i_pack *pack)
{
  packing_bounds box, grains;
  packing_domain_bounds(pack->def.domain, &box);
  if (pack->view.count == 0)
    return box;
  grains = packing_i_io_around(&pack->view);
  if ((pack->def.periodic & PACKING_PERIODIC_X) == 0)
    join(&box.lo.x, &box.hi.x, grains.lo.x, grains.hi.x);
  if ((pack->def.periodic & PACKING_PERIODIC_Y) == 0)
    join(&box.lo.y, &box.hi.y, grains.lo.y, grains.hi.y);
  if (pack->def.dim == 3 && (pack->def.periodic & PACKING_PERIODIC_Z) == 0)
    join(&box.lo.z, &box.hi.z, grains.lo.z, grains.hi.z);
  return box;
}

static packing_status find_box(packing_context *context, packing_i_pack *pack)
{
  const int given = !packing_i_io_box_unset(&pack->def.box);
  const packing_bounds box =
      given || pack->def.domain == NULL ? pack->def.box : around_domain(pack);
  return packing_i_io_box(context, &pack->view, &box, pack->def.dim == 2, &pack->box);
}

/* The unit vector along `down`, whatever its length. */
static packing_status direct(packing_context *context, int dim, packing_vec3 *down)
{
  static const char *const fields[] = {"deck.down.x", "deck.down.y", "deck.down.z"};
  PACKING_I_TRY(packing_i_check_point(context, fields, down));
  if (dim == 2 && down->z != 0)
    return packing_i_fail(context, PACKING_ERR_INVALID, "deck.down.z", PACKING_NO_INDEX,
                          "%g, and 0 is needed in two dimensions", down->z);
  const double size = fmax(fabs(down->x), fmax(fabs(down->y), fabs(down->z)));
  if (size == 0) {
    *down = dim == 2 ? packing_i_vec(0, -1, 0) : packing_i_vec(0, 0, -1);
    return PACKING_OK;
  }
  const packing_vec3 v = packing_i_vec(down->x / size, down->y / size, down->z / size);
  const double norm = packing_i_norm(v);
  *down = packing_i_vec(v.x / norm, v.y / norm, v.z / norm);
  return PACKING_OK;
}

static packing_status prepare(packing_context *context, unsigned needs,
                              packing_i_pack *pack)
{
  int32_t types;
  if (needs & PACKING_I_NEEDS_BOX)
    PACKING_I_TRY(find_box(context, pack));
  if (needs & PACKING_I_NEEDS_IDS)
    PACKING_I_TRY(packing_i_check_ids(context, &pack->view, 0));
  if ((needs & PACKING_I_NEEDS_DECK) == 0)
    return PACKING_OK;
  PACKING_I_TRY(packing_i_check_types(context, &pack->view, &types));
  PACKING_I_TRY(packing_i_deck_read(context, pack));
  return direct(context, pack->def.dim, &pack->deck.down);
}

/* The row of the table, of which `about` is the first member. */
static packing_status find_format(packing_context *context, const char *name,
                                  const packing_i_write_format **format)
{
  PACKING_I_TRY(packing_i_check_given(context, "format", name));
  for (size_t i = 0; packing_i_write_formats[i] != NULL; i++)
    if (strcmp(packing_i_write_formats[i]->about.name, name) == 0) {
      *format = packing_i_write_formats[i];
      return PACKING_OK;
    }
  return packing_i_fail(context, PACKING_ERR_INVALID, "format", PACKING_NO_INDEX,
                        "unknown, packing_write_format_at() lists those known");
}

packing_status packing_write_pack(packing_context *context, const packing_write_def *def,
                                  const char *format, const packing_view *view,
                                  const packing_stream *stream)
{
  packing_i_pack pack;
  const packing_i_write_format *row = NULL;
  memset(&pack, 0, sizeof pack);
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_write, deck, def, &pack.def));
  PACKING_I_TRY(find_format(context, format, &row));
  PACKING_I_TRY(check_def(context, &pack.def));
  PACKING_I_TRY(packing_i_io_view(context, view, pack.def.dim, &pack.view));
  PACKING_I_TRY(packing_i_check_bonds(context, pack.view.count, pack.def.bonds,
                                      pack.def.bond_count));
  PACKING_I_TRY(prepare(context, row->needs, &pack));
  return row->write(context, &pack, stream);
}
