/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What was found, as JSON for programs and as lines for people. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../common/program.h"
#include "compare.h"

static cJSON *append_object(cJSON *list)
{
  cJSON *made = report_new();
  cJSON_AddItemToArray(list, made);
  return made;
}

/* ---- for programs ---- */

static cJSON *options_of(const compare_options *o)
{
  cJSON *all = report_new(), *list = report_add_list(all, "sets");
  for (size_t i = 0; i < o->source_count; i++) {
    const source *s = &o->sources[i];
    cJSON *entry = append_object(list);
    report_add_text(entry, "option", s->option);
    report_add_text(entry, "name", s->name);
    cJSON *files = report_add_list(entry, "files");
    for (size_t k = 0; k < s->file_count; k++)
      report_append_text(files, s->files[k]);
  }
  report_add_text(all, "key", o->key);
  report_add_text(all, "test", o->test_text);
  report_add_text(all, "fit", o->fit_text);
  report_add_count(all, "bootstrap", o->bootstrap);
  report_add_u64(all, "seed", o->seed);
  report_add_text(all, "report", o->report);
  report_add_flag(all, "quiet", o->quiet);
  return all;
}

static void add_inputs(cJSON *root, const input_files *files)
{
  if (files->count == 0) {
    report_add_text(root, "input", NULL);
    return;
  }
  cJSON *list = report_add_list(root, "input");
  for (size_t i = 0; i < files->count; i++) {
    cJSON *entry = append_object(list);
    report_add_text(entry, "file", files->items[i].path);
    report_add_text(entry, "sha256", files->items[i].sha256);
  }
}

static void add_dixon(cJSON *to, const stat_dixon *d)
{
  cJSON *dixon = report_add_object(to, "dixon");
  report_add_real(dixon, "q", d->q);
  report_add_real(dixon, "suspect", d->suspect);
  report_add_real(dixon, "p", d->p);
  cJSON *critical = report_add_object(dixon, "critical");
  for (int k = 0; k < STAT_DIXON_LEVELS; k++) {
    char level[8];
    snprintf(level, sizeof level, "%.2f", stat_dixon_levels[k]);
    report_add_real(critical, level, d->critical[k]);
  }
  if (isnan(d->q))
    report_add_text(dixon, "outlier95", NULL);
  else
    report_add_flag(dixon, "outlier95", d->q > d->critical[1]);
}

static void add_fit(cJSON *list, const fit_result *f)
{
  cJSON *entry = append_object(list);
  report_add_count(entry, "rank", f->fitted ? f->rank : REPORT_NONE);
  report_add_text(entry, "name", f->law->name);
  report_add_flag(entry, "fitted", f->fitted);
  cJSON *parameters = report_add_object(entry, "parameters");
  for (int k = 0; k < FIT_PARAMETERS && f->law->parameters[k]; k++)
    report_add_real(parameters, f->law->parameters[k], f->p[k]);
  report_add_real(entry, "log_likelihood", f->log_likelihood);
  report_add_real(entry, "ks", f->ks);
  report_add_real(entry, "p", f->bootstrap_p);
  report_add_count(entry, "bootstrap", f->bootstrap);
  report_add_real(entry, "kolmogorov_p", f->kolmogorov_p);
}

static void add_set(cJSON *list, const compare_set *set)
{
  const double nan = (double)NAN;
  const int known = set->values != NULL;
  cJSON *entry = append_object(list);
  report_add_text(entry, "name", set->name);
  report_add_text(entry, "what", set->what);
  report_add_real(entry, "n", set->figures.n);
  report_add_real(entry, "mean", set->figures.mean);
  report_add_real(entry, "sd", set->figures.sd);
  report_add_real(entry, "standard_error", stat_standard_error(&set->figures));
  report_add_real(entry, "confidence95", stat_confidence95(&set->figures));
  report_add_real(entry, "min", known ? set->values[0] : nan);
  report_add_real(entry, "median", known ? stat_median(set->values, set->count) : nan);
  report_add_real(entry, "max", known ? set->values[set->count - 1] : nan);
  add_dixon(entry, &set->dixon);
  cJSON *fits = report_add_list(entry, "fits");
  for (size_t k = 0; k < set->fit_count; k++)
    add_fit(fits, &set->fits[k]);
}

/* How a p-value came about; nothing where there is none. */
static const char *method_of(double p, int exact, const char *otherwise)
{
  return isnan(p) ? NULL : exact ? "exact" : otherwise;
}

static void add_pair(cJSON *list, const compare_job *job, const compare_pair *p)
{
  cJSON *entry = append_object(list);
  report_add_text(entry, "a", job->sets[p->a].name);
  report_add_text(entry, "b", job->sets[p->b].name);
  cJSON *welch = report_add_object(entry, "welch");
  report_add_real(welch, "t", p->welch.t);
  report_add_real(welch, "dof", p->welch.dof);
  report_add_real(welch, "p", p->welch.p);
  cJSON *mann = report_add_object(entry, "mann_whitney");
  report_add_real(mann, "u", p->mann_whitney.u);
  report_add_real(mann, "p", p->mann_whitney.p);
  report_add_text(mann, "method",
                  method_of(p->mann_whitney.p, p->mann_whitney.exact, "normal"));
  cJSON *ks = report_add_object(entry, "ks");
  report_add_real(ks, "d", p->ks.d);
  report_add_real(ks, "p", p->ks.p);
  report_add_text(ks, "method", method_of(p->ks.p, p->ks.exact, "asymptotic"));
  cJSON *curves = report_add_object(entry, "curves");
  report_add_real(curves, "mae", p->curves.mae);
  report_add_real(curves, "mse", p->curves.mse);
  report_add_real(curves, "rmae", p->curves.rmae);
  report_add_real(curves, "mre", p->curves.mre);
}

cJSON *compare_report(const compare_job *job, const char *command)
{
  cJSON *root = report_new();
  report_add_text(root, "program", "packing-compare");
  report_add_text(root, "version", packing_version());
  report_add_text(root, "command", command);
  if (!cJSON_AddItemToObject(root, "options", options_of(job->asked)))
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
  add_inputs(root, &job->input);
  report_add_u64(root, "seed", job->asked->seed);
  cJSON *sets = report_add_list(root, "sets");
  for (size_t i = 0; i < job->set_count; i++)
    add_set(sets, &job->sets[i]);
  cJSON *pairs = report_add_list(root, "pairs");
  for (size_t i = 0; i < job->pair_count; i++)
    add_pair(pairs, job, &job->pairs[i]);
  cJSON *anova = report_add_object(root, "anova");
  report_add_real(anova, "f", job->anova.f);
  report_add_real(anova, "dof_between", job->anova.between);
  report_add_real(anova, "dof_within", job->anova.within);
  report_add_real(anova, "p", job->anova.p);
  return root;
}

/* ---- for people ---- */

/* Sizes of sets are whole but where they come from a standard error. */
static void print_set(FILE *to, const compare_set *s)
{
  const stat_dixon *d = &s->dixon;
  const stat_summary *f = &s->figures;
  const int digits = f->n == floor(f->n) ? 0 : 2;
  fprintf(to, "%-16s n %-8.*f mean %-11.6g", s->name, digits, f->n, f->mean);
  if (isfinite(f->sd))
    fprintf(to, " sd %-11.4g mean +- %.3g (95 %%)", f->sd, stat_confidence95(f));
  fputc('\n', to);
  if (d->q > d->critical[0])
    fprintf(
        to,
        "  outlier? %.6g: Dixon Q %.3f, limits %.3f (90 %%) %.3f (95 %%) %.3f (99 %%)\n",
        d->suspect, d->q, d->critical[0], d->critical[1], d->critical[2]);
}

static void print_pair(FILE *to, const compare_job *job, const compare_pair *p)
{
  const char *between = "";
  fprintf(to, "%s and %s:", job->sets[p->a].name, job->sets[p->b].name);
  if (!isnan(p->welch.p)) {
    fprintf(to, " Welch t %.3g, dof %.3g, p %.3g", p->welch.t, p->welch.dof, p->welch.p);
    between = ";";
  }
  if (!isnan(p->mann_whitney.p)) {
    fprintf(to, "%s Mann-Whitney U %.6g, p %.3g", between, p->mann_whitney.u,
            p->mann_whitney.p);
    between = ";";
  }
  if (!isnan(p->ks.p)) {
    fprintf(to, "%s KS %.3g, p %.3g%s", between, p->ks.d, p->ks.p,
            p->ks.exact ? "" : " (asymptotic)");
    between = ";";
  }
  if (!isnan(p->curves.mae))
    fprintf(to, "%s curves: MAE %.4g, MSE %.4g, RMAE %.4g %%, MRE %.4g %%", between,
            p->curves.mae, p->curves.mse, 100 * p->curves.rmae, 100 * p->curves.mre);
  fputc('\n', to);
}

static void print_fits(FILE *to, const compare_set *s)
{
  if (s->fit_count > 0)
    fprintf(to, "%s fits, best first:\n", s->name);
  for (size_t k = 0; k < s->fit_count; k++) {
    const fit_result *f = &s->fits[k];
    if (!f->fitted) {
      fprintf(to, "  %-12s does not apply\n", f->law->name);
      continue;
    }
    fprintf(to, "  %-12s p %-10.4g KS %-10.4g", f->law->name,
            isnan(f->bootstrap_p) ? f->kolmogorov_p : f->bootstrap_p, f->ks);
    for (int i = 0; i < FIT_PARAMETERS && f->law->parameters[i]; i++)
      fprintf(to, " %s %.6g", f->law->parameters[i], f->p[i]);
    fputc('\n', to);
  }
}

void compare_print(const compare_job *job)
{
  for (size_t i = 0; i < job->set_count; i++)
    print_set(stderr, &job->sets[i]);
  for (size_t i = 0; i < job->pair_count && job->asked->tests & ~(unsigned)TEST_DIXON;
       i++)
    print_pair(stderr, job, &job->pairs[i]);
  if (job->set_count > 2 && !isnan(job->anova.p))
    fprintf(stderr, "all sets: F %.4g, dof %g and %g, p %.3g\n", job->anova.f,
            job->anova.between, job->anova.within, job->anova.p);
  for (size_t i = 0; i < job->set_count; i++)
    print_fits(stderr, &job->sets[i]);
}
