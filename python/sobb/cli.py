# SPDX-License-Identifier: Apache-2.0
"""The command line: build, info, validate, render, demo, paper, peers, report, sweep, compare.

Exit codes: 0 done, 1 failed (the cause is on stderr), 2 wrong usage,
3 something got slower (compare).
"""

import argparse
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import sobb
from sobb.describe import describe_hierarchy, describe_scene, print_facts
from sobb.hierarchy import QUALITIES, STRATEGIES, TABLES, VOLUMES, Hierarchy, build
from sobb.progress import bar
from sobb.scene import Scene
from sobb.view import View, default_view, read_views

_MAX_SIDE = 16384
_SLOWER = 3

#: The extra of the package that a command needs, where that is another than "commands".
_EXTRAS = {"paper": "paper", "sweep": "sweep", "compare": "sweep", "report": "report"}


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs one command; returns its exit code (wrong usage exits with 2 by itself)."""
    options = _parser().parse_args(arguments)
    try:
        code = options.command(options)
        sys.stdout.flush()
        return code or 0
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # nobody reads on
        return 1
    except KeyboardInterrupt:
        return _fail("interrupted")
    except MemoryError:
        return _fail("out of memory")
    except ModuleNotFoundError as error:
        return _fail(f"{error}: install what this command needs, the extra sobb[{options.extra}]")
    except (sobb.Error, OSError, ValueError) as error:
        return _fail(str(error))


def _fail(message: str) -> int:
    print(f"sobb: {message}", file=sys.stderr)
    return 1


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="sobb", description=sobb.__doc__.split("\n")[0])
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    scene_help = (
        "a .gltf, .glb, .obj, .ply, .stl or .off file, or builtin:NAME[:TRIANGLES]; "
        "with ^4, ^16 or ^64 behind it refined to so many times its triangles, "
        "with @DEGREES turned about an oblique axis"
    )
    named_scene_help = f"{scene_help}; or the name of a file in the folder SOBB_SCENES"

    command = _add(commands, "build", _build, "build a hierarchy over a scene and save it")
    command.add_argument("scene", metavar="SCENE", help=scene_help)
    command.add_argument("-o", "--output", metavar="FILE", required=True, help="the .sobb to write")
    command.add_argument("--volume", choices=VOLUMES, default="sobb")
    command.add_argument("--k", type=int, choices=(32, 48, 64), default=64)
    command.add_argument("--quality", choices=QUALITIES, default="medium")
    command.add_argument("--strategy", choices=STRATEGIES, default="k2")
    command.add_argument(
        "--table",
        choices=TABLES,
        help="directions spread evenly, or fitted to the scene (SOBBs' default)",
    )
    command.add_argument("--width", type=int, choices=(4, 8), default=8)
    command.add_argument("--threads", type=_count, default=0, help="at most; 0 for all")

    command = _add(commands, "info", _info, "say what a scene or a .sobb file is")
    command.add_argument("source", metavar="SCENE_OR_FILE", help=f"a .sobb file; or {scene_help}")
    command.add_argument("--json", action="store_true", help="for machines, all that is known")

    command = _add(commands, "validate", _validate, "prove that a .sobb file is safe to trace")
    command.add_argument("file", metavar="FILE")

    command = _add(commands, "render", _render, "make a picture of a scene or a .sobb file")
    command.add_argument("source", metavar="SCENE_OR_FILE", help=f"a .sobb file; or {scene_help}")
    command.add_argument("-o", "--output", metavar="PNG", required=True, help="the PNG to write")
    command.add_argument("--view", type=_count, default=0, metavar="N", help="which view; 0")
    command.add_argument("--size", type=_size, default=(960, 540), metavar="WxH", help="960x540")
    command.add_argument(
        "--heat", action="store_true", help="show the volumes and triangles tested for each ray"
    )
    command.add_argument(
        "--cameras",
        metavar="FILE",
        help="a JSON file of views by the source's name; else the scene's own views. "
        "A .sobb has none: a default is made from its bounds",
    )

    command = _add(commands, "demo", _demo, "the whole way, against AABBs and Embree")
    command.add_argument("--scene", default="builtin:hairball", help=scene_help)
    command.add_argument("--out", default="out/demo", metavar="DIR", help="where the files go")
    command.add_argument("--cameras", metavar="FILE", help="a JSON file of views")

    command = _add(commands, "paper", _paper, "the paper's table: every bounding volume compared")
    command.add_argument(
        "--scenes",
        nargs="+",
        metavar="SCENE",
        help=f"{named_scene_help}. The default: the built-in ones at the paper's sizes, all .glb "
        "files of SOBB_SCENES, and four turned",
    )
    command.add_argument("--out", default="out/paper", metavar="DIR", help="where the files go")
    command.add_argument(
        "--quick", action="store_true", help="small rays and, by default, small built-in scenes"
    )
    command.add_argument("--cameras", metavar="FILE", help="a JSON file of views")
    command.add_argument("--threads", type=_count, default=0, help="at most; 0 for all")

    command = _add(commands, "peers", _peers, "rays a second beside Embree's, scene after scene")
    command.add_argument(
        "--scenes",
        nargs="+",
        metavar="SCENE",
        help=f"{named_scene_help}. The default: the built-in ones at the paper's sizes, all .glb "
        "files of SOBB_SCENES, and two turned",
    )
    command.add_argument("--cameras", metavar="FILE", help="a JSON file of views")
    command.add_argument("--threads", type=_count, default=1, help="of the tracing; 0 for all")
    command.add_argument("--isa", choices=("sse4", "avx2"), default="avx2", help="ours and theirs")
    command.add_argument("--size", type=_at_least_one, default=1024, help="primary rays: NxN")
    command.add_argument("--repetitions", type=_at_least_one, default=7)
    command.add_argument("--json", metavar="FILE", help="the figures for machines")

    command = _add(commands, "report", _report, "the results of a sweep as one page to look at")
    command.add_argument("results", metavar="RESULTS", help="the .duckdb file of a sweep")
    command.add_argument("--out", default="out/report", metavar="DIR", help="for index.html")
    command.add_argument("--no-pictures", action="store_true", help="draw no scenes: seconds")
    command.add_argument("--size", type=_size, default=(960, 540), metavar="WxH", help="960x540")
    command.add_argument(
        "--cameras", metavar="FILE", help="a JSON file of views; else that of the sweep"
    )

    command = _add(commands, "sweep", _sweep, "measure scenes × methods × options into a file")
    command.add_argument("spec", nargs="?", metavar="TOML", help="what to measure; docs/sweeps.md")
    command.add_argument("--scenes", nargs="+", metavar="SCENE", help=named_scene_help)
    command.add_argument("--methods", nargs="+", metavar="METHOD", help="aabb sobb embree")
    command.add_argument("--rays", nargs="+", metavar="RAYS", help="primary shadow diffuse1 …")
    command.add_argument("--size", type=_at_least_one, help="primary rays: NxN; 512")
    command.add_argument("--repetitions", type=_at_least_one, help="of each row; 5")
    command.add_argument("--out", default="results.duckdb", metavar="FILE", help="goes on there")
    command.add_argument("--retry", action="store_true", help="try cases that failed again")
    command.add_argument("--dask", metavar="ADDRESS", help="tcp://HOST:PORT of a Dask scheduler")

    command = _add(commands, "compare", _compare, "what got faster or slower from A to B")
    command.add_argument("a", metavar="A", help="a file of results, see sweep")
    command.add_argument("b", metavar="B", help="another, of the same sweep")
    command.add_argument(
        "--threshold", type=_fraction, default=0.05, help="smaller differences are none; 0.05"
    )
    command.add_argument("--json", action="store_true", help="for machines, all rows")
    return parser


def _add(commands, name: str, run: Callable[[argparse.Namespace], int | None], text: str):
    command = commands.add_parser(name, help=text, description=f"{text[0].upper()}{text[1:]}.")
    command.set_defaults(command=run, extra=_EXTRAS.get(name, "commands"))
    return command


def _count(text: str) -> int:
    value = int(text)
    if not 0 <= value < 1 << 32:
        raise argparse.ArgumentTypeError(f"{text} is out of range")
    return value


def _at_least_one(text: str) -> int:
    value = _count(text)
    if value == 0:
        raise argparse.ArgumentTypeError("0 is too small")
    return value


def _fraction(text: str) -> float:
    value = float(text)
    if not 0 <= value < 1:
        raise argparse.ArgumentTypeError(f"{text} is not from 0 to 1")
    return value


def _size(text: str) -> tuple[int, int]:
    try:
        width, height = (int(side) for side in text.split("x"))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not WIDTHxHEIGHT") from None
    if not (1 <= width <= _MAX_SIDE and 1 <= height <= _MAX_SIDE):
        raise argparse.ArgumentTypeError(f"{text}: sides are from 1 to {_MAX_SIDE}")
    return width, height


def _is_file(source: str) -> bool:
    return source.lower().endswith(".sobb")


def _build(options: argparse.Namespace) -> None:
    with Scene.load(options.scene) as scene, bar("build") as progress:
        hierarchy = build(
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
    hierarchy.save(options.output)
    info = hierarchy.info
    print(
        f"{options.output}: {info.triangles} triangles, {info.nodes} nodes, {info.bytes} bytes, "
        f"built in {info.total_ms:.0f} ms"
    )


def _info(options: argparse.Namespace) -> None:
    if _is_file(options.source):
        facts = describe_hierarchy(Hierarchy.open(options.source))
    else:
        facts = describe_scene(Scene.load(options.source))
    print_facts(facts, options.json)


def _validate(options: argparse.Namespace) -> None:
    info = Hierarchy.open(options.file).info
    print(f"{options.file}: valid, version {info.format_version}, {info.triangles} triangles")


def _render(options: argparse.Namespace) -> None:
    from PIL import Image  # here and below: building and asking need no pictures

    from sobb import heat, image, render

    hierarchy, views = _hierarchy_and_views(options.source, options.cameras)
    if options.view >= len(views):
        raise ValueError(f"{options.source}: no view {options.view}, there are {len(views)}")
    view, (width, height) = views[options.view], options.size
    with bar("render") as progress:
        if options.heat:
            work = render.work(hierarchy, view, width, height)
            picture = heat.picture(work, heat.shared_scale(work), hierarchy.info.volume.upper())
        else:
            picture = Image.fromarray(render.shaded(hierarchy, view, width, height, progress))
    image.write_png(options.output, picture)


def _hierarchy_and_views(source: str, cameras: str | None) -> tuple[Hierarchy, list[View]]:
    if _is_file(source):
        hierarchy = Hierarchy.open(source)
        if cameras is not None:
            return hierarchy, read_views(cameras, Path(source).stem)
        info = hierarchy.info
        return hierarchy, [default_view(info.bounds_min, info.bounds_max)]
    with Scene.load(source, views=cameras) as scene, bar("build") as progress:
        return build(scene, progress=progress), scene.views


def _demo(options: argparse.Namespace) -> None:
    from sobb import demo

    demo.run(options.scene, Path(options.out), options.cameras)


def _paper(options: argparse.Namespace) -> None:
    from sobb.paper import command

    out = Path(options.out)
    command.run(options.scenes, out, options.quick, options.cameras, options.threads)


def _peers(options: argparse.Namespace) -> None:
    from sobb.peers import command

    command.run(
        options.scenes,
        options.cameras,
        options.threads,
        options.isa,
        options.size,
        options.repetitions,
        Path(options.json) if options.json else None,
    )


def _report(options: argparse.Namespace) -> None:
    from sobb.report import command

    out = Path(options.out)
    command.run(options.results, out, not options.no_pictures, options.size, options.cameras)


def _sweep(options: argparse.Namespace) -> None:
    from sobb.sweep import command, spec

    keys = "scenes", "methods", "rays", "size", "repetitions"
    given = {key: getattr(options, key) for key in keys if getattr(options, key) is not None}
    if options.spec is None:
        sweep = spec.make(given, "the command line")
    else:
        sweep = spec.read(options.spec, given)
    command.run(sweep, Path(options.out), options.retry, options.dask)


def _compare(options: argparse.Namespace) -> int:
    from sobb.compare import command

    slower = command.run(Path(options.a), Path(options.b), options.threshold, options.json)
    return _SLOWER if slower else 0
