# SPDX-License-Identifier: Apache-2.0
"""Would clipping a child with its parent's interval pay?"""

from charts.drawing import BLUE, GREEN, ORANGE, dot_panel, figure_of, print_table, save, short


def steps(work):
    return work["nodes"] + work["leaves"]


def saved(rule):
    """The part of visits to nodes and leaves that clipping saves, in percent."""
    return 100 * (1 - steps(rule["clipped"]) / steps(rule["unclipped"]))


def draw(report, out):
    scenes = report["scenes"]
    rules = ("own k2", "sum or axes k2 weighted")
    titles = ("a basis for each child", "a basis shared by the node's children")
    for i, title in enumerate(titles):
        print_table(
            f"Clipping, {title}: nodes, leaves, triangles per ray without -> with",
            ["scene", *(f"width {entry['width']}" for entry in scenes[0]["widths"])],
            [
                [
                    short(scene["scene"]),
                    *(
                        "; ".join(
                            f"{entry['rules'][i]['unclipped'][key]:.1f} -> "
                            f"{entry['rules'][i]['clipped'][key]:.1f}"
                            for key in ("nodes", "leaves", "triangles")
                        )
                        + f" ({saved(entry['rules'][i]):.1f} %)"
                        for entry in scene["widths"]
                    ),
                ]
                for scene in scenes
            ],
        )
    ns_step = [scene["library"][1]["ns_step"] for scene in scenes]
    wide = [saved(scene["widths"][2]["rules"][1]) for scene in scenes]
    print_table(
        "Clipping: what it may cost per node, with the library's 8-wide nodes",
        ["scene", "ns per step", "saved", "break-even ns"],
        [
            [short(scene["scene"]), f"{ns:.0f}", f"{part:.1f} %", f"{ns * part / 100:.1f}"]
            for scene, ns, part in zip(scenes, ns_step, wide, strict=True)
        ],
    )
    figure, axes = figure_of(2, len(scenes))
    for axis, rule, title in zip(axes, range(len(rules)), titles, strict=True):
        series = [
            (
                f"{entry['width']} children",
                colour,
                [saved(scene["widths"][i]["rules"][rule]) for scene in scenes],
            )
            for i, (entry, colour) in enumerate(
                zip(scenes[0]["widths"], (BLUE, ORANGE, GREEN), strict=True)
            )
        ]
        dot_panel(axis, title, [short(scene["scene"]) for scene in scenes], series, 0)
        axis.set_xlabel("visits saved, %", fontsize=9)
    save(figure, axes[0], 3, out)
