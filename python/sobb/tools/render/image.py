# SPDX-License-Identifier: Apache-2.0
"""Pictures: converts linear light to sRGB, and writes PNG files."""

import io
import os

import numpy as np
from PIL import Image

from sobb.tools.shared import atomic


def to_srgb(linear: np.ndarray) -> np.ndarray:
    """Converts linear light, clipped to 0..1, to sRGB bytes: uint8 of the same shape."""
    light = np.clip(linear, 0, 1)
    curve = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    return (curve * 255 + 0.5).astype(np.uint8)


def write_png(path: str | os.PathLike[str], picture: Image.Image) -> None:
    """Writes a picture atomically: whatever happens, `path` is the old file or the new one."""
    data = io.BytesIO()
    picture.save(data, "png")
    atomic.write_bytes(path, data.getvalue())
