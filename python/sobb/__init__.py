# SPDX-License-Identifier: Apache-2.0
"""Skewed oriented bounding box hierarchies for ray tracing on CPUs.

    import numpy as np, sobb
    hierarchy = sobb.build(vertices, faces)          # float32 (n, 3), uint32 (m, 3)
    rays = np.zeros(1000, sobb.ray_dtype)            # origin, tmin, direction, tmax
    hits = hierarchy.intersect(rays)                 # t, u, v, primitive, geometry, instance

Arrays pass to the C library and back without copies. Other Python threads run while it traces.
The commands of `python -m sobb` are in `sobb.tools`, which nothing here imports.
"""

from sobb.dtypes import INVALID, MISS, OCCLUDED_INVALID, count_dtype, hit_dtype, ray_dtype
from sobb.error import Error, Status
from sobb.hierarchy import Hierarchy, build
from sobb.library import resolve_isa, version
from sobb.oracle import brute_force
from sobb.scene import Mesh, Note, Scene
from sobb.view import View

__all__ = [
    "INVALID",
    "MISS",
    "OCCLUDED_INVALID",
    "Error",
    "Hierarchy",
    "Mesh",
    "Note",
    "Scene",
    "Status",
    "View",
    "brute_force",
    "build",
    "count_dtype",
    "hit_dtype",
    "ray_dtype",
    "resolve_isa",
    "version",
]
