/* SPDX-License-Identifier: Apache-2.0 */
/* A host whose threads have the stack that docs/c-api.md says is enough: 128 KiB. Exit code 0 means
 * that every call came to its end there; one that needs more ends in the guard page. */
#define _GNU_SOURCE
#include <pthread.h>
#include <sobb/scene.h>
#include <stdio.h>
#include <string.h>

#include "work.h"

enum { STACK_SIZE = 128 << 10 };

static host_mesh mesh;

static const host_calls calls = {sobb_build,     sobb_open_memory, sobb_bytes,
                                 sobb_intersect, sobb_occluded,    sobb_release};

/* Every call that takes one ray or a packet, and those that take none. */
static int other_calls(const sobb_triangles* triangles) {
  sobb_trace_options options = SOBB_TRACE_OPTIONS_INIT;
  sobb_info info = SOBB_INFO_INIT;
  sobb_hierarchy* built = NULL;
  options.flags = SOBB_TRACE_COHERENT;
  const int good = sobb_build(triangles, NULL, &built) == SOBB_OK &&
                   sobb_get_info(built, &info) == SOBB_OK &&
                   sobb_intersect(built, mesh.rays, RAYS, mesh.hits, &options) == SOBB_OK &&
                   sobb_intersect1(built, mesh.rays, mesh.hits) == SOBB_OK &&
                   sobb_occluded1(built, mesh.rays, mesh.occluded) == SOBB_OK &&
                   sobb_intersect_packet(built, mesh.rays, 0xFFFF, mesh.hits) == SOBB_OK &&
                   sobb_occluded_packet(built, mesh.rays, 0xFFFF, mesh.occluded) == SOBB_OK &&
                   sobb_brute_force(triangles, mesh.rays, 16, mesh.hits, NULL) == SOBB_OK;
  sobb_release(built);
  return good;
}

/* Triangles of sizes from 2^-50 to 2^47 about one point, which make the deepest hierarchies. */
static void make_spiral(host_mesh* of) {
  float size = 0x1p-50f;
  for (uint32_t i = 0; i < TRIANGLES; ++i) {
    const float corners[9] = {size, 0, 0, 1.1f * size, 0.01f * size, 0, size, 0, 0.01f * size};
    memcpy(of->vertices + 9 * i, corners, sizeof corners);
    size *= 1.07f;
  }
}

static void* run(void* failed) {
  int good = 1;
  for (uint32_t quality = 1; quality <= 3; ++quality) {
    for (uint32_t threads = 0; threads <= 2; ++threads) {
      good &= work(&calls, &mesh, quality, threads, 1) > 0;
    }
  }
  make_spiral(&mesh);
  for (uint32_t quality = 1; quality <= 3; ++quality) {
    good &= work(&calls, &mesh, quality, 1, 0) == 0;
  }
  sobb_scene* scene = NULL;
  sobb_triangles triangles = SOBB_TRIANGLES_INIT;
  good &= sobb_scene_load("builtin:city:2000^4@30", NULL, &scene) == SOBB_OK &&
          sobb_scene_triangles(scene, &triangles) == SOBB_OK && other_calls(&triangles);
  sobb_scene_release(scene);
  *(int*)failed = !good;
  return NULL;
}

int main(void) {
  int failed = 1;
  pthread_t thread;
  pthread_attr_t attributes;
  make_mesh(&mesh);
  pthread_attr_init(&attributes);
  if (pthread_attr_setstacksize(&attributes, STACK_SIZE) != 0 ||
      pthread_create(&thread, &attributes, run, &failed) != 0 || pthread_join(thread, NULL) != 0) {
    fprintf(stderr, "no thread of %d bytes\n", STACK_SIZE);
    return 1;
  }
  return failed;
}
