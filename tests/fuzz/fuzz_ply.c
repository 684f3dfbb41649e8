/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fuzz_mesh.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  return fuzz_read_mesh(PACKING_MESH_FORMAT_PLY, data, size);
}
