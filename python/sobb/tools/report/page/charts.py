# SPDX-License-Identifier: Apache-2.0
"""The charts in Vega-Lite, which name their data; the page holds the data once for all charts.

`rays` and `call` are parameters that the page's own controls set. Colours are the page's CSS
variables: an SVG's attributes are CSS, so charts turn dark, and print, as the page does.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import altair as alt

from sobb.tools.report.method import Variant
from sobb.tools.report.page.points import Point

Spec = dict[str, Any]

_CHOSEN = "datum.rays === rays && datum.call === call"
_RATIOS = [
    1 / 8,
    1 / 4,
    *(i / 10 for i in range(5, 20)),
    *(i / 2 for i in range(4, 10)),
    5,
    6,
    8,
    10,
]
_SHAPES = ("circle", "square", "triangle-up", "diamond", "triangle-down", "cross")
_ROW = 15  # pixels per variant on a scene
_SPEED, _BUILD = "speed over AABB, ×", "build time over AABB, ×"


@dataclass(frozen=True)
class Chart:
    """A chart of one or more panels; without panels, the text that says why."""

    title: str
    text: str
    panels: list[tuple[str, Spec]]
    without: str


def all_charts(found: Sequence[Point], drawn: Sequence[Variant]) -> list[Chart]:
    """Returns the charts of a page. `drawn` has all variants, in the order of the legends."""
    marks = _marks(drawn)
    compared = [point for point in found if point["speed"] is not None and not point["base"]]
    built = [point for point in compared if point["build"] is not None]
    worked = [point for point in found if point["volumes"] is not None]
    curves: dict[str, set[int]] = {}
    for point in found:
        curves.setdefault(point["curve"], set()).add(point["triangles"])
    curves = {name: sizes for name, sizes in curves.items() if len(sizes) > 1}
    no_base = "Nothing to compare: AABBs were not measured beside another method."
    return [
        Chart(
            "Speed by scene and method",
            "The speed over that of AABBs, on a logarithmic scale.",
            [("", _speed(compared, marks))] if compared else [],
            no_base,
        ),
        Chart(
            "What a build costs, and what it gains",
            "Large points are geometric means over the scenes, small points are single scenes. Up "
            "and to the left is better. The dashed line joins the variants that no other beats in "
            "both (the Pareto front).",
            [("", _gain(marks))] if built else [],
            no_base,
        ),
        Chart(
            "Cost against triangles",
            "The time per ray of a scene as Loop subdivision multiplies its triangles.",
            [(name, _size(name, marks)) for name in curves],
            "No scene was measured at more than one subdivision.",
        ),
        Chart(
            "Volumes tested against time",
            "Each point is a method on a scene. Where points of one colour rise faster than their "
            "volumes, something else costs time: triangles, or memory. Volumes are those that "
            "single rays test.",
            [("", _work(marks))] if worked else [],
            "No volumes were counted.",
        ),
    ]


def noise(variations: Sequence[float]) -> Spec:
    """Draws a histogram of the figures' coefficients of variation."""
    values = alt.InlineData(values=[{"variation": 100 * v} for v in variations])
    bins = alt.Bin(maxbins=30)
    axis = alt.Axis(tickCount=8, grid=False)
    chart = alt.Chart(values).mark_bar(color="var(--accent)")
    return _spec(
        chart.encode(
            alt.X("variation:Q", bin=bins, title="coefficient of variation, %", axis=axis),
            alt.Y("count()", title="figures"),
            tooltip=[alt.Tooltip("count()", title="figures")],
        ),
        180,
    )


def _speed(compared: Sequence[Point], marks: dict[str, Any]) -> Spec:
    rows = len({(point["scene"], point["variant"]) for point in compared})
    axis = alt.Axis(ticks=False, domain=False, labelPadding=8, grid=True, bandPosition=0)
    of_variant = _points("datum.speed !== null && !datum.base").encode(
        alt.X("speed:Q", title=_SPEED, scale=_log(), axis=_ratios()),
        alt.Y("scene:N", sort=None, title=None, axis=axis),
        yOffset=alt.YOffset("variant:N", sort=None, scale=alt.Scale(paddingOuter=0.6)),
        color=marks["color"],
    )
    one = alt.Chart(alt.InlineData(values=[{}])).mark_rule(color="var(--muted)")
    stems = of_variant.mark_rule(strokeWidth=2.5, opacity=0.4).encode(x2=alt.datum(1))
    dots = of_variant.mark_point(filled=True, size=90, opacity=1)
    dots = dots.encode(shape=marks["shape"], tooltip=_tooltip("speed", "mrays"))
    layers = alt.layer(one.encode(alt.XDatum(1)), stems, dots)
    return _spec((layers), max(rows * _ROW + 30, 110))


def _gain(marks: dict[str, Any]) -> Spec:
    axis = _ratios()
    place = {
        "x": alt.X("build:Q", title=_BUILD, scale=_log(30), axis=axis),
        "y": alt.Y("speed:Q", title=_SPEED, scale=_log(30), axis=axis),
    }
    known = "datum.speed !== null && datum.build !== null && !datum.base"
    scenes = _points(known).mark_point(filled=True, size=30, opacity=0.4)
    scenes = scenes.encode(**place, **marks, tooltip=_tooltip("speed", "build"))
    means = _points("true", "means").encode(**place)
    dots = means.mark_point(filled=True, size=170, opacity=1)
    dots = dots.encode(**marks, tooltip=_tooltip("speed", "build", "front"))
    names = means.mark_text(align="left", dx=11, dy=-9, color="var(--ink)", fontSize=12)
    front = _points("datum.front", "means").encode(**place, order="build:Q")
    line = front.mark_line(interpolate="step-after", strokeDash=[4, 3], color="var(--muted)")
    layers = alt.layer(line, scenes, dots, names.encode(text="variant:N"))
    return _spec((layers), 360)


def _size(curve: str, marks: dict[str, Any]) -> Spec:
    axis = alt.Axis(format="~s", tickCount=4)
    of_curve = (
        _points("true")
        .transform_filter(alt.FieldEqualPredicate(field="curve", equal=curve))
        .encode(
            alt.X("triangles:Q", title="triangles", scale=_log(), axis=axis),
            alt.Y("ns:Q", title="ns per ray", scale=_log(), axis=axis),
            color=marks["color"],
        )
    )
    dots = of_curve.mark_point(filled=True, size=60, opacity=1)
    dots = dots.encode(shape=marks["shape"], tooltip=_tooltip("ns", "triangles"))
    return _spec((alt.layer(of_curve.mark_line(strokeWidth=2), dots)), 240)


def _work(marks: dict[str, Any]) -> Spec:
    axis = alt.Axis(format="~s", tickCount=6)
    dots = _points("datum.volumes !== null").mark_point(filled=True, size=80, opacity=0.9)
    dots = dots.encode(
        alt.X("volumes:Q", title="volumes tested per ray", scale=_log(), axis=axis),
        alt.Y("ns:Q", title="ns per ray", scale=_log(), axis=axis),
        **marks,
        tooltip=_tooltip("volumes", "tests", "ns"),
    )
    return _spec((dots), 340)


def _points(condition: str, data: str = "points") -> alt.Chart:
    chart = alt.Chart(alt.NamedData(data))
    return chart.transform_filter(f"{_CHOSEN} && {condition}")


def _ratios() -> alt.Axis:
    return alt.Axis(values=_RATIOS, format="~r", labelSeparation=8)


def _log(padding: int = 16) -> alt.Scale:
    return alt.Scale(type="log", nice=False, padding=padding)


def _marks(drawn: Sequence[Variant]) -> dict[str, Any]:
    """Returns colours and shapes: variants have their method's colour, and differ in shape."""
    colours = [variant.colour.name for variant in drawn]
    shapes = [_SHAPES[colours[:i].count(c) % len(_SHAPES)] for i, c in enumerate(colours)]
    titles = [variant.title for variant in drawn]
    paints = [f"var(--{colour})" for colour in colours]
    return {
        "color": alt.Color("variant:N", title=None, scale=alt.Scale(domain=titles, range=paints)),
        "shape": alt.Shape("variant:N", title=None, scale=alt.Scale(domain=titles, range=shapes)),
    }


_TIPS = {
    "speed": alt.Tooltip("speed:Q", title="speed over AABB", format=".2f"),
    "build": alt.Tooltip("build:Q", title="build over AABB", format=".2f"),
    "mrays": alt.Tooltip("mrays:Q", title="Mrays/s", format=".2f"),
    "ns": alt.Tooltip("ns:Q", title="ns per ray", format=".1f"),
    "volumes": alt.Tooltip("volumes:Q", title="volumes per ray", format=".1f"),
    "tests": alt.Tooltip("tests:Q", title="triangles per ray", format=".1f"),
    "triangles": alt.Tooltip("triangles:Q", format=","),
    "front": alt.Tooltip("front:N", title="on the front"),
}


def _tooltip(*names: str) -> list[alt.Tooltip]:
    where = [alt.Tooltip("scene:N"), alt.Tooltip("variant:N", title="method")]
    return where + [_TIPS[name] for name in names]


def _spec(chart: alt.Chart | alt.LayerChart, height: int) -> Spec:
    fit = alt.AutoSizeParams(type="fit-x", contains="padding")
    spec = chart.properties(width="container", height=height, autosize=fit).to_dict()
    del spec["config"]  # the page has one for all charts
    return spec
