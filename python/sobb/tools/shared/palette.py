# SPDX-License-Identifier: Apache-2.0
"""Colours of bounding volumes in charts: M. Okabe and K. Ito's, which the colour-blind tell apart.

A method has the same colour wherever it is drawn.
"""

from typing import NamedTuple


class Colour(NamedTuple):
    """A colour on white, and the same hue on black."""

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
