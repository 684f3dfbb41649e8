/* SPDX-License-Identifier: GPL-3.0-or-later */
/* packing-compare: the statistics of studies over sets of packs. */
#include <gsl/gsl_errno.h>
#include <stdlib.h>
#include "common/options.h"
#include "common/program.h"
#include "compare/compare.h"

static int write_results(compare_job *job, const char *command)
{
  char *text = report_text(compare_report(job, command));
  const pack p = {.context = job->context, .report = text};
  const int code =
      outputs_write(&job->asked->outputs, &p, 1, job->asked->report ? NULL : text);
  free(text);
  return code;
}

static int run(compare_job *job, const char *command)
{
  const packing_status status = packing_context_create(NULL, &job->context);
  if (status != PACKING_OK)
    return program_status(NULL, status, "context");
  int code = compare_gather(job);
  if (!code)
    code = outputs_check(&job->asked->outputs, job->context, &job->input);
  if (!code)
    code = compare_run(job);
  if (!code)
    code = write_results(job, command);
  if (!code && !job->asked->quiet)
    compare_print(job);
  return code;
}

/* Else a report that finds no memory would pass for one that is not JSON. */
static void *take(size_t size)
{
  return program_take_more(NULL, size, 1);
}

int main(int argc, char **argv)
{
  compare_options o;
  compare_job job = {.asked = &o};
  cJSON_Hooks hooks = {take, free};
  compare_options_init(&o);
  standard_files_fill();
  interrupt_catch();
  cJSON_InitHooks(&hooks);
  gsl_set_error_handler_off(); /* the program's own: a failed special function is a NaN */
  int code = options_parse_in_order(&compare_argp, argc, argv, &o);
  if (!code)
    code = compare_options_check(&o);
  if (!code) {
    char *command = program_command_line(argc, argv);
    code = run(&job, command);
    free(command);
  }
  compare_job_free(&job);
  compare_options_free(&o);
  return code;
}
