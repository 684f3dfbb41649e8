/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The interface of all placers. */
#include "place_internal.h"

const char *packing_placer_state_name(packing_placer_state state)
{
  switch (state) {
  case PACKING_PLACER_RUNNING:
    return "running";
  case PACKING_PLACER_DONE:
    return "done";
  case PACKING_PLACER_SATURATED:
    return "saturated";
  case PACKING_PLACER_GAVE_UP:
    return "gave up";
  }
  return "unknown";
}

packing_status packing_i_placer_create(packing_context *context,
                                       const packing_i_placer_ops *ops,
                                       packing_domain *domain, packing_psd *psd,
                                       packing_particles *particles,
                                       packing_placer **placer)
{
  if (domain == NULL || psd == NULL || particles == NULL || placer == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID,
                          domain == NULL      ? "domain"
                          : psd == NULL       ? "psd"
                          : particles == NULL ? "particles"
                                              : "placer",
                          PACKING_NO_INDEX, "NULL");
  if (packing_domain_dim(domain) != packing_particles_dim(particles))
    return packing_i_fail(context, PACKING_ERR_RANGE, "particles", PACKING_NO_INDEX,
                          "the store has %d dimensions, the domain %d",
                          packing_particles_dim(particles), packing_domain_dim(domain));
  packing_placer *p = packing_i_calloc(packing_i_allocator(context), 1, sizeof *p);
  if (p == NULL)
    return packing_i_nomem(context);
  p->ops = ops;
  p->context = packing_i_context_hold(context);
  p->domain = packing_domain_retain(domain);
  p->psd = packing_psd_retain(psd);
  p->particles = particles;
  p->domain_volume = packing_domain_volume(domain);
  packing_placer_report_init(&p->tally);
  *placer = p;
  return PACKING_OK;
}

packing_status packing_i_placer_check_room_of(const packing_placer *placer, double r)
{
  const unsigned periodic = packing_domain_periodic(placer->domain);
  packing_bounds b;
  packing_domain_bounds(placer->domain, &b);
  int room = 1;
  for (int axis = 0; axis < 3; axis++)
    if ((periodic >> axis & 1U) &&
        packing_i_component(b.hi, axis) - packing_i_component(b.lo, axis) < 2 * r)
      room = 0;
  packing_domain *inset = NULL;
  packing_status status = PACKING_OK;
  if (room)
    status = packing_domain_create_inset(NULL, placer->domain,
                                         r * (1 - packing_i_room_slack), &inset);
  packing_domain_destroy(inset);
  if (status == PACKING_ERR_NOMEM)
    return packing_i_nomem(placer->context);
  /* Room whose volume cannot be computed well enough is room. */
  if (room && (status == PACKING_OK || status == PACKING_ERR_RANGE))
    return PACKING_OK;
  return packing_i_fail(placer->context, PACKING_ERR_GEOMETRY, "psd", PACKING_NO_INDEX,
                        "a particle of radius %.12g does not fit into the container", r);
}

packing_status packing_i_placer_check_room(const packing_placer *placer)
{
  return packing_i_placer_check_room_of(placer, packing_psd_max_r(placer->psd));
}

packing_status packing_i_placer_put_body(packing_placer *placer, packing_vec3 centre,
                                         double r, size_t component, double volume)
{
  packing_particles *store = placer->particles;
  PACKING_I_TRY(packing_i_particles_push(store, centre.x, centre.y, centre.z, r));
  if (store->component != NULL)
    store->component[store->count - 1] = (int32_t)component;
  placer->tally.placed++;
  placer->tally.solid_volume += volume;
  placer->tally.volume_fraction = placer->tally.solid_volume / placer->domain_volume;
  return PACKING_OK;
}

packing_status packing_i_placer_put(packing_placer *placer, packing_vec3 centre, double r,
                                    size_t component)
{
  return packing_i_placer_put_body(placer, centre, r, component,
                                   packing_i_ball_volume(placer->particles->dim, r));
}

packing_status packing_placer_step(packing_placer *placer, size_t budget,
                                   packing_placer_report *report)
{
  if (placer == NULL)
    return PACKING_ERR_INVALID;
  packing_context *context = placer->context;
  if (budget == 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "budget", PACKING_NO_INDEX,
                          "0 must be at least 1");
  if (report != NULL && report->struct_size < sizeof report->struct_size)
    return packing_i_report_write(context, report, &placer->tally, sizeof placer->tally);
  if (placer->tally.state == PACKING_PLACER_RUNNING)
    PACKING_I_TRY(placer->ops->step(placer, budget));
  if (placer->tally.state != PACKING_PLACER_RUNNING)
    placer->tally.progress = 1;
  if (report == NULL)
    return PACKING_OK;
  return packing_i_report_write(context, report, &placer->tally, sizeof placer->tally);
}

void packing_placer_destroy(packing_placer *placer)
{
  if (placer == NULL)
    return;
  if (placer->method != NULL)
    placer->ops->release(placer);
  packing_psd_destroy(placer->psd);
  packing_domain_destroy(placer->domain);
  packing_context *context = placer->context;
  packing_i_free(packing_i_allocator(context), placer);
  packing_context_destroy(context);
}
