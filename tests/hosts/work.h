/* SPDX-License-Identifier: Apache-2.0 */
/* What the hosts in this folder do with the library: a small mesh, rays, and the functions that
 * they call, which a host that loads the library by hand looks up. */
#ifndef SOBB_TESTS_HOSTS_WORK_H
#define SOBB_TESTS_HOSTS_WORK_H

#include <sobb/sobb.h>

enum { TRIANGLES = 1000, RAYS = 4096 };

typedef struct host_mesh {
  float vertices[9 * TRIANGLES];
  uint32_t indices[3 * TRIANGLES];
  sobb_ray rays[RAYS];
  sobb_hit hits[RAYS];
  uint8_t occluded[RAYS];
} host_mesh;

/* The functions of the library that the hosts call. */
typedef struct host_calls {
  sobb_status (*build)(const sobb_triangles*, const sobb_build_options*, sobb_hierarchy**);
  sobb_status (*open_memory)(const void*, uint64_t, const sobb_open_options*, sobb_hierarchy**);
  sobb_status (*bytes)(const sobb_hierarchy*, const void**, uint64_t*);
  sobb_status (*intersect)(const sobb_hierarchy*, const sobb_ray*, uint64_t, sobb_hit*,
                           const sobb_trace_options*);
  sobb_status (*occluded)(const sobb_hierarchy*, const sobb_ray*, uint64_t, uint8_t*,
                          const sobb_trace_options*);
  void (*release)(sobb_hierarchy*);
} host_calls;

/* Slivers all over a cube, and rays from its centre. */
static inline void make_mesh(host_mesh* mesh) {
  for (uint32_t i = 0; i < 3 * TRIANGLES; ++i) {
    mesh->vertices[3 * i] = (float)(i % 5003 * 7919 % 1000);
    mesh->vertices[3 * i + 1] = (float)(i % 4099 * 977 % 997);
    mesh->vertices[3 * i + 2] = (float)(i * 31 % 991);
    mesh->indices[i] = i;
  }
  for (int i = 0; i < RAYS; ++i) {
    const sobb_ray ray = {{500, 500, 500},
                          0,
                          {(float)(i % 201) - 100.5f, (float)(i % 77) - 38.0f, (float)(i % 133)},
                          1e9f};
    mesh->rays[i] = ray;
  }
}

/* Builds, opens the bytes and, if asked, traces. Returns the number of rays that hit, 0 without
 * tracing, or -1 where a call failed. */
static inline int work(const host_calls* calls, host_mesh* mesh, uint32_t quality, uint32_t threads,
                       int trace) {
  sobb_triangles triangles = SOBB_TRIANGLES_INIT;
  sobb_build_options build = SOBB_BUILD_OPTIONS_INIT;
  sobb_open_options open = SOBB_OPEN_OPTIONS_INIT;
  sobb_trace_options options = SOBB_TRACE_OPTIONS_INIT;
  sobb_hierarchy* built = NULL;
  sobb_hierarchy* opened = NULL;
  const void* data = NULL;
  uint64_t size = 0;
  int hit_count = 0;
  triangles.vertices = mesh->vertices;
  triangles.vertex_count = 3 * TRIANGLES;
  triangles.indices = mesh->indices;
  triangles.triangle_count = TRIANGLES;
  build.quality = quality;
  build.threads = open.threads = options.threads = threads;

  int failed = calls->build(&triangles, &build, &built) != SOBB_OK ||
               calls->bytes(built, &data, &size) != SOBB_OK ||
               calls->open_memory(data, size, &open, &opened) != SOBB_OK;
  if (!failed && trace) {
    failed = calls->intersect(opened, mesh->rays, RAYS, mesh->hits, &options) != SOBB_OK ||
             calls->occluded(opened, mesh->rays, RAYS, mesh->occluded, &options) != SOBB_OK;
    for (int i = 0; i < RAYS && !failed; ++i) {
      const int hit = mesh->hits[i].primitive < SOBB_INVALID;
      failed = mesh->occluded[i] != (hit ? SOBB_OCCLUDED : SOBB_FREE);
      hit_count += hit;
    }
  }
  calls->release(opened);
  calls->release(built);
  return failed ? -1 : hit_count;
}

#endif
