/* SPDX-License-Identifier: Apache-2.0 */
/* A host that works on several threads, then forks: parent and child both go on building and
 * tracing. Exit code 0 means that every child found the hits of its parent, in time.
 * usage: forked ROUNDS */
#define _GNU_SOURCE
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "work.h"

static host_mesh mesh;

static const host_calls calls = {sobb_build,     sobb_open_memory, sobb_bytes,
                                 sobb_intersect, sobb_occluded,    sobb_release};

/* Every quality with the default and with more threads than there may be. */
static int child_works(uint32_t quality, int expected) {
  alarm(60); /* ends a child that hangs */
  return work(&calls, &mesh, quality, 0, 1) == expected &&
         work(&calls, &mesh, quality, 8, 1) == expected;
}

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  int failures = 0;
  make_mesh(&mesh);
  for (int i = 0; i < atoi(argv[1]); ++i) {
    const uint32_t quality = 1 + (uint32_t)i % 3;
    const int expected = work(&calls, &mesh, quality, i % 2 == 0 ? 0 : 4, 1);
    if (expected <= 0) return 1;
    if (i % 4 == 0) usleep(2000); /* workers go to sleep; else they are just leaving the loop */
    const pid_t child = fork();
    if (child == 0) exit(child_works(quality, expected) ? 0 : 1);
    int status = -1;
    if (child < 0 || waitpid(child, &status, 0) != child || status != 0) {
      fprintf(stderr, "round %d: wait status %#x\n", i, (unsigned)status);
      ++failures;
    }
  }
  printf("%s children, %d failed\n", argv[1], failures);
  return failures == 0 ? 0 : 1;
}
