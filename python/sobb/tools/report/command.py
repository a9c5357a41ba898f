# SPDX-License-Identifier: Apache-2.0
"""The command `report`: makes one HTML page of the results of a sweep."""

from argparse import ArgumentParser, Namespace
from pathlib import Path

from sobb.tools import arguments

HELP = "make one HTML page of the results of a sweep"
EXTRA = "report"


def add_arguments(parser: ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("results", metavar="RESULTS", help="the .duckdb file of a sweep")
    parser.add_argument(
        "--out",
        default="out/report",
        metavar="DIR",
        help="the folder for index.html; %(default)s by default",
    )
    parser.add_argument(
        "--no-pictures",
        action="store_true",
        help="draw no scenes, so that the page is made in seconds",
    )
    arguments.add_picture_size(parser)
    arguments.add_cameras(parser, "the file that the sweep was given")


def run(options: Namespace) -> None:
    """Does the command's work."""
    from sobb.tools.report import write

    pictures = not options.no_pictures
    write.run(options.results, Path(options.out), pictures, options.size, options.cameras)
