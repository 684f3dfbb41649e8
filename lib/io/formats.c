/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All formats: one line each. */
#include "io_internal.h"

const packing_i_format *const packing_i_formats[] = {
    &packing_i_format_csv,    &packing_i_format_vtp,     &packing_i_format_lammps,
    &packing_i_format_yade,   &packing_i_format_xyz,     &packing_i_format_curve,
    &packing_i_format_sample, &packing_i_format_polygon, NULL,
};
