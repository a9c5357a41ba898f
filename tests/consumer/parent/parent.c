/* SPDX-License-Identifier: Apache-2.0 */
/* A library of the parent's own: BUILD_SHARED_LIBS says of which kind. */
int parent_answer(void);

int parent_answer(void) { return 42; }
