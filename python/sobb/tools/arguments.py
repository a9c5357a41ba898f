# SPDX-License-Identifier: Apache-2.0
"""Arguments that several commands take: the types that check them, and their help texts."""

import argparse
from argparse import ArgumentTypeError

_MAX_SIDE = 16384

SCENE = (
    "a .gltf, .glb, .obj, .ply, .stl or .off file, or a built-in scene, builtin:NAME[:TRIANGLES]; "
    "^4, ^16 or ^64 behind it refines the scene to so many times its triangles, and @DEGREES "
    "turns it about an oblique axis"
)
SCENE_OR_FILE = f"a .sobb file; or a scene: {SCENE}"
NAMED_SCENE = f"{SCENE}; or the name of a file in the folder that SOBB_SCENES names"


def count(text: str) -> int:
    """A whole number that a uint32 holds."""
    value = _whole(text)
    if not 0 <= value < 1 << 32:
        raise ArgumentTypeError(f"{text} is not from 0 to 2^32 - 1")
    return value


def at_least_one(text: str) -> int:
    """A count that is not zero."""
    value = count(text)
    if value == 0:
        raise ArgumentTypeError("0 is too small")
    return value


def fraction(text: str) -> float:
    """A number from 0 to less than 1."""
    try:
        value = float(text)
    except ValueError:
        raise ArgumentTypeError(f"{text!r} is not a number") from None
    if not 0 <= value < 1:
        raise ArgumentTypeError(f"{text} is not from 0 to less than 1")
    return value


def size(text: str) -> tuple[int, int]:
    """The width and height of a picture, WIDTHxHEIGHT."""
    try:
        width, height = (int(side) for side in text.split("x"))
    except ValueError:
        raise ArgumentTypeError(f"{text!r} is not WIDTHxHEIGHT") from None
    if not (1 <= width <= _MAX_SIDE and 1 <= height <= _MAX_SIDE):
        raise ArgumentTypeError(f"{text}: sides are from 1 to {_MAX_SIDE}")
    return width, height


def add_picture_size(parser: argparse.ArgumentParser) -> None:
    """Adds --size, which is 960x540 by default."""
    parser.add_argument(
        "--size",
        type=size,
        default=(960, 540),
        metavar="WxH",
        help="width and height of a picture in pixels; 960x540 by default",
    )


def add_cameras(parser: argparse.ArgumentParser, otherwise: str) -> None:
    """Adds --cameras; the help says which views are taken without it."""
    parser.add_argument(
        "--cameras",
        metavar="FILE",
        help=f"a JSON file of views, by the names of scenes; by default {otherwise}",
    )


def add_threads(parser: argparse.ArgumentParser, default: int, what: str) -> None:
    """Adds --threads; `what` is the beginning of its help."""
    every = "one per processor that this process may use"
    chosen = f"by default {every}" if default == 0 else f"{default} by default, 0 for {every}"
    parser.add_argument(
        "--threads",
        type=count,
        default=default,
        metavar="N",
        help=f"{what}; {chosen}",
    )


def _whole(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise ArgumentTypeError(f"{text!r} is not a whole number") from None
