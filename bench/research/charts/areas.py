# SPDX-License-Identifier: Apache-2.0
"""How far are the volumes' areas from the least?"""

from charts.drawing import (
    BLUE,
    GREEN,
    INK,
    ORANGE,
    RED,
    dot_panel,
    figure_of,
    mean,
    print_table,
    save,
    short,
)

STRATEGIES = (("k", BLUE), ("k2", ORANGE), ("k2 or axes", GREEN), ("k3", RED))
PLANES = (32, 48, 64, 128, 256)
KINDS = ("leaf", "small inner", "large inner")


def area_means(scenes, group):
    """Each method's area over the AABB's by kind of node, as means over the scenes."""
    means = {}
    for kind in range(len(KINDS)):
        ratios = [scene[group][kind]["ratio"] for scene in scenes]
        means[KINDS[kind]] = {name: mean(ratio[name] for ratio in ratios) for name in ratios[0]}
    return means


def draw(report, out):
    scenes = report["scenes"]
    for group, title in (
        ("sampled", "Area over the AABB's, 10,000 nodes per scene"),
        ("optimised", "The same with free normals, 1,000 nodes of each kind per scene"),
    ):
        means = area_means(scenes, group)
        print_table(
            title,
            ["volume", *KINDS],
            [[name, *(means[kind][name] for kind in KINDS)] for name in means[KINDS[0]]],
        )
        names = ("14-DOP", "OBB", "SOBB 32 k2", "SOBB 64 k2", "SOBB 64 k3", "SOBB 256 k3")
        if group == "sampled":
            continue
        print_table(
            "By scene, leaves / inner nodes of at most 64 triangles / larger ones",
            ["scene", *names, "free normals"],
            [
                [
                    short(scene["scene"]),
                    *(
                        " / ".join(f"{kind['ratio'][name]:.2f}" for kind in scene[group])
                        for name in (*names, "free normals")
                    ),
                ]
                for scene in scenes
            ],
        )
    means = area_means(scenes, "optimised")
    labels = ["14-DOP", "OBB", *(f"SOBB {k}" for k in PLANES), "free normals"]
    figure, axes = figure_of(3, len(labels), 11)
    for axis, kind in zip(axes, KINDS, strict=True):
        ratio = means[kind]
        single = [ratio["14-DOP"], ratio["OBB"], *[None] * len(PLANES), ratio["free normals"]]
        series = [
            (name, colour, [None, None, *(ratio[f"SOBB {k} {name}"] for k in PLANES), None])
            for name, colour in STRATEGIES
        ]
        dot_panel(axis, kind, labels, [*series, ("no choice", INK, single)], 1)
        axis.set_xlabel("area / AABB's area", fontsize=9)
    save(figure, axes[0], 5, out)
