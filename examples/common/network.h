/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_NETWORK_H
#define EXAMPLES_NETWORK_H

/* A pore network as files. */

#include <packing/packing.h>

/* VTK PolyData for ParaView and VTK's readers: pores as points (radius, coordination, cells,
 * limit, pore), constrictions as lines (width, which is
 * their radius, way_limit, constriction). A line that leaves a
 * periodic cell ends at a point of its own, where the image of the pore stands (image 1).
 * Returns what the stream does. */
packing_status network_write_vtp(const packing_pores *pores, const packing_domain *domain,
                                 const packing_stream *stream);

/* Tables with one header line, numbers with 17 digits:
 * pore,x,y,z,radius,coordination,cells,limit and
 * constriction,a,b,image_x,image_y,image_z,x,y,z,radius,limit. Limits by name: free, particle,
 * wall, open. */
packing_status network_write_pores(const packing_pores *pores,
                                   const packing_stream *stream);
packing_status network_write_constrictions(const packing_pores *pores,
                                           const packing_stream *stream);

/* The four files of the Statoil format (P.-E. Oren, S. Bakke, O. J. Arntzen, SPE J. 3, 1998,
 * 324) that pnflow, OpenPNM and PoreFlow read, PREFIX_node1.dat and so on: flow goes along x;
 * pores that reach within `reach` of an end of the container's box are inlet or outlet. Pores and
 * throats are balls and round tubes; ways through periodic directions are left out. */
enum { NETWORK_NODE1, NETWORK_NODE2, NETWORK_LINK1, NETWORK_LINK2, NETWORK_PARTS };
packing_status network_write_statoil(const packing_pores *pores,
                                     const packing_bounds *box, double reach, int part,
                                     const packing_stream *stream);

#endif
