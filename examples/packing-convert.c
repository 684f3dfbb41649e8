/* SPDX-License-Identifier: GPL-3.0-or-later */
/* packing-convert: packs from one format into others; crop, scale, shift, replicate. */
#include <stdlib.h>
#include <string.h>
#include "common/program.h"
#include "convert/convert.h"

static void copy_bonds(convert_job *job)
{
  const packing_bonds *bonds = job->asked->in.bonds;
  job->bond_count = packing_bonds_count(bonds);
  job->bonds = program_take(job->bond_count, sizeof *job->bonds);
  if (job->bond_count > 0)
    memcpy(job->bonds, packing_bonds_data(bonds), job->bond_count * sizeof *job->bonds);
}

static int set_up(convert_job *job)
{
  convert_options *o = job->asked;
  int code = options_context(&o->common, &job->context);
  input_announce(&o->in, &job->files);
  if (!code)
    code = outputs_check(&o->common.outputs, job->context, &job->files);
  if (!code)
    code = input_read(&o->in, job->context, &job->files);
  if (!code)
    code = input_domain(&o->in, o->common.domain, &job->spec, &job->domain_text);
  if (!code)
    code = domain_spec_create_noting(job->context, &job->spec, &job->files, &job->domain);
  if (!code && job->domain_text)
    job->first_domain = program_copy(job->domain_text, strlen(job->domain_text));
  return code;
}

static int run(convert_job *job, const char *command)
{
  const double start = program_seconds();
  int code = set_up(job);
  if (code)
    return code;
  job->read = packing_particles_count(job->asked->in.particles);
  copy_bonds(job);
  code = convert_change(job);
  if (code)
    return code;
  job->report.time_total = program_seconds() - start;
  code = convert_write(job, command);
  if (!code)
    input_tell_domain(&job->asked->in, job->asked->common.domain, job->first_domain);
  return code;
}

static void clean_up(convert_job *job)
{
  free(job->bonds);
  packing_domain_destroy(job->domain);
  free(job->domain_text);
  free(job->first_domain);
  input_files_free(&job->files);
  convert_options_free(job->asked);
  packing_context_destroy(job->context);
}

int main(int argc, char **argv)
{
  convert_options o;
  convert_job job = {.asked = &o};
  convert_options_init(&o);
  report_init(&job.report);
  standard_files_fill();
  interrupt_catch();
  int code = options_parse(&convert_argp, argc, argv, &o);
  if (!code)
    code = convert_options_check(&o);
  if (!code) {
    char *command = program_command_line(argc, argv);
    code = run(&job, command);
    free(command);
  }
  clean_up(&job);
  return code;
}
