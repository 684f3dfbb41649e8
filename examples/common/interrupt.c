/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Being told to stop: the handler sets a flag, the loops look at it, so that temporary files
 * are cleared away; told a second time, the program ends where it is. A closed pipe becomes a
 * failed write. */
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>
#include "program.h"

static volatile sig_atomic_t stop;

static void note(int number)
{
  (void)number;
  stop = 1;
}

void interrupt_catch(void)
{
  static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
  struct sigaction action;
  memset(&action, 0, sizeof action);
  sigemptyset(&action.sa_mask);
  action.sa_handler = note;
  action.sa_flags = (int)(SA_RESTART | SA_RESETHAND);
  for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
    sigaction(numbers[i], &action, NULL);
  action.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &action, NULL);
}

void standard_files_fill(void)
{
  int fd;
  do
    fd = open("/dev/null", O_RDONLY);
  while (fd >= 0 && fd <= STDERR_FILENO);
  if (fd >= 0)
    close(fd);
}

void interrupt_take(void)
{
  stop = 0;
  interrupt_catch();
}

int interrupted(void)
{
  return stop;
}
