/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reader of polygons: what it takes must be a container whose area its distances bear out,
 * what it refuses must leave the result alone and say why. */
#include "fuzz.h"
#include <math.h>

static void check_domain(packing_domain *domain)
{
  packing_bounds b;
  packing_domain_bounds(domain, &b);
  const double volume = packing_domain_volume(domain);
  fuzz_require(volume > 0 && isfinite(volume));
  fuzz_require(b.lo.x < b.hi.x && b.lo.y < b.hi.y);
  for (int i = 0; i <= 4; i++) {
    const packing_vec3 p = {b.lo.x + 0.25 * i * (b.hi.x - b.lo.x),
                            b.lo.y + 0.25 * i * (b.hi.y - b.lo.y), 0};
    packing_vec3 n;
    const double d = packing_domain_signed_distance(domain, &p, &n);
    fuzz_require(!isnan(d) && isfinite(n.x) && isfinite(n.y));
    fuzz_require(packing_domain_holds(domain, &p, 0) == (d >= 0));
  }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  packing_context *context = fuzz_context();
  packing_domain *domain = NULL;
  fuzz_input in;
  const packing_stream stream = fuzz_stream(&in, data, size);
  const packing_status status = packing_read_polygon(context, NULL, &stream, &domain);
  if (status == PACKING_OK) {
    check_domain(domain);
    packing_domain_destroy(domain);
  } else {
    fuzz_require(status == PACKING_ERR_FORMAT || status == PACKING_ERR_RANGE ||
                 status == PACKING_ERR_GEOMETRY);
    fuzz_require(domain == NULL);
    fuzz_require(packing_context_message(context)[0] != '\0');
    fuzz_require(strchr(packing_context_message(context), '\n') == NULL);
  }
  packing_context_destroy(context);
  return 0;
}
