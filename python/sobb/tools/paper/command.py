# SPDX-License-Identifier: Apache-2.0
"""The command `paper`: measures every bounding volume and writes the paper's table."""

from argparse import ArgumentParser, Namespace
from pathlib import Path

from sobb.tools import arguments

HELP = "make the paper's table, which compares all bounding volumes"
EXTRA = "paper"


def add_arguments(parser: ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument(
        "--scenes",
        nargs="+",
        metavar="SCENE",
        help=f"{arguments.NAMED_SCENE}. By default the built-in scenes at the sizes of the "
        "paper's, all .glb files of SOBB_SCENES, and four of these turned",
    )
    parser.add_argument(
        "--out",
        default="out/paper",
        metavar="DIR",
        help="the folder for the table as Markdown, CSV and LaTeX, and the chart; %(default)s by "
        "default",
    )
    parser.add_argument(
        "--quick",
        action="store_true",
        help="trace few rays and, unless scenes are named, small built-in scenes",
    )
    arguments.add_cameras(parser, "the views of each scene")
    arguments.add_threads(parser, 0, "how many threads build and trace")


def run(options: Namespace) -> None:
    """Does the command's work."""
    from sobb.tools.paper import measure

    measure.run(options.scenes, Path(options.out), options.quick, options.cameras, options.threads)
