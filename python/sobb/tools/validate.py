# SPDX-License-Identifier: Apache-2.0
"""The command `validate`: proves that a .sobb file is safe to trace."""

from argparse import ArgumentParser, Namespace

from sobb.hierarchy import Hierarchy

HELP = "prove that a .sobb file is safe to trace"
EXTRA = "commands"


def add_arguments(parser: ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("file", metavar="FILE", help="the .sobb file to read")


def run(options: Namespace) -> None:
    """Does the command's work."""
    info = Hierarchy.open(options.file).info
    print(f"{options.file}: valid, version {info.format_version}, {info.triangles} triangles")
