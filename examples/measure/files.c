/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of what was found. */
#include <stdlib.h>
#include "../common/network.h"
#include "../common/table.h"
#include "measure.h"

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

packing_status write_pores(const pack *p, const packing_stream *stream)
{
  return network_write_pores(((const measure_job *)p->own)->pores.network, stream);
}

packing_status write_constrictions(const pack *p, const packing_stream *stream)
{
  return network_write_constrictions(((const measure_job *)p->own)->pores.network,
                                     stream);
}

packing_status write_network(const pack *p, const packing_stream *stream)
{
  return network_write_vtp(((const measure_job *)p->own)->pores.network, p->domain,
                           stream);
}

/* Pores within a mean radius of the box's ends are inlet or outlet. */
static packing_status write_statoil(const pack *p, int part, const packing_stream *stream)
{
  const measure_job *job = p->own;
  packing_bounds box;
  packing_domain_bounds(p->domain, &box);
  return network_write_statoil(job->pores.network, &box, job->sizes.mean, part, stream);
}

packing_status write_node1(const pack *p, const packing_stream *stream)
{
  return write_statoil(p, NETWORK_NODE1, stream);
}

packing_status write_node2(const pack *p, const packing_stream *stream)
{
  return write_statoil(p, NETWORK_NODE2, stream);
}

packing_status write_link1(const pack *p, const packing_stream *stream)
{
  return write_statoil(p, NETWORK_LINK1, stream);
}

packing_status write_link2(const pack *p, const packing_stream *stream)
{
  return write_statoil(p, NETWORK_LINK2, stream);
}
