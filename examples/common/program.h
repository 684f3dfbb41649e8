/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_PROGRAM_H
#define EXAMPLES_PROGRAM_H

/* What every program starts with: exit codes, one-line errors, the context, numbers in text. */

#include <packing/packing.h>

/* Exit codes, the same for all programs. */
enum {
  PROGRAM_DONE = 0,
  PROGRAM_SHORT = 1,     /* the asked was not reached, or the audit failed */
  PROGRAM_BAD_INPUT = 2, /* nothing was written */
  PROGRAM_SYSTEM = 3,    /* input, output or memory */
  PROGRAM_INTERRUPTED = 130
};

/* Prints "NAME: message" as one line on standard error and returns `code`. */
__attribute__((format(printf, 2, 3))) int program_fail(int code, const char *format, ...);

/* The same without being a failure; nothing after program_quiet(). */
__attribute__((format(printf, 1, 2))) void program_remark(const char *format, ...);
void program_quiet(void);

/* Says that nothing was written and returns PROGRAM_INTERRUPTED. */
int program_interrupted(void);

/* Tells a failed call of the library, `what` being the option or file it was for; returns
 * the exit code that its status stands for. */
int program_status(const packing_context *context, packing_status status,
                   const char *what);

/* The option that stands for a field of the library. */
typedef struct program_field {
  const char *field, *option;
} program_field;

/* The same of a call whose fields are those of options: the line begins with the option. `rows`
 * (the last with a NULL field; NULL: none) are the fields whose options have another name than
 * theirs with hyphens; `what` is for failures that name no field. */
int program_field_status(const packing_context *context, packing_status status,
                         const char *what, const program_field *rows);

/* Memory or the end of the program: for the small things that are read from the command
 * line, before any work starts. */
void *program_take(size_t count, size_t size);
void *program_take_more(void *block, size_t count, size_t size);
char *program_copy(const char *text, size_t length);

/* Numbers in text, the same in every locale: no blanks, no hexadecimal, no infinity. They
 * return 0, or an exit code after a line that starts with `where`. */
int number_real(const char *where, const char *text, double *value);
int number_positive(const char *where, const char *text, double *value);
int number_not_negative(const char *where, const char *text, double *value);
int number_share(const char *where, const char *text,
                 double *value); /* above 0, below 1 */
int number_whole(const char *where, const char *text, uint64_t least, uint64_t most,
                 uint64_t *value);

/* The shortest text that reads back as the number: 15 to 17 digits. */
enum { NUMBER_TEXT = 32 };
void number_text(char text[NUMBER_TEXT], double value);

/* Seconds on a clock that never jumps. */
double program_seconds(void);

/* Sets up SIGINT, SIGTERM, SIGHUP and SIGPIPE; from then on interrupted() tells. */
void interrupt_catch(void);
/* Standard files that the caller has closed become /dev/null, unwritable: else the next file
 * to be opened takes their number, and a report ends up in a pack. */
void standard_files_fill(void);
int interrupted(void);
/* Takes an interruption as the end of the work and not of the program: the next one counts anew. */
void interrupt_take(void);

/* The command line as one could type it again. Free it. */
char *program_command_line(int argc, char **argv);

#endif
