/* SPDX-License-Identifier: Apache-2.0 */
/* A C99 program outside the project: loads a scene, builds, saves, opens, traces, compares. Its
 * argument is a path that it may write to. Exit code 0 means that all went as it should. */
#include <sobb/scene.h>
#include <sobb/sobb.h>
#include <stdio.h>
#include <string.h>

enum { RAYS = 1000 };

static void make_rays(const sobb_view* view, sobb_ray* rays) {
  for (int i = 0; i < RAYS; ++i) {
    const float angle = 0.4f * ((float)i / RAYS - 0.5f);
    memset(&rays[i], 0, sizeof rays[i]);
    rays[i].tmax = 1e30f;
    for (int axis = 0; axis < 3; ++axis) {
      rays[i].origin[axis] = view->eye[axis];
      rays[i].direction[axis] = view->target[axis] - view->eye[axis];
    }
    rays[i].direction[i % 3] += angle;
  }
}

/* Counts hits; a negative result says that reopened file and oracle disagree. */
static int compare(const sobb_triangles* triangles, const sobb_hierarchy* hierarchy,
                   const sobb_ray* rays) {
  static sobb_hit hits[RAYS];
  static sobb_hit expected[RAYS];
  static uint8_t occluded[RAYS];
  int hit_count = 0;
  if (sobb_intersect(hierarchy, rays, RAYS, hits, NULL) != SOBB_OK) return -1;
  if (sobb_occluded(hierarchy, rays, RAYS, occluded, NULL) != SOBB_OK) return -2;
  if (sobb_brute_force(triangles, rays, RAYS, expected, NULL) != SOBB_OK) return -3;
  if (memcmp(hits, expected, sizeof hits) != 0) return -4;
  for (int i = 0; i < RAYS; ++i) {
    const int hit = hits[i].primitive != SOBB_MISS;
    if (occluded[i] != (hit ? SOBB_OCCLUDED : SOBB_FREE)) return -5;
    hit_count += hit;
  }
  return hit_count;
}

static sobb_status run(const char* path) {
  static sobb_ray rays[RAYS];
  sobb_scene* scene = NULL;
  sobb_hierarchy* built = NULL;
  sobb_hierarchy* opened = NULL;
  sobb_view view;
  sobb_triangles triangles = SOBB_TRIANGLES_INIT;
  sobb_build_options options = SOBB_BUILD_OPTIONS_INIT;
  options.threads = 2;

  sobb_status status = sobb_scene_load("builtin:pipes:2000", NULL, &scene);
  if (status == SOBB_OK) status = sobb_scene_triangles(scene, &triangles);
  if (status == SOBB_OK) status = sobb_scene_view(scene, 0, &view);
  if (status == SOBB_OK) status = sobb_build(&triangles, &options, &built);
  if (status == SOBB_OK) status = sobb_save(built, path);
  if (status == SOBB_OK) status = sobb_open(path, NULL, &opened);
  if (status == SOBB_OK) {
    make_rays(&view, rays);
    const int hit_count = compare(&triangles, opened, rays);
    printf("version %u, %d rays, %d hits\n", (unsigned)sobb_version(), RAYS, hit_count);
    if (hit_count <= 0) status = SOBB_ERROR_INTERNAL;
  }
  sobb_release(opened);
  sobb_release(built);
  sobb_scene_release(scene);
  return status;
}

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const sobb_status status = run(argv[1]);
  if (status != SOBB_OK) {
    fprintf(stderr, "%s: %s\n", sobb_status_string(status), sobb_last_error());
  }
  return status == SOBB_OK ? 0 : 1;
}
