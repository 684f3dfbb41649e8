/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every refusal of contacts.h, which names what is wrong and writes nothing. */
#include "test.h"

typedef struct fixture {
  packing_context *context;
  packing_domain *box;
  double x[2], y[2], z[2], r[2], q[2];
  packing_view view;
  packing_contacts *contacts;
} fixture;

static void begin(fixture *f)
{
  memset(f, 0, sizeof *f);
  f->context = test_context(1, PACKING_ISA_AUTO);
  f->box = test_box(4, 4, 4, 0);
  for (int i = 0; i < 2; i++) {
    f->x[i] = 1 + 2 * i;
    f->y[i] = f->z[i] = f->r[i] = f->q[i] = 1;
  }
  packing_view_init_arrays(&f->view, 2, f->x, f->y, f->z, f->r);
  assert_ok(packing_contacts_create(f->context, NULL, f->box, &f->view, &f->contacts));
}

static void end(fixture *f)
{
  packing_contacts_destroy(f->contacts);
  packing_domain_destroy(f->box);
  packing_context_destroy(f->context);
}

static void refuse(fixture *f, const packing_contacts_def *def, packing_status status,
                   const char *field)
{
  packing_contacts *contacts = NULL;
  assert_fails(f->context,
               packing_contacts_create(f->context, def, f->box, &f->view, &contacts),
               status, field);
  assert_null(contacts);
  assert_true(packing_contacts_create(NULL, def, f->box, &f->view, &contacts) == status);
}

static void create_refuses_bad_options(void **state)
{
  (void)state;
  fixture f;
  packing_contacts_def def;
  begin(&f);
  packing_contacts_def_init(&def);
  assert_true(def.tolerance == 1e-9 && def.gap == 0 && def.walls == 1 && def.dim == 0);
  def.tolerance = -1e-9;
  refuse(&f, &def, PACKING_ERR_RANGE, "tolerance");
  def.tolerance = (double)NAN;
  refuse(&f, &def, PACKING_ERR_INVALID, "tolerance");
  packing_contacts_def_init(&def);
  def.gap = -1;
  refuse(&f, &def, PACKING_ERR_RANGE, "gap");
  def.gap = (double)INFINITY;
  refuse(&f, &def, PACKING_ERR_INVALID, "gap");
  packing_contacts_def_init(&def);
  def.walls = 2;
  refuse(&f, &def, PACKING_ERR_RANGE, "walls");
  packing_contacts_def_init(&def);
  def.dim = 1;
  refuse(&f, &def, PACKING_ERR_RANGE, "dim");
  packing_contacts_def_init(&def);
  def.struct_size = 3;
  refuse(&f, &def, PACKING_ERR_ABI, "struct_size");
  end(&f);
}

static void create_refuses_bad_packs(void **state)
{
  (void)state;
  fixture f;
  begin(&f);
  packing_contacts *contacts = NULL;
  assert_fails(f.context,
               packing_contacts_create(f.context, NULL, f.box, NULL, &contacts),
               PACKING_ERR_INVALID, "view");
  assert_fails(f.context, packing_contacts_create(f.context, NULL, f.box, &f.view, NULL),
               PACKING_ERR_INVALID, "contacts");
  f.z[1] = (double)NAN;
  refuse(&f, NULL, PACKING_ERR_INVALID, "particle 1");
  f.z[1] = 1;
  f.r[0] = 0;
  refuse(&f, NULL, PACKING_ERR_RANGE, "particle 0");
  f.r[0] = 1;
  f.view.r.data = NULL;
  refuse(&f, NULL, PACKING_ERR_INVALID, "view");
#if SIZE_MAX > UINT32_MAX
  packing_view_init_arrays(&f.view, (size_t)UINT32_MAX + 1, f.x, f.y, f.z, f.r);
  f.view.x.stride = f.view.y.stride = f.view.z.stride = f.view.r.stride = 0;
  refuse(&f, NULL, PACKING_ERR_RANGE, "4294967296 particles");
#endif
  end(&f);
}

static void a_gap_of_many_periods_is_refused(void **state)
{
  (void)state;
  fixture f;
  packing_contacts_def def;
  begin(&f);
  packing_domain_destroy(f.box);
  f.box = test_box(4, 4, 4, 1);
  packing_contacts_def_init(&def);
  def.gap = 1e9;
  refuse(&f, &def, PACKING_ERR_RANGE, "gap");
  end(&f);
}

static void questions_without_a_network_are_refused(void **state)
{
  (void)state;
  packing_coordination_report coordination;
  packing_classes_report classes;
  packing_fabric_report fabric;
  packing_contact list[1];
  size_t count = 77;
  packing_coordination_report_init(&coordination);
  packing_classes_report_init(&classes);
  packing_fabric_report_init(&fabric);
  assert_status(packing_contacts_list(NULL, 0, 1, list, &count), PACKING_ERR_INVALID);
  assert_status(packing_contacts_degrees(NULL, &count, NULL), PACKING_ERR_INVALID);
  assert_status(packing_contacts_coordination(NULL, &coordination), PACKING_ERR_INVALID);
  assert_status(packing_contacts_classes(NULL, NULL, &classes), PACKING_ERR_INVALID);
  assert_status(packing_contacts_fabric(NULL, NULL, &fabric), PACKING_ERR_INVALID);
  assert_status(packing_contacts_normals(NULL, NULL, &count, 1, &count),
                PACKING_ERR_INVALID);
  assert_int_equal(count, 77);
}

static void answers_need_room(void **state)
{
  (void)state;
  fixture f;
  begin(&f);
  packing_contact list[1];
  packing_fabric_report blank;
  memset(&blank, 0, sizeof blank);
  size_t count = 77;
  assert_fails(f.context, packing_contacts_list(f.contacts, 0, 1, NULL, &count),
               PACKING_ERR_INVALID, "list");
  assert_fails(f.context, packing_contacts_list(f.contacts, 0, 1, list, NULL),
               PACKING_ERR_INVALID, "count");
  assert_fails(f.context, packing_contacts_normals(f.contacts, NULL, NULL, 1, &count),
               PACKING_ERR_INVALID, "counts");
  assert_fails(f.context, packing_contacts_normals(f.contacts, NULL, &count, 1, NULL),
               PACKING_ERR_INVALID, "count");
  assert_fails(f.context, packing_contacts_coordination(f.contacts, NULL),
               PACKING_ERR_INVALID, "report");
  assert_fails(f.context, packing_contacts_classes(f.contacts, NULL, NULL),
               PACKING_ERR_INVALID, "report");
  assert_fails(f.context, packing_contacts_fabric(f.contacts, NULL, NULL),
               PACKING_ERR_INVALID, "report");
  assert_fails(f.context, packing_contacts_fabric(f.contacts, NULL, &blank),
               PACKING_ERR_ABI, "report");
  assert_int_equal(count, 77);
  end(&f);
}

static void options_of_questions_are_checked(void **state)
{
  (void)state;
  fixture f;
  begin(&f);
  packing_classes_def classes;
  packing_classes_report report;
  packing_fabric_def fabric;
  packing_fabric_report tensor;
  packing_classes_report_init(&report);
  packing_fabric_report_init(&tensor);
  packing_classes_def_init(&classes);
  classes.up.y = (double)INFINITY;
  assert_fails(f.context, packing_contacts_classes(f.contacts, &classes, &report),
               PACKING_ERR_INVALID, "up.y");
  packing_classes_def_init(&classes);
  classes.walls = -1;
  assert_fails(f.context, packing_contacts_classes(f.contacts, &classes, &report),
               PACKING_ERR_RANGE, "walls");
  classes.struct_size = 0;
  assert_fails(f.context, packing_contacts_classes(f.contacts, &classes, &report),
               PACKING_ERR_ABI, "struct_size");
  packing_fabric_def_init(&fabric);
  fabric.of = (packing_contacts_of)3;
  assert_fails(f.context, packing_contacts_fabric(f.contacts, &fabric, &tensor),
               PACKING_ERR_RANGE, "of");
  fabric.struct_size = 0;
  assert_fails(f.context, packing_contacts_fabric(f.contacts, &fabric, &tensor),
               PACKING_ERR_ABI, "struct_size");
  assert_true(report.firm == 0 && tensor.count == 0);
  packing_contacts_destroy(f.contacts);
  packing_contacts_def def;
  packing_contacts_def_init(&def);
  def.dim = 2;
  assert_ok(packing_contacts_create(f.context, &def, f.box, &f.view, &f.contacts));
  packing_classes_def_init(&classes);
  classes.up.z = 1;
  assert_fails(f.context, packing_contacts_classes(f.contacts, &classes, &report),
               PACKING_ERR_INVALID, "up");
  end(&f);
}

static void refuse_layout(fixture *f, const packing_normals_def *def, int dim,
                          packing_status status, const char *field)
{
  size_t count = 77;
  assert_fails(f->context, packing_normals_layout(f->context, def, dim, NULL, 0, &count),
               status, field);
  if (dim == 3)
    assert_fails(f->context, packing_contacts_normals(f->contacts, def, NULL, 0, &count),
                 status, field);
  assert_int_equal(count, 77);
}

static void layouts_are_checked(void **state)
{
  (void)state;
  fixture f;
  packing_normals_def def;
  packing_normals_bin bin;
  size_t count = 0;
  begin(&f);
  refuse_layout(&f, NULL, 1, PACKING_ERR_RANGE, "dim");
  for (int k = 0; k < 2; k++) {
    packing_normals_def_init(&def);
    def.bands = k == 0 ? 1 : 1001;
    refuse_layout(&f, &def, 3, PACKING_ERR_RANGE, "bands");
  }
  for (int k = 0; k < 3; k++) {
    packing_normals_def_init(&def);
    def.sectors = k == 0 ? 0 : k == 1 ? 7 : 10002;
    refuse_layout(&f, &def, 3, PACKING_ERR_RANGE, "sectors");
  }
  packing_normals_def_init(&def);
  def.of = (packing_contacts_of)-1;
  refuse_layout(&f, &def, 3, PACKING_ERR_RANGE, "of");
  def.struct_size = 8;
  refuse_layout(&f, &def, 3, PACKING_ERR_ABI, "struct_size");
  assert_fails(f.context, packing_normals_layout(f.context, NULL, 3, NULL, 1, &count),
               PACKING_ERR_INVALID, "bins");
  assert_fails(f.context, packing_normals_layout(f.context, NULL, 3, &bin, 1, NULL),
               PACKING_ERR_INVALID, "count");
  end(&f);
}

static void refuse_orientations(fixture *f, const packing_orientations_def *def,
                                packing_status status, const char *field)
{
  packing_fabric_report report;
  packing_fabric_report_init(&report);
  assert_fails(f->context,
               packing_measure_orientations(f->context, def, &f->view, &report), status,
               field);
  assert_int_equal(report.count, 0);
}

static void orientations_are_checked(void **state)
{
  (void)state;
  fixture f;
  packing_orientations_def def;
  begin(&f);
  packing_column *q[4] = {&f.view.qw, &f.view.qx, &f.view.qy, &f.view.qz};
  static const char *const names[4] = {"qw", "qx", "qy", "qz"};
  for (int k = 0; k < 4; k++) {
    refuse_orientations(&f, NULL, PACKING_ERR_INVALID, names[k]);
    q[k]->data = f.q;
    q[k]->stride = sizeof *f.q;
  }
  packing_orientations_def_init(&def);
  def.dim = 0;
  refuse_orientations(&f, &def, PACKING_ERR_RANGE, "dim");
  packing_orientations_def_init(&def);
  def.axis.x = (double)NAN;
  refuse_orientations(&f, &def, PACKING_ERR_INVALID, "axis.x");
  def.struct_size = 1;
  refuse_orientations(&f, &def, PACKING_ERR_ABI, "struct_size");
  f.q[1] = 0;
  refuse_orientations(&f, NULL, PACKING_ERR_INVALID, "particle 1");
  f.q[1] = (double)INFINITY;
  refuse_orientations(&f, NULL, PACKING_ERR_INVALID, "particle 1");
  f.q[1] = 1; /* x to y to z to x */
  packing_orientations_def_init(&def);
  def.dim = 2;
  def.axis.y = 1;
  refuse_orientations(&f, &def, PACKING_ERR_INVALID, "particle 0");
  assert_fails(f.context, packing_measure_orientations(f.context, NULL, &f.view, NULL),
               PACKING_ERR_INVALID, "report");
  packing_fabric_report report;
  packing_fabric_report_init(&report);
  assert_fails(f.context, packing_measure_orientations(f.context, NULL, NULL, &report),
               PACKING_ERR_INVALID, "view");
  end(&f);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(create_refuses_bad_options),
      cmocka_unit_test(create_refuses_bad_packs),
      cmocka_unit_test(a_gap_of_many_periods_is_refused),
      cmocka_unit_test(questions_without_a_network_are_refused),
      cmocka_unit_test(answers_need_room),
      cmocka_unit_test(options_of_questions_are_checked),
      cmocka_unit_test(layouts_are_checked),
      cmocka_unit_test(orientations_are_checked),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
