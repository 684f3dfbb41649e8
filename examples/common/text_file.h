/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_TEXT_FILE_H
#define EXAMPLES_TEXT_FILE_H

/* A whole file as text. */

#include "spec.h"

/* Reads it, a zero byte behind, and notes it with its hash; free the text in any case. Returns
 * 0, or an exit code after one line on standard error that begins with `option`. */
int text_file_read(packing_context *context, input_files *files, const char *option,
                   const char *path, char **text, size_t *length);

#endif
