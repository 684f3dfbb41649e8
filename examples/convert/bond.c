/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bonds between neighbours. */
#include <stdlib.h>
#include "../common/program.h"
#include "convert.h"

/* One bond a pair, even where several images touch, and none of a particle with its own. */
static void take_pairs(convert_job *job, const packing_contact *list, size_t count)
{
  packing_bond *bonds = program_take(count, sizeof *bonds);
  size_t made = 0;
  for (size_t k = 0; k < count; k++) {
    const int again =
        made > 0 && bonds[made - 1].i == list[k].i && bonds[made - 1].j == list[k].j;
    if (list[k].i != list[k].j && !again)
      bonds[made++] = (packing_bond){.i = list[k].i, .j = list[k].j, .type = 1};
  }
  free(job->bonds);
  job->bonds = bonds;
  job->bond_count = made;
}

static packing_status find_pairs(const convert_job *job, const change *c,
                                 packing_contacts **contacts)
{
  packing_contacts_def def;
  packing_view view;
  packing_contacts_def_init(&def);
  def.gap = c->factor;
  def.walls = 0;
  def.dim = job->spec.dim;
  packing_particles_view(job->asked->in.particles, &view);
  return packing_contacts_create(job->context, &def, job->domain, &view, contacts);
}

int convert_bond(convert_job *job, const change *c)
{
  packing_contacts *contacts = NULL;
  packing_status status = find_pairs(job, c, &contacts);
  if (status != PACKING_OK)
    return convert_failed(job, c, status);
  const size_t all = packing_contacts_count(contacts);
  packing_contact *list = program_take(all, sizeof *list);
  size_t got = 0;
  status = packing_contacts_list(contacts, 0, all, list, &got);
  packing_contacts_destroy(contacts);
  if (status == PACKING_OK)
    take_pairs(job, list, got);
  free(list);
  return status == PACKING_OK ? 0 : convert_failed(job, c, status);
}
