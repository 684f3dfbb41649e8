/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene for POV-Ray 3.7: spheres coloured by radius, the container as a clear mesh, a camera
 * that sees the box, a light. POV-Ray's axes are left-handed; `right -x` makes them ours. */
#include "vec.h"
#include "writers_internal.h"

enum { SHADES = 32 };

static const double view_angle = 30; /* degrees */

/* From the smallest to the largest radius: blue, green, yellow. */
static void put_shade(packing_i_writer *w, int shade)
{
  static const double stops[3][3] = {
      {0.1875, 0.25, 0.5625}, {0.125, 0.5625, 0.546875}, {0.984375, 0.875, 0.25}};
  const double t = 2.0 * shade / (SHADES - 1);
  const int at = t < 1 ? 0 : 1;
  const double s = t - at;
  packing_i_put_text(w, "#declare S");
  packing_i_put_int(w, shade);
  packing_i_put_text(w, " = texture { pigment { color rgb <");
  for (int k = 0; k < 3; k++) {
    packing_i_put_text(w, k == 0 ? "" : ", ");
    packing_i_put_double(w, (1 - s) * stops[at][k] + s * stops[at + 1][k]);
  }
  packing_i_put_text(w, "> } finish { ambient 0.15 diffuse 0.75 specular 0.2 } }\n");
}

static void put_point(packing_i_writer *w, packing_vec3 p)
{
  packing_i_put_char(w, '<');
  packing_i_put_vec(w, ',', p);
  packing_i_put_char(w, '>');
}

/* Far enough along `toward` to see the ball round the box. */
static packing_vec3 eye(const packing_bounds *box, packing_vec3 middle,
                        packing_vec3 toward)
{
  const double diagonal = packing_i_norm(packing_i_sub(box->hi, box->lo));
  const double distance =
      0.5 * diagonal / sin(view_angle / 360 * PACKING_I_PI) / packing_i_norm(toward);
  return packing_i_add(middle, packing_i_scale(toward, distance));
}

static void put_camera(packing_i_writer *w, const packing_i_pack *pack)
{
  const int flat = pack->def.dim == 2;
  const packing_bounds *box = &pack->box;
  const packing_vec3 middle =
      packing_i_vec(0.5 * box->lo.x + 0.5 * box->hi.x, 0.5 * box->lo.y + 0.5 * box->hi.y,
                    0.5 * box->lo.z + 0.5 * box->hi.z);
  const packing_vec3 toward = flat ? packing_i_vec(0, 0, 1) : packing_i_vec(1, -2, 0.75);
  packing_i_put_text(w, "camera {\n  location ");
  put_point(w, eye(box, middle, toward));
  packing_i_put_text(w, flat ? "\n  sky y" : "\n  sky z");
  packing_i_put_text(w, "\n  right -x * image_width / image_height\n  angle ");
  packing_i_put_double(w, view_angle);
  packing_i_put_text(w, "\n  look_at ");
  put_point(w, middle);
  packing_i_put_text(w, "\n}\nlight_source { ");
  put_point(
      w, eye(box, middle, flat ? packing_i_vec(-1, 1, 2) : packing_i_vec(-0.5, -2, 2.5)));
  packing_i_put_text(w, " color rgb 1.2 }\n");
}

static void put_spheres(packing_i_writer *w, const packing_view *v)
{
  double least = v->count > 0 ? packing_i_view_r(v, 0) : 0;
  for (size_t i = 1; i < v->count; i++)
    least = fmin(least, packing_i_view_r(v, i));
  const double span = packing_i_view_largest_r(v) - least;
  for (size_t i = 0; i < v->count && w->status == PACKING_OK; i++) {
    const double r = packing_i_view_r(v, i);
    const double t = span > 0 ? (r - least) / span : 0.5;
    packing_i_put_text(w, "sphere { ");
    put_point(w, packing_i_view_centre(v, i));
    packing_i_put_text(w, ", ");
    packing_i_put_double(w, r);
    packing_i_put_text(w, " texture { S");
    packing_i_put_int(w, (int64_t)(t * (SHADES - 1) + 0.5));
    packing_i_put_text(w, " } }\n");
  }
}

static void put_triangle(void *user, const packing_vec3 corner[3])
{
  packing_i_writer *w = user;
  packing_i_put_text(w, "triangle { ");
  for (int i = 0; i < 3; i++) {
    packing_i_put_text(w, i == 0 ? "" : ", ");
    put_point(w, corner[i]);
  }
  packing_i_put_text(w, " }\n");
}

static void put_container(packing_i_writer *w, const packing_write_def *d)
{
  if (d->domain == NULL || !packing_i_mesh_exists(d->domain))
    return;
  packing_i_put_text(w, "mesh {\n");
  packing_i_mesh_visit(d->domain, d->facets, put_triangle, w);
  packing_i_put_text(w, "pigment { color rgbt <0.6, 0.7, 0.8, 0.85> } no_shadow\n}\n");
}

static packing_status write_pov(packing_context *context, const packing_i_pack *pack,
                                const packing_stream *stream)
{
  packing_i_writer w;
  PACKING_I_TRY(packing_i_writer_open(&w, context, "pov", stream));
  packing_i_put_text(&w, "// ");
  packing_i_put_title(&w, pack);
  packing_i_put_text(&w, "\n#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n"
                         "background { color rgb 1 }\n");
  put_camera(&w, pack);
  for (int i = 0; i < SHADES; i++)
    put_shade(&w, i);
  put_spheres(&w, &pack->view);
  put_container(&w, &pack->def);
  return packing_i_writer_end(&w);
}

const packing_i_write_format packing_i_write_pov = {
    {sizeof(packing_write_format), "pov", ".pov",
     "centre, radius as size and colour, the container as a clear mesh", "POV-Ray 3.7",
     1},
    PACKING_I_NEEDS_BOX,
    write_pov};
