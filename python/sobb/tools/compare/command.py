# SPDX-License-Identifier: Apache-2.0
"""The command `compare`: says what got faster or slower between two files of results."""

from argparse import ArgumentParser, Namespace
from pathlib import Path

from sobb.tools import arguments

HELP = "say what got faster or slower from one file of results to another"
EXTRA = "sweep"

_SLOWER = 3


def add_arguments(parser: ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("a", metavar="A", help="the file of results before, as sweep writes it")
    parser.add_argument("b", metavar="B", help="the file of results after, of the same sweep")
    parser.add_argument(
        "--threshold",
        type=arguments.fraction,
        default=0.05,
        metavar="FRACTION",
        help="the least change of speed that counts as faster or slower; %(default)s by default",
    )
    parser.add_argument("--json", action="store_true", help="print all rows as one JSON object")


def run(options: Namespace) -> int:
    """Does the command's work; the exit code is 3 where something got slower."""
    from sobb.tools.compare import compare

    slower = compare.run(Path(options.a), Path(options.b), options.threshold, options.json)
    return _SLOWER if slower else 0
