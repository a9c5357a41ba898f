# SPDX-License-Identifier: Apache-2.0
"""The command `sweep`: measures scenes, methods and options into a file of results."""

from argparse import ArgumentParser, Namespace
from pathlib import Path

from sobb.tools import arguments

HELP = "measure every combination of scenes, methods and options into a file of results"
EXTRA = "sweep"


def add_arguments(parser: ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument(
        "spec",
        nargs="?",
        metavar="TOML",
        help="a file that says what to measure (docs/sweeps.md); --scenes, --methods, --rays, "
        "--size and --repetitions replace its keys, and --scenes is needed without a file",
    )
    parser.add_argument("--scenes", nargs="+", metavar="SCENE", help=arguments.NAMED_SCENE)
    parser.add_argument(
        "--methods",
        nargs="+",
        metavar="METHOD",
        help="the hierarchies aabb, sobb and embree, which are the default, or other volumes "
        "(docs/sweeps.md)",
    )
    parser.add_argument(
        "--rays",
        nargs="+",
        metavar="RAYS",
        help="the kinds of rays: primary, shadow, diffuse1, diffuse7, random; all by default",
    )
    parser.add_argument(
        "--size",
        type=arguments.at_least_one,
        metavar="N",
        help="trace NxN primary rays; 512 by default",
    )
    parser.add_argument(
        "--repetitions",
        type=arguments.at_least_one,
        metavar="N",
        help="how often each figure is measured; 5 by default",
    )
    parser.add_argument(
        "--out",
        default="results.duckdb",
        metavar="FILE",
        help="the file of results; cases that it has already are not measured again; %(default)s "
        "by default",
    )
    parser.add_argument("--retry", action="store_true", help="measure again the cases that failed")
    parser.add_argument(
        "--dask",
        metavar="ADDRESS",
        help="measure on the workers of the Dask scheduler at tcp://HOST:PORT; by default this "
        "machine measures",
    )


def run(options: Namespace) -> None:
    """Does the command's work."""
    from sobb.tools.sweep import run, spec

    keys = "scenes", "methods", "rays", "size", "repetitions"
    given = {key: getattr(options, key) for key in keys if getattr(options, key) is not None}
    if options.spec is None:
        sweep = spec.make(given, "the command line")
    else:
        sweep = spec.read(options.spec, given)
    run.run(sweep, Path(options.out), options.retry, options.dask)
