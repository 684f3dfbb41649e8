/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far the growth was when: figure 11 of Perez Morales et al. */
#include "../common/program.h"
#include "../common/table.h"
#include "front.h"

void front_trace_look(front_job *job, double seconds)
{
  const size_t at = job->mark_count;
  if (!job->asked->trace)
    return;
  if ((at & (at - 1)) == 0) /* room for twice as many at each power of two */
    job->marks = program_take_more(job->marks, at ? 2 * at : 1, sizeof *job->marks);
  job->marks[job->mark_count++] =
      (front_mark){seconds, job->placed.placed, job->placed.volume_fraction};
}

packing_status front_trace_write(const pack *p, const packing_stream *stream)
{
  const front_job *job = p->own;
  table t;
  table_open(&t, stream);
  table_print(&t, "seconds,particles,volume_fraction\n");
  for (size_t i = 0; i < job->mark_count; i++)
    table_print(&t, "%.6f,%zu,%.17g\n", job->marks[i].seconds, job->marks[i].placed,
                job->marks[i].volume_fraction);
  return table_close(&t);
}
