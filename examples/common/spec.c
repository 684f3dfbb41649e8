/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "spec.h"
#include <stdlib.h>
#include <string.h>
#include "program.h"

const char spec_help[] =
    "Containers (--domain):\n"
    "  box:LX,LY,LZ  rect:LX,LY        corner at the origin\n"
    "  cylinder:R,H  tube:RI,RO,H  cone:R0,R1,H  silo:R,H,ROUT,HCONE\n"
    "                                  axis z from z = 0, centred on x = y = 0; "
    "',axis=x' or ',axis=y' as a last field turns it\n"
    "  sphere:R  circle:R  annulus:RI,RO\n"
    "                                  centred at the origin\n"
    "Appended to a container, from left to right: '+periodic' or '+periodic:xy' (box, "
    "rect), '+open:top' (no wall at the top), '+at:X,Y,Z' moves it, '+scale:S' "
    "multiplies "
    "what stands before it. rect, circle and annulus make two-dimensional packs.\n"
    "\n"
    "Sizes (--psd), in radii:\n"
    "  mono:R  uniform:MIN,MAX  normal:MEAN,SD,MIN,MAX\n"
    "  lognormal:MEDIAN,SIGMA,MIN,MAX  weibull:SCALE,SHAPE,MIN,MAX\n"
    "  gamma:SCALE,SHAPE,MIN,MAX  exponential:MEAN,MIN,MAX\n"
    "  discrete:R1=W1,R2=W2,...        shares W of radii R\n"
    "  curve:FILE                      a sieve curve: a header "
    "'diameter,percent_passing' "
    "(or 'diameter,passing', 0 to 1), rising rows from 0 to 100, '#' comments; in "
    "DIAMETERS\n"
    "  sample:FILE                     a list of measured radii, one a line\n"
    "',by=mass' or ',by=number' as a last field says what the shares count (curve and "
    "discrete: mass, the others: number). A mixture is '0.84*SIZES+0.16*SIZES', its "
    "shares "
    "by mass.\n"
    "\n"
    "All lengths are in one unit of your choice.\n";

char **spec_split(char *text, char separator, size_t *count)
{
  char **words = NULL;
  size_t n = 0;
  for (char *at = text; at;) {
    char *end = strchr(at, separator);
    if (end)
      *end++ = '\0';
    words = program_take_more(words, n + 1, sizeof *words);
    words[n++] = at;
    at = end;
  }
  *count = n;
  return words;
}

void input_files_free(input_files *files)
{
  for (size_t i = 0; i < files->count; i++)
    free(files->items[i].path);
  free(files->items);
  files->items = NULL;
  files->count = 0;
}
