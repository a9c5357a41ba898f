/* SPDX-License-Identifier: Apache-2.0 */
/* A C99 program of a parent project: builds hierarchies over one soup of triangles in every
 * quality, volume and width, traces them with every instruction set in every mode, and compares all
 * hits with the oracle's. Prints hashes of hits and of files; programs of all parents print the
 * same. */
#include <inttypes.h>
#include <sobb/sobb.h>
#include <stdio.h>
#include <string.h>

enum { TRIANGLES = 3000, RAYS = 2048, PACKET = 16 };

static float vertices[TRIANGLES * 9];
static uint32_t indices[TRIANGLES * 3];
static sobb_ray rays[RAYS];
static sobb_hit expected[RAYS];

static uint32_t next_random(void) {
  static uint64_t state = 21;
  state = state * 6364136223846793005u + 1442695040888963407u;
  return (uint32_t)(state >> 32);
}

/* From -1 to 1, in steps that a float holds: the parent's compiler has nothing to round. */
static float next_coordinate(void) {
  return (float)((int32_t)(next_random() >> 8) - 0x800000) / 0x800000;
}

static float from_bits(uint32_t bits) {
  float value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

/* Every other triangle is a sliver; some lie within the denormal numbers about the origin. */
static void make_triangles(void) {
  for (uint32_t i = 0; i < TRIANGLES; ++i) {
    float* corner = &vertices[9 * i];
    for (int k = 0; k < 9; ++k) {
      corner[k] = next_coordinate();
      if (k >= 3) corner[k] = corner[k - 3] + corner[k] / (k >= 6 && i % 2 == 0 ? 1024 : 8);
      if (i % 300 == 7) corner[k] = from_bits(next_random() & 0x800FFFFFu);
    }
    for (uint32_t k = 0; k < 3; ++k) indices[3 * i + k] = 3 * i + k;
  }
}

/* Rays of any direction, some to infinity; some that have a denormal direction, none, or NaN. */
static void make_rays(void) {
  const float infinity = from_bits(0x7F800000u);
  for (int i = 0; i < RAYS; ++i) {
    sobb_ray* ray = &rays[i];
    ray->tmax = i % 3 == 0 ? infinity : 4;
    for (int axis = 0; axis < 3; ++axis) {
      ray->origin[axis] = i % 5 == 0 ? 0 : next_coordinate();
      ray->direction[axis] = i % 7 == 0 && axis != i % 3 ? 0 : next_coordinate();
      if (i % 64 == 9) ray->direction[axis] = from_bits(next_random() & 0x800FFFFFu);
      if (i % 64 == 10) ray->direction[axis] = 0;
      if (i % 64 == 11) ray->origin[axis] = from_bits(0x7FC00000u);
    }
  }
}

static uint64_t hash_of(uint64_t hash, const void* data, uint64_t size) {
  const uint8_t* bytes = data;
  for (uint64_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 1099511628211u;
  return hash;
}

/* Traces all rays with one instruction set in one mode: 0 an array, 1 a coherent one, 2 packets,
 * 3 one by one, and occlusion of all. */
static int trace(const sobb_hierarchy* hierarchy, uint32_t isa, int mode) {
  static sobb_hit hits[RAYS];
  static uint8_t occluded[RAYS];
  sobb_trace_options options;
  memset(&options, 0, sizeof options);
  options.struct_size = sizeof options;
  options.isa = isa;
  options.flags = mode == 1 ? SOBB_TRACE_COHERENT : 0;
  options.threads = mode == 0 ? 2 : 1;
  sobb_status status = SOBB_OK;
  if (mode < 2) {
    status = sobb_intersect(hierarchy, rays, RAYS, hits, &options);
  } else {
    for (int i = 0; i < RAYS && status == SOBB_OK; i += mode == 2 ? PACKET : 1) {
      status = mode == 2 ? sobb_intersect_packet(hierarchy, &rays[i], 0xFFFF, &hits[i])
                         : sobb_intersect1(hierarchy, &rays[i], &hits[i]);
    }
  }
  if (status == SOBB_OK) status = sobb_occluded(hierarchy, rays, RAYS, occluded, &options);
  if (status != SOBB_OK) return 1;
  for (int i = 0; i < RAYS; ++i) {
    const uint32_t primitive = expected[i].primitive;
    const int right = primitive == SOBB_INVALID ? SOBB_OCCLUDED_INVALID
                      : primitive == SOBB_MISS  ? SOBB_FREE
                                                : SOBB_OCCLUDED;
    if (occluded[i] != right) return 1;
  }
  return memcmp(hits, expected, sizeof hits) != 0;
}

/* Builds once, traces every way, and continues the hash of files. */
static int build_and_trace(const sobb_triangles* mesh, const sobb_build_options* options,
                           uint64_t* files) {
  sobb_hierarchy* hierarchy = NULL;
  const void* bytes = NULL;
  uint64_t size = 0;
  int wrong = 0;
  if (sobb_build(mesh, options, &hierarchy) != SOBB_OK) return 1;
  if (sobb_bytes(hierarchy, &bytes, &size) != SOBB_OK) return 1;
  *files = hash_of(*files, bytes, size);
  for (uint32_t isa = 1; isa <= sobb_isa_count(); ++isa) {
    sobb_isa resolved;
    if (sobb_resolve_isa((sobb_isa)isa, &resolved) != SOBB_OK) continue;
    for (int mode = 0; mode < 4; ++mode) wrong += trace(hierarchy, isa, mode);
  }
  sobb_release(hierarchy);
  return wrong;
}

int main(void) {
  uint64_t files = 14695981039346656037u;
  int wrong = 0;
  uint32_t hit_count = 0;
  uint32_t invalid_count = 0;
  sobb_triangles mesh;
  sobb_build_options options;
  memset(&mesh, 0, sizeof mesh);
  memset(&options, 0, sizeof options);
  make_triangles();
  make_rays();
  mesh.struct_size = sizeof mesh;
  mesh.vertices = vertices;
  mesh.vertex_count = TRIANGLES * 3;
  mesh.indices = indices;
  mesh.triangle_count = TRIANGLES;
  options.struct_size = sizeof options;
  options.threads = 2;
  if (sobb_brute_force(&mesh, rays, RAYS, expected, NULL) != SOBB_OK) wrong = 1;
  for (int i = 0; i < RAYS; ++i) {
    invalid_count += expected[i].primitive == SOBB_INVALID;
    hit_count += expected[i].primitive < TRIANGLES;
  }
  for (uint32_t choice = 0; choice < 12; ++choice) {
    options.quality = SOBB_QUALITY_LOW + choice % 3;
    options.width = choice / 3 % 2 == 0 ? 4 : 8;
    options.volume = choice < 6 ? SOBB_VOLUME_AABB : SOBB_VOLUME_SOBB;
    wrong += build_and_trace(&mesh, &options, &files);
  }
  printf("%u hits, %u invalid, hits %016" PRIx64 ", files %016" PRIx64 "\n", (unsigned)hit_count,
         (unsigned)invalid_count, hash_of(14695981039346656037u, expected, sizeof expected), files);
  if (wrong != 0) fprintf(stderr, "%d wrong; %s\n", wrong, sobb_last_error());
  return wrong == 0 && hit_count > RAYS / 8 && invalid_count > 0 ? 0 : 1;
}
