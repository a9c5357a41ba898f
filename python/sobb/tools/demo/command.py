# SPDX-License-Identifier: Apache-2.0
"""The command `demo`: takes a scene from its triangles to a table against AABBs and Embree."""

from argparse import ArgumentParser, Namespace
from pathlib import Path

from sobb.tools import arguments

HELP = "load a scene, build, save, check and draw it, and compare it with AABBs and Embree"
EXTRA = "commands"


def add_arguments(parser: ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument(
        "--scene",
        default="builtin:hairball",
        metavar="SCENE",
        help=f"{arguments.SCENE}; %(default)s by default",
    )
    parser.add_argument(
        "--out",
        default="out/demo",
        metavar="DIR",
        help="the folder for the hierarchy and the pictures; %(default)s by default",
    )
    arguments.add_cameras(parser, "the views of the scene")


def run(options: Namespace) -> None:
    """Does the command's work."""
    from sobb.tools.demo import walkthrough

    walkthrough.run(options.scene, Path(options.out), options.cameras)
