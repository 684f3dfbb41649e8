/* SPDX-License-Identifier: GPL-3.0-or-later */
/* VTK XML PolyData: a vertex for each point, a line for each bond. 48 bytes a particle and what
 * the optional columns take, 28 a bond and 4 a particle where there are bonds. */
#include "vtk_internal.h"

const packing_i_format packing_i_format_vtp = {
    "vtp", ".vtp", "VTK XML PolyData 1.0, appended raw data; VTK file formats, vtk.org",
    "centre, radius, id, type, component, velocity, spin, orientation, bonds"};

void packing_vtp_def_fill(packing_vtp_def *def, size_t size)
{
  packing_vtp_def defaults = {0};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static void lay_out(packing_i_vtk_file *file, packing_i_vtk_cells cells)
{
  const packing_i_vtk_cells vertices = {cells.vertices, NULL, 0};
  const packing_i_vtk_cells lines = {0, cells.bonds, cells.bond_count};
  packing_i_vtk_add_cells(file, "connectivity", PACKING_I_VTK_CONNECTIVITY, vertices);
  packing_i_vtk_add_cells(file, "offsets", PACKING_I_VTK_OFFSETS, vertices);
  if (cells.bond_count == 0)
    return;
  packing_i_vtk_add_cells(file, "connectivity", PACKING_I_VTK_CONNECTIVITY, lines);
  packing_i_vtk_add_cells(file, "offsets", PACKING_I_VTK_OFFSETS, lines);
  packing_i_vtk_add_cells(file, "bond", PACKING_I_VTK_BOND_TYPES, cells);
}

static void put_counts(packing_i_writer *w, packing_i_vtk_cells cells)
{
  packing_i_put_text(w, " NumberOfVerts=\"");
  packing_i_put_int(w, (int64_t)cells.vertices);
  packing_i_put_text(w, "\" NumberOfLines=\"");
  packing_i_put_int(w, (int64_t)cells.bond_count);
  packing_i_put_text(w, "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\"");
}

static void put_cells(packing_i_writer *w, const packing_i_vtk_file *file)
{
  const size_t at = file->points_at + 1;
  packing_i_vtk_put_arrays(w, file, "<Verts>\n", at, at + 2, "</Verts>\n");
  if (file->count == at + 2)
    return;
  packing_i_vtk_put_arrays(w, file, "<Lines>\n", at + 2, at + 4, "</Lines>\n");
  packing_i_vtk_put_arrays(w, file, "<CellData>\n", at + 4, at + 5, "</CellData>\n");
}

static const packing_i_vtk_dialect poly_data = {"vtp", "PolyData", lay_out, put_counts,
                                                put_cells};

packing_status packing_write_vtp(packing_context *context, const packing_vtp_def *def,
                                 const packing_view *view, const packing_stream *stream)
{
  packing_vtp_def d;
  packing_view v;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_vtp, compression, def, &d));
  PACKING_I_TRY(packing_i_io_view(context, view, 0, &v));
  PACKING_I_TRY(packing_i_check_bonds(context, v.count, d.bonds, d.bond_count));
  return packing_i_vtk_write(context, &poly_data, d.compression, &v, d.bonds,
                             d.bond_count, stream);
}
