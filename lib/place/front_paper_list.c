/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "front_paper_list.h"
#include <string.h>

packing_status packing_i_front_list_reserve(packing_i_front_list *list,
                                            packing_context *context, size_t count)
{
  const size_t held = packing_i_front_list_count(list);
  if (count <= list->capacity - list->end)
    return PACKING_OK;
  if (count <= list->capacity - held && list->first >= held) {
    memcpy(list->member, list->member + list->first, held * sizeof *list->member);
  } else {
    const packing_allocator *allocator = packing_i_allocator(context);
    const size_t capacity = held + held / 2 + count + 256;
    uint32_t *member = packing_i_alloc(allocator, capacity, sizeof *member);
    if (member == NULL)
      return packing_i_nomem(context);
    if (held > 0)
      memcpy(member, list->member + list->first, held * sizeof *member);
    packing_i_free(allocator, list->member);
    list->member = member;
    list->capacity = capacity;
  }
  list->first = 0;
  list->end = held;
  return PACKING_OK;
}

void packing_i_front_list_add(packing_i_front_list *list, size_t particle)
{
  list->member[list->end++] = (uint32_t)particle;
}

size_t packing_i_front_list_select(const packing_i_front_list *list,
                                   packing_i_stream *stream)
{
  switch (list->select) {
  case PACKING_FRONT_FIFO:
    return list->first;
  case PACKING_FRONT_LIFO:
    return list->end - 1;
  case PACKING_FRONT_RANDOM:
    break;
  }
  return list->first + packing_i_stream_below(stream, packing_i_front_list_count(list));
}

void packing_i_front_list_drop(packing_i_front_list *list, size_t at)
{
  if (list->select == PACKING_FRONT_FIFO)
    list->first++;
  else
    list->member[at] = list->member[--list->end];
}

packing_status packing_i_front_list_rising(const packing_i_front_list *list,
                                           packing_context *context, size_t particles,
                                           size_t capacity, size_t *index, size_t *count)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  unsigned char *on = packing_i_calloc(allocator, particles, 1);
  if (on == NULL)
    return packing_i_nomem(context);
  for (size_t k = list->first; k < list->end; k++)
    on[list->member[k]] = 1;
  for (size_t i = 0, k = 0; i < particles && k < capacity; i++)
    if (on[i])
      index[k++] = i;
  *count = packing_i_front_list_count(list);
  packing_i_free(allocator, on);
  return PACKING_OK;
}
