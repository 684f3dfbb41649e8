/* SPDX-License-Identifier: GPL-3.0-or-later */
/* packing-measure: what can be shown about a pack, from anyone. */
#include <stdlib.h>
#include "common/program.h"
#include "measure/measure.h"

static int read_domain(measure_job *job)
{
  const measure_options *o = job->asked;
  int code = input_domain(&o->in, o->common.domain, &job->spec, &job->domain_text);
  if (!code && !job->domain_text)
    return program_fail(PROGRAM_BAD_INPUT,
                        "--domain is missing, and %s tells no container; see --help",
                        o->in.path);
  return code ? code
              : domain_spec_create_noting(job->context, &job->spec, &job->files,
                                          &job->domain);
}

static int set_up(measure_job *job)
{
  measure_options *o = job->asked;
  int code = options_context(&o->common, &job->context);
  input_announce(&o->in, &job->files);
  if (!code)
    code = input_read(&o->in, job->context, &job->files);
  if (!code)
    code = read_domain(job);
  if (!code && o->common.psd)
    code = psd_spec_create(job->context, o->common.psd, job->spec.dim, &job->psd,
                           &job->files);
  if (!code)
    code = sizes_read_sieves(job);
  if (code)
    return code;
  measure_options_complete(o, &job->spec);
  packing_particles_view(o->in.particles, &job->view);
  if (job->spec.dim == 2)
    job->view.z.data = NULL;
  return measure_add_outputs(job);
}

static int run(measure_job *job, const char *command)
{
  const double start = program_seconds();
  int code = set_up(job);
  if (!code)
    code = measure_run(job);
  if (!code)
    code = measure_write(job, command, start);
  if (code)
    return code;
  input_tell_domain(&job->asked->in, job->asked->common.domain, job->domain_text);
  if (!job->asked->common.quiet)
    measure_summary(job);
  return 0;
}

static void clean_up(measure_job *job)
{
  measure_free(job);
  packing_psd_destroy(job->psd);
  packing_domain_destroy(job->domain);
  free(job->domain_text);
  input_files_free(&job->files);
  measure_options_free(job->asked);
  packing_context_destroy(job->context);
}

int main(int argc, char **argv)
{
  measure_options o;
  measure_job job = {.asked = &o};
  measure_options_init(&o);
  report_init(&job.report);
  standard_files_fill();
  interrupt_catch();
  int code = options_parse(&measure_argp, argc, argv, &o);
  if (!code)
    code = measure_options_check(&o);
  if (!code) {
    char *command = program_command_line(argc, argv);
    code = run(&job, command);
    free(command);
  }
  clean_up(&job);
  return code;
}
