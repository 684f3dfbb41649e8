/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_PACKING_H
#define PACKING_PACKING_H

/** \file packing/packing.h
 *  All of libpacking. */

#include <packing/base.h>
#include <packing/contacts.h>
#include <packing/dem.h>
#include <packing/domain.h>
#include <packing/front.h>
#include <packing/grid.h>
#include <packing/io.h>
#include <packing/loosen.h>
#include <packing/measure.h>
#include <packing/mesh.h>
#include <packing/order.h>
#include <packing/particles.h>
#include <packing/placer.h>
#include <packing/pores.h>
#include <packing/porosity.h>
#include <packing/psd.h>
#include <packing/readers.h>
#include <packing/rng.h>
#include <packing/shape.h>
#include <packing/sizes.h>
#include <packing/solids.h>
#include <packing/tangency.h>
#include <packing/types.h>
#include <packing/writers.h>

#endif
