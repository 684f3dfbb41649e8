/* SPDX-License-Identifier: GPL-3.0-or-later */
/* VTK XML UnstructuredGrid: a vertex for each point and a line for each bond, in one list of
 * cells. 49 bytes a particle and what the optional columns take. */
#include "vtk_internal.h"
#include "writers_internal.h"

static void lay_out(packing_i_vtk_file *file, packing_i_vtk_cells cells)
{
  packing_i_vtk_add_cells(file, "connectivity", PACKING_I_VTK_CONNECTIVITY, cells);
  packing_i_vtk_add_cells(file, "offsets", PACKING_I_VTK_OFFSETS, cells);
  packing_i_vtk_add_cells(file, "types", PACKING_I_VTK_CELL_TYPES, cells);
  if (cells.bond_count > 0)
    packing_i_vtk_add_cells(file, "bond", PACKING_I_VTK_BOND_TYPES, cells);
}

static void put_counts(packing_i_writer *w, packing_i_vtk_cells cells)
{
  packing_i_put_text(w, " NumberOfCells=\"");
  packing_i_put_int(w, (int64_t)(cells.vertices + cells.bond_count));
  packing_i_put_char(w, '"');
}

static void put_cells(packing_i_writer *w, const packing_i_vtk_file *file)
{
  const size_t at = file->points_at + 1;
  packing_i_vtk_put_arrays(w, file, "<Cells>\n", at, at + 3, "</Cells>\n");
  if (file->count > at + 3)
    packing_i_vtk_put_arrays(w, file, "<CellData>\n", at + 3, at + 4, "</CellData>\n");
}

static const packing_i_vtk_dialect grid = {"vtu", "UnstructuredGrid", lay_out, put_counts,
                                           put_cells};

static packing_status write_vtu(packing_context *context, const packing_i_pack *pack,
                                const packing_stream *stream)
{
  return packing_i_vtk_write(context, &grid, pack->def.compression, &pack->view,
                             pack->def.bonds, pack->def.bond_count, stream);
}

const packing_i_write_format packing_i_write_vtu = {
    {sizeof(packing_write_format), "vtu", ".vtu",
     "centre, radius, id, type, component, velocity, spin, orientation, bonds",
     "VTK 9.1, ParaView", 1},
    PACKING_I_NEEDS_NOTHING,
    write_vtu};
