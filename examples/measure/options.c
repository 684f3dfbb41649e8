/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "../common/program.h"
#include "measure.h"

const char measure_program[] = "packing-measure";

static const uint64_t MOST_BINS = 1000000, MOST_CELLS = 100000000, MOST_PLANES = 1000;

enum {
  KEY_TOLERANCE = 0x500,
  KEY_UP,
  KEY_RDF,
  KEY_ORDER,
  KEY_ORDER_LIST,
  KEY_PROFILE,
  KEY_SECTION,
  KEY_MAP,
  KEY_PORES,
  KEY_PORE_FILES,
  KEY_PORE_MERGE,
  KEY_BONDS,
  KEY_CONTACTS,
  KEY_SIEVES,
  KEY_NORMALS,
  KEY_PLOT,
  KEY_PLOT_FORMAT
};

static const struct argp_option table[] = {
    {NULL, 0, NULL, 0, "Contacts:", 3},
    {"tolerance", KEY_TOLERANCE, "GAP", 0,
     "particles touch when their surfaces are at most GAP (r_i + r_j) apart (default "
     "1e-9)",
     3},
    {"up", KEY_UP, "X,Y,Z", 0,
     "against gravity, for who is stable (default +z, in two dimensions +y)", 3},
    {"contacts", KEY_CONTACTS, "FILE", 0, "write the list of contacts (CSV)", 3},
    {"bonds", KEY_BONDS, "GAP:FILE", 0,
     "write the list of pairs whose surfaces are at most GAP apart, a length (CSV)", 3},
    {"normals", KEY_NORMALS, "BANDS", 0,
     "the histogram of contact normals in bins of equal area, in so many bands from pole "
     "to pole (default with --plot 6 to 18; in two dimensions twice as many sectors)",
     3},
    {NULL, 0, NULL, 0, "Order and void, where asked for (order always):", 4},
    {"order", KEY_ORDER, "WHO", 0,
     "neighbours of the bond orders: a factor F, centres at most F (r_i + r_j) apart "
     "(default 1.2), nearest:N, or none: no bond orders",
     4},
    {"order-list", KEY_ORDER_LIST, "FILE", 0,
     "write the bond orders of each particle (CSV)", 4},
    {"rdf", KEY_RDF, "RMAX[,BINS]", 0,
     "radial distribution up to RMAX mean diameters (default with --plot: 5, or less "
     "where a small container leaves no centre; 100 bins)",
     4},
    {"profile", KEY_PROFILE, "WAY[,BINS]", 0,
     "porosity along x, y or z, along the radius from the middle axis of the container "
     "(radius-x, radius-y, radius: of axis z, of two dimensions of its centre) or from "
     "its centre (sphere); 50 bins; may be repeated",
     4},
    {"section", KEY_SECTION, "PLANES", 0,
     "z=H: porosity of the plane z = H; z,N: of N planes in the middles of equal parts; "
     "x and y likewise: the binary occupation ratio, black being void; may be repeated",
     4},
    {"map", KEY_MAP, "NX,NY,NZ[:FILE]", 0,
     "porosity in each cell of a grid; its cells as a table in FILE (CSV)", 4},
    {"pores", KEY_PORES, NULL, 0, "pores and constrictions", 4},
    {"pore-network", KEY_PORE_FILES, "PREFIX", 0,
     "and their network: PREFIX.vtp (ParaView), PREFIX-pores.csv, "
     "PREFIX-constrictions.csv and, in three dimensions, the Statoil format of "
     "pore-network "
     "codes, flow along x: PREFIX_node1.dat, _node2, _link1, _link2",
     4},
    {"pore-merge", KEY_PORE_MERGE, "SHARE", 0,
     "pores of which more than SHARE of the diameter lies in a larger one belong to that",
     4},
    {NULL, 0, NULL, 0, "Sizes:", 5},
    {"sieves", KEY_SIEVES, "LIST", 0,
     "masses on sieves: openings D1,D2,... (diameters), or a file with one a line", 5},
    {"plot", KEY_PLOT, "PREFIX", 0,
     "draw PREFIX-sizes, PREFIX-rdf, PREFIX-coordination, PREFIX-normals, PREFIX-profile "
     "and, in three dimensions, PREFIX-section",
     7},
    {"plot-format", KEY_PLOT_FORMAT, "FORMAT", 0, "png (default) or svg", 7},
    {NULL, 0, NULL, 0, NULL, 0},
};

#define BAD(...) program_fail(PROGRAM_BAD_INPUT, __VA_ARGS__)

const char *axis_name(packing_axis axis)
{
  static const char *const names[] = {"x", "y", "z"};
  return names[axis];
}

/* "x", "y" or "z" alone; 0 where it is none of them. */
static int axis_of(const char *word, packing_axis *axis)
{
  if (strlen(word) != 1 || !strchr("xyz", *word))
    return 0;
  *axis = (packing_axis)(*word - 'x');
  return 1;
}

/* Words between commas, in a copy; free both. */
typedef struct words {
  char *copy;
  char **word;
  size_t count;
} words;

static words words_of(const char *text, char separator)
{
  words w = {.copy = program_copy(text, strlen(text))};
  w.word = spec_split(w.copy, separator, &w.count);
  return w;
}

static void words_free(words *w)
{
  free(w->word);
  free(w->copy);
}

static int read_count(const char *option, const char *text, uint64_t most, size_t *count)
{
  uint64_t value = 0;
  const int code = number_whole(option, text, 1, most, &value);
  *count = (size_t)value;
  return code;
}

static int read_tolerance(const char *text, measure_options *o)
{
  const int code = number_positive("--tolerance", text, &o->tolerance);
  if (!code && o->tolerance >= 1)
    return BAD("--tolerance: %s is not below 1", text);
  return code;
}

static int read_up(const char *text, measure_options *o)
{
  words w = words_of(text, ',');
  double v[3] = {0, 0, 0};
  int code = w.count == 2 || w.count == 3 ? 0 : BAD("--up: '%s' is not X,Y,Z", text);
  for (size_t i = 0; i < w.count && !code; i++)
    code = number_real("--up", w.word[i], &v[i]);
  if (!code && v[0] == 0 && v[1] == 0 && v[2] == 0)
    code = BAD("--up: 0 is no direction");
  o->up = (packing_vec3){v[0], v[1], v[2]};
  words_free(&w);
  return code;
}

static int read_rdf(const char *text, measure_options *o)
{
  words w = words_of(text, ',');
  int code = w.count <= 2 ? number_positive("--rdf", w.word[0], &o->rdf_max)
                          : BAD("--rdf: '%s' is not RMAX,BINS", text);
  if (!code && w.count == 2)
    code = read_count("--rdf", w.word[1], MOST_BINS, &o->rdf_bins);
  o->rdf = 1;
  words_free(&w);
  return code;
}

static int read_order(const char *text, measure_options *o)
{
  o->order_text = text;
  o->no_order = strcmp(text, "none") == 0;
  if (o->no_order)
    return 0;
  if (strncmp(text, "nearest:", 8) == 0) {
    o->neighbours.kind = PACKING_NEIGHBOURS_NEAREST;
    return read_count("--order", text + 8, 256, &o->neighbours.nearest);
  }
  o->neighbours.kind = PACKING_NEIGHBOURS_WITHIN;
  if (!isdigit((unsigned char)*text) && !strchr("+-.", *text))
    return BAD("--order: '%s' is not a factor, nearest:N or none", text);
  return number_positive("--order", text, &o->neighbours.factor);
}

static int read_way(const char *word, profile_ask *p)
{
  const int radius = strncmp(word, "radius", 6) == 0;
  p->axis = PACKING_AXIS_Z;
  p->kind = radius                        ? PACKING_PROFILE_CYLINDERS
            : strcmp(word, "sphere") == 0 ? PACKING_PROFILE_SPHERES
                                          : PACKING_PROFILE_SLABS;
  if (strlen(word) >= sizeof p->name ||
      (p->kind == PACKING_PROFILE_SLABS && !axis_of(word, &p->axis)) ||
      (radius && word[6] && (word[6] != '-' || !axis_of(word + 7, &p->axis))))
    return BAD("--profile: '%s' is not x, y, z, radius, radius-x, radius-y, radius-z or "
               "sphere",
               word);
  strcpy(p->name, word);
  return 0;
}

static int read_profile(const char *text, measure_options *o)
{
  words w = words_of(text, ',');
  profile_ask p = {.bins = 50};
  int code = w.count <= 2 ? read_way(w.word[0], &p)
                          : BAD("--profile: '%s' is not WAY,BINS", text);
  if (!code && w.count == 2)
    code = read_count("--profile", w.word[1], MOST_BINS, &p.bins);
  o->profiles = program_take_more(o->profiles, o->profile_count + 1, sizeof *o->profiles);
  o->profiles[o->profile_count++] = p;
  words_free(&w);
  return code;
}

static int read_section(const char *text, measure_options *o)
{
  section_ask s = {.one = strchr(text, '=') != NULL};
  words w = words_of(text, s.one ? '=' : ',');
  int code = w.count == 2 && axis_of(w.word[0], &s.axis)
                 ? 0
                 : BAD("--section: '%s' is not AXIS=H or AXIS,N", text);
  if (!code)
    code = s.one ? number_real("--section", w.word[1], &s.height)
                 : read_count("--section", w.word[1], MOST_PLANES, &s.count);
  o->sections = program_take_more(o->sections, o->section_count + 1, sizeof *o->sections);
  o->sections[o->section_count++] = s;
  words_free(&w);
  return code;
}

static int read_map(const char *text, measure_options *o)
{
  const char *file = strchr(text, ':');
  char *cells = program_copy(text, file ? (size_t)(file - text) : strlen(text));
  words w = words_of(cells, ',');
  o->map_text = text;
  o->map[2] = 1;
  int code = w.count == 2 || w.count == 3 ? 0 : BAD("--map: '%s' is not NX,NY,NZ", cells);
  for (size_t i = 0; i < w.count && !code; i++)
    code = number_whole("--map", w.word[i], 1, MOST_BINS, &o->map[i]);
  if (!code &&
      (double)o->map[0] * (double)o->map[1] * (double)o->map[2] > (double)MOST_CELLS)
    code = BAD("--map: more than %llu cells", (unsigned long long)MOST_CELLS);
  words_free(&w);
  free(cells);
  if (!code && file && !file[1])
    return BAD("--map: a file name is missing in '%s'", text);
  if (!code && file)
    outputs_add(&o->common.outputs, "--map", text, file + 1)->write = write_map;
  return code;
}

static int read_bonds(const char *text, measure_options *o)
{
  const char *file = strchr(text, ':');
  if (o->bond_text)
    return BAD("--bonds: given twice");
  if (!file || !file[1])
    return BAD("--bonds: '%s' is not GAP:FILE", text);
  char *gap = program_copy(text, (size_t)(file - text));
  int code = number_real("--bonds", gap, &o->bond_gap);
  if (!code && o->bond_gap < 0)
    code = BAD("--bonds: %s is below 0", gap);
  free(gap);
  o->bond_text = text;
  outputs_add(&o->common.outputs, "--bonds", text, file + 1)->write = write_bonds;
  return code;
}

static int read_contacts(const char *text, measure_options *o)
{
  if (o->contact_file || !*text)
    return BAD("--contacts: %s", *text ? "given twice" : "a file name is missing");
  o->contact_file = text;
  outputs_add(&o->common.outputs, "--contacts", text, text)->write = write_contacts;
  return 0;
}

static int read_order_list(const char *text, measure_options *o)
{
  if (o->order_file || !*text)
    return BAD("--order-list: %s", *text ? "given twice" : "a file name is missing");
  o->order_file = text;
  outputs_add(&o->common.outputs, "--order-list", text, text)->write = write_order;
  return 0;
}

static int read_pore_merge(const char *text, measure_options *o)
{
  const int code = number_real("--pore-merge", text, &o->pores_overlap);
  o->pores = 1;
  if (!code && !(o->pores_overlap >= 0 && o->pores_overlap <= 1))
    return BAD("--pore-merge: %s is not from 0 to 1", text);
  return code;
}

static int read_prefix(const char *option, const char *text, const char **slot)
{
  if (*slot)
    return BAD("%s: given twice", option);
  if (!*text)
    return BAD("%s: a name is missing", option);
  *slot = text;
  return 0;
}

static int read_normals(const char *text, measure_options *o)
{
  uint64_t bands = 0;
  const int code = number_whole("--normals", text, 2, 1000, &bands);
  o->normals = (int)bands;
  return code;
}

static int read_plot_format(const char *text, measure_options *o)
{
  o->svg = strcmp(text, "svg") == 0;
  if (o->svg || strcmp(text, "png") == 0)
    return 0;
  return BAD("--plot-format: '%s' is not png or svg", text);
}

static int read_own(int key, const char *text, measure_options *o)
{
  switch (key) {
  case KEY_TOLERANCE:
    return read_tolerance(text, o);
  case KEY_UP:
    return read_up(text, o);
  case KEY_RDF:
    return read_rdf(text, o);
  case KEY_ORDER:
    return read_order(text, o);
  case KEY_ORDER_LIST:
    return read_order_list(text, o);
  case KEY_PROFILE:
    return read_profile(text, o);
  case KEY_SECTION:
    return read_section(text, o);
  case KEY_MAP:
    return o->map_text ? BAD("--map: given twice") : read_map(text, o);
  case KEY_PORES:
    o->pores = 1;
    return 0;
  case KEY_PORE_FILES:
    o->pores = 1;
    return read_prefix("--pore-network", text, &o->pores_prefix);
  case KEY_PORE_MERGE:
    return read_pore_merge(text, o);
  case KEY_BONDS:
    return read_bonds(text, o);
  case KEY_CONTACTS:
    return read_contacts(text, o);
  case KEY_NORMALS:
    return read_normals(text, o);
  case KEY_SIEVES:
    return read_prefix("--sieves", text, &o->sieves_text);
  case KEY_PLOT:
    return read_prefix("--plot", text, &o->plot);
  case KEY_PLOT_FORMAT:
    return read_plot_format(text, o);
  default:
    return -1;
  }
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
  measure_options *o = state->input;
  if (key == ARGP_KEY_INIT) {
    options_refuse(key, argument, state);
    options_pass_on(state, &o->common, 2);
    state->child_inputs[2] = &o->in;
    return 0;
  }
  const int code = read_own(key, argument, o);
  if (code > 0)
    exit(code);
  return code == 0 ? 0 : options_refuse(key, argument, state);
}

static const struct argp_child children[] = {{&options_pack_argp, 0, NULL, 0},
                                             {&options_sizes_argp, 0, NULL, 0},
                                             {&input_argp, 0, NULL, 0},
                                             {NULL, 0, NULL, 0}};

const struct argp measure_argp = {
    .options = table,
    .parser = parse,
    .args_doc = "--in=[FORMAT:]FILE --domain=SPEC",
    .doc =
        "Measures a pack of spheres or discs from anyone: audit, volume fraction, "
        "coordination, stability, fabric and order always, sizes against --psd, the rest "
        "where asked for. A summary goes to standard error, a JSON report to standard "
        "output. Without --domain the container is what the file tells: a box, or the "
        "note '# domain: SPEC' of a table. Exit status 0 whatever is found; whether the "
        "audit passed, the report says.\v ",
    .children = children,
    .help_filter = options_add_taker_help,
};

void measure_options_init(measure_options *o)
{
  memset(o, 0, sizeof *o);
  options_init(&o->common);
  input_init(&o->in);
  packing_neighbours_def_init(&o->neighbours);
  o->tolerance = 1e-9;
  o->rdf_bins = 100;
  o->bond_gap = o->pores_overlap = (double)NAN;
}

void measure_options_free(measure_options *o)
{
  options_free(&o->common);
  input_free(&o->in);
  free(o->profiles);
  free(o->sections);
}

int measure_options_check(const measure_options *o)
{
  const int code = input_check(&o->in);
  if (code)
    return code;
  if (o->svg && !o->plot)
    return BAD("--plot-format: there is no --plot");
  if (o->order_file && o->no_order)
    return BAD("--order-list: --order is none");
  return 0;
}

void measure_options_complete(measure_options *o, const domain_spec *spec)
{
  const int flat = spec->dim == 2;
  if (!o->plot)
    return;
  o->rdf = 1;
  if (o->profile_count == 0) {
    o->profiles = program_take(1, sizeof *o->profiles);
    o->profiles[o->profile_count++] =
        (profile_ask){.kind = PACKING_PROFILE_SLABS,
                      .axis = flat ? PACKING_AXIS_Y : PACKING_AXIS_Z,
                      .bins = 50,
                      .name = {flat ? 'y' : 'z'}};
  }
  if (o->section_count == 0 && !flat) {
    o->sections = program_take(1, sizeof *o->sections);
    o->sections[o->section_count++] = (section_ask){.axis = PACKING_AXIS_Z, .count = 1};
  }
}
