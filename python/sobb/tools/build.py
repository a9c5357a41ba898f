# SPDX-License-Identifier: Apache-2.0
"""The command `build`: builds a hierarchy over a scene and saves it."""

from argparse import ArgumentParser, Namespace

from sobb import hierarchy
from sobb.info import QUALITIES, STRATEGIES, TABLES, VOLUMES
from sobb.scene import Scene
from sobb.tools import arguments
from sobb.tools.shared.progress import bar

HELP = "build a hierarchy over a scene and save it"
EXTRA = "commands"


def add_arguments(parser: ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("scene", metavar="SCENE", help=arguments.SCENE)
    parser.add_argument(
        "-o", "--output", metavar="FILE", required=True, help="the .sobb file to write"
    )
    parser.add_argument(
        "--volume",
        choices=VOLUMES,
        default="sobb",
        help="the bounding volume, axis-aligned or skewed; %(default)s by default",
    )
    parser.add_argument(
        "--k",
        type=int,
        choices=(32, 48, 64),
        default=64,
        help="planes of the k-DOP that SOBBs are chosen from; %(default)s by default",
    )
    parser.add_argument(
        "--quality",
        choices=QUALITIES,
        default="medium",
        help="how much time the build takes to make rays fast; %(default)s by default",
    )
    parser.add_argument(
        "--strategy",
        choices=STRATEGIES,
        default="k2",
        help="how a SOBB's three directions are searched: k is the fastest, k3 tries all; "
        "%(default)s by default",
    )
    parser.add_argument(
        "--table",
        choices=TABLES,
        help="directions spread evenly, or fitted to the scene; fitted by default for SOBBs",
    )
    parser.add_argument(
        "--width",
        type=int,
        choices=(4, 8),
        default=8,
        help="children per node; %(default)s by default",
    )
    arguments.add_threads(parser, 0, "how many threads build at most")


def run(options: Namespace) -> None:
    """Does the command's work."""
    with Scene.load(options.scene) as scene, bar("build") as progress:
        built = hierarchy.build(
            scene,
            volume=options.volume,
            k=options.k,
            quality=options.quality,
            strategy=options.strategy,
            table=options.table,
            width=options.width,
            threads=options.threads,
            progress=progress,
        )
    built.save(options.output)
    info = built.info
    print(
        f"{options.output}: {info.triangles} triangles, {info.nodes} nodes, {info.bytes} bytes, "
        f"built in {info.total_ms:.0f} ms"
    )
