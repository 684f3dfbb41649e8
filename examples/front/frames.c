/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures of the growth: figures 3 and 4 of Perez Morales et al. Particles are only added while
 * the pack grows, so a moment is how many there were and which of them were the front. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "../common/picture.h"
#include "../common/program.h"
#include "front.h"

static int keep_frame(front_job *job, size_t count)
{
  front_frame *f = &job->frames[job->frame_count];
  *f = (front_frame){.count = count, .volume_fraction = job->placed.volume_fraction};
  packing_status status = packing_front_members(job->placer, 0, NULL, &f->members);
  f->member = program_take(f->members, sizeof *f->member);
  job->frame_count++;
  if (status == PACKING_OK)
    status = packing_front_members(job->placer, f->members, f->member, &f->members);
  return status == PACKING_OK ? 0 : front_status(job, status);
}

/* A frame at each k-th part of the work, and the end. */
int front_frames_look(front_job *job)
{
  const size_t wanted = job->asked->frame_count;
  const size_t count = packing_particles_count(job->particles);
  const int ended = job->placed.state != PACKING_PLACER_RUNNING || interrupted();
  if (wanted == 0)
    return 0;
  if (!job->frames)
    job->frames = program_take(wanted, sizeof *job->frames);
  if (job->frame_count == wanted)
    return 0;
  if (!ended && (job->placed.progress * (double)wanted < (double)(job->frame_count + 1) ||
                 job->frame_count + 1 == wanted))
    return 0;
  return keep_frame(job, count);
}

/* The pack as it grew, before it is loosened or moved. */
int front_frames_keep(front_job *job)
{
  packing_particles_def def;
  packing_view view;
  if (!job->frames || !(job->asked->loosen_given || job->asked->settle))
    return 0;
  packing_particles_def_init(&def);
  def.dim = job->spec.dim;
  packing_particles_view(job->particles, &view);
  packing_status status = packing_particles_create(job->context, &def, &job->grown);
  if (status == PACKING_OK)
    status = packing_particles_assign(job->grown, &view);
  return status == PACKING_OK ? 0 : program_status(job->context, status, "--frames");
}

void front_frames_free(front_job *job)
{
  for (size_t i = 0; i < job->frame_count; i++)
    free(job->frames[i].member);
  free(job->frames);
}

/* The pack of a moment; the marks are to be freed. */
static pack pack_of(const front_job *job, const pack *now, const front_frame *f,
                    unsigned char **marks)
{
  static const char *const titles[] = {"growth outward, the front in red",
                                       "growth inward, the front in red"};
  pack p = *now;
  if (job->grown)
    packing_particles_view(job->grown, &p.view);
  p.view.count = f->count;
  *marks = program_take(f->count, 1);
  for (size_t k = 0; k < f->members; k++)
    (*marks)[f->member[k]] = 1;
  p.marked = *marks;
  p.title = titles[job->asked->direction];
  p.volume_fraction = job->standing_fraction + f->volume_fraction;
  return p;
}

packing_status front_frames_write(const pack *now, const packing_stream *stream, int svg)
{
  const front_job *job = now->own;
  const size_t count = job->frame_count;
  pack *packs = program_take(count, sizeof *packs);
  unsigned char **marks = program_take(count, sizeof *marks);
  for (size_t i = 0; i < count; i++)
    packs[i] = pack_of(job, now, &job->frames[i], &marks[i]);
  const packing_status status = svg ? picture_write_sheet_svg(packs, count, stream)
                                    : picture_write_sheet_png(packs, count, stream);
  for (size_t i = 0; i < count; i++)
    free(marks[i]);
  free(marks);
  free(packs);
  return status;
}
