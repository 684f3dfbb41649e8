/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Materials and what two of them are to each other: E. M. B. Campello and K. R. Cassares, Lat.
 * Am. J. Solids Struct. 13 (2016) 23, equation 8. The paper gives neither the contact with a
 * rigid wall, E* = E / (1 - nu^2), nor damping and friction of unlike materials: the mean of
 * both unless the user sets them. A table is small and of fixed size. */
#include "dem_internal.h"
#include <math.h>

/* Pairs in any order, a material's number or RIGID_ROW: (0, 0), (1, 0), (1, 1), (2, 0), ... */
enum { RIGID_ROW = 0, ROWS = PACKING_I_MATERIALS + 1, PAIRS = ROWS * (ROWS + 1) / 2 };

/* What the user set for two materials. */
typedef struct contact {
  int set;
  double damping, friction;
} contact;

struct packing_materials {
  packing_context *context;
  size_t count;
  packing_material_def material[PACKING_I_MATERIALS];
  contact pair[PAIRS];
};

static size_t row_of(size_t material)
{
  return material == PACKING_MATERIAL_RIGID ? RIGID_ROW : material + 1;
}

static size_t pair_of(size_t a, size_t b)
{
  const size_t s = row_of(a), t = row_of(b);
  return s > t ? s * (s + 1) / 2 + t : t * (t + 1) / 2 + s;
}

void packing_material_def_fill(packing_material_def *def, size_t size)
{
  packing_material_def defaults = {.poisson = 0.25, .damping = 0.1, .friction = 0.2};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_materials_create(packing_context *context,
                                        packing_materials **materials)
{
  if (materials == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "materials", PACKING_NO_INDEX,
                          "NULL");
  packing_materials *m =
      packing_i_calloc(packing_i_allocator(context), 1, sizeof(packing_materials));
  if (m == NULL)
    return packing_i_nomem(context);
  m->context = packing_i_context_hold(context);
  *materials = m;
  return PACKING_OK;
}

void packing_materials_destroy(packing_materials *materials)
{
  if (materials == NULL)
    return;
  packing_context *context = materials->context;
  packing_i_free(packing_i_allocator(context), materials);
  packing_context_destroy(context);
}

/* (1 - nu^2) / E: how much a material gives way. */
static double compliance(const packing_material_def *d)
{
  return (1 - d->poisson) * (1 + d->poisson) / d->young;
}

static double rigid_young(const packing_material_def *d)
{
  return d->young / ((1 - d->poisson) * (1 + d->poisson));
}

static packing_status check(packing_context *context, const packing_material_def *d)
{
  PACKING_I_TRY(packing_i_check_positive(context, "density", d->density));
  PACKING_I_TRY(packing_i_check_positive(context, "young", d->young));
  PACKING_I_TRY(packing_i_check_finite(context, "poisson", d->poisson));
  if (d->poisson <= -1 || d->poisson > 0.5)
    return packing_i_fail(context, PACKING_ERR_RANGE, "poisson", PACKING_NO_INDEX,
                          "%g must be above -1 and at most 0.5", d->poisson);
  PACKING_I_TRY(packing_i_check_not_negative(context, "damping", d->damping));
  PACKING_I_TRY(packing_i_check_not_negative(context, "friction", d->friction));
  if (!isnormal(compliance(d)) || !isnormal(rigid_young(d)))
    return packing_i_fail(context, PACKING_ERR_RANGE, "young", PACKING_NO_INDEX,
                          "%g gives a stiffness beyond what a double can hold", d->young);
  return PACKING_OK;
}

packing_status packing_materials_add(packing_materials *materials,
                                     const packing_material_def *def, size_t *index)
{
  if (materials == NULL)
    return PACKING_ERR_INVALID;
  packing_context *context = materials->context;
  if (def == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "def", PACKING_NO_INDEX, "NULL");
  packing_material_def d;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_material, friction, def, &d));
  PACKING_I_TRY(check(context, &d));
  if (materials->count == PACKING_I_MATERIALS)
    return packing_i_fail(context, PACKING_ERR_RANGE, "materials", PACKING_NO_INDEX,
                          "a table has at most %d", PACKING_I_MATERIALS);
  if (index != NULL)
    *index = materials->count;
  materials->material[materials->count++] = d;
  return PACKING_OK;
}

static packing_status check_index(const packing_materials *materials, const char *field,
                                  size_t index)
{
  if (index == PACKING_MATERIAL_RIGID || index < materials->count)
    return PACKING_OK;
  return packing_i_fail(materials->context, PACKING_ERR_RANGE, field, PACKING_NO_INDEX,
                        "%zu is none of the %zu materials", index, materials->count);
}

packing_status packing_materials_set_pair(packing_materials *materials, size_t a,
                                          size_t b, double damping, double friction)
{
  if (materials == NULL)
    return PACKING_ERR_INVALID;
  packing_context *context = materials->context;
  PACKING_I_TRY(check_index(materials, "a", a));
  PACKING_I_TRY(check_index(materials, "b", b));
  if (a == PACKING_MATERIAL_RIGID && b == PACKING_MATERIAL_RIGID)
    return packing_i_fail(context, PACKING_ERR_INVALID, "b", PACKING_NO_INDEX,
                          "two rigid walls never touch");
  PACKING_I_TRY(packing_i_check_not_negative(context, "damping", damping));
  PACKING_I_TRY(packing_i_check_not_negative(context, "friction", friction));
  materials->pair[pair_of(a, b)] = (contact){1, damping, friction};
  return PACKING_OK;
}

static packing_pair_material against_rigid(const packing_materials *materials, size_t a)
{
  const packing_material_def *d = &materials->material[a];
  const contact *set = &materials->pair[pair_of(a, PACKING_MATERIAL_RIGID)];
  return (packing_pair_material){.young = rigid_young(d),
                                 .damping = set->set ? set->damping : d->damping,
                                 .friction = set->set ? set->friction : d->friction};
}

static packing_pair_material of_two(const packing_materials *materials, size_t a,
                                    size_t b)
{
  const packing_material_def *d = &materials->material[a], *e = &materials->material[b];
  const contact *set = &materials->pair[pair_of(a, b)];
  return (packing_pair_material){
      .young = 1 / (compliance(d) + compliance(e)),
      .damping = set->set ? set->damping : 0.5 * d->damping + 0.5 * e->damping,
      .friction = set->set ? set->friction : 0.5 * d->friction + 0.5 * e->friction};
}

packing_status packing_i_materials_table(packing_context *context,
                                         const packing_materials *materials,
                                         packing_i_pair_table *table)
{
  const size_t count = materials->count;
  if (count == 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "materials", PACKING_NO_INDEX,
                          "a table without a material");
  table->count = count;
  for (size_t a = 0; a < count; a++) {
    packing_pair_material *pair = &table->pair[a * (count + 1)];
    double *share = &table->share[a * (count + 1)];
    const double own = compliance(&materials->material[a]);
    table->density[a] = materials->material[a].density;
    for (size_t b = 0; b < count; b++) {
      pair[b] = of_two(materials, a, b);
      share[b] = own / (own + compliance(&materials->material[b]));
    }
    pair[count] = against_rigid(materials, a);
    share[count] = 1;
  }
  return PACKING_OK;
}
