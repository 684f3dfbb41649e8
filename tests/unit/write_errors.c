/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the writers refuse, each with its status and the field's name, before the first byte. */
#include "test.h"

static const double x[] = {0.25, 0.5}, y[] = {0.5, 0.125}, z[] = {0.75, 0.5},
                    r[] = {0.125, 0.0625};

static packing_context *context;
static packing_write_def def;
static packing_deck_def deck;
static packing_view view;

static void begin(void)
{
  packing_write_def_init(&def);
  packing_deck_def_init(&deck);
  def.box.hi.x = def.box.hi.y = def.box.hi.z = 1;
  packing_view_init_arrays(&view, 2, x, y, z, r);
}

static packing_status attempt(const char *format)
{
  test_buffer buffer = {0};
  const packing_stream stream = test_buffer_stream(&buffer);
  const packing_status status = packing_write_pack(context, &def, format, &view, &stream);
  if (status != PACKING_OK)
    assert_int_equal(buffer.size, 0);
  test_buffer_free(&buffer);
  return status;
}

/* One field spoilt, in a fresh pack. */
#define assert_refuses(format, status, field, spoil)                                     \
  do {                                                                                   \
    begin();                                                                             \
    spoil;                                                                               \
    assert_fails(context, attempt(format), (status), (field));                           \
  } while (0)

static int setup(void **state)
{
  (void)state;
  context = test_context(1, PACKING_ISA_AUTO);
  return 0;
}

static int teardown(void **state)
{
  (void)state;
  packing_context_destroy(context);
  return 0;
}

static void the_def(void **state)
{
  (void)state;
  assert_refuses("gif", PACKING_ERR_INVALID, "format", (void)0);
  assert_refuses(NULL, PACKING_ERR_INVALID, "format", (void)0);
  assert_refuses("dump", PACKING_ERR_ABI, "struct_size", def.struct_size = 0);
  assert_refuses("dump", PACKING_ERR_INVALID, "dim", def.dim = 4);
  assert_refuses("dump", PACKING_ERR_INVALID, "z", def.dim = 2);
  assert_refuses("dump", PACKING_ERR_INVALID, "periodic", def.periodic = 8);
  assert_refuses("dump", PACKING_ERR_RANGE, "density", def.density = 0);
  assert_refuses("dump", PACKING_ERR_INVALID, "density", def.density = (double)NAN);
  assert_refuses("dump", PACKING_ERR_INVALID, "time", def.time = (double)INFINITY);
  assert_refuses("pov", PACKING_ERR_RANGE, "facets", def.facets = 2);
  assert_refuses("pov", PACKING_ERR_RANGE, "facets", def.facets = 5000);
  assert_refuses("pov", PACKING_ERR_INVALID, "title", def.title = "a\n#include \"b\"");
  assert_refuses("lammps", PACKING_ERR_INVALID, "title", def.title = "a\rb");
  assert_refuses("vtu", PACKING_ERR_INVALID, "compression", def.compression = 10);
  assert_refuses("vtp", PACKING_ERR_INVALID, "compression", def.compression = -1);
  assert_refuses("dump", PACKING_ERR_RANGE, "box", def.box.hi.y = 0);
  assert_refuses("geo", PACKING_ERR_INVALID, "box", def.box.hi.y = (double)INFINITY);
  begin();
  assert_status(packing_write_pack(context, &def, "csv", &view, NULL),
                PACKING_ERR_INVALID);
  assert_status(packing_write_pack(NULL, &def, "csv", NULL, NULL), PACKING_ERR_INVALID);
}

static void the_particles(void **state)
{
  (void)state;
  static const char *const formats[] = {
      "csv",     "vtp",       "vtu",          "lammps",      "dump",         "liggghts",
      "yade",    "yade-pack", "geo",          "xyz",         "pov",          "pfc",
      "mercury", "neper-coo", "neper-weight", "lammps-deck", "liggghts-deck"};
  static const double bad[] = {0.25, (double)NAN}, zero[] = {0.1, 0};
  for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
    assert_refuses(formats[i], PACKING_ERR_INVALID, "x: particle 1", view.x.data = bad);
    assert_refuses(formats[i], PACKING_ERR_INVALID, "r: particle 1", view.r.data = zero);
    assert_refuses(formats[i], PACKING_ERR_INVALID, "z", view.z.data = NULL);
    assert_refuses(formats[i], PACKING_ERR_INVALID, "vz: particle 1",
                   (view.vz.data = bad, view.vz.stride = sizeof bad[0]));
  }
}

static void the_bonds(void **state)
{
  (void)state;
  static const packing_bond beyond[] = {{0, 1, 1}, {0, 2, 1}}, self[] = {{1, 1, 1}},
                            typeless[] = {{0, 1, 0}};
#define WITH(b, n) (def.bonds = (b), def.bond_count = (n))
  assert_refuses("csv", PACKING_ERR_INVALID, "bonds: bond 1: particle 2 of 2",
                 WITH(beyond, 2));
  assert_refuses("vtu", PACKING_ERR_INVALID, "bonds: bond 0: particle 1 with itself",
                 WITH(self, 1));
  assert_refuses("geo", PACKING_ERR_INVALID, "bonds", WITH(NULL, 1));
  assert_refuses("vtp", PACKING_ERR_RANGE, "bond_count", WITH(beyond, SIZE_MAX));
  assert_refuses("lammps", PACKING_ERR_RANGE, "bonds: bond 0: type 0 is below 1",
                 WITH(typeless, 1));
#undef WITH
  begin();
  test_buffer buffer = {0};
  const packing_stream stream = test_buffer_stream(&buffer);
  packing_vtp_def vtp;
  packing_vtp_def_init(&vtp);
  vtp.bonds = self;
  vtp.bond_count = 1;
  assert_fails(context, packing_write_vtp(context, &vtp, &view, &stream),
               PACKING_ERR_INVALID, "bonds");
  packing_lammps_def lammps;
  packing_lammps_def_init(&lammps);
  lammps.bonds = beyond;
  lammps.bond_count = 2;
  assert_fails(context, packing_write_lammps(context, &lammps, &view, &stream),
               PACKING_ERR_INVALID, "bonds");
  assert_int_equal(buffer.size, 0);
}

static void ids_and_types(void **state)
{
  (void)state;
  static const int64_t twice[] = {4, 4}, below[] = {-1, 0}, none[] = {0, 1},
                       huge[] = {1, INT64_C(1) << 31};
  static const int32_t type[] = {1, 0}, many[] = {1, 101};
#define ID(ids) (view.id.data = (ids), view.id.stride = sizeof(ids)[0])
#define TYPE(types) (view.type.data = (types), view.type.stride = sizeof(types)[0])
  assert_refuses("geo", PACKING_ERR_INVALID, "id: 4 stands twice", ID(twice));
  assert_refuses("geo", PACKING_ERR_RANGE, "id: particle 0", ID(below));
  assert_refuses("dump", PACKING_ERR_RANGE, "id: particle 1", ID(huge));
  assert_refuses("pfc", PACKING_ERR_RANGE, "id: particle 0", ID(none));
  assert_refuses("lammps-deck", PACKING_ERR_RANGE, "type: particle 1", TYPE(type));
  assert_refuses("mercury", PACKING_ERR_RANGE, "type: particle 1", TYPE(type));
  assert_refuses("liggghts-deck", PACKING_ERR_RANGE, "type", TYPE(many));
  begin();
  ID(none);
  assert_ok(attempt("geo")); /* from 0 there */
  TYPE(many);
  assert_ok(attempt("lammps-deck"));
#undef ID
#undef TYPE
}

static void what_a_format_cannot_say(void **state)
{
  (void)state;
  static const double large[] = {0.25, 0.1};
  assert_refuses("yade-pack", PACKING_ERR_UNSUPPORTED, "periodic", def.periodic = 3);
  assert_refuses("pfc", PACKING_ERR_RANGE, "box: 1 wide", view.r.data = large);
  assert_refuses("lammps", PACKING_ERR_RANGE, "box: the centre", def.box.hi.z = 0.75);
  assert_refuses("stl", PACKING_ERR_INVALID, "domain", (void)0);
}

static void decks(void **state)
{
  (void)state;
#define DECK(field, value) (def.deck = &deck, deck.field = (value))
  static const char *const formats[] = {"lammps-deck", "liggghts-deck"};
  for (size_t i = 0; i < 2; i++) {
    const char *f = formats[i];
    assert_refuses(f, PACKING_ERR_INVALID, "deck.data_name", DECK(data_name, ""));
    assert_refuses(f, PACKING_ERR_INVALID, "deck.data_name", DECK(data_name, NULL));
    assert_refuses(f, PACKING_ERR_INVALID, "deck.data_name", DECK(data_name, "a b"));
    assert_refuses(f, PACKING_ERR_INVALID, "deck.data_name",
                   DECK(data_name, "a\nshell rm"));
    assert_refuses(f, PACKING_ERR_INVALID, "deck.mesh_name", DECK(mesh_name, "${x}"));
    assert_refuses(f, PACKING_ERR_INVALID, "deck.dump_name", DECK(dump_name, "a&"));
    assert_refuses(f, PACKING_ERR_RANGE, "deck.youngs_modulus", DECK(youngs_modulus, 0));
    assert_refuses(f, PACKING_ERR_RANGE, "deck.poisson_ratio", DECK(poisson_ratio, 0.5));
    assert_refuses(f, PACKING_ERR_INVALID, "deck.poisson_ratio",
                   DECK(poisson_ratio, (double)NAN));
    assert_refuses(f, PACKING_ERR_RANGE, "deck.friction", DECK(friction, -1));
    assert_refuses(f, PACKING_ERR_RANGE, "deck.restitution", DECK(restitution, 0.01));
    assert_refuses(f, PACKING_ERR_RANGE, "deck.restitution", DECK(restitution, 1.1));
    assert_refuses(f, PACKING_ERR_RANGE, "deck.gravity", DECK(gravity, -9.81));
    assert_refuses(f, PACKING_ERR_RANGE, "deck.timestep", DECK(timestep, -1));
    assert_refuses(f, PACKING_ERR_RANGE, "deck.steps", DECK(steps, UINT64_MAX));
    assert_refuses(f, PACKING_ERR_INVALID, "deck.down.x", DECK(down.x, (double)NAN));
    assert_refuses(f, PACKING_ERR_INVALID, "deck.down.z",
                   (DECK(down.z, 1), def.dim = 2, view.z.data = NULL));
    assert_refuses(f, PACKING_ERR_INVALID, "view", view.count = 0);
    assert_refuses(f, PACKING_ERR_ABI, "struct_size", DECK(struct_size, 3));
  }
#undef DECK
}

static double distance(void *user, const packing_vec3 *point, packing_vec3 *normal)
{
  (void)user;
  (void)normal;
  return 1 - sqrt(point->x * point->x + point->y * point->y + point->z * point->z);
}

static packing_domain *custom(void)
{
  packing_domain_custom_def custom_def;
  packing_domain *domain = NULL;
  packing_domain_custom_def_init(&custom_def);
  custom_def.signed_distance = distance;
  custom_def.bounds.lo.x = custom_def.bounds.lo.y = custom_def.bounds.lo.z = -1;
  custom_def.bounds.hi.x = custom_def.bounds.hi.y = custom_def.bounds.hi.z = 1;
  custom_def.volume = 4.18879;
  assert_ok(packing_domain_create_custom(NULL, &custom_def, &domain));
  return domain;
}

static void domains(void **state)
{
  (void)state;
  packing_domain *flat = test_rectangle(1, 1, 0), *round = test_box(1, 1, 1, 7),
                 *any = custom();
  assert_refuses("dump", PACKING_ERR_INVALID, "domain", def.domain = flat);
  assert_refuses("stl", PACKING_ERR_UNSUPPORTED, "domain", def.domain = round);
  assert_refuses("stl-ascii", PACKING_ERR_UNSUPPORTED, "domain", def.domain = any);
  assert_refuses("lammps-deck", PACKING_ERR_UNSUPPORTED, "domain", def.domain = any);
  assert_refuses("liggghts-deck", PACKING_ERR_UNSUPPORTED, "domain", def.domain = any);
  assert_refuses("dump", PACKING_ERR_INVALID, "periodic",
                 (def.domain = round, def.periodic = 1));
  assert_refuses("stl", PACKING_ERR_UNSUPPORTED, "domain",
                 (def.domain = flat, def.dim = 2, view.z.data = NULL));
  begin();
  def.domain = any;
  assert_ok(attempt("pov")); /* without the shape */
  packing_domain_destroy(flat);
  packing_domain_destroy(round);
  packing_domain_destroy(any);
}

static packing_status attempt_stl(const packing_stl_def *stl,
                                  const packing_domain *domain)
{
  test_buffer buffer = {0};
  const packing_stream stream = test_buffer_stream(&buffer);
  const packing_status status = packing_write_stl(context, stl, domain, &stream);
  if (status != PACKING_OK)
    assert_int_equal(buffer.size, 0);
  test_buffer_free(&buffer);
  return status;
}

static void stl(void **state)
{
  (void)state;
  packing_domain *box = test_box(1, 1, 1, 0), *large = test_box(1e39, 1e39, 1e39, 0);
  packing_domain_box_def far_def;
  packing_domain_cylinder_def lost_def;
  packing_domain *far_off = NULL, *lost = NULL;
  packing_stl_def stl_def;
  packing_domain_box_def_init(&far_def);
  far_def.size.x = far_def.size.y = far_def.size.z = 1;
  far_def.corner.x = 1e9;
  assert_ok(packing_domain_create_box(NULL, &far_def, &far_off));
  packing_domain_cylinder_def_init(&lost_def);
  lost_def.radius = lost_def.height = 1;
  lost_def.base.x = 4e15;
  assert_ok(packing_domain_create_cylinder(NULL, &lost_def, &lost));
  packing_stl_def_init(&stl_def);
  assert_ok(attempt_stl(NULL, box));
  assert_fails(context, attempt_stl(NULL, NULL), PACKING_ERR_INVALID, "domain");
  assert_fails(context, attempt_stl(&stl_def, large), PACKING_ERR_RANGE, "domain");
  assert_fails(context, attempt_stl(&stl_def, far_off), PACKING_ERR_RANGE, "domain");
  stl_def.ascii = 1;
  assert_ok(attempt_stl(&stl_def, large));
  assert_ok(attempt_stl(&stl_def, far_off));
  assert_fails(context, attempt_stl(&stl_def, lost), PACKING_ERR_RANGE, "domain");
  stl_def.ascii = 2;
  assert_fails(context, attempt_stl(&stl_def, box), PACKING_ERR_RANGE, "ascii");
  packing_stl_def_init(&stl_def);
  stl_def.facets = 2;
  assert_fails(context, attempt_stl(&stl_def, box), PACKING_ERR_RANGE, "facets");
  packing_stl_def_init(&stl_def);
  stl_def.title = "a\nfacet";
  assert_fails(context, attempt_stl(&stl_def, box), PACKING_ERR_INVALID, "title");
  stl_def.struct_size = 1;
  assert_fails(context, attempt_stl(&stl_def, box), PACKING_ERR_ABI, "struct_size");
  assert_fails(context, packing_write_stl(context, NULL, box, NULL), PACKING_ERR_INVALID,
               "stream");
  packing_domain_destroy(box);
  packing_domain_destroy(large);
  packing_domain_destroy(far_off);
  packing_domain_destroy(lost);
}

static void collections(void **state)
{
  (void)state;
  test_buffer buffer = {0};
  const packing_stream stream = test_buffer_stream(&buffer);
  const packing_pvd_entry bad[] = {
      {NULL, 0, 0}, {"", 0, 0}, {"a\nb", 0, 0}, {"a", (double)NAN, 0}, {"a", 0, -1}};
  static const char *const fields[] = {"file", "file", "file", "time", "part"};
  for (size_t i = 0; i < 5; i++)
    assert_fails(context, packing_write_pvd(context, &bad[i], 1, &stream),
                 PACKING_ERR_INVALID, fields[i]);
  assert_fails(context, packing_write_pvd(context, NULL, 1, &stream), PACKING_ERR_INVALID,
               "entries");
  assert_fails(context, packing_write_pvd(context, NULL, 0, NULL), PACKING_ERR_INVALID,
               "stream");
  assert_int_equal(buffer.size, 0);
  assert_ok(packing_write_pvd(context, NULL, 0, &stream));
  test_buffer_free(&buffer);
}

static void yade_periods(void **state)
{
  (void)state;
  test_buffer buffer = {0};
  const packing_stream stream = test_buffer_stream(&buffer);
  packing_yade_def yade;
  begin();
  packing_yade_def_init(&yade);
  yade.period.x = yade.period.y = 1;
  assert_fails(context, packing_write_yade(context, &yade, &view, &stream),
               PACKING_ERR_RANGE, "period.z");
  yade.period.z = 2;
  yade.header = 1;
  assert_fails(context, packing_write_yade(context, &yade, &view, &stream),
               PACKING_ERR_INVALID, "header");
  assert_int_equal(buffer.size, 0);
}

/* A stream that ends after any number of bytes: its status comes back. */
static void streams_fail_at_every_byte(void **state)
{
  (void)state;
  static const packing_bond bond[] = {{0, 1, 1}};
  packing_domain *domain = test_box(1, 1, 1, 0);
  for (size_t f = 0; packing_write_format_at(f) != NULL; f++) {
    test_buffer whole = {0};
    begin();
    def.domain = domain;
    def.bonds = bond;
    def.bond_count = 1;
    packing_stream stream = test_buffer_stream(&whole);
    const char *name = packing_write_format_at(f)->name;
    assert_ok(packing_write_pack(context, &def, name, &view, &stream));
    const size_t step = 1 + whole.size / 40;
    for (size_t limit = 1; limit < whole.size; limit += step) {
      test_buffer part = {0};
      part.limit = limit;
      stream = test_buffer_stream(&part);
      assert_fails(context, packing_write_pack(context, &def, name, &view, &stream),
                   PACKING_ERR_IO, "stream");
      test_buffer_free(&part);
    }
    test_buffer_free(&whole);
  }
  packing_domain_destroy(domain);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(the_def, setup, teardown),
      cmocka_unit_test_setup_teardown(the_particles, setup, teardown),
      cmocka_unit_test_setup_teardown(the_bonds, setup, teardown),
      cmocka_unit_test_setup_teardown(ids_and_types, setup, teardown),
      cmocka_unit_test_setup_teardown(what_a_format_cannot_say, setup, teardown),
      cmocka_unit_test_setup_teardown(decks, setup, teardown),
      cmocka_unit_test_setup_teardown(domains, setup, teardown),
      cmocka_unit_test_setup_teardown(stl, setup, teardown),
      cmocka_unit_test_setup_teardown(collections, setup, teardown),
      cmocka_unit_test_setup_teardown(yade_periods, setup, teardown),
      cmocka_unit_test_setup_teardown(streams_fail_at_every_byte, setup, teardown),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
