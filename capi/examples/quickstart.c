/* SPDX-License-Identifier: Apache-2.0 */
/* Builds a hierarchy over a tetrahedron, saves it, opens the file, traces one ray. */
#include <sobb/sobb.h>
#include <stdio.h>

static const float vertices[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
static const uint32_t indices[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

static int run(const char* path) {
  sobb_triangles triangles = SOBB_TRIANGLES_INIT;
  triangles.vertices = vertices;
  triangles.vertex_count = 4;
  triangles.indices = indices;
  triangles.triangle_count = 4;
  sobb_hierarchy* built = NULL;
  sobb_status status = sobb_build(&triangles, NULL, &built);
  if (status == SOBB_OK) status = sobb_save(built, path);
  sobb_release(built);
  if (status != SOBB_OK) return status;

  sobb_hierarchy* opened = NULL;
  status = sobb_open(path, NULL, &opened);
  if (status != SOBB_OK) return status;

  sobb_ray ray = {{0.25f, 0.25f, -1.0f}, 0.0f, {0.0f, 0.0f, 1.0f}, 10.0f};
  sobb_hit hit;
  status = sobb_intersect1(opened, &ray, &hit);
  sobb_release(opened);
  if (status != SOBB_OK) return status;

  if (hit.primitive == SOBB_MISS) {
    printf("The ray misses.\n");
  } else {
    printf("The ray hits triangle %u at t = %g.\n", (unsigned)hit.primitive, hit.t);
  }
  return SOBB_OK;
}

int main(int argc, char** argv) {
  const int status = run(argc > 1 ? argv[1] : "quickstart.sobb");
  if (status == SOBB_OK) return 0;
  fprintf(stderr, "%s: %s\n", sobb_status_string((sobb_status)status), sobb_last_error());
  return 1;
}
