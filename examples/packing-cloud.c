/* SPDX-License-Identifier: GPL-3.0-or-later */
/* packing-cloud: a loose, audited, non-overlapping pack in a container: the start of a
 * discrete-element simulation. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
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
  packing_coordination_report coordination;
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
    state->child_inputs[0] = &o->common;
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

static char *add_spec_help(int key, const char *text, void *input)
{
  (void)input;
  return key == ARGP_KEY_HELP_POST_DOC ? strdup(spec_help) : (char *)(uintptr_t)text;
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
    code = domain_spec_create(c->context, &c->spec, &c->domain);
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

/* ---- measures ---- */

static packing_status measure_audit(cloud *c, const packing_view *view)
{
  packing_audit_def def;
  packing_audit_report audit;
  packing_audit_def_init(&def);
  packing_audit_report_init(&audit);
  def.limit = c->asked->common.max_overlap;
  const packing_status status = packing_audit(c->context, &def, c->domain, view, &audit);
  c->report.max_overlap = audit.max_overlap;
  c->report.max_protrusion = audit.max_protrusion;
  c->report.audit_limit = def.limit;
  c->report.audit_passed = audit.passed;
  return status;
}

static packing_status measure_volume(cloud *c, const packing_view *view)
{
  packing_volume_report volume;
  packing_volume_report_init(&volume);
  const packing_status status =
      packing_measure_volume(c->context, NULL, c->domain, view, &volume);
  c->report.domain_volume = volume.domain_volume;
  c->report.solid_volume = volume.solid_volume;
  c->report.volume_fraction = volume.volume_fraction;
  c->report.volume_fraction_inner = volume.inner_fraction;
  return status;
}

static packing_status measure_coordination(cloud *c, const packing_view *view)
{
  packing_coordination_def def;
  packing_coordination_def_init(&def);
  def.dim = c->spec.dim;
  packing_coordination_report_init(&c->coordination);
  const packing_status status =
      packing_measure_coordination(c->context, &def, c->domain, view, &c->coordination);
  c->report.coordination_mean = c->coordination.mean;
  c->report.coordination_mean_no_rattlers = c->coordination.mean_no_rattlers;
  c->report.coordination_tolerance = def.tolerance;
  c->report.rattlers = c->coordination.rattlers;
  c->report.histogram = c->coordination.histogram;
  c->report.histogram_bins = PACKING_COORDINATION_BINS;
  return status;
}

static packing_status measure_sizes(cloud *c, const packing_view *view)
{
  packing_sizes_report sizes;
  packing_sizes_report_init(&sizes);
  const packing_status status = packing_measure_sizes(c->context, c->psd, view, &sizes);
  c->report.ks = sizes.ks;
  c->report.ks_limit = sizes.ks_limit;
  c->report.ks_mass = sizes.ks_mass;
  c->report.mean_relative_error = sizes.mean_relative_error;
  return status;
}

static int measure(cloud *c, const packing_view *view)
{
  const double start = program_seconds();
  packing_status status = measure_audit(c, view);
  if (status == PACKING_OK)
    status = measure_volume(c, view);
  if (status == PACKING_OK && view->count > 0)
    status = measure_coordination(c, view);
  if (status == PACKING_OK && view->count > 0)
    status = measure_sizes(c, view);
  c->report.unplaced = c->placed.unplaced;
  c->report.time_measure = program_seconds() - start;
  return status == PACKING_OK ? 0 : program_status(c->context, status, "measures");
}

/* ---- results ---- */

/* The pack's files as typed. */
static void report_add_outputs(cJSON *all, const outputs *out)
{
  cJSON *list = report_add_list(all, "out");
  for (size_t i = 0; i < out->count; i++)
    if (strcmp(out->items[i].option, "--out") == 0)
      report_append_text(list, out->items[i].text);
}

static cJSON *report_options(const cloud *c)
{
  const options *o = &c->asked->common;
  cJSON *all = cJSON_CreateObject();
  if (!all)
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
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
  report_add_u64(all, "seed", o->seed);
  report_add_u64(all, "stream", o->stream);
  report_add_count(all, "threads", (size_t)packing_context_threads(c->context));
  report_add_text(all, "isa", packing_isa_name(packing_context_isa(c->context)));
  report_add_real(all, "max_overlap", o->max_overlap);
  report_add_text(all, "colour", colour_name(o->colour));
  report_add_outputs(all, &o->outputs);
  report_add_text(all, "plot_sizes", o->plot_sizes);
  report_add_text(all, "report", o->report);
  report_add_flag(all, "quiet", o->quiet);
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
  r->dim = c->spec.dim;
  r->particles = view->count;
  r->time_total = program_seconds() - start;
  char *text = report_text(r);
  p.report = text;
  fill_notes(c, &p.notes);
  const int code = outputs_write(&o->outputs, &p, o->report ? NULL : text);
  notes_free(&p.notes);
  free(text);
  return code;
}

/* Whether the pack is what was asked; says so if not. */
static int judge(const cloud *c)
{
  const options *o = &c->asked->common;
  const int limited = c->count > 0 || c->volume_fraction > 0;
  const char *state = packing_placer_state_name(c->placed.state);
  if (!c->report.audit_passed)
    return program_fail(PROGRAM_SHORT,
                        "the audit failed: overlap %.3g, protrusion %.3g, limit %.3g",
                        c->report.max_overlap, c->report.max_protrusion, o->max_overlap);
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
  code = measure(c, &view);
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
                                               {NULL, 0, NULL, 0}};
  static const struct argp own = {
      .options = own_options,
      .parser = parse_own,
      .args_doc = "--domain=SPEC --psd=SPEC",
      .doc =
          "Fills a container with a loose, audited, non-overlapping pack of spheres or "
          "discs: the start of a discrete-element simulation.\v ",
      .children = children,
      .help_filter = add_spec_help,
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
