# SPDX-License-Identifier: Apache-2.0
"""What does a basis shared by a node's children lose?"""

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


def draw(report, out):
    scenes = report["scenes"]
    rules = [rule["rule"] for rule in scenes[0]["widths"][0]["rules"]]
    figure, axes = figure_of(2, len(rules))
    for i, axis in enumerate(axes):
        width = scenes[0]["widths"][i]["width"]

        def ratio(scene, rule, key, i=i):
            own, this = (scene["widths"][i]["rules"][j] for j in (0, rule))
            of = (
                (lambda entry: entry[key])
                if key.endswith("area")
                else lambda entry: entry["work"][key]
            )
            return of(this) / of(own)

        keys = ("inner_area", "leaf_area", "volumes", "triangles")
        means = {
            key: [mean(ratio(scene, rule, key) for scene in scenes) for rule in range(len(rules))]
            for key in keys
        }
        print_table(
            f"Sharing, {width} children: over a basis for each child by k3, mean of the scenes",
            ["rule", *keys],
            [[name, *(means[key][rule] for key in keys)] for rule, name in enumerate(rules)],
        )
        chosen = [
            rules.index(name)
            for name in ("axes", "average k3", "sum k3", "sum or axes k2 weighted")
        ]
        print_table(
            f"Sharing, {width} children, by scene: volumes, triangles over a basis each by k3",
            ["scene", *(rules[rule] for rule in chosen)],
            [
                [
                    short(scene["scene"]),
                    *(
                        f"{ratio(scene, rule, 'volumes'):.3f}, "
                        f"{ratio(scene, rule, 'triangles'):.3f}"
                        for rule in chosen
                    ),
                ]
                for scene in scenes
            ],
        )
        series = [
            ("inner area", BLUE, means["inner_area"]),
            ("leaf area", ORANGE, means["leaf_area"]),
            ("volumes per ray", GREEN, means["volumes"]),
            ("triangles per ray", RED, means["triangles"]),
        ]
        dot_panel(axis, f"{width} children per node", rules, series, 1)
        axis.set_xlabel("over a basis for each child by k3", fontsize=9)
    save(figure, axes[0], 4, out)
