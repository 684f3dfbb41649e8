/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Packs for other programs to load: make_pack SCENE FOLDER writes one in every format;
 * make_pack SCENE - reads `x y z r` rows and prints how many particles they are, and the least
 * distance of one to the container's walls, in its radii and less the radius. */
#include "domain_scenes.h"

typedef struct named_scene {
  const char *name;
  scene where;
  size_t count;
  double min_r, max_r;
  int bonded;
} named_scene;

static const named_scene scenes[] = {
    {"box", {SCENE_BOX, 4, 3, 5, 0, {-1, 2, 0.5}, 2, 0, 0}, 200, 0.1, 0.3, 0},
    {"open",
     {SCENE_BOX, 3, 3, 5, 0, {0, 0, 0}, 2, 1, PACKING_PERIODIC_X},
     150,
     0.1,
     0.3,
     0},
    {"periodic", {SCENE_BOX, 4, 4, 4, 0, {-1, 0, 0}, 2, 0, 7}, 200, 0.1, 0.3, 0},
    {"cylinder", {SCENE_CYLINDER, 2, 5, 0, 0, {1, -3, 2}, 1, 0, 0}, 200, 0.1, 0.3, 0},
    {"tube", {SCENE_TUBE, 1, 2.5, 4, 0, {1, 0, 0}, 2, 0, 0}, 200, 0.1, 0.3, 0},
    {"cone", {SCENE_CONE, 0.5, 2.5, 4, 0, {0, 1, 0}, 2, 0, 0}, 150, 0.1, 0.3, 0},
    {"silo", {SCENE_SILO, 2, 6, 0.5, 2, {0, 0, 1}, 2, 1, 0}, 200, 0.1, 0.3, 0},
    {"sphere", {SCENE_SPHERE, 2.5, 0, 0, 0, {1, 1, 1}, 2, 0, 0}, 200, 0.1, 0.3, 0},
    {"rectangle", {SCENE_RECTANGLE, 8, 8, 0, 0, {0, 0, 0}, 1, 0, 0}, 100, 0.1, 0.3, 0},
    {"circle", {SCENE_CIRCLE, 4, 0, 0, 0, {1, 0, 0}, 1, 0, 0}, 80, 0.1, 0.3, 0},
    {"annulus", {SCENE_ANNULUS, 2, 5, 0, 0, {0, 1, 0}, 1, 0, 0}, 100, 0.1, 0.3, 0},
    {"bonded", {SCENE_BOX, 4, 4, 4, 0, {0, 0, 0}, 2, 0, 0}, 200, 0.1, 0.3, 1},
};

static const named_scene *find(const char *name)
{
  for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++)
    if (strcmp(scenes[i].name, name) == 0)
      return &scenes[i];
  fprintf(stderr, "no scene %s\n", name);
  exit(2);
}

static packing_particles *fill(const named_scene *s, packing_domain *domain)
{
  packing_rsa_def def;
  packing_placer *placer = NULL;
  packing_particles *particles = test_store(packing_domain_dim(domain));
  packing_psd *psd = test_uniform(s->min_r, s->max_r);
  packing_rsa_def_init(&def);
  def.count = s->count;
  assert_ok(packing_rsa_create(NULL, &def, domain, psd, particles, &placer));
  test_run(placer);
  packing_placer_destroy(placer);
  packing_psd_destroy(psd);
  return particles;
}

static double at(const packing_column *c, size_t i)
{
  return *(const double *)(const void *)((const char *)c->data + i * c->stride);
}

/* Types 1, 2, 3 in turn: decks have tables of them. */
static void set_types(packing_view *view)
{
  enum { MOST = 1000 };
  static int32_t types[MOST];
  assert_true(view->count <= MOST);
  for (int i = 0; i < MOST; i++)
    types[i] = 1 + i % 3;
  view->type.data = types;
  view->type.stride = sizeof types[0];
}

/* Pairs with a gap below a fifth of the sum of their radii. */
static size_t bonds_of(const packing_view *v, packing_bond *bonds)
{
  size_t count = 0;
  for (size_t i = 0; i < v->count; i++)
    for (size_t j = i + 1; j < v->count; j++) {
      const double x = at(&v->x, i) - at(&v->x, j), y = at(&v->y, i) - at(&v->y, j),
                   z = at(&v->z, i) - at(&v->z, j);
      if (sqrt(x * x + y * y + z * z) < 1.2 * (at(&v->r, i) + at(&v->r, j)))
        bonds[count++] = (packing_bond){i, j, 1 + (int32_t)(j % 2)};
    }
  return count;
}

static packing_file *create(const char *folder, const char *name)
{
  char path[4096];
  packing_file *file = NULL;
  snprintf(path, sizeof path, "%s/%s", folder, name);
  assert_ok(packing_file_create(NULL, path, &file));
  return file;
}

static void write_as(const packing_write_def *def, const packing_view *view,
                     const char *format, const char *folder, const char *name)
{
  packing_file *file = create(folder, name);
  const packing_status status =
      packing_write_pack(NULL, def, format, view, packing_file_stream(file));
  if (status == PACKING_ERR_UNSUPPORTED) { /* no mesh of it, no such cell */
    packing_file_close(file);
    return;
  }
  assert_ok(status);
  assert_ok(packing_file_commit(file));
}

static void write_all(packing_write_def *def, const packing_view *view,
                      const char *folder)
{
  static const char *const files[][2] = {
      {"csv", "pack.csv"},        {"vtp", "pack.vtp"},
      {"vtu", "pack.vtu"},        {"lammps", "pack.data"},
      {"dump", "pack.dump"},      {"liggghts", "liggghts.data"},
      {"yade", "pack.txt"},       {"yade-pack", "pack.spheres"},
      {"geo", "pack.geo"},        {"xyz", "pack.xyz"},
      {"pov", "pack.pov"},        {"stl", "binary.stl"},
      {"stl-ascii", "text.stl"},  {"pfc", "pack.dat"},
      {"neper-coo", "coo.txt"},   {"neper-weight", "weight.txt"},
      {"mercury", "pack.mercury"}};
  packing_deck_def deck;
  packing_deck_def_init(&deck);
  deck.youngs_modulus = 1e9;
  def->deck = &deck;
  for (size_t i = 0; i < sizeof files / sizeof files[0]; i++)
    write_as(def, view, files[i][0], folder, files[i][1]);
  write_as(def, view, "lammps-deck", folder, "in.lammps");
  deck.data_name = "liggghts.data";
  deck.mesh_name = "text.stl";
  write_as(def, view, "liggghts-deck", folder, "in.liggghts");
  def->compression = 1;
  write_as(def, view, "vtp", folder, "zlib.vtp");
  write_as(def, view, "vtu", folder, "zlib.vtu");
}

static void write_series(const char *folder)
{
  static const packing_pvd_entry series[] = {{"pack.vtp", 0, 0}, {"pack.vtu", 0.5, 1}};
  packing_file *file = create(folder, "series.pvd");
  assert_ok(packing_write_pvd(NULL, series, 2, packing_file_stream(file)));
  assert_ok(packing_file_commit(file));
}

static void make(const named_scene *s, packing_domain *domain, const char *folder)
{
  enum { MOST_BONDS = 5000 };
  static packing_bond bonds[MOST_BONDS];
  packing_write_def def;
  packing_view view;
  packing_particles *particles = fill(s, domain);
  packing_particles_view(particles, &view);
  set_types(&view);
  packing_write_def_init(&def);
  def.dim = packing_domain_dim(domain);
  def.domain = domain;
  def.density = 2650;
  def.facets = 96; /* corners stand out by 5e-4 of a radius of a wall */
  def.bonds = bonds;
  def.bond_count = s->bonded ? bonds_of(&view, bonds) : 0;
  write_all(&def, &view, folder);
  write_series(folder);
  printf("%zu %zu\n", view.count, def.bond_count);
  packing_particles_destroy(particles);
}

static void check(const packing_domain *domain)
{
  packing_vec3 p;
  double r, least = HUGE_VAL;
  size_t count = 0;
  while (scanf("%lf %lf %lf %lf", &p.x, &p.y, &p.z, &r) == 4) {
    least = fmin(least, packing_domain_signed_distance(domain, &p, NULL) / r - 1);
    count++;
  }
  printf("%zu %.9g\n", count, least);
}

int main(int argc, char **argv)
{
  if (argc != 3) {
    fputs("usage: make_pack SCENE FOLDER|-\n", stderr);
    return 2;
  }
  const named_scene *s = find(argv[1]);
  packing_domain *domain = scene_make(&s->where);
  if (strcmp(argv[2], "-") == 0)
    check(domain);
  else
    make(s, domain, argv[2]);
  packing_domain_destroy(domain);
  return 0;
}
