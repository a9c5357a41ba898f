/* SPDX-License-Identifier: Apache-2.0 */
/* A host that loads the library, works and unloads it, round after round, as hosts do with plugins.
 * Each combination of quality, threads and tracing has a process of its own, so that the library is
 * really gone before each first round. Exit code 0 means that none crashed or failed.
 * usage: unload LIBRARY [SCENE_LIBRARY] ROUNDS */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <sobb/scene.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "work.h"

static host_mesh mesh;

static int find(void* library, const char* name, void* function) {
  void* found = dlsym(library, name);
  memcpy(function, &found, sizeof found);
  return found != NULL;
}

static int one_round(const char* path, uint32_t quality, uint32_t threads, int trace) {
  host_calls calls;
  void* library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (library == NULL || !find(library, "sobb_build", &calls.build) ||
      !find(library, "sobb_open_memory", &calls.open_memory) ||
      !find(library, "sobb_bytes", &calls.bytes) ||
      !find(library, "sobb_intersect", &calls.intersect) ||
      !find(library, "sobb_occluded", &calls.occluded) ||
      !find(library, "sobb_release", &calls.release)) {
    fprintf(stderr, "%s\n", dlerror());
    return 0;
  }
  const int hit_count = work(&calls, &mesh, quality, threads, trace);
  dlclose(library);
  return trace ? hit_count > 0 : hit_count == 0;
}

/* Loads a refined scene through the importers. */
static int one_scene_round(const char* path) {
  sobb_status (*load)(const char*, const sobb_scene_options*, sobb_scene**);
  void (*release)(sobb_scene*);
  sobb_scene* scene = NULL;
  void* library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (library == NULL || !find(library, "sobb_scene_load", &load) ||
      !find(library, "sobb_scene_release", &release)) {
    fprintf(stderr, "%s\n", dlerror());
    return 0;
  }
  const int loaded = load("builtin:city:1000^4", NULL, &scene) == SOBB_OK;
  release(scene);
  dlclose(library);
  return loaded;
}

/* Runs one combination in this process. Workers of the last round may go on for a while after it,
 * so the process does too. */
static int run_rounds(const char* path, const char* scene_path, int rounds, int trace,
                      uint32_t quality, uint32_t threads) {
  for (int i = 0; i < rounds; ++i) {
    if (!one_round(path, quality, threads, trace)) return 2;
    if (scene_path != NULL && !one_scene_round(scene_path)) return 3;
    if (i % 8 == 0) usleep(1000); /* a worker goes to sleep meanwhile */
  }
  usleep(50000);
  void* left = dlopen(path, RTLD_NOW | RTLD_NOLOAD);
  /* On one thread nothing is left behind. */
  return threads == 1 && left != NULL ? 4 : 0;
}

int main(int argc, char** argv) {
  static const uint32_t thread_counts[] = {0, 1, 2, 8};
  if (argc < 3 || argc > 4) return 2;
  const char* scene_path = argc == 4 ? argv[2] : NULL;
  const int rounds = atoi(argv[argc - 1]);
  int failures = 0;
  make_mesh(&mesh);
  for (int i = 0; i < 24; ++i) {
    const uint32_t quality = 1 + (uint32_t)i / 8;
    const uint32_t threads = thread_counts[i / 2 % 4];
    const int trace = i % 2;
    const pid_t child = fork();
    if (child == 0) {
      alarm(600); /* ends a child that hangs */
      exit(run_rounds(argv[1], scene_path, rounds, trace, quality, threads));
    }
    int status = -1;
    if (child < 0 || waitpid(child, &status, 0) != child || status != 0) {
      fprintf(stderr, "quality %u, %u threads, trace %d: wait status %#x\n", quality, threads,
              trace, (unsigned)status);
      ++failures;
    }
  }
  printf("24 hosts of %d rounds, %d failed\n", rounds, failures);
  return failures == 0 ? 0 : 1;
}
