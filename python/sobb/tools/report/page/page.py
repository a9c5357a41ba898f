# SPDX-License-Identifier: Apache-2.0
"""Fills the template of the page."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import jinja2
import vl_convert
from markupsafe import Markup

from sobb import library
from sobb.tools.render import heat
from sobb.tools.report.method import variants
from sobb.tools.report.page import charts, facts, noise
from sobb.tools.report.page.points import gains, points
from sobb.tools.report.page.table import Row, Table, tables
from sobb.tools.report.pictures.draw import Picture
from sobb.tools.report.results import CALLS, RAYS, Results
from sobb.tools.report.scene import titles
from sobb.tools.shared import palette
from sobb.tools.shared.cells import Cell, Column, number

_HERE = Path(__file__).parent
_HEAT_STOPS = 17
_BEST_RAYS = ("diffuse1", "diffuse7")  # the rays that the paper is about

Values = dict[str, Any]


def html(results: Results, pictures: Sequence[Picture]) -> str:
    """Returns the whole page."""
    found = points(results)
    drawn = sorted(set(variants(results.done).values()))
    specs: list[charts.Spec] = []
    rays = results.rays()
    return _template().render(
        version=library.version(),
        css=_text("page.css"),
        js=_text("page.js"),
        colours=palette.COLOURS,
        **facts.lead(results, found),
        rays=[(name, RAYS.get(name, name)) for name in rays],
        first_rays=_first_rays(results),
        calls=[(name, CALLS.get(name, name)) for name in results.calls()],
        tables=[_table(table) for table in tables(results)],
        charts=[_chart(chart, specs) for chart in charts.all_charts(found, drawn)],
        pictures=pictures,
        heat_colours=_heat_colours(),
        noise=_noise(results, specs),
        failed=_failed(results),
        runs=facts.runs(results),
        specs=specs,
        datasets={"points": found, "means": gains(found)},
        vega=_vega() if specs else "",
    )


def _first_rays(results: Results) -> str:
    """Returns the kind of rays that most cases have; of several, the first of _BEST_RAYS."""
    counts = Counter(
        rays
        for case in results.done
        for rays in {key.rays for key in case.figures if key.metric == "mrays_s"}
    )
    worth = [*reversed(_BEST_RAYS)]
    ranked = {name: worth.index(name) if name in worth else -1 for name in results.rays()}
    return max(ranked, key=lambda name: (counts[name], ranked[name]), default="")


def _template() -> jinja2.Template:
    return jinja2.Environment(
        loader=jinja2.FileSystemLoader(_HERE),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    ).get_template("page.html")


def _text(name: str) -> Markup:
    return Markup((_HERE / name).read_text("utf-8"))


def _vega() -> Markup:
    """Returns Vega, Vega-Lite and vegaEmbed, in which nothing looks like a script's end."""
    return Markup(vl_convert.javascript_bundle().replace("</script", r"<\/script"))


def _chart(chart: charts.Chart, specs: list[charts.Spec]) -> Values:
    """Returns a chart whose panels are named by their places among all specs."""
    first = len(specs)
    specs += [spec for _, spec in chart.panels]
    panels = [(title, first + i) for i, (title, _) in enumerate(chart.panels)]
    return {"title": chart.title, "text": chart.text, "without": chart.without, "panels": panels}


def _noise(results: Results, specs: list[charts.Spec]) -> Values:
    found = noise.variations(results)
    spec = len(specs) if found else None
    specs += [charts.noise([v.variation for v in found])] if found else []
    return {"spec": spec, **noise.section(found)}


def _table(table: Table) -> Values:
    places = {title: i for i, title in enumerate(dict.fromkeys(r.scene for r in table.rows))}
    drawn = sorted({row.variant for row in table.rows})
    bodies = [body for body in (table.rows, table.means) if body]
    return {
        "call": table.call,
        "title": CALLS.get(table.call, table.call).capitalize(),
        "columns": [_heading(column) for column in table.columns],
        "bodies": [
            [_row(row, places.get(row.scene, 0), drawn.index(row.variant)) for row in body]
            for body in bodies
        ],
    }


def _heading(column: Column) -> Values:
    name, _, unit = column.title.partition(" [")
    return {"name": name, "unit": f"[{unit}" if unit else ""}


def _row(row: Row, scene_place: int, variant_place: int) -> Values:
    return {
        "scene": row.scene,
        "scene_place": scene_place,
        "variant": row.variant.title,
        "variant_place": variant_place,
        "colour": row.variant.colour.name,
        "cells": [_cell(cell) for cell in row.cells],
    }


def _cell(cell: Cell) -> Values:
    known = cell.value if cell.value is not None else cell.ratio
    return {
        "sort": "" if known is None else f"{known:.9g}",
        "value": number(cell.value) if cell.value is not None else "" if cell.ratio else "–",
        "ratio": "" if cell.ratio is None else f"({cell.ratio:.2f})",
        "best": cell.best,
    }


def _failed(results: Results) -> list[Values]:
    title, named = titles(results.cases), variants(results.cases)
    return [
        {
            "scene": title[case.case_id],
            "variant": named[case.case_id].title,
            "status": case.status,
            "seconds": "–" if case.seconds is None else f"{case.seconds:.1f} s",
            "error": case.error or "",
        }
        for case in results.failed
    ]


def _heat_colours() -> str:
    return ", ".join(f"rgb({r} {g} {b})" for r, g, b in heat.colour_map(_HEAT_STOPS))
