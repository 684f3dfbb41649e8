/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines of text as words between blanks and tabs. */
#include "read_internal.h"
#include <string.h>

static inline int is_blank(char c)
{
  return c == ' ' || c == '\t';
}

packing_status packing_i_read_line(packing_i_read *read, packing_i_words *words)
{
  return packing_i_lines_next(&read->lines, &words->at, &words->end);
}

packing_status packing_i_read_needed(packing_i_read *read, const char *what,
                                     packing_i_words *words)
{
  PACKING_I_TRY(packing_i_read_line(read, words));
  if (words->at == NULL)
    return packing_i_read_fail(read, PACKING_ERR_FORMAT, "the file ends before %s", what);
  return PACKING_OK;
}

packing_i_words packing_i_words_cut(packing_i_words *words)
{
  const char *mark = memchr(words->at, '#', (size_t)(words->end - words->at));
  packing_i_words behind = {words->end, words->end};
  if (mark == NULL)
    return behind;
  behind.at = mark + 1;
  words->end = mark;
  return behind;
}

int packing_i_words_ended(packing_i_words *words)
{
  while (words->at < words->end && is_blank(*words->at))
    words->at++;
  return words->at == words->end;
}

packing_i_words packing_i_words_take(packing_i_words *words)
{
  packing_i_words word;
  (void)packing_i_words_ended(words);
  word.at = words->at;
  while (words->at < words->end && !is_blank(*words->at))
    words->at++;
  word.end = words->at;
  return word;
}

unsigned packing_i_words_count(packing_i_words words)
{
  unsigned count = 0;
  for (; !packing_i_words_ended(&words); count++)
    (void)packing_i_words_take(&words);
  return count;
}

int packing_i_word_is(packing_i_words word, const char *text)
{
  const size_t length = (size_t)(word.end - word.at);
  return strlen(text) == length && memcmp(text, word.at, length) == 0;
}

int packing_i_words_begin(packing_i_words *words, const char *these)
{
  packing_i_words rest = *words, wanted = {these, these + strlen(these)};
  while (!packing_i_words_ended(&wanted)) {
    const packing_i_words a = packing_i_words_take(&wanted),
                          b = packing_i_words_take(&rest);
    if (a.end - a.at != b.end - b.at || memcmp(a.at, b.at, (size_t)(a.end - a.at)) != 0)
      return 0;
  }
  *words = rest;
  return 1;
}

int packing_i_words_are(packing_i_words words, const char *these)
{
  return packing_i_words_begin(&words, these) && packing_i_words_ended(&words);
}

/* The word that a number should be; it must not be missing. */
static packing_status take_number(const packing_i_read *read, packing_i_words *words,
                                  const char *name, packing_i_words *word)
{
  *word = packing_i_words_take(words);
  if (word->at == word->end)
    return packing_i_read_fail(read, PACKING_ERR_FORMAT, "%s is missing", name);
  return PACKING_OK;
}

packing_status packing_i_words_double(const packing_i_read *read, packing_i_words *words,
                                      const char *name, double *v)
{
  packing_i_words word;
  PACKING_I_TRY(take_number(read, words, name, &word));
  const char *p = word.at;
  packing_i_number found = packing_i_parse_double(&p, v);
  if (found == PACKING_I_NUMBER_OK && p != word.end)
    found = PACKING_I_NUMBER_NONE;
  if (found == PACKING_I_NUMBER_OK)
    return PACKING_OK;
  return packing_i_number_fail(&read->lines, name, word.at, word.end, found,
                               "a finite number");
}

packing_status packing_i_words_doubles(const packing_i_read *read, packing_i_words *words,
                                       const char *name, unsigned count, double *v)
{
  for (unsigned k = 0; k < count; k++)
    PACKING_I_TRY(packing_i_words_double(read, words, name, &v[k]));
  return PACKING_OK;
}

packing_status packing_i_words_int(const packing_i_read *read, packing_i_words *words,
                                   const char *name, int64_t least, int64_t most,
                                   int64_t *v)
{
  packing_i_words word;
  PACKING_I_TRY(take_number(read, words, name, &word));
  const char *p = word.at;
  packing_i_number found = packing_i_parse_int(&p, v);
  if (found == PACKING_I_NUMBER_OK && p != word.end)
    found = PACKING_I_NUMBER_NONE;
  else if (found == PACKING_I_NUMBER_OK && (*v < least || *v > most))
    found = PACKING_I_NUMBER_LARGE;
  if (found == PACKING_I_NUMBER_OK)
    return PACKING_OK;
  return packing_i_number_fail(&read->lines, name, word.at, word.end, found,
                               "a whole number");
}

packing_status packing_i_words_int32(const packing_i_read *read, packing_i_words *words,
                                     const char *name, int32_t least, int32_t most,
                                     int32_t *v)
{
  int64_t wide;
  PACKING_I_TRY(packing_i_words_int(read, words, name, least, most, &wide));
  *v = (int32_t)wide;
  return PACKING_OK;
}

packing_status packing_i_words_done(const packing_i_read *read, packing_i_words *words)
{
  char quote[PACKING_I_QUOTE_SIZE];
  if (packing_i_words_ended(words))
    return PACKING_OK;
  return packing_i_read_fail(read, PACKING_ERR_FORMAT, "%s is too much",
                             packing_i_quote(words->at, words->end, quote));
}
