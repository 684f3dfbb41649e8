/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_FUZZ_MESH_H
#define PACKING_FUZZ_MESH_H

/* packing_read_mesh(): what it takes must be a mesh that can be checked, and that a container is
 * made of only where it is sound; what it refuses must say why, and memory must go with the input.
 * The size of the input chooses the options. */

#include "fuzz_read.h"

static inline void fuzz_check_mesh(packing_context *context, packing_mesh *mesh)
{
  packing_mesh_report report;
  packing_mesh_view v;
  packing_domain_mesh_def def;
  packing_domain *domain = NULL;
  packing_mesh_report_init(&report);
  packing_mesh_view_init(&v);
  packing_domain_mesh_def_init(&def);
  fuzz_require(packing_mesh_arrays(context, mesh, &v) == PACKING_OK);
  fuzz_require(v.triangle_count > 0);
  for (size_t i = 0; i < 3 * v.vertex_count; i++)
    fuzz_require(isfinite(v.vertices[i]));
  for (size_t i = 0; i < 3 * v.triangle_count; i++)
    fuzz_require(v.triangles[i] < v.vertex_count);
  fuzz_require(packing_mesh_check(context, mesh, &report) == PACKING_OK);
  fuzz_require((report.defect == PACKING_MESH_SOUND) == (report.count == 0));
  fuzz_require(report.count == 0 || report.triangle < v.triangle_count);
  def.mesh = mesh;
  const packing_status status = packing_domain_create_mesh(context, &def, &domain);
  if (report.defect != PACKING_MESH_SOUND)
    fuzz_require(status == PACKING_ERR_GEOMETRY);
  if (status == PACKING_OK) {
    const packing_vec3 p = {v.vertices[0], v.vertices[1], v.vertices[2]};
    fuzz_require(fabs(packing_domain_signed_distance(domain, &p, NULL)) <=
                 1e-12 * sqrt(packing_mesh_area(mesh)) +
                     1e-14 * (fabs(p.x) + fabs(p.y) + fabs(p.z)));
    fuzz_require(packing_domain_volume(domain) > 0);
  }
  packing_domain_destroy(domain);
}

static inline int fuzz_read_mesh(packing_mesh_format format, const uint8_t *data,
                                 size_t size)
{
  packing_context *context = fuzz_bounded_context();
  packing_mesh *mesh = NULL;
  packing_read_mesh_def def;
  fuzz_input in;
  const packing_stream stream = fuzz_stream(&in, data, size);
  packing_read_mesh_def_init(&def);
  def.format = size % 2 ? format : PACKING_MESH_FORMAT_AUTO;
  def.merge = size % 3 == 0 ? 1e-3 : 0;
  const packing_status status = packing_read_mesh(context, &def, &stream, &mesh);
  if (status == PACKING_OK) {
    fuzz_check_mesh(context, mesh);
  } else {
    fuzz_require(status == PACKING_ERR_FORMAT || status == PACKING_ERR_RANGE ||
                 status == PACKING_ERR_UNSUPPORTED || status == PACKING_ERR_GEOMETRY);
    fuzz_require(mesh == NULL && packing_context_message(context)[0] != '\0');
    fuzz_require(strchr(packing_context_message(context), '\n') == NULL);
  }
  packing_mesh_destroy(mesh);
  packing_context_destroy(context);
  return 0;
}

#endif
