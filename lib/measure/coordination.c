/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts: how many, how they are spread, and how many are left a particle once those with
 * fewer than dim + 1 (which nothing holds in place) are taken out, over and over (as in
 * L. E. Silbert, Soft Matter 6, 2010, 2918; D. Weaire's "rattlers"). Linear in particles and
 * contacts. */
#include "measure/contacts_internal.h"

/* What taking particles out needs. The network tells whom a particle owns contacts with; `start`
 * and `owner` tell who owns contacts with it. */
typedef struct removal {
  const packing_contacts *contacts;
  uint32_t *degree; /* contacts left */
  size_t *start;
  uint32_t *owner;
  uint32_t *removed; /* in order */
  size_t count;
} removal;

void packing_coordination_def_fill(packing_coordination_def *def, size_t size)
{
  packing_coordination_def defaults = {0};
  defaults.tolerance = 1e-9;
  defaults.dim = 3;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

/* Owners of contacts with each; start[] is moved to the right place by filling backwards. */
static void connect(removal *m)
{
  const packing_contacts *c = m->contacts;
  size_t end = 0;
  for (size_t p = 0; p < c->grid->count; p++) {
    end += m->degree[p] - (c->start[p + 1] - c->start[p]);
    m->start[p] = end;
  }
  m->start[c->grid->count] = end;
  for (size_t p = 0; p < c->grid->count; p++)
    for (size_t k = c->start[p]; k < c->start[p + 1]; k++)
      m->owner[--m->start[c->other[k]]] = (uint32_t)p;
}

/* A particle stands in removed[] from the moment its contacts sink below. */
static void lose_contacts(removal *m, const uint32_t *partner, size_t count, size_t least)
{
  for (size_t k = 0; k < count; k++)
    if (m->degree[partner[k]]-- == least)
      m->removed[m->count++] = partner[k];
}

/* Takes out whoever has fewer than `least` contacts left. */
static void remove_rattlers(removal *m, size_t least)
{
  const packing_contacts *c = m->contacts;
  for (size_t p = 0; p < c->grid->count; p++)
    if (m->degree[p] < least)
      m->removed[m->count++] = (uint32_t)p;
  for (size_t k = 0; k < m->count; k++) {
    const size_t p = m->removed[k];
    lose_contacts(m, c->other + c->start[p], c->start[p + 1] - c->start[p], least);
    lose_contacts(m, m->owner + m->start[p], m->start[p + 1] - m->start[p], least);
  }
}

static size_t count_below(const removal *m, size_t least)
{
  size_t below = 0;
  for (size_t p = 0; p < m->contacts->grid->count; p++)
    below += (size_t)(m->degree[p] < least);
  return below;
}

/* Nothing to link where nobody is to go, as in a crystal. */
static packing_status find_rattlers(removal *m, size_t least)
{
  const packing_contacts *c = m->contacts;
  if (count_below(m, least) == 0)
    return PACKING_OK;
  m->start = packing_i_alloc(c->allocator, c->grid->count + 1, sizeof *m->start);
  m->owner = packing_i_alloc(c->allocator, c->count, sizeof *m->owner);
  m->removed = packing_i_alloc(c->allocator, c->grid->count, sizeof *m->removed);
  if (m->start == NULL || m->owner == NULL || m->removed == NULL)
    return packing_i_nomem(c->context);
  connect(m);
  remove_rattlers(m, least);
  return PACKING_OK;
}

static void count_degrees(const removal *m, packing_coordination_report *report)
{
  for (size_t p = 0; p < m->contacts->grid->count; p++) {
    const size_t last = PACKING_COORDINATION_BINS - 1;
    report->histogram[m->degree[p] < last ? m->degree[p] : last]++;
  }
}

/* Contacts a particle among those that are left. Whoever is out has fewer than `least`. */
static double mean_left(const removal *m, size_t least)
{
  size_t ends = 0;
  const size_t left = m->contacts->grid->count - m->count;
  for (size_t p = 0; p < m->contacts->grid->count; p++)
    ends += m->degree[p] < least ? 0 : m->degree[p];
  return left == 0 ? (double)NAN : (double)ends / (double)left;
}

packing_status packing_contacts_coordination(const packing_contacts *c,
                                             packing_coordination_report *report)
{
  packing_coordination_report found;
  if (c == NULL)
    return PACKING_ERR_INVALID;
  const size_t count = c->grid->count, least = (size_t)c->dim + 1;
  removal m = {c, NULL, NULL, NULL, NULL, 0};
  packing_coordination_report_init(&found);
  m.degree = packing_i_alloc(c->allocator, count, sizeof *m.degree);
  if (m.degree == NULL)
    return packing_i_nomem(c->context);
  packing_i_contacts_count_degrees(c, m.degree);
  count_degrees(&m, &found);
  packing_status status = find_rattlers(&m, least);
  if (status == PACKING_OK) {
    found.contacts = c->count;
    found.mean = count == 0 ? (double)NAN : 2.0 * (double)c->count / (double)count;
    found.rattlers = m.count;
    found.mean_no_rattlers = mean_left(&m, least);
    status = packing_i_report_write(c->context, report, &found, sizeof found);
  }
  packing_i_free(c->allocator, m.degree);
  packing_i_free(c->allocator, m.start);
  packing_i_free(c->allocator, m.owner);
  packing_i_free(c->allocator, m.removed);
  return status;
}

packing_status packing_measure_coordination(packing_context *context,
                                            const packing_coordination_def *def,
                                            packing_domain *domain,
                                            const packing_view *view,
                                            packing_coordination_report *report)
{
  packing_coordination_def d;
  packing_contacts_def contacts_def;
  packing_contacts *contacts = NULL;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_coordination, dim, def, &d));
  if (d.dim != 2 && d.dim != 3)
    return packing_i_fail(context, PACKING_ERR_RANGE, "dim", PACKING_NO_INDEX,
                          "%d, must be 2 or 3", d.dim);
  packing_contacts_def_init(&contacts_def);
  contacts_def.tolerance = d.tolerance;
  contacts_def.dim = d.dim;
  contacts_def.walls = 0;
  PACKING_I_TRY(packing_contacts_create(context, &contacts_def, domain, view, &contacts));
  const packing_status status = packing_contacts_coordination(contacts, report);
  packing_contacts_destroy(contacts);
  return status;
}
