/* SPDX-License-Identifier: Apache-2.0 */
/* Compiles as C99 and as C++ without a warning: every initialiser of the headers, as a local
 * variable and as a constant, and a status that is ignored on purpose. Exit code 0 means that each
 * initialiser sets the struct's size and nothing else. */
#include <sobb/scene.h>
#include <sobb/sobb.h>
#include <string.h>

static const sobb_triangles triangles = SOBB_TRIANGLES_INIT;
static const sobb_build_options build_options = SOBB_BUILD_OPTIONS_INIT;
static const sobb_open_options open_options = SOBB_OPEN_OPTIONS_INIT;
static const sobb_trace_options trace_options = SOBB_TRACE_OPTIONS_INIT;
static const sobb_info info = SOBB_INFO_INIT;
static const sobb_scene_options scene_options = SOBB_SCENE_OPTIONS_INIT;
static const sobb_scene_info scene_info = SOBB_SCENE_INFO_INIT;
static const sobb_scene_note scene_note = SOBB_SCENE_NOTE_INIT;

/* Returns whether the struct begins with its size, and has no other byte set. */
static int is_initial(const void* options, uint32_t size) {
  const unsigned char* bytes = (const unsigned char*)options;
  uint32_t struct_size = 0;
  memcpy(&struct_size, options, sizeof struct_size);
  if (struct_size != size) return 0;
  for (uint32_t i = sizeof struct_size; i < size; ++i) {
    if (bytes[i] != 0) return 0;
  }
  return 1;
}

int main(void) {
  sobb_build_options changed = SOBB_BUILD_OPTIONS_INIT;
  sobb_hierarchy* none = NULL;
  changed.quality = SOBB_QUALITY_HIGH;
  (void)sobb_build(&triangles, &changed, &none); /* of no triangles: fails */
  if (none != NULL) return 1;
  return is_initial(&triangles, sizeof triangles) &&
                 is_initial(&build_options, sizeof build_options) &&
                 is_initial(&open_options, sizeof open_options) &&
                 is_initial(&trace_options, sizeof trace_options) &&
                 is_initial(&info, sizeof info) &&
                 is_initial(&scene_options, sizeof scene_options) &&
                 is_initial(&scene_info, sizeof scene_info) &&
                 is_initial(&scene_note, sizeof scene_note)
             ? 0
             : 1;
}
