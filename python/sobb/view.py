# SPDX-License-Identifier: Apache-2.0
"""A view, from which a picture is taken, and files of views."""

import json
import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class View:
    """A pinhole view: positions in the scene's units, vfov the whole vertical angle."""

    eye: Vector
    target: Vector
    up: Vector
    vfov_degrees: float


def default_view(bounds_min: Sequence[float], bounds_max: Sequence[float]) -> View:
    """Returns the view that scene.h states for a scene without one.

    With the centre c and the half diagonal h of the box, the eye is at c + 2.2 h (0.48, 0.36, 0.8)
    and looks at c; y is up, and the angle is 50 degrees.
    """
    x, y, z = ((a + b) / 2 for a, b in zip(bounds_min, bounds_max, strict=True))
    half = math.dist(bounds_min, bounds_max) / 2 or 1.0
    far = 2.2 * half
    eye = (x + far * 0.48, y + far * 0.36, z + far * 0.8)
    return View(eye, (x, y, z), (0.0, 1.0, 0.0), 50.0)


def read_views(path: str | os.PathLike[str], stem: str) -> list[View]:
    """Reads the views of the scene `stem` from a JSON file of views, as scene.h describes it.

    Raises OSError, or ValueError that names the file and the view that is wrong.
    """
    try:
        views = json.loads(Path(path).read_text("utf-8"))[stem]
    except KeyError:
        raise ValueError(f"{path}: no views of {stem!r}") from None
    except (TypeError, ValueError) as error:
        raise ValueError(f"{path}: not a JSON object of views: {error}") from None
    try:
        return [_parse(view) for view in views]
    except (KeyError, TypeError, ValueError) as error:
        raise ValueError(f"{path}: views of {stem!r}: {error!r}") from None


def _parse(view: dict) -> View:
    def vector(name: str) -> Vector:
        x, y, z = (float(value) for value in view[name])
        return x, y, z

    return View(vector("eye"), vector("target"), vector("up"), float(view["vfov_degrees"]))
