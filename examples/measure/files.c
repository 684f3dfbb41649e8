/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of what was found. */
#include <stdlib.h>
#include "../common/table.h"
#include "measure.h"

enum { AT_ONCE = 65536 }; /* entries copied from the library */

static const char CONTACT_HEADER[] = "i,j,image_x,image_y,image_z,nx,ny,nz,gap,wall\n";

static void print_contact(table *t, const packing_contact *c)
{
  const long long j = c->j == PACKING_NO_INDEX ? -1 : (long long)c->j;
  table_print(t, "%zu,%lld,%d,%d,%d,%.17g,%.17g,%.17g,%.17g,%d\n", c->i, j,
              (int)c->image[0], (int)c->image[1], (int)c->image[2], c->normal.x,
              c->normal.y, c->normal.z, c->gap, (int)c->wall);
}

/* The list at once: asking for parts would cost linear time each. */
static packing_status write_list(const packing_contacts *contacts,
                                 const packing_stream *stream)
{
  table t;
  size_t all = 0, got = 0;
  if (contacts)
    all = packing_contacts_count(contacts) + packing_contacts_wall_count(contacts);
  packing_contact *list = malloc((all ? all : 1) * sizeof *list);
  packing_status status = list ? PACKING_OK : PACKING_ERR_NOMEM;
  if (list && all > 0)
    status = packing_contacts_list(contacts, 0, all, list, &got);
  table_open(&t, stream);
  table_print(&t, "%s", CONTACT_HEADER);
  for (size_t k = 0; k < got && status == PACKING_OK; k++)
    print_contact(&t, &list[k]);
  const packing_status written = table_close(&t);
  free(list);
  return status == PACKING_OK ? written : status;
}

packing_status write_contacts(const pack *p, const packing_stream *stream)
{
  const measure_job *job = p->own;
  return write_list(job->contacts, stream);
}

packing_status write_bonds(const pack *p, const packing_stream *stream)
{
  const measure_job *job = p->own;
  return write_list(job->bonds, stream);
}

packing_status write_map(const pack *p, const packing_stream *stream)
{
  const map_found *found = &((const measure_job *)p->own)->map;
  const packing_porosity_map_report *r = &found->report;
  const packing_vec3 lo = r->bounds.lo, hi = r->bounds.hi;
  table t;
  table_open(&t, stream);
  table_print(&t, "x,y,z,volume,solid,porosity\n");
  for (size_t k = 0; k < found->count; k++) {
    const packing_porosity_cell *cell = &found->cells[k];
    const double ix = (double)(k % r->nx) + 0.5, iy = (double)(k / r->nx % r->ny) + 0.5;
    const double iz = (double)(k / r->nx / r->ny) + 0.5;
    table_print(&t, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n",
                lo.x + (hi.x - lo.x) * ix / (double)r->nx,
                lo.y + (hi.y - lo.y) * iy / (double)r->ny,
                lo.z + (hi.z - lo.z) * iz / (double)r->nz, cell->volume, cell->solid,
                cell->porosity);
  }
  return table_close(&t);
}

/* ---- the network of pores ---- */

static const char *limit_name(packing_pore_limit limit)
{
  static const char *const names[] = {"free", "particle", "wall", "open"};
  return names[limit];
}

/* An index, or -1 for none. */
static long long index_of(size_t i)
{
  return i == PACKING_NO_INDEX ? -1 : (long long)i;
}

static void print_pore(table *t, size_t number, const packing_pore *pore)
{
  table_print(t, "%zu,%.17g,%.17g,%.17g,%.17g,%zu,%s,%lld,%lld,%lld,%lld\n", number,
              pore->centre.x, pore->centre.y, pore->centre.z, pore->radius,
              pore->coordination, limit_name(pore->limit), index_of(pore->particles[0]),
              index_of(pore->particles[1]), index_of(pore->particles[2]),
              index_of(pore->particles[3]));
}

packing_status write_pores(const pack *p, const packing_stream *stream)
{
  const packing_pores *network = ((const measure_job *)p->own)->pores.network;
  packing_pore *list = malloc(AT_ONCE * sizeof *list);
  packing_status status = list ? PACKING_OK : PACKING_ERR_NOMEM;
  table t;
  size_t all = network != NULL;
  table_open(&t, stream);
  table_print(&t, "pore,x,y,z,r,coordination,limit,p1,p2,p3,p4\n");
  for (size_t at = 0; at < all && status == PACKING_OK; at += AT_ONCE) {
    status = packing_pores_list(network, at, AT_ONCE, list, &all);
    for (size_t k = 0; k < AT_ONCE && at + k < all && status == PACKING_OK; k++)
      print_pore(&t, at + k, &list[k]);
  }
  free(list);
  const packing_status written = table_close(&t);
  return status == PACKING_OK ? written : status;
}

static void print_constriction(table *t, const packing_constriction *c)
{
  table_print(t, "%zu,%zu,%d,%d,%d,%.17g,%.17g,%.17g,%.17g,%s,%lld,%lld,%lld\n", c->a,
              c->b, c->image[0], c->image[1], c->image[2], c->centre.x, c->centre.y,
              c->centre.z, c->radius, limit_name(c->limit), index_of(c->particles[0]),
              index_of(c->particles[1]), index_of(c->particles[2]));
}

packing_status write_constrictions(const pack *p, const packing_stream *stream)
{
  const packing_pores *network = ((const measure_job *)p->own)->pores.network;
  packing_constriction *list = malloc(AT_ONCE * sizeof *list);
  packing_status status = list ? PACKING_OK : PACKING_ERR_NOMEM;
  table t;
  size_t all = network != NULL;
  table_open(&t, stream);
  table_print(&t, "a,b,image_x,image_y,image_z,x,y,z,r,limit,p1,p2,p3\n");
  for (size_t at = 0; at < all && status == PACKING_OK; at += AT_ONCE) {
    status = packing_pores_constrictions(network, at, AT_ONCE, list, &all);
    for (size_t k = 0; k < AT_ONCE && at + k < all && status == PACKING_OK; k++)
      print_constriction(&t, &list[k]);
  }
  free(list);
  const packing_status written = table_close(&t);
  return status == PACKING_OK ? written : status;
}
