/* SPDX-License-Identifier: GPL-3.0-or-later */
/* packing-layers: dense packs, laid layer by layer at random and settled by the stepper:
 * E. M. B. Campello, K. R. Cassares, Lat. Am. J. Solids Struct. 13, 23 (2016). */
#include <stdlib.h>
#include "common/program.h"
#include "layers/layers.h"

static int make_all(layers_job *job, layered_pack *packs, size_t count)
{
  int code = 0;
  progress_start(&job->bar, "", !job->asked->common.quiet);
  for (job->made = 0; job->made < count && !code; job->made++)
    code = layers_make(job, &packs[job->made]);
  progress_clear();
  return code;
}

static int run(layers_job *job, const char *command)
{
  int code = layers_set_up(job);
  if (code)
    return code;
  const size_t count = (size_t)(job->asked->packs * job->asked->sets);
  layered_pack *packs = program_take(count, sizeof *packs);
  code = make_all(job, packs, count);
  if (!code)
    code = layers_write(job, packs, count, command);
  if (!code)
    code = layers_judge(job, packs, count);
  for (size_t i = 0; i < count; i++)
    layered_pack_free(&packs[i]);
  free(packs);
  return code;
}

int main(int argc, char **argv)
{
  static const struct argp_child children[] = {
      {&options_argp, 0, NULL, 0}, {&forces_argp, 0, NULL, 0}, {NULL, 0, NULL, 0}};
  static const struct argp own = {
      .options = layers_options_table,
      .parser = layers_options_parse,
      .args_doc = "--example=5.3\n--domain=SPEC --psd=SPEC",
      .doc =
          "Makes dense packs of spheres or discs: a loose layer is laid at random on "
          "top of the bed and settles under gravity by the discrete-element method, "
          "again and again until the container is full (Campello and Cassares, 2016). "
          "Particles keep the sizes asked for; the volume fraction counts what is below "
          "the height, particles cut there; the files hold all particles, those above "
          "too, with their last velocities.\v ",
      .children = children,
      .help_filter = options_add_spec_help,
  };
  layers_options o;
  layers_job job = {.asked = &o};
  layers_options_init(&o);
  standard_files_fill();
  interrupt_catch();
  int code = options_parse(&own, argc, argv, &o);
  if (!code) {
    char *command = program_command_line(argc, argv);
    code = run(&job, command);
    free(command);
  }
  layers_clean_up(&job);
  options_free(&o.common);
  return code;
}
