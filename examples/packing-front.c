/* SPDX-License-Identifier: GPL-3.0-or-later */
/* packing-front: dense packs without dynamics, grown by an advancing front: I. Perez Morales,
 * R. Rosello Valera, C. Recarey Morfa et al.: a general advancing front packing algorithm for
 * the discrete element method. */
#include <math.h>
#include <stdlib.h>
#include "common/program.h"
#include "front/front.h"

static int run(front_job *job, const char *command)
{
  static int (*const steps[])(front_job *) = {front_set_up,      front_grow,
                                              front_frames_keep, front_loosen,
                                              front_settle,      front_measure};
  const double start = program_seconds();
  int code = 0;
  for (size_t i = 0; i < sizeof steps / sizeof steps[0] && !code; i++)
    code = steps[i](job);
  if (!code)
    code = front_write(job, command, start);
  if (code)
    return code;
  if (job->asked->in.text)
    input_tell_domain(&job->asked->in, job->asked->common.domain, job->domain_text);
  return front_judge(job);
}

int main(int argc, char **argv)
{
  static const struct argp_child children[] = {{&options_argp, 0, NULL, 0},
                                               {&options_amount_argp, 0, NULL, 0},
                                               {&forces_argp, 0, NULL, 0},
                                               {&input_argp, 0, NULL, 0},
                                               {NULL, 0, NULL, 0}};
  static const struct argp own = {
      .options = front_options_table,
      .parser = front_options_parse,
      .args_doc = "--domain=SPEC --psd=SPEC",
      .doc =
          "Fills a container with a dense, audited, non-overlapping pack of spheres or "
          "discs by an advancing front: each particle is placed in contact with three "
          "bodies (two in two dimensions) that stand already, particles or walls. The "
          "sizes stay those asked for. Particles of --in stand where they are, and the "
          "pack grows around them. Forces are those of --settle.\v ",
      .children = children,
      .help_filter = options_add_grower_help,
  };
  front_options o;
  front_job job = {.asked = &o, .loosened = (double)NAN};
  front_options_init(&o);
  report_init(&job.report);
  standard_files_fill();
  interrupt_catch();
  int code = options_parse(&own, argc, argv, &o);
  if (!code)
    code = front_options_check(&o);
  if (!code) {
    char *command = program_command_line(argc, argv);
    code = run(&job, command);
    free(command);
  }
  front_clean_up(&job);
  input_free(&o.in);
  options_free(&o.common);
  return code;
}
