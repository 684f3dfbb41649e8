/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "spec.h"
#include <stdlib.h>
#include <string.h>
#include "program.h"

const char spec_help[] =
    "Containers (--domain):\n"
    "  box:LX,LY,LZ  rect:LX,LY       corner at the origin\n"
    "  cylinder:R,H  tube:RI,RO,H  cone:R0,R1,H  silo:R,H,ROUT,HCONE\n"
    "                                 axis z from z = 0, centred on x = y = 0;\n"
    "                                 ',axis=x' or ',axis=y' as a last field turns it\n"
    "  sphere:R  circle:R  annulus:RI,RO\n"
    "                                 centred at the origin\n"
    "Appended, and applied from left to right:\n"
    "  +periodic  +periodic:xy        box and rect: in all or some directions\n"
    "  +open:top                      no wall at the top\n"
    "  +at:X,Y,Z                      moved\n"
    "  +scale:S                       what stands before it times S\n"
    "rect, circle and annulus make two-dimensional packs.\n"
    "\n"
    "Sizes (--psd), in radii:\n"
    "  mono:R  uniform:MIN,MAX  normal:MEAN,SD,MIN,MAX\n"
    "  lognormal:MEDIAN,SIGMA,MIN,MAX  weibull:SCALE,SHAPE,MIN,MAX\n"
    "  gamma:SCALE,SHAPE,MIN,MAX  exponential:MEAN,MIN,MAX\n"
    "  discrete:R1=W1,R2=W2,...       shares W of radii R\n"
    "  sample:FILE                    measured radii, one a line\n"
    "  curve:FILE                     a sieve curve, in DIAMETERS: a header line\n"
    "                                 'diameter,percent_passing' (0 to 100) or\n"
    "                                 'diameter,passing' (0 to 1), rising rows from\n"
    "                                 0 to 100 or 1; '#' starts a comment\n"
    "',by=mass' or ',by=number' as a last field says what shares count (curve and\n"
    "discrete: mass; the others: number). '0.84*SIZES+0.16*SIZES' is a mixture, its\n"
    "shares by mass. All lengths are in one unit of your choice.\n"
    "\n"
    "Exit status:\n"
    "  0    done\n"
    "  1    less was placed than asked, or the audit failed; files are written\n"
    "  2    bad input: one line says what, nothing is written\n"
    "  3    a file cannot be read or written, or memory is out\n"
    "  130  interrupted, nothing is written\n";

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
