/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Crystals by common neighbours: each bond of a particle is marked by three numbers, and the marks
 * of all its bonds tell the structure.
 *
 * J. D. Honeycutt, H. C. Andersen, J. Phys. Chem. 91 (1987) 4950; D. Faken, H. Jonsson, Comput.
 * Mater. Sci. 2 (1994) 279; tables as in A. Stukowski, Model. Simul. Mater. Sci. Eng. 20 (2012)
 * 045021. A set of neighbours is a word of bits: only particles with 12 or 14 of them can be a piece
 * of a crystal. Linear in the bonds. */
#include "measure/order_internal.h"

enum { MOST_BONDS = 14, MARKS = 5 };

/* Marks that matter, and how many of each a structure has. */
static const unsigned char marks[MARKS][3] = {
    {4, 2, 1}, {4, 2, 2}, {4, 4, 4}, {6, 6, 6}, {5, 5, 5}};
static const unsigned char table[PACKING_STRUCTURE_END][MARKS] = {{0, 0, 0, 0, 0},
                                                                  {12, 0, 0, 0, 0},
                                                                  {6, 6, 0, 0, 0},
                                                                  {0, 0, 6, 8, 0},
                                                                  {0, 0, 0, 0, 12}};

typedef struct crystals {
  const packing_neighbours *neighbours;
  packing_structure *structures;
  size_t capacity;
  packing_common_neighbours_report *parts; /* of each block */
} crystals;

const char *packing_structure_name(packing_structure structure)
{
  static const char *const names[PACKING_STRUCTURE_END] = {"other", "fcc", "hcp", "bcc",
                                                           "icosahedral"};
  const int k = (int)structure;
  return k >= 0 && k < PACKING_STRUCTURE_END ? names[k] : "unknown";
}

static int bits(unsigned set)
{
  int count = 0;
  for (; set != 0; set &= set - 1)
    count++;
  return count;
}

static int lowest(unsigned set)
{
  int bit = 0;
  for (; (set & 1u) == 0; set >>= 1)
    bit++;
  return bit;
}

/* Which neighbours of i are neighbours of its neighbour b too. Seen from i the neighbours of b are
 * moved by b's own periods; that keeps their order, so the two lists are merged. */
static unsigned shared_with(const packing_neighbours *n, size_t i,
                            const packing_i_bond *b)
{
  const packing_i_bond *own = n->bonds + n->start[i];
  const size_t bonds = n->start[i + 1] - n->start[i];
  unsigned set = 0;
  size_t k = 0;
  for (size_t p = n->start[b->j]; p < n->start[b->j + 1] && k < bonds; p++) {
    packing_i_bond seen = n->bonds[p];
    for (int axis = 0; axis < 3; axis++)
      seen.image[axis] = (int16_t)(seen.image[axis] + b->image[axis]);
    while (k < bonds && packing_i_bond_compare(&own[k], &seen) < 0)
      k++;
    if (k < bonds && packing_i_bond_compare(&own[k], &seen) == 0)
      set |= 1u << k;
  }
  return set;
}

/* The bonds of the connected piece of `set` that holds `member`; takes it out of *set. */
static int take_piece(const unsigned *linked, unsigned *set, int member)
{
  const unsigned all = *set;
  unsigned piece = 1u << member, fresh = piece;
  int ends = 0;
  while (fresh != 0) {
    const int k = lowest(fresh);
    const unsigned near = linked[k] & all;
    ends += bits(near);
    fresh = (fresh & (fresh - 1)) | (near & ~piece);
    piece |= near;
  }
  *set = all & ~piece;
  return ends / 2;
}

/* The mark of a bond whose ends share `common`: which of marks[], or MARKS. */
static int mark_of(const unsigned *linked, unsigned common)
{
  const int shared = bits(common);
  int all = 0, longest = 0;
  while (common != 0) {
    const int piece = take_piece(linked, &common, lowest(common));
    all += piece;
    longest = piece > longest ? piece : longest;
  }
  int m = 0;
  while (m < MARKS &&
         (marks[m][0] != shared || marks[m][1] != all || marks[m][2] != longest))
    m++;
  return m;
}

static packing_structure structure_of(const packing_neighbours *n, size_t i)
{
  const size_t bonds = n->start[i + 1] - n->start[i];
  unsigned linked[MOST_BONDS];
  unsigned char found[MARKS + 1] = {0};
  if (bonds != 12 && bonds != 14)
    return PACKING_STRUCTURE_OTHER;
  for (size_t k = 0; k < bonds; k++)
    linked[k] = shared_with(n, i, &n->bonds[n->start[i] + k]);
  for (size_t k = 0; k < bonds; k++)
    found[mark_of(linked, linked[k])]++;
  for (int s = PACKING_STRUCTURE_END - 1; s > PACKING_STRUCTURE_OTHER; s--)
    if (found[MARKS] == 0 && memcmp(found, table[s], MARKS) == 0)
      return (packing_structure)s;
  return PACKING_STRUCTURE_OTHER;
}

static void measure_block(void *arg, size_t block)
{
  const crystals *c = arg;
  const size_t end = packing_i_measure_block_end(block, c->neighbours->count);
  packing_common_neighbours_report *p = &c->parts[block];
  packing_common_neighbours_report_init(p);
  for (size_t i = block * PACKING_I_MEASURE_BLOCK; i < end; i++) {
    const packing_structure found = structure_of(c->neighbours, i);
    if (c->neighbours->index[i] < c->capacity)
      c->structures[c->neighbours->index[i]] = found;
    if (!c->neighbours->counts[i])
      continue;
    p->counted++;
    p->number[found]++;
  }
}

static packing_status check_arguments(packing_context *context,
                                      const packing_neighbours *neighbours,
                                      const packing_structure *structures,
                                      size_t capacity,
                                      const packing_common_neighbours_report *report)
{
  PACKING_I_TRY(packing_i_check_given(context, "neighbours", neighbours));
  if (neighbours->flat)
    return packing_i_fail(
        context, PACKING_ERR_INVALID, "neighbours", PACKING_NO_INDEX,
        "of a pack in two dimensions: the crystals are those of spheres");
  if (neighbours->kind != PACKING_NEIGHBOURS_WITHIN)
    return packing_i_fail(context, PACKING_ERR_INVALID, "neighbours", PACKING_NO_INDEX,
                          "the nearest: those within a distance are needed");
  if (capacity > 0)
    PACKING_I_TRY(packing_i_check_given(context, "structures", structures));
  return packing_i_report_check(context, report);
}

packing_status packing_measure_common_neighbours(packing_context *context,
                                                 const packing_neighbours *neighbours,
                                                 packing_structure *structures,
                                                 size_t capacity,
                                                 packing_common_neighbours_report *report)
{
  packing_common_neighbours_report found;
  PACKING_I_TRY(check_arguments(context, neighbours, structures, capacity, report));
  crystals c = {neighbours, structures, capacity, NULL};
  const size_t blocks = packing_i_measure_blocks(neighbours->count);
  const packing_allocator *allocator = packing_i_allocator(context);
  c.parts = packing_i_alloc(allocator, blocks, sizeof *c.parts);
  if (c.parts == NULL)
    return packing_i_nomem(context);
  packing_i_parallel(context, blocks, measure_block, &c);
  packing_common_neighbours_report_init(&found);
  for (size_t b = 0; b < blocks; b++) {
    found.counted += c.parts[b].counted;
    for (int s = 0; s < PACKING_STRUCTURE_END; s++)
      found.number[s] += c.parts[b].number[s];
  }
  packing_i_free(allocator, c.parts);
  return packing_i_report_write(context, report, &found, sizeof found);
}
