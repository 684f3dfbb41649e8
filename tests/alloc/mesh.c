/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every allocation of meshes, their check, their containers and their readers fails once. */
#include "mesh_scenes.h"

static int kind_now;

static packing_status from_arrays(packing_context *context, uint64_t *hash)
{
  shape *s = shape_of(kind_now);
  packing_mesh *mesh = NULL;
  packing_domain *domain = NULL, *inset = NULL;
  packing_status status = shape_try(context, s, 1, &mesh);
  if (status == PACKING_OK)
    status = shape_domain_of(context, mesh, &domain);
  if (status == PACKING_OK && kind_now == SHAPE_CUBE) /* along the axes: takes no time */
    status = packing_domain_create_inset(context, domain, 0.05, &inset);
  if (status == PACKING_OK) {
    const double v[2] = {packing_domain_volume(domain),
                         inset == NULL ? 0 : packing_domain_volume(inset)};
    *hash = test_hash(TEST_HASH_START, v, sizeof v);
  }
  packing_domain_destroy(inset);
  packing_domain_destroy(domain);
  packing_mesh_destroy(mesh);
  free(s);
  return status;
}

static void meshes(void **state)
{
  (void)state;
  const int kinds[] = {SHAPE_TETRAHEDRON, SHAPE_CUBE, SHAPE_HOLLOW};
  for (int i = 0; i < 3; i++) {
    kind_now = kinds[i];
    assert_true(test_every_allocation(from_arrays) >= 20);
  }
}

static const char *text_now;

static packing_status from_text(packing_context *context, uint64_t *hash)
{
  packing_mesh *mesh = NULL;
  test_buffer buffer = {0};
  test_buffer_text(&buffer, text_now);
  const packing_stream stream = test_buffer_stream(&buffer);
  const packing_status status = packing_read_mesh(context, NULL, &stream, &mesh);
  if (status == PACKING_OK) {
    const double v = packing_mesh_volume(mesh);
    *hash = test_hash(TEST_HASH_START, &v, sizeof v);
  }
  packing_mesh_destroy(mesh);
  test_buffer_free(&buffer);
  return status;
}

static void readers(void **state)
{
  (void)state;
  static const char *const texts[] = {
      "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nendsolid\n",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2 4\n",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_index\n"
      "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"};
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
    text_now = texts[i];
    assert_true(test_every_allocation(from_text) >= 8);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(meshes), cmocka_unit_test(readers)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
