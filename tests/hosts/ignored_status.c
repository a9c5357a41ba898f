/* SPDX-License-Identifier: Apache-2.0 */
/* Ignores a status, which compilers refuse with -Werror where the language has a way to say so. */
#include <sobb/sobb.h>

void ignore(const sobb_hierarchy* hierarchy, sobb_info* info) { sobb_get_info(hierarchy, info); }
