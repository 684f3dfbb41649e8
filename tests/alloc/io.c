/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Readers, writers and files with every allocation failing in turn. */
#define _XOPEN_SOURCE 700
#include "test.h"
#include <unistd.h>

static const double x[] = {0.25, 0.5}, r[] = {0.125, 0.0625};
static const int64_t id[] = {2, 1};

static packing_view small_pack(void)
{
  packing_view view;
  packing_view_init_arrays(&view, 2, x, x, x, r);
  view.id.data = id; /* falling: LAMMPS sorts them */
  view.id.stride = sizeof id[0];
  return view;
}

typedef packing_status (*write_function)(packing_context *context,
                                         const packing_view *view,
                                         const packing_stream *stream);

static packing_status csv(packing_context *context, const packing_view *view,
                          const packing_stream *stream)
{
  return packing_write_csv(context, NULL, view, stream);
}

static packing_status vtp(packing_context *context, const packing_view *view,
                          const packing_stream *stream)
{
  return packing_write_vtp(context, NULL, view, stream);
}

/* zlib, where it is there. */
static packing_status vtp_zlib(packing_context *context, const packing_view *view,
                               const packing_stream *stream)
{
  packing_vtp_def def;
  packing_vtp_def_init(&def);
  def.compression = 1;
  const packing_status status = packing_write_vtp(context, &def, view, stream);
  return status == PACKING_ERR_UNSUPPORTED ? PACKING_OK : status;
}

static packing_status lammps(packing_context *context, const packing_view *view,
                             const packing_stream *stream)
{
  return packing_write_lammps(context, NULL, view, stream);
}

static packing_status yade(packing_context *context, const packing_view *view,
                           const packing_stream *stream)
{
  return packing_write_yade(context, NULL, view, stream);
}

static packing_status xyz(packing_context *context, const packing_view *view,
                          const packing_stream *stream)
{
  return packing_write_xyz(context, NULL, view, stream);
}

static write_function writing;

static packing_status write_scenario(packing_context *context, uint64_t *hash)
{
  test_buffer buffer = {0};
  const packing_stream stream = test_buffer_stream(&buffer);
  const packing_view view = small_pack();
  const packing_status status = writing(context, &view, &stream);
  *hash = test_hash(TEST_HASH_START, buffer.data, buffer.size);
  test_buffer_free(&buffer);
  return status;
}

static void writers(void **state)
{
  (void)state;
  static const write_function all[] = {csv, vtp, vtp_zlib, lammps, yade, xyz};
  for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
    writing = all[i];
    const size_t failures = test_every_allocation(write_scenario);
    assert_true(failures > 0 || all[i] == vtp_zlib);
  }
}

static packing_status read_scenario(packing_context *context, uint64_t *hash)
{
  test_buffer buffer;
  packing_particles *particles = NULL;
  test_buffer_text(&buffer, "x,y,z,r,id,vx,vy,vz\n1,2,3,4,5,6,7,8\n9,8,7,6,5,4,3,2\n");
  const packing_stream stream = test_buffer_stream(&buffer);
  packing_status status = packing_particles_create(context, NULL, &particles);
  if (status == PACKING_OK)
    status = packing_read_csv(context, &stream, particles);
  if (status == PACKING_OK)
    *hash = test_hash_particles(particles);
  else if (particles != NULL)
    assert_int_equal(packing_particles_count(particles), 0);
  packing_particles_destroy(particles);
  test_buffer_free(&buffer);
  return status;
}

static void reader_of_packs(void **state)
{
  (void)state;
  assert_true(test_every_allocation(read_scenario) >= 3);
}

static packing_status sizes(packing_context *context, uint64_t *hash, int curve)
{
  test_buffer buffer;
  packing_psd *psd = NULL;
  test_buffer_text(&buffer, curve ? "diameter,passing\n1,0\n2,0.5\n4,1\n" : "1\n2\n2\n");
  const packing_stream stream = test_buffer_stream(&buffer);
  const packing_status status = curve ? packing_read_curve(context, NULL, &stream, &psd)
                                      : packing_read_sample(context, NULL, &stream, &psd);
  if (status == PACKING_OK) {
    const double median = packing_psd_quantile(psd, PACKING_BY_MASS, 0.5);
    *hash = test_hash(TEST_HASH_START, &median, sizeof median);
  } else {
    assert_null(psd);
  }
  packing_psd_destroy(psd);
  test_buffer_free(&buffer);
  return status;
}

static packing_status curve_scenario(packing_context *context, uint64_t *hash)
{
  return sizes(context, hash, 1);
}

static packing_status sample_scenario(packing_context *context, uint64_t *hash)
{
  return sizes(context, hash, 0);
}

static void readers_of_sizes(void **state)
{
  (void)state;
  assert_true(test_every_allocation(curve_scenario) >= 2);
  assert_true(test_every_allocation(sample_scenario) >= 2);
}

static char path[300];

static packing_status file_scenario(packing_context *context, uint64_t *hash)
{
  packing_file *file = NULL;
  char text[8] = "";
  size_t count = 0;
  packing_status status = packing_file_create(context, path, &file);
  if (status != PACKING_OK)
    return status;
  const packing_stream *stream = packing_file_stream(file);
  assert_ok(stream->write(stream->user, "text", 4));
  assert_ok(packing_file_commit(file));
  status = packing_file_open(context, path, &file);
  if (status == PACKING_OK) {
    stream = packing_file_stream(file);
    assert_ok(stream->read(stream->user, text, sizeof text, &count));
    packing_file_close(file);
  }
  *hash = test_hash(TEST_HASH_START, text, count);
  return status;
}

static void files(void **state)
{
  (void)state;
  const char *base = getenv("TMPDIR");
  char directory[256];
  snprintf(directory, sizeof directory, "%s/packing-alloc-XXXXXX",
           base != NULL && strlen(base) < 200 ? base : "/tmp");
  assert_non_null(mkdtemp(directory));
  snprintf(path, sizeof path, "%s/file", directory);
  assert_true(test_every_allocation(file_scenario) >= 5);
  assert_int_equal(unlink(path), 0);
  assert_int_equal(rmdir(directory), 0); /* no temporary file is left */
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(writers),
      cmocka_unit_test(reader_of_packs),
      cmocka_unit_test(readers_of_sizes),
      cmocka_unit_test(files),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
