# SPDX-License-Identifier: Apache-2.0
"""Are hierarchies built for AABBs the right ones?"""

from charts.drawing import (
    BLUE,
    GREEN,
    INK,
    ORANGE,
    dot_panel,
    figure_of,
    mean,
    print_table,
    save,
    short,
)

# Splits, leaves and collapse identify a row of the report.
HIERARCHIES = {
    ("embree", "embree", "greedy-aabb"): "today's",
    ("embree", "embree", "greedy-sobb"): "greedy by SOBB",
    ("embree", "embree", "exact-aabb"): "exact by AABB",
    ("embree", "embree", "exact-sobb"): "exact by SOBB",
    ("embree", "embree", "exact-sharing"): "exact, shared basis",
    ("embree", "aabb", "greedy-aabb"): "leaves by AABB",
    ("embree", "sobb", "greedy-aabb"): "leaves by SOBB",
    ("embree", "aabb", "exact-aabb"): "leaves + exact by AABB",
    ("embree", "sobb", "exact-sobb"): "leaves + exact by SOBB",
    ("embree", "sobb", "exact-sharing"): "leaves + exact, shared",
    ("aabb", "aabb", "greedy-aabb"): "splits by AABB",
    ("sobb", "sobb", "greedy-aabb"): "splits by SOBB",
    ("sobb-fibres", "sobb", "greedy-aabb"): "  + fibres",
    ("sobb-all-directions", "sobb", "greedy-aabb"): "  + 32 directions",
    ("sobb-all-directions-fibres", "sobb", "exact-sharing"): "all of it",
}
HAIR = ("hairball", "wool", "sintel-hair")


def label_of(name):
    """The label of a hierarchy. A binary one has that of its wide one with today's collapse."""
    splits, leaves, collapse = name
    return HIERARCHIES[splits, leaves, "greedy-aabb" if collapse == "none" else collapse]


def hierarchies_of(scene, layout):
    """The rows that a report has of a layout, by splits, leaves and collapse."""
    return {
        (row["splits"], row["leaves_by"], row["collapse"]): row
        for row in scene["hierarchies"]
        if row["layout"] == layout
    }


def over_todays(scene, layout):
    """Figures over those of the first, today's, hierarchy, by splits, leaves and collapse."""
    rows = hierarchies_of(scene, layout)
    own = next(iter(rows.values()))
    ratios = {}
    for name, row in rows.items():
        ratios[name] = {
            key: row[key] / own[key]
            for key in ("area_inner", "area_leaf", "mean_leaf_depth", "nodes", "depth")
        }
        for kind in ("primary", "secondary"):
            for key, value in row[kind].items():
                ratios[name][f"{kind} {key}"] = value / own[kind][key]
    return ratios


def draw(report, out):
    scenes = report["scenes"]
    keys = ("area_inner", "area_leaf", "mean_leaf_depth", "nodes")
    work = [f"secondary {key}" for key in ("nodes", "volumes", "blocks", "triangles")]
    for layout in ("wide", "binary"):
        ratios = [over_todays(scene, layout) for scene in scenes]
        rays = [*work, "secondary Mrays/s"] if layout == "wide" else work
        print_table(
            f"Topologies, {layout}: over today's, mean of the scenes",
            ["hierarchy", *keys, *rays],
            [
                [
                    label_of(name),
                    *(mean(scene[name][key] for scene in ratios) for key in (*keys, *rays)),
                ]
                for name in ratios[0]
            ],
        )
    wide = {short(scene["scene"]): over_todays(scene, "wide") for scene in scenes}
    print_table(
        "Topologies, 8-wide, by scene: nodes, blocks per secondary ray; rays per second",
        ["hierarchy", *wide],
        [
            [
                label,
                *(
                    f"{rows[name]['secondary nodes']:.2f}, {rows[name]['secondary blocks']:.2f}; "
                    f"{rows[name]['secondary Mrays/s']:.2f}"
                    for rows in wide.values()
                ),
            ]
            for name, label in HIERARCHIES.items()
        ],
    )

    def per_million(name, key, all_rows):
        return (
            1e6 * rows[name][key] / scene["triangles"]
            for rows, scene in zip(all_rows, scenes, strict=True)
        )

    print_table(
        "Topologies: depth, mean depth of leaves, binary and 8-wide; ms per million triangles",
        ["hierarchy", "layout", "deepest", "mean depth", "splits", "areas and collapse"],
        [
            [
                label_of(name),
                layout,
                *(
                    f"{mean(rows[name][key] for rows in all_rows):.2f}"
                    for key in ("depth", "mean_leaf_depth")
                ),
                *(
                    f"{mean(max(ms, 1e-3) for ms in per_million(name, key, all_rows)):.0f}"
                    for key in ("topology_ms", "collapse_ms")
                ),
            ]
            for layout in ("binary", "wide")
            for all_rows in [[hierarchies_of(scene, layout) for scene in scenes]]
            for name in all_rows[0]
        ],
    )
    groups = (
        ("hair", BLUE, [wide[name] for name in wide if name in HAIR]),
        ("turned town", ORANGE, [wide[name] for name in wide if "@" in name]),
        ("pipes", GREEN, [wide[name] for name in wide if name == "pipes"]),
        ("the rest", INK, [wide[n] for n in wide if n not in (*HAIR, "pipes") and "@" not in n]),
    )
    figure, axes = figure_of(3, len(HIERARCHIES), 12)
    panels = (
        ("secondary nodes", "nodes per secondary ray"),
        ("secondary blocks", "triangle blocks per secondary ray"),
        ("secondary Mrays/s", "secondary rays per second"),
    )
    for axis, (key, title) in zip(axes, panels, strict=True):
        series = [
            (name, colour, [mean(rows[way][key] for rows in members) for way in HIERARCHIES])
            for name, colour, members in groups
            if members
        ]
        dot_panel(axis, title, list(HIERARCHIES.values()), series, 1)
        axis.set_xlabel("over today's", fontsize=9)
    save(figure, axes[0], 4, out)
