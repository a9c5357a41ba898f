// SPDX-License-Identifier: Apache-2.0
// TinyGLTF's data model; its header is included nowhere else.
#pragma once

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop
