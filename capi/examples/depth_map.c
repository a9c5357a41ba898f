/* SPDX-License-Identifier: Apache-2.0 */
/* Loads a scene, traces its first view, prints what it sees as text: the nearer, the denser. */
#include <math.h>
#include <sobb/scene.h>
#include <sobb/sobb.h>
#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 78, HEIGHT = 39 };

static void subtract(const float* a, const float* b, float* out) {
  for (int i = 0; i < 3; ++i) out[i] = a[i] - b[i];
}

static void cross(const float* a, const float* b, float* out) {
  for (int i = 0; i < 3; ++i) {
    out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
  }
}

static void normalize(float* a) {
  const float length = sqrtf(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  for (int i = 0; i < 3; ++i) a[i] /= length;
}

/* One ray a character, line by line; a character is twice as high as wide. */
static void make_rays(const sobb_view* view, sobb_ray* rays) {
  float forward[3];
  float right[3];
  float up[3];
  subtract(view->target, view->eye, forward);
  normalize(forward);
  cross(forward, view->up, right);
  normalize(right);
  cross(right, forward, up);
  const float extent = tanf(view->vfov_degrees * 3.14159265f / 360.0f);
  for (int y = 0; y < HEIGHT; ++y) {
    for (int x = 0; x < WIDTH; ++x) {
      sobb_ray* ray = &rays[y * WIDTH + x];
      const float across = extent * (2.0f * x + 1.0f - WIDTH) / (2.0f * HEIGHT);
      const float upward = extent * (1.0f - (2.0f * y + 1.0f) / HEIGHT);
      ray->tmin = 0.0f;
      ray->tmax = INFINITY;
      for (int i = 0; i < 3; ++i) {
        ray->origin[i] = view->eye[i];
        ray->direction[i] = forward[i] + across * right[i] + upward * up[i];
      }
    }
  }
}

static void print_depths(const sobb_hit* hits) {
  static const char shades[] = "@%#*+=-:.";
  float nearest = INFINITY;
  float farthest = 0.0f;
  for (int i = 0; i < WIDTH * HEIGHT; ++i) {
    if (hits[i].primitive == SOBB_MISS) continue;
    nearest = fminf(nearest, hits[i].t);
    farthest = fmaxf(farthest, hits[i].t);
  }
  const float scale = farthest > nearest ? (sizeof shades - 2) / (farthest - nearest) : 0.0f;
  for (int y = 0; y < HEIGHT; ++y) {
    for (int x = 0; x < WIDTH; ++x) {
      const sobb_hit* hit = &hits[y * WIDTH + x];
      const int missed = hit->primitive == SOBB_MISS;
      putchar(missed ? ' ' : shades[(int)((hit->t - nearest) * scale)]);
    }
    putchar('\n');
  }
}

int main(int argc, char** argv) {
  static sobb_ray rays[WIDTH * HEIGHT];
  static sobb_hit hits[WIDTH * HEIGHT];
  const char* source = argc > 1 ? argv[1] : "builtin:hairball:20000";
  sobb_scene* scene = NULL;
  sobb_hierarchy* hierarchy = NULL;
  sobb_triangles triangles = SOBB_TRIANGLES_INIT;
  sobb_view view;

  sobb_status status = sobb_scene_load(source, NULL, &scene);
  if (status == SOBB_OK) status = sobb_scene_triangles(scene, &triangles);
  if (status == SOBB_OK) status = sobb_scene_view(scene, 0, &view);
  if (status == SOBB_OK) status = sobb_build(&triangles, NULL, &hierarchy);
  if (status == SOBB_OK) {
    make_rays(&view, rays);
    status = sobb_intersect(hierarchy, rays, WIDTH * HEIGHT, hits, NULL);
  }
  if (status == SOBB_OK) print_depths(hits);
  if (status != SOBB_OK) fprintf(stderr, "%s\n", sobb_last_error());
  sobb_release(hierarchy);
  sobb_scene_release(scene);
  return status == SOBB_OK ? EXIT_SUCCESS : EXIT_FAILURE;
}
