/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The little of XML that VTK's files are made of. Raw appended data make them no XML at all, so
 * that no parser of XML takes them whole; here the walk simply stops before. */
#include "read_vtk_internal.h"

static packing_status fail(packing_i_xml *x, const char *at, const char *what)
{
  x->read->byte = (uint64_t)(at - x->first);
  return packing_i_read_fail(x->read, PACKING_ERR_FORMAT, "%s", what);
}

static int is_space(char c)
{
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static int is_name(char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         c == '_' || c == '-' || c == ':' || c == '.';
}

static const char *skip_space(const char *p)
{
  while (is_space(*p))
    p++;
  return p;
}

/* Takes a name; empty where none stands. */
static packing_i_words take_name(const char **p)
{
  packing_i_words name = {*p, *p};
  while (is_name(*name.end))
    name.end++;
  *p = name.end;
  return name;
}

/* Behind the next `mark`, or NULL. */
static const char *behind(const packing_i_xml *x, const char *from, const char *mark)
{
  const size_t length = strlen(mark);
  for (const char *p = from; p != NULL && p < x->end; p++) {
    p = memchr(p, mark[0], (size_t)(x->end - p));
    if (p == NULL || (size_t)(x->end - p) < length)
      return NULL;
    if (memcmp(p, mark, length) == 0)
      return p + length;
  }
  return NULL;
}

/* Takes `name = "value"`; 0: malformed. */
static int take_attribute(const char **p, const char *end, packing_i_words *name,
                          packing_i_words *value)
{
  *name = take_name(p);
  *p = skip_space(*p);
  if (name->at == name->end || **p != '=')
    return 0;
  *p = skip_space(*p + 1);
  const char quote = **p;
  if (quote != '"' && quote != '\'')
    return 0;
  value->at = *p + 1;
  value->end = memchr(value->at, quote, (size_t)(end - value->at));
  if (value->end == NULL)
    return 0;
  *p = value->end + 1;
  return 1;
}

/* From behind the name to the >. */
static packing_status take_attributes(packing_i_xml *x, const char *p)
{
  packing_i_words name, value;
  x->attributes.at = p;
  for (;;) {
    const char *next = skip_space(p);
    x->attributes.end = next;
    x->empty = *next == '/' && next[1] == '>';
    if (x->empty || *next == '>') {
      x->at = next + 1 + x->empty;
      return PACKING_OK;
    }
    if (next == p || !take_attribute(&next, x->end, &name, &value))
      return fail(x, next, "a malformed tag");
    p = next;
  }
}

static packing_status open(packing_i_xml *x, const char *tag)
{
  const char *p = tag + 1;
  const packing_i_words name = take_name(&p);
  if (name.at == name.end)
    return fail(x, tag, "a malformed tag");
  if (x->depth == PACKING_I_XML_DEPTH)
    return fail(x, tag, "elements in too many elements");
  x->names[x->depth++] = name;
  return take_attributes(x, p);
}

static packing_status close(packing_i_xml *x, const char *tag)
{
  const char *p = tag + 2;
  const packing_i_words name = take_name(&p);
  p = skip_space(p);
  if (*p != '>' || x->depth == 0)
    return fail(x, tag, "a malformed tag");
  const packing_i_words *open_name = &x->names[x->depth - 1];
  if (name.end - name.at != open_name->end - open_name->at ||
      memcmp(name.at, open_name->at, (size_t)(name.end - name.at)) != 0)
    return fail(x, tag, "an end tag of another element");
  x->at = p + 1;
  return PACKING_OK;
}

/* The next tag that is not a comment or an instruction; NULL: none. */
static packing_status find_tag(packing_i_xml *x, const char **tag)
{
  for (;;) {
    const char *p = memchr(x->at, '<', (size_t)(x->end - x->at));
    *tag = p;
    if (p == NULL)
      return PACKING_OK;
    if (p[1] != '?' && p[1] != '!')
      return PACKING_OK;
    if (p[1] == '!' && (p[2] != '-' || p[3] != '-'))
      return fail(x, p, "neither element nor comment");
    x->at = p[1] == '?' ? behind(x, p, "?>") : behind(x, p + 4, "-->");
    if (x->at == NULL) {
      x->at = x->end;
      return fail(x, p, "a comment without an end");
    }
  }
}

packing_status packing_i_xml_next(packing_i_xml *x, packing_i_xml_event *event)
{
  const char *tag;
  if (x->empty) { /* the end of <LIKE/> */
    x->empty = 0;
    *event = PACKING_I_XML_END;
    return PACKING_OK;
  }
  if (*event == PACKING_I_XML_END && x->depth > 0)
    x->depth--;
  PACKING_I_TRY(find_tag(x, &tag));
  if (tag == NULL) {
    *event = PACKING_I_XML_LAST;
    return x->depth == 0 ? PACKING_OK : fail(x, x->end, "the file ends too early");
  }
  *event = tag[1] == '/' ? PACKING_I_XML_END : PACKING_I_XML_START;
  return *event == PACKING_I_XML_END ? close(x, tag) : open(x, tag);
}

int packing_i_xml_is(const packing_i_xml *x, unsigned up, const char *name)
{
  return up < x->depth && packing_i_word_is(x->names[x->depth - 1 - up], name);
}

packing_i_words packing_i_xml_attribute(const packing_i_xml *x, const char *wanted)
{
  packing_i_words name, value = {NULL, NULL};
  const char *p = skip_space(x->attributes.at);
  while (p < x->attributes.end) {
    if (!take_attribute(&p, x->end, &name, &value))
      break;
    if (packing_i_word_is(name, wanted))
      return value;
    p = skip_space(p);
  }
  value.at = value.end = NULL;
  return value;
}

packing_status packing_i_xml_count(const packing_i_xml *x, const char *name,
                                   uint64_t absent, uint64_t *v)
{
  const packing_i_words text = packing_i_xml_attribute(x, name);
  char quote[PACKING_I_QUOTE_SIZE];
  const char *p = text.at;
  int64_t n = -1;
  *v = absent;
  if (text.at == NULL)
    return PACKING_OK;
  if (packing_i_parse_int(&p, &n) == PACKING_I_NUMBER_OK && p == text.end && n >= 0) {
    *v = (uint64_t)n;
    return PACKING_OK;
  }
  x->read->byte = (uint64_t)(text.at - x->first);
  return packing_i_read_fail(x->read, PACKING_ERR_FORMAT, "%s: %s is no count", name,
                             packing_i_quote(text.at, text.end, quote));
}
