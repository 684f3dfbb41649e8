/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All measures, one after the other. */
#include <stdlib.h>
#include "../common/measures.h"
#include "../common/program.h"
#include "../common/progress.h"
#include "measure.h"

int measure_failed(const measure_job *job, packing_status status, const char *what)
{
  return program_status(job->context, status, what);
}

/* What all programs measure, and the contact network. */
static int measure_common(measure_job *job)
{
  const measured m = {.context = job->context,
                      .domain = job->domain,
                      .psd = job->psd,
                      .view = &job->view,
                      .dim = job->spec.dim,
                      .limit = job->asked->common.max_overlap,
                      .tolerance = job->asked->tolerance};
  return measures_fill(&job->report, &m, &job->contacts);
}

typedef struct stage {
  const char *label;
  int (*measure)(measure_job *job);
  int wanted;
} stage;

int measure_run(measure_job *job)
{
  const measure_options *o = job->asked;
  const int some = job->view.count > 0;
  const stage stages[] = {
      {"audit, contacts", measure_common, 1},
      {"contacts", contacts_measure, some},
      {"normals", normals_measure, some && (o->normals > 0 || o->plot)},
      {"order", order_measure, some && !o->no_order},
      {"radial distribution", rdf_measure, some && o->rdf},
      {"profiles", profiles_measure, o->profile_count > 0},
      {"sections", sections_measure, o->section_count > 0},
      {"map", map_measure, o->map_text != NULL},
      {"pores", pores_measure, o->pores},
      {"sizes", sizes_measure, some},
  };
  const size_t count = sizeof stages / sizeof stages[0];
  const double start = program_seconds();
  progress bar;
  int code = 0;
  progress_start(&bar, "", !o->common.quiet);
  for (size_t i = 0; i < count && !code; i++) {
    bar.label = stages[i].label;
    progress_show(&bar, (double)i / (double)count, i);
    if (stages[i].wanted)
      code = stages[i].measure(job);
    if (!code && interrupted())
      code = program_interrupted();
  }
  progress_clear();
  job->report.time_measure = program_seconds() - start;
  return code;
}

static void free_sections(measure_job *job)
{
  for (size_t i = 0; job->sections && i < job->asked->section_count; i++) {
    section_found *s = &job->sections[i];
    for (size_t k = 0; s->planes && k < s->count; k++)
      free(s->planes[k].pixels);
    free(s->planes);
  }
  free(job->sections);
}

void measure_free(measure_job *job)
{
  packing_contacts_destroy(job->contacts);
  packing_contacts_destroy(job->bonds);
  packing_pores_destroy(job->pores.network);
  for (size_t i = 0; job->profiles && i < job->asked->profile_count; i++)
    free(job->profiles[i].bins);
  free(job->profiles);
  free_sections(job);
  free(job->normals.bins);
  free(job->normals.counts);
  order_free(&job->order);
  free(job->rdf.bins);
  free(job->map.cells);
  free(job->sizes.openings);
  free(job->sizes.sieves);
  free(job->sizes.components);
}
