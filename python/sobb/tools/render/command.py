# SPDX-License-Identifier: Apache-2.0
"""The command `render`: makes a picture of a scene or a .sobb file."""

from argparse import ArgumentParser, Namespace
from pathlib import Path

from sobb.hierarchy import Hierarchy, build
from sobb.scene import Scene
from sobb.tools import arguments
from sobb.tools.shared.progress import bar
from sobb.view import View, default_view, read_views

HELP = "make a picture of a scene or a .sobb file"
EXTRA = "commands"


def add_arguments(parser: ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("source", metavar="SCENE_OR_FILE", help=arguments.SCENE_OR_FILE)
    parser.add_argument(
        "-o", "--output", metavar="PNG", required=True, help="the PNG file to write"
    )
    parser.add_argument(
        "--view",
        type=arguments.count,
        default=0,
        metavar="N",
        help="the number of the view, from 0; %(default)s by default",
    )
    arguments.add_picture_size(parser)
    parser.add_argument(
        "--heat",
        action="store_true",
        help="show how many volumes and triangles each ray tests, with a scale beside the picture",
    )
    arguments.add_cameras(
        parser, "the views of the scene; a .sobb file has none, and is seen from outside its bounds"
    )


def run(options: Namespace) -> None:
    """Does the command's work."""
    from PIL import Image

    from sobb.tools.render import heat, image, shading

    hierarchy, views = _hierarchy_and_views(options.source, options.cameras)
    if options.view >= len(views):
        raise ValueError(f"{options.source}: no view {options.view}, there are {len(views)}")
    view, (width, height) = views[options.view], options.size
    with bar("render") as progress:
        if options.heat:
            work = heat.work(hierarchy, view, width, height)
            picture = heat.picture(work, heat.shared_scale(work), hierarchy.info.volume.upper())
        else:
            picture = Image.fromarray(shading.shaded(hierarchy, view, width, height, progress))
    image.write_png(options.output, picture)


def _hierarchy_and_views(source: str, cameras: str | None) -> tuple[Hierarchy, list[View]]:
    if source.lower().endswith(".sobb"):
        hierarchy = Hierarchy.open(source)
        if cameras is not None:
            return hierarchy, read_views(cameras, Path(source).stem)
        info = hierarchy.info
        return hierarchy, [default_view(info.bounds_min, info.bounds_max)]
    with Scene.load(source, views=cameras) as scene, bar("build") as progress:
        return build(scene, progress=progress), scene.views
