/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "spec.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "program.h"

const char spec_domain_help[] =
    "Containers (--domain), in any unit of length:\n"
    "  box:LX,LY,LZ            its lower corner at the origin\n"
    "  rect:LX,LY              the same in two dimensions\n"
    "  cylinder:R,H            axis z, the centre of its base at the origin\n"
    "  tube:RI,RO,H            between two cylinders\n"
    "  cone:R0,R1,H            of radius R0 at its base and R1 at its top\n"
    "  silo:R,H,ROUT,HCONE     a cylinder on a cone with an outlet of radius ROUT\n"
    "  sphere:R                centred at the origin\n"
    "  circle:R                the same in two dimensions\n"
    "  annulus:RI,RO           between two circles\n"
    "  polygon:FILE            in two dimensions, with holes: a header line 'x,y', then\n"
    "                          a vertex a line; a blank line, or another number in a\n"
    "                          column 'ring', begins the next ring\n"
    "  mesh:FILE               a closed surface of triangles: STL, OBJ, PLY\n"
    "  ...,axis=x              or y: the axis of a cylinder, tube, cone, silo\n"
    "  ...+periodic            box, rect; +periodic:xy in these directions only\n"
    "  ...+open:top            without a wall at the top\n"
    "  ...+at:X,Y,Z            moved\n"
    "  ...+scale:S             times S; what is appended applies left to right\n"
    "  --or SPEC               --domain joined with another container, --and: what both\n"
    "                          have in common, --minus: without the other; left to\n"
    "                          right, none of them periodic or open\n";

const char spec_psd_help[] =
    "Sizes (--psd), in radii:\n"
    "  mono:R                  equal particles\n"
    "  uniform:MIN,MAX         all radii alike\n"
    "  normal:MEAN,SD,MIN,MAX  cut to MIN, MAX, as the next four are\n"
    "  lognormal:MEDIAN,SIGMA,MIN,MAX\n"
    "                          SIGMA: standard deviation of the logarithm\n"
    "  weibull:SCALE,SHAPE,MIN,MAX\n"
    "                          SCALE: the radius that 63.2 % are below\n"
    "  gamma:SCALE,SHAPE,MIN,MAX\n"
    "                          of mean SCALE * SHAPE\n"
    "  exponential:MEAN,MIN,MAX\n"
    "                          MEAN, SD, MEDIAN: all before the cut\n"
    "  discrete:R1=W1,R2=W2    shares W of radii R, in rising order of R\n"
    "  sample:FILE             measured radii, one a line\n"
    "  curve:FILE              a sieve curve, in DIAMETERS: a header line\n"
    "                          'diameter,percent_passing' (0 to 100) or\n"
    "                          'diameter,passing' (0 to 1), then rising rows from\n"
    "                          0 to 100 or 1; '#' starts a comment\n"
    "  ...,by=mass             or by=number: what the shares count (default: mass\n"
    "                          for curve and discrete, number for the others)\n"
    "  0.84*SIZES+0.16*SIZES   a mixture, its shares by mass\n";

const char spec_maker_status_help[] =
    "Exit status:\n"
    "  0                       done\n"
    "  1                       less was placed than asked, or the audit failed;\n"
    "                          files are written\n"
    "  2                       bad input: one line says what, nothing is written\n"
    "  3                       a file cannot be read or written, or no memory\n"
    "  130                     interrupted, nothing is written\n";

const char spec_grower_status_help[] =
    "Exit status:\n"
    "  0                       done\n"
    "  1                       less was placed than asked, or the audit failed;\n"
    "                          files are written\n"
    "  2                       bad input: one line says what, nothing is written\n"
    "  3                       a file cannot be read or written, or no memory\n"
    "  130                     interrupted: while particles are placed, files hold the\n"
    "                          pack as it stood, audited; later nothing is written\n";

const char spec_taker_status_help[] =
    "Exit status:\n"
    "  0                       done, whatever the audit says\n"
    "  2                       bad input: one line says what, nothing is written\n"
    "  3                       a file cannot be read or written, or no memory\n"
    "  130                     interrupted, nothing is written\n";

void spec_list(char *list, size_t size, const char *name)
{
  const size_t used = strlen(list);
  snprintf(list + used, size - used, "%s%s", used ? ", " : "", name);
}

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
