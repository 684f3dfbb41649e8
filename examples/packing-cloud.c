/* SPDX-License-Identifier: GPL-3.0-or-later */
/* packing-cloud: a loose, audited, non-overlapping pack in a container: the start of a
 * discrete-element simulation. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "common/measures.h"
#include "common/options.h"
#include "common/program.h"
#include "common/progress.h"
#include "common/report.h"

static const char PROGRAM[] = "packing-cloud";

/* How much work a step does: short enough for a lively bar and a prompt interrupt. */
enum { STEP = 8 };

typedef struct cloud_options {
  options common;
  const char *method;              /* as given or defaulted */
  int lattice;                     /* 1: lattice, 0: rsa */
  packing_lattice_kind kind;       /* of a lattice */
  packing_order order;             /* of rsa */
  uint64_t max_failures;           /* of rsa */
  int order_given, failures_given; /* for saying that a lattice has none */
} cloud_options;

typedef struct cloud {
  cloud_options *asked;
  domain_spec spec;
  input_files input;
  packing_context *context;
  packing_domain *domain;
  packing_psd *psd;
  packing_particles *particles;
  packing_placer *placer;
  packing_placer_report placed;
  size_t count;           /* what the placer is told, 0: no limit */
  double volume_fraction; /* the same */
  report report;
} cloud;

/* ---- options ---- */

enum { KEY_METHOD = 0x200, KEY_ORDER, KEY_MAX_FAILURES };

static const struct argp_option own_options[] = {
    {NULL, 0, NULL, 0, "How:", 3},
    {"method", KEY_METHOD, "METHOD", 0,
     "rsa (default): random sequential addition; lattice:KIND: a lattice cut to the "
     "container, KIND one of cells (a random point in each cell; it needs --count and a "
     "box, rect or cylinder), sc, bcc, fcc, hcp, simple-hexagonal, and in two dimensions "
     "hexagonal, square",
     3},
    {"order", KEY_ORDER, "ORDER", 0,
     "rsa: drawn (default) places radii as they come; descending draws all first and "
     "places the largest first, which packs wide gradings denser",
     3},
    {"max-failures", KEY_MAX_FAILURES, "N", 0,
     "rsa: give up after so many refusals of one radius (default 1000000; equal sizes "
     "end "
     "in proved saturation instead)",
     3},
    {NULL, 0, NULL, 0, NULL, 0},
};

static int read_lattice(const char *name, packing_lattice_kind *kind)
{
  for (int k = 0; k < PACKING_LATTICE_END; k++)
    if (strcmp(packing_lattice_kind_name((packing_lattice_kind)k), name) == 0) {
      *kind = (packing_lattice_kind)k;
      return 0;
    }
  return program_fail(PROGRAM_BAD_INPUT, "--method: unknown lattice '%s'; see --help",
                      name);
}

static int read_method(const char *text, cloud_options *o)
{
  o->method = text;
  o->lattice = strncmp(text, "lattice:", 8) == 0;
  if (o->lattice)
    return read_lattice(text + 8, &o->kind);
  if (strcmp(text, "rsa") == 0)
    return 0;
  return program_fail(PROGRAM_BAD_INPUT, "--method: '%s' is not rsa or lattice:KIND",
                      text);
}

static int read_order(const char *text, cloud_options *o)
{
  o->order_given = 1;
  o->order =
      strcmp(text, "descending") == 0 ? PACKING_ORDER_DESCENDING : PACKING_ORDER_DRAWN;
  if (o->order == PACKING_ORDER_DRAWN && strcmp(text, "drawn") != 0)
    return program_fail(PROGRAM_BAD_INPUT, "--order: '%s' is not drawn or descending",
                        text);
  return 0;
}

static error_t parse_own(int key, char *argument, struct argp_state *state)
{
  cloud_options *o = state->input;
  int code = 0;
  switch (key) {
  case ARGP_KEY_INIT:
    options_refuse(key, argument, state);
    options_pass_on(state, &o->common, 2);
    return 0;
  case KEY_METHOD:
    code = read_method(argument, o);
    break;
  case KEY_ORDER:
    code = read_order(argument, o);
    break;
  case KEY_MAX_FAILURES:
    o->failures_given = 1;
    code = number_whole("--max-failures", argument, 1, UINT64_MAX, &o->max_failures);
    break;
  default:
    return options_refuse(key, argument, state);
  }
  if (code)
    exit(code);
  return 0;
}

static int check_options(const cloud_options *o)
{
  const char *lost = o->order_given ? "--order" : "--max-failures";
  if (!o->common.domain)
    return program_fail(PROGRAM_BAD_INPUT, "--domain is missing; see --help");
  if (!o->common.psd)
    return program_fail(PROGRAM_BAD_INPUT, "--psd is missing; see --help");
  if (o->lattice && (o->order_given || o->failures_given))
    return program_fail(PROGRAM_BAD_INPUT, "%s: a lattice has none", lost);
  return 0;
}

/* ---- the work ---- */

/* What was asked in the placer's terms. Rsa stops at a volume; a lattice only counts, so
 * there the mean particle decides. */
static int set_amount(cloud *c)
{
  const options *o = &c->asked->common;
  const double whole = packing_domain_volume(c->domain);
  double mean = 0, solid = 0;
  c->count = o->count;
  if (!isnan(o->mass))
    solid = o->mass / o->density;
  if (!isnan(o->porosity))
    solid = (1 - o->porosity) * whole;
  if (solid > whole)
    return program_fail(PROGRAM_BAD_INPUT,
                        "--mass: %.9g at density %.9g is a volume of %.9g, the container "
                        "has %.9g",
                        o->mass, o->density, solid, whole);
  if (!c->asked->lattice) {
    c->volume_fraction = solid / whole;
    return 0;
  }
  if (solid > 0) {
    const packing_status status =
        packing_psd_moment(c->psd, PACKING_BY_NUMBER, c->spec.dim, &mean);
    if (status != PACKING_OK)
      return program_status(c->context, status, "--psd");
    mean *= c->spec.dim == 2 ? M_PI : 4 * M_PI / 3;
    c->count = (size_t)fmax(1, floor(solid / mean + 0.5));
  }
  return 0;
}

static int create_store(cloud *c)
{
  packing_particles_def def;
  packing_particles_def_init(&def);
  def.dim = c->spec.dim;
  if (packing_psd_components(c->psd) > 1)
    def.columns = PACKING_COLUMN_COMPONENT;
  const packing_status status = packing_particles_create(c->context, &def, &c->particles);
  return status == PACKING_OK ? 0 : program_status(c->context, status, "particles");
}

static packing_status create_rsa(cloud *c)
{
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.seed = c->asked->common.seed;
  def.stream = c->asked->common.stream;
  def.count = c->count;
  def.volume_fraction = c->volume_fraction;
  def.order = c->asked->order;
  def.max_failures = c->asked->max_failures;
  return packing_rsa_create(c->context, &def, c->domain, c->psd, c->particles,
                            &c->placer);
}

static packing_status create_lattice(cloud *c)
{
  packing_lattice_def def;
  packing_lattice_def_init(&def);
  def.kind = c->asked->kind;
  def.seed = c->asked->common.seed;
  def.stream = c->asked->common.stream;
  def.count = c->count;
  return packing_lattice_create(c->context, &def, c->domain, c->psd, c->particles,
                                &c->placer);
}

static int create_placer(cloud *c)
{
  const packing_status status = c->asked->lattice ? create_lattice(c) : create_rsa(c);
  return status == PACKING_OK ? 0 : program_status(c->context, status, c->asked->method);
}

static int set_up(cloud *c)
{
  const options *o = &c->asked->common;
  int code = domain_spec_parse(o->domain, &c->spec);
  if (!code)
    code = options_context(o, &c->context);
  if (!code)
    code = domain_spec_create_noting(c->context, &c->spec, &c->input, &c->domain);
  if (!code)
    code = psd_spec_create(c->context, o->psd, c->spec.dim, &c->psd, &c->input);
  if (!code)
    code = set_amount(c);
  if (!code)
    code = create_store(c);
  if (!code)
    code = create_placer(c);
  if (!code)
    code = outputs_check(&o->outputs, c->context, &c->input);
  return code;
}

static int place(cloud *c)
{
  const double start = program_seconds();
  progress bar;
  packing_placer_report_init(&c->placed);
  progress_start(&bar, "placing", !c->asked->common.quiet);
  do {
    const packing_status status = packing_placer_step(c->placer, STEP, &c->placed);
    if (status != PACKING_OK)
      return program_status(c->context, status, c->asked->method);
    progress_show(&bar, c->placed.progress, c->placed.placed);
  } while (c->placed.state == PACKING_PLACER_RUNNING && !interrupted());
  progress_clear();
  c->report.time_place = program_seconds() - start;
  return interrupted() ? program_interrupted() : 0;
}

/* ---- results ---- */

static cJSON *report_options(const cloud *c)
{
  const options *o = &c->asked->common;
  cJSON *all = report_new();
  report_add_text(all, "domain", o->domain);
  report_add_text(all, "psd", o->psd);
  report_add_text(all, "method", c->asked->method);
  report_add_text(all, "order",
                  c->asked->lattice                             ? NULL
                  : c->asked->order == PACKING_ORDER_DESCENDING ? "descending"
                                                                : "drawn");
  report_add_count(all, "max_failures",
                   c->asked->lattice ? REPORT_NONE : (size_t)c->asked->max_failures);
  report_add_count(all, "count", o->count ? o->count : REPORT_NONE);
  report_add_real(all, "mass", o->mass);
  report_add_real(all, "density", o->density);
  report_add_real(all, "target_porosity", o->porosity);
  options_report(all, o, c->context);
  return all;
}

static void fill_notes(const cloud *c, notes *all)
{
  const options *o = &c->asked->common;
  notes_add(all, "program", "%s %s", PROGRAM, packing_version());
  notes_add(all, "domain", "%s", o->domain);
  notes_add(all, "psd", "%s", o->psd);
  notes_add(all, "method", "%s%s", c->asked->method,
            c->asked->order == PACKING_ORDER_DESCENDING ? ", descending" : "");
  notes_add(all, "seed", "%llu", (unsigned long long)o->seed);
  notes_add(all, "stream", "%llu", (unsigned long long)o->stream);
  notes_add(all, "placed", "%s", packing_placer_state_name(c->placed.state));
  notes_add(all, "audit",
            c->report.audit_passed ? "passed, limit %g" : "FAILED, limit %g",
            o->max_overlap);
}

static int write_results(cloud *c, const packing_view *view, const char *command,
                         double start)
{
  options *o = &c->asked->common;
  report *r = &c->report;
  pack p = {.context = c->context,
            .spec = &c->spec,
            .domain = c->domain,
            .psd_text = o->psd,
            .psd = c->psd,
            .view = *view,
            .density = o->density,
            .volume_fraction = r->volume_fraction,
            .colour = o->colour};
  r->program = PROGRAM;
  r->command = command;
  r->options = report_options(c);
  r->input = &c->input;
  r->seed = o->seed;
  r->threads = packing_context_threads(c->context);
  r->time_total = program_seconds() - start;
  char *text = report_text(report_object(r));
  p.report = text;
  fill_notes(c, &p.notes);
  const int code = outputs_write(&o->outputs, &p, 1, o->report ? NULL : text);
  notes_free(&p.notes);
  free(text);
  return code;
}

/* Whether the pack is what was asked; says so if not. */
static int judge(const cloud *c)
{
  const int limited = c->count > 0 || c->volume_fraction > 0;
  const char *state = packing_placer_state_name(c->placed.state);
  if (measures_judge(&c->report) != PROGRAM_DONE)
    return PROGRAM_SHORT;
  if (c->placed.state == PACKING_PLACER_GAVE_UP && !limited)
    program_remark("gave up after %llu refusals of one radius: not proved to be full",
                   (unsigned long long)c->asked->max_failures);
  if (c->placed.state == PACKING_PLACER_DONE || !limited)
    return PROGRAM_DONE;
  /* The largest find room while there is some. */
  const char *hint =
      c->placed.state == PACKING_PLACER_GAVE_UP && c->asked->order == PACKING_ORDER_DRAWN
          ? "; --order descending places more"
          : "";
  if (c->count > 0)
    return program_fail(PROGRAM_SHORT, "%s: %zu of %zu particles placed%s", state,
                        c->placed.placed, c->count, hint);
  return program_fail(PROGRAM_SHORT, "%s: volume fraction %.6g of %.6g reached%s", state,
                      c->placed.volume_fraction, c->volume_fraction, hint);
}

static int run(cloud *c, const char *command)
{
  const double start = program_seconds();
  packing_view view;
  int code = set_up(c);
  if (!code)
    code = place(c);
  if (code)
    return code;
  packing_particles_view(c->particles, &view);
  c->report.unplaced = c->placed.unplaced;
  const measured m = {.context = c->context,
                      .domain = c->domain,
                      .psd = c->psd,
                      .view = &view,
                      .dim = c->spec.dim,
                      .limit = c->asked->common.max_overlap};
  code = measures_fill(&c->report, &m, NULL);
  if (!code)
    code = write_results(c, &view, command, start);
  return code ? code : judge(c);
}

static void clean_up(cloud *c)
{
  packing_placer_destroy(c->placer);
  packing_particles_destroy(c->particles);
  packing_psd_destroy(c->psd);
  packing_domain_destroy(c->domain);
  packing_context_destroy(c->context);
  input_files_free(&c->input);
}

int main(int argc, char **argv)
{
  static const struct argp_child children[] = {{&options_argp, 0, NULL, 0},
                                               {&options_amount_argp, 0, NULL, 0},
                                               {NULL, 0, NULL, 0}};
  static const struct argp own = {
      .options = own_options,
      .parser = parse_own,
      .args_doc = "--domain=SPEC --psd=SPEC",
      .doc =
          "Fills a container with a loose, audited, non-overlapping pack of spheres or "
          "discs: the start of a discrete-element simulation.\v ",
      .children = children,
      .help_filter = options_add_spec_help,
  };
  cloud_options o = {.method = "rsa", .max_failures = 1000000};
  cloud c = {.asked = &o};
  options_init(&o.common);
  report_init(&c.report);
  standard_files_fill();
  interrupt_catch();
  int code = options_parse(&own, argc, argv, &o);
  if (!code)
    code = check_options(&o);
  if (!code) {
    char *command = program_command_line(argc, argv);
    code = run(&c, command);
    free(command);
  }
  clean_up(&c);
  options_free(&o.common);
  return code;
}
