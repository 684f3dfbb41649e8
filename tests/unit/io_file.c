/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files: whole or not at all, and the system's reason. */
#define _XOPEN_SOURCE 700
#include "test.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* A directory of the test's own, in TMPDIR or /tmp. */
typedef struct place {
  char directory[256];
  char path[512];
  packing_context *context;
} place;

static int set_up(void **state)
{
  place *p = calloc(1, sizeof *p);
  const char *base = getenv("TMPDIR");
  assert_non_null(p);
  snprintf(p->directory, sizeof p->directory, "%s/packing-io-XXXXXX",
           base != NULL && strlen(base) < 200 ? base : "/tmp");
  assert_non_null(mkdtemp(p->directory));
  snprintf(p->path, sizeof p->path, "%s/pack.csv", p->directory);
  p->context = test_context(1, PACKING_ISA_AUTO);
  *state = p;
  return 0;
}

static int entries(const char *directory)
{
  DIR *d = opendir(directory);
  int count = 0;
  assert_non_null(d);
  for (const struct dirent *e; (e = readdir(d)) != NULL;)
    count += strcmp(e->d_name, ".") != 0 && strcmp(e->d_name, "..") != 0;
  closedir(d);
  return count;
}

static int tear_down(void **state)
{
  place *p = *state;
  char command[300];
  snprintf(command, sizeof command, "rm -rf %s", p->directory);
  assert_int_equal(system(command), 0);
  packing_context_destroy(p->context);
  free(p);
  return 0;
}

static packing_file *create(place *p)
{
  packing_file *file = NULL;
  assert_ok(packing_file_create(p->context, p->path, &file));
  return file;
}

static packing_status put(packing_file *file, const char *text)
{
  const packing_stream *s = packing_file_stream(file);
  return s->write(s->user, text, strlen(text));
}

static void write_file(const char *path, const char *text)
{
  FILE *f = fopen(path, "w");
  assert_non_null(f);
  assert_true(fputs(text, f) >= 0);
  assert_int_equal(fclose(f), 0);
}

static void assert_holds(place *p, const char *path, const char *want)
{
  packing_file *file = NULL;
  char got[256] = "";
  size_t used = 0, count;
  assert_ok(packing_file_open(p->context, path, &file));
  const packing_stream *s = packing_file_stream(file);
  assert_null(s->write);
  do {
    assert_ok(s->read(s->user, got + used, 3, &count));
    used += count;
    assert_true(used < sizeof got - 3);
  } while (count > 0);
  assert_string_equal(got, want);
  packing_file_close(file);
}

static void commit_makes_it_appear(void **state)
{
  place *p = *state;
  packing_file *file = create(p);
  assert_null(packing_file_stream(file)->read);
  assert_ok(put(file, "x,y,z,r\n"));
  assert_int_equal(access(p->path, F_OK), -1); /* not before */
  assert_ok(packing_file_commit(file));
  assert_holds(p, p->path, "x,y,z,r\n");
  assert_int_equal(entries(p->directory), 1);
}

static void close_throws_away(void **state)
{
  place *p = *state;
  write_file(p->path, "old");
  packing_file *file = create(p);
  assert_ok(put(file, "new"));
  assert_int_equal(entries(p->directory), 2);
  packing_file_close(file);
  assert_holds(p, p->path, "old");
  assert_int_equal(entries(p->directory), 1);
}

static void commit_replaces_what_was_there(void **state)
{
  place *p = *state;
  write_file(p->path, "old and longer");
  packing_file *file = create(p);
  assert_ok(put(file, "new"));
  assert_holds(p, p->path, "old and longer");
  assert_ok(packing_file_commit(file));
  assert_holds(p, p->path, "new");
}

static void two_files_at_once_do_not_meet(void **state)
{
  place *p = *state;
  packing_file *a = create(p), *b = create(p);
  assert_ok(put(a, "a"));
  assert_ok(put(b, "b"));
  assert_ok(packing_file_commit(b));
  assert_ok(packing_file_commit(a));
  assert_holds(p, p->path, "a");
  assert_int_equal(entries(p->directory), 1);
}

static void a_link_keeps_pointing_at_what_is_replaced(void **state)
{
  place *p = *state;
  char target[512];
  struct stat s;
  snprintf(target, sizeof target, "%s/target", p->directory);
  write_file(target, "old");
  assert_int_equal(symlink("target", p->path), 0);
  packing_file *file = create(p);
  assert_ok(put(file, "new"));
  assert_ok(packing_file_commit(file));
  assert_holds(p, target, "new");
  assert_int_equal(lstat(p->path, &s), 0);
  assert_true(S_ISLNK(s.st_mode));
}

static void the_umask_decides_the_permissions(void **state)
{
  place *p = *state;
  struct stat s;
  const mode_t before = umask(027);
  packing_file *file = create(p);
  assert_ok(packing_file_commit(file));
  umask(before);
  assert_int_equal(stat(p->path, &s), 0);
  assert_int_equal(s.st_mode & 0777, 0640);
  assert_int_equal(s.st_size, 0);
}

static void a_path_without_a_directory_works(void **state)
{
  place *p = *state;
  char here[512];
  packing_file *file = NULL;
  assert_non_null(getcwd(here, sizeof here));
  assert_int_equal(chdir(p->directory), 0);
  const packing_status created = packing_file_create(p->context, "bare", &file);
  const packing_status committed =
      created == PACKING_OK ? packing_file_commit(file) : created;
  assert_int_equal(chdir(here), 0);
  assert_ok(committed);
  assert_int_equal(entries(p->directory), 1);
}

/* More than the buffer, in pieces of every kind. */
static void large_writes_arrive_in_order(void **state)
{
  place *p = *state;
  enum { SIZE = 300000 };
  unsigned char *data = malloc(SIZE), *back = malloc(SIZE + 1);
  packing_file *file = create(p);
  const packing_stream *s = packing_file_stream(file);
  size_t at = 0, step = 1, count, used = 0;
  assert_true(data != NULL && back != NULL);
  for (size_t i = 0; i < SIZE; i++)
    data[i] = (unsigned char)(i * 2654435761U >> 13);
  while (at < SIZE) {
    const size_t n = SIZE - at < step ? SIZE - at : step;
    assert_ok(s->write(s->user, data + at, n));
    at += n;
    step = step * 3 % 100003;
  }
  assert_ok(packing_file_commit(file));
  assert_ok(packing_file_open(p->context, p->path, &file));
  s = packing_file_stream(file);
  do {
    assert_ok(s->read(s->user, back + used, SIZE + 1 - used, &count));
    used += count;
  } while (count > 0);
  packing_file_close(file);
  assert_int_equal(used, SIZE);
  assert_memory_equal(back, data, SIZE);
  free(data);
  free(back);
}

static void what_cannot_be_opened_says_why(void **state)
{
  place *p = *state;
  packing_file *file = NULL;
  char missing[600];
  snprintf(missing, sizeof missing, "%s/no/such/pack.csv", p->directory);
  assert_fails(p->context, packing_file_open(p->context, missing, &file), PACKING_ERR_IO,
               "such/pack.csv: No such file or directory");
  assert_fails(p->context, packing_file_create(p->context, missing, &file),
               PACKING_ERR_IO, "No such file or directory");
  assert_fails(p->context, packing_file_open(p->context, p->directory, &file),
               PACKING_ERR_IO, "Is a directory");
  assert_fails(p->context, packing_file_create(p->context, p->directory, &file),
               PACKING_ERR_IO, "Is a directory");
  assert_fails(p->context, packing_file_create(p->context, "", &file), PACKING_ERR_IO,
               "No such file or directory");
  strcpy(missing, p->directory);
  strcat(missing, "/new/");
  assert_fails(p->context, packing_file_create(p->context, missing, &file),
               PACKING_ERR_IO, "No such file or directory");
  assert_fails(p->context, packing_file_open(p->context, NULL, &file),
               PACKING_ERR_INVALID, "path");
  assert_fails(p->context, packing_file_create(p->context, p->path, NULL),
               PACKING_ERR_INVALID, "file");
  assert_status(packing_file_open(NULL, missing, &file), PACKING_ERR_IO);
  assert_null(file);
  assert_int_equal(entries(p->directory), 0);
}

static void a_strange_path_keeps_the_message_in_one_line(void **state)
{
  place *p = *state;
  packing_file *file = NULL;
  char path[900];
  memset(path, 'a', sizeof path);
  path[0] = '/';
  for (size_t i = 100; i < sizeof path; i += 100)
    path[i] = '/';
  strcpy(path + sizeof path - 20, "x\ny\x1b[31mend");
  assert_fails(p->context, packing_file_open(p->context, path, &file), PACKING_ERR_IO,
               "x?y?[31mend: No such file or directory");
}

/* root may write anywhere: the child that tries is nobody. */
static void an_unwritable_directory_says_why(void **state)
{
  place *p = *state;
  assert_int_equal(chmod(p->directory, 0555), 0);
  const pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    packing_file *file = NULL;
    if (geteuid() == 0 && setuid(65534) != 0)
      _exit(2);
    const packing_status status = packing_file_create(p->context, p->path, &file);
    _exit(status == PACKING_ERR_IO && file == NULL &&
                  strstr(packing_context_message(p->context), "Permission denied")
              ? 0
              : 1);
  }
  int result;
  assert_int_equal(waitpid(child, &result, 0), child);
  assert_int_equal(chmod(p->directory, 0755), 0);
  assert_int_equal(result, 0);
  assert_int_equal(entries(p->directory), 0);
}

static void a_full_device_fails_and_stays_failed(void **state)
{
  place *p = *state;
  packing_file *file = NULL;
  if (access("/dev/full", W_OK) != 0)
    skip();
  assert_ok(packing_file_create(p->context, "/dev/full", &file));
  assert_ok(put(file, "buffered"));
  assert_fails(p->context, packing_file_commit(file), PACKING_ERR_IO,
               "/dev/full: No space left on device");
  assert_ok(packing_file_create(p->context, "/dev/full", &file));
  const packing_stream *s = packing_file_stream(file);
  char *large = calloc(1, 100000);
  assert_non_null(large);
  assert_status(s->write(s->user, large, 100000), PACKING_ERR_IO);
  assert_status(put(file, "more"), PACKING_ERR_IO); /* remembered */
  assert_status(packing_file_commit(file), PACKING_ERR_IO);
  free(large);
}

static void a_device_is_written_in_place(void **state)
{
  place *p = *state;
  packing_file *file = NULL;
  struct stat s;
  assert_ok(packing_file_create(p->context, "/dev/null", &file));
  assert_ok(put(file, "gone"));
  assert_ok(packing_file_commit(file));
  assert_int_equal(stat("/dev/null", &s), 0);
  assert_true(S_ISCHR(s.st_mode));
}

static void a_pipe_is_written_in_place(void **state)
{
  place *p = *state;
  packing_file *file = NULL;
  char got[16] = "";
  struct stat s;
  assert_int_equal(mkfifo(p->path, 0600), 0);
  const int reader = open(p->path, O_RDONLY | O_NONBLOCK);
  assert_true(reader >= 0);
  assert_ok(packing_file_create(p->context, p->path, &file));
  assert_ok(put(file, "through"));
  assert_ok(packing_file_commit(file));
  assert_int_equal(read(reader, got, sizeof got - 1), 7);
  assert_string_equal(got, "through");
  close(reader);
  assert_int_equal(stat(p->path, &s), 0);
  assert_true(S_ISFIFO(s.st_mode));
}

/* Standard output sent to a regular file by a shell: what we write comes behind what stands
 * there, in the same file. */
static void standard_output_is_written_in_place(void **state)
{
  place *p = *state;
  const char *const names[] = {"/dev/stdout", "/proc/self/fd/1"};
  write_file(p->path, "first\n");
  const pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    packing_file *file = NULL;
    const int fd = open(p->path, O_WRONLY | O_APPEND);
    if (fd < 0 || dup2(fd, STDOUT_FILENO) < 0)
      _exit(1);
    for (int i = 0; i < 2; i++)
      if (packing_file_create(p->context, names[i], &file) != PACKING_OK ||
          put(file, "more\n") != PACKING_OK || packing_file_commit(file) != PACKING_OK)
        _exit(1);
    _exit(0);
  }
  int result;
  assert_int_equal(waitpid(child, &result, 0), child);
  assert_int_equal(result, 0);
  assert_holds(p, p->path, "first\nmore\nmore\n");
}

/* A limit on the size of files stands for a full disk. */
static void a_full_disk_keeps_the_old_file(void **state)
{
  place *p = *state;
  write_file(p->path, "old");
  const pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    const struct rlimit limit = {100000, 100000};
    packing_file *file = NULL;
    packing_status status = PACKING_OK;
    char line[1000];
    memset(line, 'x', sizeof line);
    signal(SIGXFSZ, SIG_IGN);
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0 ||
        packing_file_create(p->context, p->path, &file) != PACKING_OK)
      _exit(2);
    const packing_stream *s = packing_file_stream(file);
    for (int i = 0; i < 300; i++)
      if (status == PACKING_OK)
        status = s->write(s->user, line, sizeof line);
    _exit(status == PACKING_ERR_IO && packing_file_commit(file) == PACKING_ERR_IO &&
                  strstr(packing_context_message(p->context), "File too large")
              ? 0
              : 1);
  }
  int result;
  assert_int_equal(waitpid(child, &result, 0), child);
  assert_int_equal(result, 0);
  assert_holds(p, p->path, "old");
  assert_int_equal(entries(p->directory), 1);
}

/* The target becomes a directory while we write: rename fails. */
static void a_failed_rename_leaves_nothing(void **state)
{
  place *p = *state;
  packing_file *file = create(p);
  assert_ok(put(file, "text"));
  assert_int_equal(mkdir(p->path, 0700), 0);
  assert_fails(p->context, packing_file_commit(file), PACKING_ERR_IO, "directory");
  assert_int_equal(entries(p->directory), 1);
}

/* Address 0 of this process: it opens, and cannot be read. */
static void a_read_that_fails_says_why(void **state)
{
  place *p = *state;
  packing_file *file = NULL;
  packing_particles *particles = test_store(3);
  if (access("/proc/self/mem", R_OK) != 0)
    skip();
  assert_ok(packing_file_open(p->context, "/proc/self/mem", &file));
  assert_fails(p->context,
               packing_read_csv(p->context, packing_file_stream(file), particles),
               PACKING_ERR_IO, "/proc/self/mem: Input/output error");
  packing_file_close(file);
  packing_particles_destroy(particles);
}

static void commit_is_for_what_was_created(void **state)
{
  place *p = *state;
  packing_file *file = NULL;
  write_file(p->path, "old");
  assert_ok(packing_file_open(p->context, p->path, &file));
  assert_fails(p->context, packing_file_commit(file), PACKING_ERR_INVALID, "reading");
  assert_status(packing_file_commit(NULL), PACKING_ERR_INVALID);
  assert_holds(p, p->path, "old");
}

/* The file holds the context: the order of destruction does not matter. */
static void a_file_outlives_its_context(void **state)
{
  place *p = *state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_file *file = NULL;
  assert_ok(packing_file_create(context, p->path, &file));
  packing_context_destroy(context);
  assert_ok(put(file, "text"));
  assert_ok(packing_file_commit(file));
  assert_holds(p, p->path, "text");
}

/* A writer's failure on a file keeps the file's message: it says more. */
static void a_writer_keeps_the_reason_of_the_file(void **state)
{
  place *p = *state;
  packing_file *file = NULL;
  packing_view view;
  const double one = 1;
  if (access("/dev/full", W_OK) != 0)
    skip();
  enum { COUNT = 10000 };
  double *x = calloc(COUNT, sizeof *x);
  assert_non_null(x);
  packing_view_init_arrays(&view, COUNT, x, x, x, x);
  view.r.data = &one;
  view.r.stride = 0; /* one radius for all */
  assert_ok(packing_file_create(p->context, "/dev/full", &file));
  assert_fails(p->context,
               packing_write_csv(p->context, NULL, &view, packing_file_stream(file)),
               PACKING_ERR_IO, "/dev/full: No space left on device");
  packing_file_close(file);
  free(x);
}

int main(void)
{
#define FILE_TEST(f) cmocka_unit_test_setup_teardown(f, set_up, tear_down)
  const struct CMUnitTest tests[] = {
      FILE_TEST(commit_makes_it_appear),
      FILE_TEST(close_throws_away),
      FILE_TEST(commit_replaces_what_was_there),
      FILE_TEST(two_files_at_once_do_not_meet),
      FILE_TEST(a_link_keeps_pointing_at_what_is_replaced),
      FILE_TEST(the_umask_decides_the_permissions),
      FILE_TEST(a_path_without_a_directory_works),
      FILE_TEST(large_writes_arrive_in_order),
      FILE_TEST(what_cannot_be_opened_says_why),
      FILE_TEST(a_strange_path_keeps_the_message_in_one_line),
      FILE_TEST(an_unwritable_directory_says_why),
      FILE_TEST(a_full_device_fails_and_stays_failed),
      FILE_TEST(a_device_is_written_in_place),
      FILE_TEST(a_pipe_is_written_in_place),
      FILE_TEST(standard_output_is_written_in_place),
      FILE_TEST(a_full_disk_keeps_the_old_file),
      FILE_TEST(a_failed_rename_leaves_nothing),
      FILE_TEST(a_read_that_fails_says_why),
      FILE_TEST(commit_is_for_what_was_created),
      FILE_TEST(a_file_outlives_its_context),
      FILE_TEST(a_writer_keeps_the_reason_of_the_file),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
