/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The summary for people: one thing a line, on standard error. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include "../common/canvas.h"
#include "measure.h"

__attribute__((format(printf, 2, 3))) static void say(const char *what,
                                                      const char *format, ...)
{
  va_list arguments;
  fprintf(stderr, "%-17s", what);
  va_start(arguments, format);
  vfprintf(stderr, format, arguments);
  va_end(arguments);
  fputc('\n', stderr);
}

/* The ending of a word that `count` things share. */
static const char *plural(size_t count)
{
  return count == 1 ? "" : "s";
}

static void say_pack(const measure_job *job)
{
  const sizes_found *s = &job->sizes;
  const char *what = job->spec.dim == 2 ? "disc" : "sphere",
             *ending = plural(job->view.count);
  char count[40];
  canvas_format_count(count, sizeof count, job->view.count);
  if (!s->made)
    say("pack", "%s: no particles", job->asked->in.path);
  else if (s->lo == s->hi)
    say("pack", "%s: %s %s%s of radius %.6g", job->asked->in.path, count, what, ending,
        s->lo);
  else
    say("pack", "%s: %s %s%s, radii %.6g to %.6g, mean %.6g", job->asked->in.path, count,
        what, ending, s->lo, s->hi, s->mean);
}

static void say_void(const report *r)
{
  char inner[80] = "";
  if (isfinite(r->volume_fraction_inner))
    snprintf(inner, sizeof inner, "; away from the walls %.4f", r->volume_fraction_inner);
  say("volume fraction", "%.4f, porosity %.4f%s", r->volume_fraction,
      1 - r->volume_fraction, inner);
}

static void say_contacts(const measure_job *job)
{
  const report *r = &job->report;
  const packing_classes_report *c = &job->classes;
  if (!job->contacts)
    return;
  const size_t walls = packing_contacts_wall_count(job->contacts);
  char text[COORDINATION_TEXT];
  say("coordination", "%s; %zu contact%s with walls", coordination_say(text, r), walls,
      plural(walls));
  say("stability", "firm %.1f %%, stable %.1f %%, non stable %.1f %%",
      100 * c->firm_share, 100 * c->stable_share, 100 * c->non_stable_share);
}

static void say_fabric(const report_fabric *f)
{
  char third[32] = "";
  if (!f->known || f->count == 0)
    return;
  if (f->dim == 3)
    snprintf(third, sizeof third, " %.4f", f->eigenvalues[2]);
  say("fabric", "%.4f %.4f%s, sd %.4f (of %zu random contact%s %.4f)", f->eigenvalues[0],
      f->eigenvalues[1], third, f->sd, f->count, plural(f->count), f->noise_floor);
}

static void say_order(const measure_job *job)
{
  const order_found *o = &job->order;
  if (!o->made)
    return;
  if (!isfinite(job->spec.dim == 2 ? o->hexatic.mean : o->q6.whole))
    say("order", "no neighbours");
  else if (job->spec.dim == 2)
    say("order", "psi_6 mean %.4f, global %.4f; %.1f %% with six neighbours",
        o->hexatic.mean, o->hexatic.whole, 100 * o->hexatic.share);
  else
    say("order", "Q4 %.4f, Q6 %.4f; local means %.4f, %.4f", o->q4.whole, o->q6.whole,
        o->q4.mean, o->q6.mean);
}

static void say_sizes(const measure_job *job)
{
  const packing_size_tests_report *t = &job->sizes.tests;
  if (!job->psd || !job->sizes.made)
    return;
  char chi_square[48] = "";
  if (isfinite(t->chi_square_p))
    snprintf(chi_square, sizeof chi_square, ", chi-square p %.3g", t->chi_square_p);
  say("sizes", "Kolmogorov-Smirnov %.4f (p %.3g)%s; by mass MAE %.3g %%", t->ks, t->ks_p,
      chi_square, job->sizes.errors.mae);
}

static void say_sections(const measure_job *job)
{
  for (size_t i = 0; job->sections && i < job->asked->section_count; i++) {
    const section_found *s = &job->sections[i];
    for (size_t k = 0; k < s->count; k++) {
      char text[SECTION_TEXT];
      say(k == 0 ? "sections" : "", "%s",
          section_say(text, job->asked->sections[i].axis, &s->planes[k]));
    }
  }
}

static void say_radii(const char *what, size_t count, double least, double most,
                      double mean)
{
  if (count == 0)
    say(what, "none");
  else
    say(what, "%zu, radii %.6g to %.6g, mean %.6g", count, least, most, mean);
}

static void say_pores(const measure_job *job)
{
  const packing_pores_report *r = &job->pores.report;
  if (!job->pores.network)
    return;
  say_radii("pores", r->pores, r->min_r, r->max_r, r->mean_r);
  say_radii("constrictions", r->constrictions, r->min_constriction_r,
            r->max_constriction_r, r->mean_constriction_r);
}

static void say_audit(const report *r)
{
  const packing_audit_report *a = &r->audit;
  say("audit", "%s: overlap %.3g, protrusion %.3g, limit %.3g",
      r->audit_passed ? "passed" : "FAILED", r->max_overlap, r->max_protrusion,
      r->audit_limit);
  if (a->overlaps > 0)
    say("",
        "%zu overlap%s, the largest of particles %zu and %zu; %zu pair%s at one place",
        a->overlaps, plural(a->overlaps), a->overlap_i, a->overlap_j, a->duplicates,
        plural(a->duplicates));
  if (a->protrusions > 0)
    say("", "%zu stick%s out, particle %zu the farthest", a->protrusions,
        a->protrusions == 1 ? "s" : "", a->protrusion_i);
}

void measure_summary(const measure_job *job)
{
  const report *r = &job->report;
  say_pack(job);
  say("container", "%s, %s %.6g", job->domain_text,
      job->spec.dim == 2 ? "area" : "volume", r->domain_volume);
  say_audit(r);
  say_void(r);
  say_contacts(job);
  say_fabric(&r->fabric);
  say_order(job);
  say_sizes(job);
  say_sections(job);
  say_pores(job);
}
