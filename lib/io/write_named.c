/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Formats that have a function of their own in io.h, behind packing_write_pack(): their defs
 * filled from the common one. */
#include "vec.h"
#include "writers_internal.h"

static packing_status write_csv(packing_context *context, const packing_i_pack *pack,
                                const packing_stream *stream)
{
  packing_csv_def def;
  packing_csv_def_init(&def);
  def.dim = pack->def.dim;
  def.note_count = pack->def.note_count;
  def.keys = pack->def.keys;
  def.values = pack->def.values;
  return packing_write_csv(context, &def, &pack->view, stream);
}

const packing_i_write_format packing_i_write_csv = {
    {sizeof(packing_write_format), "csv", ".csv", "every column, and notes in # lines",
     "spreadsheets, packing_read_csv()", 1},
    PACKING_I_NEEDS_NOTHING,
    write_csv};

static packing_status write_vtp(packing_context *context, const packing_i_pack *pack,
                                const packing_stream *stream)
{
  packing_vtp_def def;
  packing_vtp_def_init(&def);
  def.compression = pack->def.compression;
  def.bonds = pack->def.bonds;
  def.bond_count = pack->def.bond_count;
  return packing_write_vtp(context, &def, &pack->view, stream);
}

const packing_i_write_format packing_i_write_vtp = {
    {sizeof(packing_write_format), "vtp", ".vtp",
     "centre, radius, id, type, component, velocity, spin, orientation, bonds",
     "VTK 9.1, ParaView", 1},
    PACKING_I_NEEDS_NOTHING,
    write_vtp};

static packing_status write_data(packing_context *context, const packing_i_pack *pack,
                                 size_t bond_count, const packing_stream *stream)
{
  packing_lammps_def def;
  packing_lammps_def_init(&def);
  def.dim = pack->def.dim;
  def.density = pack->def.density;
  def.box = pack->box;
  def.title = pack->def.title;
  def.bonds = pack->def.bonds;
  def.bond_count = bond_count;
  return packing_write_lammps(context, &def, &pack->view, stream);
}

static packing_status write_lammps(packing_context *context, const packing_i_pack *pack,
                                   const packing_stream *stream)
{
  return write_data(context, pack, pack->def.bond_count, stream);
}

const packing_i_write_format packing_i_write_lammps = {
    {sizeof(packing_write_format), "lammps", ".data",
     "centre, radius, density, id, type, velocity, spin, box, bonds",
     "LAMMPS 29Sep2021, atom_style sphere; with bonds hybrid sphere bond", 1},
    PACKING_I_NEEDS_BOX,
    write_lammps};

/* LIGGGHTS has no bonds between spheres. */
static packing_status write_liggghts(packing_context *context, const packing_i_pack *pack,
                                     const packing_stream *stream)
{
  return write_data(context, pack, 0, stream);
}

const packing_i_write_format packing_i_write_liggghts = {
    {sizeof(packing_write_format), "liggghts", "",
     "centre, radius, density, id, type, velocity, spin, box",
     "LIGGGHTS 3.8.0, atom_style granular or sphere", 1},
    PACKING_I_NEEDS_BOX,
    write_liggghts};

static packing_status write_yade(packing_context *context, const packing_i_pack *pack,
                                 const packing_stream *stream)
{
  return packing_write_yade(context, NULL, &pack->view, stream);
}

const packing_i_write_format packing_i_write_yade = {
    {sizeof(packing_write_format), "yade", ".txt", "centre, radius",
     "YADE 2023.02a, ymport.text() and SpherePack", 1},
    PACKING_I_NEEDS_NOTHING,
    write_yade};

/* SpherePack keeps a cell of three directions, or none. */
static packing_status write_yade_pack(packing_context *context,
                                      const packing_i_pack *pack,
                                      const packing_stream *stream)
{
  const unsigned all = PACKING_PERIODIC_X | PACKING_PERIODIC_Y | PACKING_PERIODIC_Z;
  packing_yade_def def;
  packing_yade_def_init(&def);
  if (pack->def.periodic != 0 && pack->def.periodic != all)
    return packing_i_fail(context, PACKING_ERR_UNSUPPORTED, "periodic", PACKING_NO_INDEX,
                          "YADE's cell is periodic in all directions or in none");
  if (pack->def.periodic == all)
    def.period = packing_i_sub(pack->box.hi, pack->box.lo);
  return packing_write_yade(context, &def, &pack->view, stream);
}

const packing_i_write_format packing_i_write_yade_pack = {
    {sizeof(packing_write_format), "yade-pack", "",
     "centre, radius, a cell periodic in all directions",
     "YADE 2023.02a, pack.SpherePack().load()", 1},
    PACKING_I_NEEDS_BOX,
    write_yade_pack};

static packing_status write_xyz(packing_context *context, const packing_i_pack *pack,
                                const packing_stream *stream)
{
  packing_xyz_def def;
  packing_xyz_def_init(&def);
  def.box = pack->box;
  def.periodic = pack->def.periodic;
  def.time = pack->def.time;
  return packing_write_xyz(context, &def, &pack->view, stream);
}

const packing_i_write_format packing_i_write_xyz = {
    {sizeof(packing_write_format), "xyz", ".xyz .extxyz",
     "centre, radius, id, type, velocity, spin, orientation, cell, periodic directions, "
     "time",
     "ASE 3.22, OVITO (by its manual)", 1},
    PACKING_I_NEEDS_BOX,
    write_xyz};

static packing_status write_stl(packing_context *context, const packing_i_pack *pack,
                                int ascii, const packing_stream *stream)
{
  packing_stl_def def;
  packing_stl_def_init(&def);
  def.ascii = ascii;
  def.facets = pack->def.facets;
  def.title = pack->def.title;
  PACKING_I_TRY(packing_i_check_given(context, "domain", pack->def.domain));
  return packing_write_stl(context, &def, pack->def.domain, stream);
}

static packing_status write_stl_binary(packing_context *context,
                                       const packing_i_pack *pack,
                                       const packing_stream *stream)
{
  return write_stl(context, pack, 0, stream);
}

const packing_i_write_format packing_i_write_stl = {
    {sizeof(packing_write_format), "stl", ".stl",
     "the container alone, as triangles in single precision", "VTK 9.1, LIGGGHTS 3.8.0",
     1},
    PACKING_I_NEEDS_NOTHING,
    write_stl_binary};

static packing_status write_stl_text(packing_context *context, const packing_i_pack *pack,
                                     const packing_stream *stream)
{
  return write_stl(context, pack, 1, stream);
}

const packing_i_write_format packing_i_write_stl_ascii = {
    {sizeof(packing_write_format), "stl-ascii", "",
     "the container alone, as triangles in double precision", "VTK 9.1, LIGGGHTS 3.8.0",
     1},
    PACKING_I_NEEDS_NOTHING,
    write_stl_text};
