# SPDX-License-Identifier: Apache-2.0
"""A walk through the library with one scene, from its triangles to a table against Embree."""
