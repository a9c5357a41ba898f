#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Turns sobb_study's answers, docs/data/study-*.json, into charts and tables of docs/study.md.

A developer's tool; needs Matplotlib. Charts: docs/images/study-QUESTION.svg. Tables are printed.
"""

import argparse
import json
import math
import pathlib
import sys
from collections.abc import Sequence

from matplotlib import rc_context
from matplotlib.figure import Figure

ROOT = pathlib.Path(__file__).resolve().parent.parent
# M. Okabe, K. Ito, "Color Universal Design" (2008): told apart by every kind of colour vision.
BLUE, ORANGE, GREEN, RED, PURPLE, INK = (
    "#0072B2",
    "#E69F00",
    "#009E73",
    "#D55E00",
    "#CC79A7",
    "#222222",
)
MARKERS = "osD^vP"
GRID = "#DDDDDD"


def mean(values):
    """The geometric mean, as ratios want."""
    values = list(values)
    return math.exp(sum(map(math.log, values)) / len(values))


def short(scene):
    """A scene's name without where it comes from."""
    return scene.removeprefix("builtin:").replace(".glb", "")


def pretty(name):
    """A name as the documents spell it."""
    return name.replace("k2", "k²").replace("k3", "k³")


def print_table(title, head, rows):
    print(f"\n{title}\n")
    print("| " + " | ".join(map(pretty, head)) + " |")
    print("|---" * len(head) + "|")
    for row in rows:
        print(
            "| "
            + " | ".join(pretty(cell) if isinstance(cell, str) else f"{cell:.3f}" for cell in row)
            + " |"
        )


def dot_panel(axis, title, labels, series, reference=None):
    """Marks in rows. `series` is a list of (name, colour, values), None where there is none."""
    axis.set_title(title, fontsize=10, color=INK, loc="left")
    axis.set_yticks(range(len(labels)), list(map(pretty, labels)), fontsize=9)
    axis.set_ylim(len(labels) - 0.5, -0.5)
    axis.grid(axis="x", color=GRID, linewidth=0.7)
    axis.tick_params(length=0, labelsize=9, colors=INK)
    for row in range(0, len(labels), 2):
        axis.axhspan(row - 0.5, row + 0.5, color="#F5F5F5", linewidth=0, zorder=0)
    if reference is not None:
        axis.axvline(reference, color=INK, linewidth=1, zorder=1)
    crowd = [sum(values[row] is not None for _, _, values in series) for row in range(len(labels))]
    for i, (name, colour, values) in enumerate(series):
        shown = [(value, row) for row, value in enumerate(values) if value is not None]
        # One below the other within the row, so that equal values stay readable.
        step = 0.5 * (i / max(len(series) - 1, 1) - 0.5)
        axis.scatter(
            [value for value, _ in shown],
            [row + (step if crowd[row] > 1 else 0) for _, row in shown],
            s=34,
            color=colour,
            marker=MARKERS[i % len(MARKERS)],
            label=pretty(name),
            zorder=3,
        )
    for side in ("top", "right", "left"):
        axis.spines[side].set_visible(False)


def save(figure, axis, columns, path):
    handles, labels = axis.get_legend_handles_labels()
    figure.legend(
        handles, labels, loc="outside lower center", ncol=columns, fontsize=9, frameon=False
    )
    kind = path.suffix[1:]
    # Equal figures make equal files: no date, no random names.
    with rc_context({"svg.hashsalt": "sobb"}):
        figure.savefig(path, dpi=110, metadata={"Date": None} if kind == "svg" else None)


def figure_of(panels, rows, width=10.0):
    figure = Figure(figsize=(width, 1.6 + 0.42 * rows), facecolor="white", layout="constrained")
    return figure, figure.subplots(1, panels, sharey=True, squeeze=False)[0]


# ------------------------------------------------------------------------------------ areas --

STRATEGIES = (("k", BLUE), ("k2", ORANGE), ("k2 or axes", GREEN), ("k3", RED))
PLANES = (32, 48, 64, 128, 256)
KINDS = ("leaf", "small inner", "large inner")


def area_means(scenes, group):
    """By kind of node: each method's area over the AABB's, the mean over the scenes."""
    means = {}
    for kind in range(len(KINDS)):
        ratios = [scene[group][kind]["ratio"] for scene in scenes]
        means[KINDS[kind]] = {name: mean(ratio[name] for ratio in ratios) for name in ratios[0]}
    return means


def draw_areas(report, out):
    scenes = report["scenes"]
    for group, title in (
        ("sampled", "Area over the AABB's, 10,000 nodes a scene"),
        ("optimised", "The same with free normals, 1,000 nodes of each kind a scene"),
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


# ----------------------------------------------------------------------------------- tables --

TURNED = "city, 8 turns"


def table_rows(scenes):
    """By scene (the turned towns as one) and table: ratios to the AABB's figures."""
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


def draw_tables(report, out):
    rows = table_rows(report["scenes"])
    origins = (("paper", BLUE), ("separation", ORANGE), ("default", GREEN), ("fitted", RED))
    for k in (32, 48, 64):
        names = [
            f"{origin} {k}" if origin in ("default", "fitted") else f"{origin}-{k}"
            for origin, _ in origins
        ]
        print_table(
            f"k = {k}: inner area / leaf area; wide volumes / triangles a ray, over the AABB's",
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
        ("wide triangles", "triangles a ray, 8-wide"),
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


# --------------------------------------------------------------------------------- clipping --


def steps(work):
    return work["nodes"] + work["leaves"]


def saved(rule):
    """The part of visits to nodes and leaves that clipping saves, in percent."""
    return 100 * (1 - steps(rule["clipped"]) / steps(rule["unclipped"]))


def draw_clipping(report, out):
    scenes = report["scenes"]
    rules = ("own k2", "sum or axes k2 weighted")
    titles = ("a basis for each child", "a basis shared by the node's children")
    for i, title in enumerate(titles):
        print_table(
            f"Clipping, {title}: nodes, leaves, triangles a ray without -> with",
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
        "Clipping: what it may cost a node, with the library's 8-wide nodes",
        ["scene", "ns a step", "saved", "break-even ns"],
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


# ---------------------------------------------------------------------------------- sharing --


def draw_sharing(report, out):
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
            ("volumes a ray", GREEN, means["volumes"]),
            ("triangles a ray", RED, means["triangles"]),
        ]
        dot_panel(axis, f"{width} children a node", rules, series, 1)
        axis.set_xlabel("over a basis for each child by k3", fontsize=9)
    save(figure, axes[0], 4, out)


# ------------------------------------------------------------------------------- topologies --

# What makes a row of the report: splits, leaves, collapse.
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
    """Of a binary hierarchy that of the wide one that is collapsed from it as today."""
    splits, leaves, collapse = name
    return HIERARCHIES[splits, leaves, "greedy-aabb" if collapse == "none" else collapse]


def hierarchies_of(scene, layout):
    """By splits, leaves and collapse: the report's rows of a layout."""
    return {
        (row["splits"], row["leaves_by"], row["collapse"]): row
        for row in scene["hierarchies"]
        if row["layout"] == layout
    }


def over_todays(scene, layout):
    """By splits, leaves and collapse: figures over those of the library's own hierarchy."""
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


def draw_topologies(report, out):
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
        "Topologies, 8-wide, by scene: nodes, blocks a secondary ray; rays a second",
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
        "Topologies: depth, mean depth of leaves, binary and 8-wide; processor ms a million",
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
        ("secondary nodes", "nodes a secondary ray"),
        ("secondary blocks", "triangle blocks a secondary ray"),
        ("secondary Mrays/s", "secondary rays a second"),
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


QUESTIONS = {
    "areas": draw_areas,
    "tables": draw_tables,
    "clipping": draw_clipping,
    "sharing": draw_sharing,
    "topologies": draw_topologies,
}


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("questions", nargs="*", metavar="QUESTION", help=", ".join(QUESTIONS))
    parser.add_argument("--data", type=pathlib.Path, default=ROOT / "docs/data")
    parser.add_argument("--images", type=pathlib.Path, default=ROOT / "docs/images")
    parser.add_argument("--format", choices=("svg", "png"), default="svg")
    chosen = parser.parse_args(arguments)
    for question in chosen.questions or QUESTIONS:
        if question not in QUESTIONS:
            parser.error(f"no question {question}; there are {', '.join(QUESTIONS)}")
        data = chosen.data / f"study-{question}.json"
        report = json.loads(data.read_text(encoding="utf-8"))
        QUESTIONS[question](report, chosen.images / f"study-{question}.{chosen.format}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
