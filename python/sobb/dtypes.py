# SPDX-License-Identifier: Apache-2.0
"""The C structs of rays, hits and counts as NumPy structured types, byte for byte."""

import numpy as np

#: sobb_ray, 32 bytes: the points origin + t * direction with tmin <= t <= tmax.
ray_dtype = np.dtype(
    [("origin", "<f4", 3), ("tmin", "<f4"), ("direction", "<f4", 3), ("tmax", "<f4")]
)

#: sobb_hit, 24 bytes: the point (1-u-v) v0 + u v1 + v v2 of triangle `primitive`.
hit_dtype = np.dtype(
    [
        ("t", "<f4"),
        ("u", "<f4"),
        ("v", "<f4"),
        ("primitive", "<u4"),
        ("geometry", "<u4"),
        ("instance", "<u4"),
    ]
)

#: sobb_count, 16 bytes: the work done for a ray.
count_dtype = np.dtype(
    [("nodes", "<u4"), ("volumes", "<u4"), ("blocks", "<u4"), ("triangles", "<u4")]
)

#: hit["primitive"] of a ray that hit nothing.
MISS = 0xFFFFFFFF
#: hit["primitive"] of a ray with NaN, infinity, no direction, or tmin < 0.
INVALID = 0xFFFFFFFE
#: The occlusion byte of such a ray; the others are 0 (free) and 1 (occluded).
OCCLUDED_INVALID = 255


def is_hit(hits: np.ndarray) -> np.ndarray:
    """Which of `hits` (hit_dtype, any shape) hit a triangle: bool, of the same shape."""
    return hits["primitive"] < INVALID
