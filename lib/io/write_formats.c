/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All formats that packs are written in, one line each, and how a program finds one. */
#include "writers_internal.h"

const packing_i_write_format *const packing_i_write_formats[] = {
    &packing_i_write_csv,         &packing_i_write_vtp,
    &packing_i_write_vtu,         &packing_i_write_lammps,
    &packing_i_write_lammps_deck, &packing_i_write_dump,
    &packing_i_write_liggghts,    &packing_i_write_liggghts_deck,
    &packing_i_write_yade,        &packing_i_write_yade_pack,
    &packing_i_write_geo,         &packing_i_write_xyz,
    &packing_i_write_pov,         &packing_i_write_stl,
    &packing_i_write_stl_ascii,   &packing_i_write_pfc,
    &packing_i_write_neper_coo,   &packing_i_write_neper_weight,
    &packing_i_write_mercury,     NULL,
};

const packing_write_format *packing_write_format_at(size_t index)
{
  for (size_t i = 0; packing_i_write_formats[i] != NULL; i++)
    if (i == index)
      return &packing_i_write_formats[i]->about;
  return NULL;
}

const packing_write_format *packing_write_format_find(const char *name)
{
  for (size_t i = 0; name != NULL && packing_i_write_formats[i] != NULL; i++)
    if (strcmp(packing_i_write_formats[i]->about.name, name) == 0)
      return &packing_i_write_formats[i]->about;
  return NULL;
}

/* Whether `list` ("" or ".a .b") has the extension, of `length` bytes. */
static int lists(const char *list, const char *extension, size_t length)
{
  while (*list != '\0') {
    const size_t word = strcspn(list, " ");
    if (word == length && memcmp(list, extension, length) == 0)
      return 1;
    list += word + strspn(list + word, " ");
  }
  return 0;
}

/* A name that is nothing but its extension has none. */
const packing_write_format *packing_write_format_of(const char *path)
{
  const char *dot = path == NULL ? NULL : strrchr(path, '.');
  if (dot == NULL || dot == path || dot[-1] == '/' || strchr(dot, '/') != NULL)
    return NULL;
  for (size_t i = 0; packing_i_write_formats[i] != NULL; i++)
    if (lists(packing_i_write_formats[i]->about.extensions, dot, strlen(dot)))
      return &packing_i_write_formats[i]->about;
  return NULL;
}
