/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The vector work of the stepper, once for all instruction sets. Included by kernels_*.c, which
 * define what a vector is:
 *   TARGET                   attribute of every function
 *   WIDTH                    doubles of a vector, at most 8
 *   vector, mask             types; + - * / work on vectors
 *   vector_all(a)            a in all lanes
 *   vector_load(p), vector_store(p, v)
 *   vector_sqrt(v), vector_least0(v): v, or 0 where it is not > 0
 *   vector_image(v, period, half): the nearest image of a difference
 *   vector_less(a, b, lanes) the first `lanes` of a < b
 *   vector_pack(p, v, m)     stores the lanes of m one after the other
 *   index_pack(p, q, m)      the same for indices at q
 *   mask_count(m)
 *   records_load(base, stride, index, v[4]): four doubles of WIDTH records, transposed
 *   slot_pack(p, first, m)   the same for the numbers first, first + 1, ...
 *   records_add(base, i, j, lanes, v[6], w[6]): pair after pair, adds v[0..2] to doubles 0..2 of
 *                            record i of 8 doubles, v[3..5] to its doubles 4..6; then w to j
 * Every operation is one IEEE operation a lane: all sets give the same bits. */

TARGET static void screen(const double *position, const packing_i_images *images,
                          double reach, const uint32_t *list_i, const uint32_t *list_j,
                          size_t first, size_t count, packing_i_batch *b)
{
  size_t held = b->count;
  for (size_t k = 0; k < count; k += WIDTH) {
    const uint32_t *i = list_i + first + k, *j = list_j + first + k;
    const unsigned lanes = (unsigned)(count - k < WIDTH ? count - k : WIDTH);
    vector a[4], c[4];
    records_load(position, PACKING_I_POSITION, i, a);
    records_load(position, PACKING_I_POSITION, j, c);
    vector dx = c[0] - a[0], dy = c[1] - a[1], dz = c[2] - a[2];
    if (images->any) {
      dx = vector_image(dx, images->period[0], images->half[0]);
      dy = vector_image(dy, images->period[1], images->half[1]);
      dz = vector_image(dz, images->period[2], images->half[2]);
    }
    const vector d2 = dx * dx + dy * dy + dz * dz;
    vector near = a[3] + c[3];
    if (reach > 0)
      near = vector_all(reach);
    const mask m = vector_less(d2, near * near, lanes);
    vector_pack(b->dx + held, dx, m);
    vector_pack(b->dy + held, dy, m);
    vector_pack(b->dz + held, dz, m);
    vector_pack(b->distance + held, d2, m);
    vector_pack(b->ri + held, a[3], m);
    vector_pack(b->rj + held, c[3], m);
    index_pack(b->i + held, i, m);
    index_pack(b->j + held, j, m);
    slot_pack(b->slot + held, (uint32_t)(first + k), m);
    held += mask_count(m);
  }
  b->count = held;
}

/* Campello and Cassares, equations 6 (n), 8 and 11 (r*, m*), 9 (overlap), 14 (u, with the spins)
 * and 15 (arms). */
TARGET static void motion(const double *motion, int touching, int arms_at_radius,
                          packing_i_batch *b)
{
  const vector one = vector_all(1), none = vector_all(0);
  const size_t whole =
      (b->count + 7) / 8 * 8; /* laws may read as far, whatever WIDTH is */
  for (size_t k = 0; k < whole; k += WIDTH) {
    vector vi[4], vj[4], wi[4], wj[4];
    records_load(motion, PACKING_I_MOTION, b->i + k, vi);
    records_load(motion, PACKING_I_MOTION, b->j + k, vj);
    records_load(motion + 4, PACKING_I_MOTION, b->i + k, wi);
    records_load(motion + 4, PACKING_I_MOTION, b->j + k, wj);
    const vector ri = vector_load(b->ri + k), rj = vector_load(b->rj + k), sum = ri + rj;
    const vector d = vector_sqrt(vector_load(b->distance + k)), inverse = one / d;
    const vector nx = vector_load(b->dx + k) * inverse,
                 ny = vector_load(b->dy + k) * inverse,
                 nz = vector_load(b->dz + k) * inverse;
    vector overlap = sum - d;
    if (touching)
      overlap = vector_least0(overlap);
    vector arm_i = ri, arm_j = rj;
    if (!arms_at_radius) {
      arm_i = ri - vector_load(b->share + k) * overlap;
      arm_j = d - arm_i;
    }
    /* Turning adds -(arm_i w_i + arm_j w_j) x n to v_j - v_i at the contact. */
    const vector tx = arm_i * wi[0] + arm_j * wj[0], ty = arm_i * wi[1] + arm_j * wj[1],
                 tz = arm_i * wi[2] + arm_j * wj[2];
    const vector gx = vj[0] - vi[0], gy = vj[1] - vi[1], gz = vj[2] - vi[2];
    const vector approach = none - (gx * nx + gy * ny + gz * nz);
    vector_store(b->ux + k, (gx + approach * nx) - (ty * nz - tz * ny));
    vector_store(b->uy + k, (gy + approach * ny) - (tz * nx - tx * nz));
    vector_store(b->uz + k, (gz + approach * nz) - (tx * ny - ty * nx));
    vector_store(b->dx + k, nx);
    vector_store(b->dy + k, ny);
    vector_store(b->dz + k, nz);
    vector_store(b->distance + k, d);
    vector_store(b->arm_i + k, arm_i);
    vector_store(b->arm_j + k, arm_j);
    vector_store(b->overlap + k, overlap);
    vector_store(b->reduced_r + k, ri * rj / sum);
    vector_store(b->reduced_m + k, vi[3] * vj[3] / (vi[3] + vj[3]));
    vector_store(b->approach + k, approach);
    vector_store(b->normal + k, none);
    vector_store(b->fx + k, none);
    vector_store(b->fy + k, none);
    vector_store(b->fz + k, none);
  }
}

/* Equations 2 and 15: forces, opposite on j, and moments a n x f of the same sign on both. */
TARGET static void add(double *force, const packing_i_batch *b)
{
  const vector none = vector_all(0);
  for (size_t k = 0; k < b->count; k += WIDTH) {
    const unsigned lanes = (unsigned)(b->count - k < WIDTH ? b->count - k : WIDTH);
    const vector nx = vector_load(b->dx + k), ny = vector_load(b->dy + k),
                 nz = vector_load(b->dz + k);
    const vector fx = vector_load(b->fx + k), fy = vector_load(b->fy + k),
                 fz = vector_load(b->fz + k), push = vector_load(b->normal + k);
    const vector ai = vector_load(b->arm_i + k), aj = vector_load(b->arm_j + k);
    const vector mx = ny * fz - nz * fy, my = nz * fx - nx * fz, mz = nx * fy - ny * fx;
    const vector x = fx - push * nx, y = fy - push * ny, z = fz - push * nz;
    const vector on_i[6] = {x, y, z, ai * mx, ai * my, ai * mz};
    const vector on_j[6] = {none - x, none - y, none - z, aj * mx, aj * my, aj * mz};
    records_add(force, b->i + k, b->j + k, lanes, on_i, on_j);
  }
}

/* The four doubles of half a record go through the same operations, which compilers turn into
 * vectors: the fourth of each constant in `a` leaves what stands there (r, m, 1/m, 1/J). */
TARGET static double advance(const packing_i_advance *a, size_t first, size_t end)
{
  const packing_i_advance c = *a;
  double *restrict position = c.position, *restrict motion = c.motion;
  double *restrict force = c.force;
  const double *restrict built = c.built;
  double most[4] = {0, 0, 0, 0}, sum[4] = {0, 0, 0, 0};
  for (size_t p = first; p < end; p++) {
    double *x = position + PACKING_I_POSITION * p, *f = force + PACKING_I_FORCE * p;
    double *v = motion + PACKING_I_MOTION * p;
    const double *from = built + PACKING_I_POSITION * p;
    const double inverse = f[3], turn = f[7], drag = c.drag * inverse;
    double faster[4], spin[4], at[4], rest[4], torque[4];
    for (int k = 0; k < 4; k++)
      faster[k] =
          v[k] + c.dt[k] * (f[k] * inverse + c.gravity[k] - drag * (v[k] - c.flow[k]));
    for (int k = 0; k < 4; k++)
      spin[k] = v[k + 4] + c.spin_dt[k] * (f[k + 4] * turn);
    for (int k = 0; k < 4; k++)
      at[k] = x[k] + c.dt[k] * faster[k];
    for (int k = 0; k < 4; k++)
      rest[k] = f[k] * c.keep[k];
    for (int k = 0; k < 4; k++)
      torque[k] = f[k + 4] * c.keep[k];
    for (int k = 0; k < 4; k++) {
      const double way2 = (at[k] - from[k]) * (at[k] - from[k]);
      most[k] = way2 > most[k] ? way2 : most[k];
      sum[k] += way2;
    }
    memcpy(v, faster, sizeof faster);
    memcpy(v + 4, spin, sizeof spin);
    memcpy(x, at, sizeof at);
    memcpy(f, rest, sizeof rest);
    memcpy(f + 4, torque, sizeof torque);
  }
  /* A sum is finite only if all its parts are. */
  const double total = sum[0] + sum[1] + sum[2];
  return total < HUGE_VAL ? most[0] + most[1] + most[2] : HUGE_VAL;
}
