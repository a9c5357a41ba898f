# SPDX-License-Identifier: Apache-2.0
"""What does another direction table bring?"""

from charts.drawing import (
    BLUE,
    GREEN,
    ORANGE,
    RED,
    dot_panel,
    figure_of,
    mean,
    print_table,
    save,
    short,
)

TURNED = "city, 8 turns"


def table_rows(scenes):
    """Ratios to the AABB's figures by scene (the turned towns as one) and table."""
    groups = {}
    for scene in scenes:
        turned = scene["scene"].startswith("builtin:city:60000@")
        groups.setdefault(TURNED if turned else short(scene["scene"]), []).append(scene)
    rows = {}
    for name, members in groups.items():
        rows[name] = {}
        for i, table in enumerate(members[0]["tables"][1:], 1):
            ratios = []
            for scene in members:
                box, this = scene["tables"][0], scene["tables"][i]
                area = {
                    key: this["binary"][key] / box["binary"][key]
                    for key in ("inner_area", "leaf_area")
                }
                work = {
                    f"{width} {key}": this[width]["work"][key] / box[width]["work"][key]
                    for width in ("binary", "wide")
                    for key in ("volumes", "triangles")
                }
                ratios.append(area | work)
            rows[name][table["table"]] = {
                key: mean(ratio[key] for ratio in ratios) for key in ratios[0]
            }
    return rows


def draw(report, out):
    rows = table_rows(report["scenes"])
    origins = (("paper", BLUE), ("separation", ORANGE), ("default", GREEN), ("fitted", RED))
    for k in (32, 48, 64):
        names = [
            f"{origin} {k}" if origin in ("default", "fitted") else f"{origin}-{k}"
            for origin, _ in origins
        ]
        print_table(
            f"k = {k}: inner area / leaf area; wide volumes / triangles per ray, over the AABB's",
            ["scene", *(origin for origin, _ in origins)],
            [
                [
                    scene,
                    *(
                        f"{tables[name]['inner_area']:.2f} / {tables[name]['leaf_area']:.2f}; "
                        f"{tables[name]['wide volumes']:.2f} / {tables[name]['wide triangles']:.2f}"
                        for name in names
                    ),
                ]
                for scene, tables in rows.items()
            ],
        )
    figure, axes = figure_of(3, len(rows), 12)
    panels = (
        ("inner_area", "area of inner nodes, binary"),
        ("leaf_area", "area of leaves, binary"),
        ("wide triangles", "triangles per ray, 8-wide"),
    )
    for axis, (key, title) in zip(axes, panels, strict=True):
        series = [
            (
                f"{origin} 64",
                colour,
                [
                    tables[f"{origin} 64" if origin in ("default", "fitted") else f"{origin}-64"][
                        key
                    ]
                    for tables in rows.values()
                ],
            )
            for origin, colour in origins
        ]
        dot_panel(axis, title, list(rows), series, 1)
        axis.set_xlabel("over the AABB's", fontsize=9)
    save(figure, axes[0], 4, out)
