# SPDX-License-Identifier: Apache-2.0
"""The command `peers`: measures rays per second beside Embree's, scene after scene."""

from argparse import ArgumentParser, Namespace
from pathlib import Path

from sobb.tools import arguments
from sobb.tools.shared import isa

HELP = "measure rays per second beside Embree's, scene after scene"
EXTRA = "commands"


def add_arguments(parser: ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument(
        "--scenes",
        nargs="+",
        metavar="SCENE",
        help=f"{arguments.NAMED_SCENE}. By default the built-in scenes at the sizes of the "
        "paper's, all .glb files of SOBB_SCENES, and two of these turned",
    )
    arguments.add_cameras(parser, "the views of each scene")
    arguments.add_threads(parser, 1, "how many threads trace; builds take all")
    parser.add_argument(
        "--isa",
        choices=isa.EMBREE,
        default="avx2",
        help="the instruction set of both libraries; %(default)s by default",
    )
    parser.add_argument(
        "--size",
        type=arguments.at_least_one,
        default=1024,
        metavar="N",
        help="trace NxN primary rays; %(default)s by default",
    )
    parser.add_argument(
        "--repetitions",
        type=arguments.at_least_one,
        default=7,
        metavar="N",
        help="how often each figure is measured; the median is shown; %(default)s by default",
    )
    parser.add_argument("--json", metavar="FILE", help="write the figures to this file as JSON")


def run(options: Namespace) -> None:
    """Does the command's work."""
    from sobb.tools.peers import measure

    measure.run(
        options.scenes,
        options.cameras,
        options.threads,
        options.isa,
        options.size,
        options.repetitions,
        Path(options.json) if options.json else None,
    )
