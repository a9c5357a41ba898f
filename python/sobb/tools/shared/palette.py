# SPDX-License-Identifier: Apache-2.0
"""The colours of bounding volumes in charts, the same wherever a method is drawn.

They are those of M. Okabe and K. Ito, which the colour-blind tell apart.
"""

from typing import NamedTuple


class Colour(NamedTuple):
    """A colour for light paper, and the same hue for dark paper."""

    name: str
    light: str
    dark: str


GREY = Colour("grey", "#6f6f6c", "#a9a9a6")
ORANGE = Colour("orange", "#d55e00", "#ff8a3d")
GREEN = Colour("green", "#009e73", "#2fc79a")
BLUE = Colour("blue", "#0072b2", "#4fb0f0")
PURPLE = Colour("purple", "#aa4499", "#d583c6")
AMBER = Colour("amber", "#b87a00", "#ecb53a")

COLOURS = (GREY, ORANGE, GREEN, BLUE, PURPLE, AMBER)
