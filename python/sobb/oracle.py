# SPDX-License-Identifier: Apache-2.0
"""The oracle: closest hits by testing every triangle, which define what is right."""

from collections.abc import Sequence
from ctypes import byref
from typing import Any

import numpy as np

from sobb import library, structs
from sobb.dtypes import hit_dtype
from sobb.hierarchy import contiguous_rays
from sobb.triangles import TriangleArgument


def brute_force(
    triangles: Any,
    rays: np.ndarray,
    faces: Any = None,
    threads: int = 0,
    origin: Sequence[float] | None = None,
) -> np.ndarray:
    """Finds closest hits without a hierarchy, in scalar code; every hierarchy gives the same bits.

    triangles, faces, origin: as in build().
    rays: ray_dtype, any shape. Returns hit_dtype of that shape.
    threads: how many threads trace at most; 0 for all.

    Cost: O(rays * triangles).
    """
    argument = TriangleArgument(triangles, faces, origin)
    rays = contiguous_rays(rays)
    hits = np.empty(rays.shape, hit_dtype)
    options = structs.TraceOptions(threads=library.unsigned("threads", threads))
    library.check(
        library.core().sobb_brute_force(
            byref(argument.struct), rays.ctypes.data, rays.size, hits.ctypes.data, byref(options)
        )
    )
    return hits
