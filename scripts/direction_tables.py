#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes and checks the default direction tables, lib/bounds/directions/direction_sets.inc.

A developer's tool; needs NumPy and SciPy. The method and the figures: docs/direction-tables.md.
"""

import argparse
import pathlib
import re
import sys

import numpy as np
from scipy.optimize import linprog
from scipy.spatial import ConvexHull

ROOT = pathlib.Path(__file__).resolve().parent.parent
CONSTANTS = ROOT / "lib/bounds/directions/direction_sets.inc"
DOCUMENT = ROOT / "docs/direction-tables.md"
COUNTS = (16, 24, 32, 64, 128)
AXES = np.eye(3)


def normalized(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def holes(directions):
    """The empty circles that three directions or their opposites span on the sphere.

    These are the facets of the convex hull of the directions and their opposites. Returns, for one
    of each opposite pair, its directions (indices and signs), its centre, and the cosine of its
    angular radius.
    """
    count = len(directions)
    points = np.concatenate([directions, -directions])
    hull = ConvexHull(points)
    centre = hull.equations[:, :3]
    # Lexicographic half-space: of a facet and its opposite, just one is in it.
    first = np.argmax(np.abs(centre) > 1e-9, axis=1)
    half = centre[np.arange(len(centre)), first] > 0
    corners, centre = hull.simplices[half], centre[half]
    corner_sign = np.where(corners < count, 1.0, -1.0)
    return corners % count, corner_sign, centre, -hull.equations[half, 3]


def covering_gradient(directions):
    """cos(radius) of every hole, with its derivative by each direction.

    The cosine is the distance h of the plane of the corners p from the origin, reached at the foot
    h u = sum(weight p). The foot minimises the distance, so to first order only the corners'
    displacement counts: dh = sum(weight u . dp).
    """
    corner, sign, u, h = holes(directions)
    p = directions[corner] * sign[..., None]
    weight = np.linalg.solve(p.transpose(0, 2, 1), (h[:, None] * u)[..., None])[..., 0]
    gradient = np.zeros((len(h), *directions.shape))
    for j in range(3):
        gradient[np.arange(len(h)), corner[:, j]] = (weight * sign)[:, j, None] * u
    return h, gradient


def separation_gradient(directions):
    """-cos(angle) of every two lines, with its derivative by each direction."""
    i, j = np.triu_indices(len(directions), 1)
    dot = np.einsum("ij,ij->i", directions[i], directions[j])
    gradient = np.zeros((len(dot), *directions.shape))
    rows = np.arange(len(dot))
    gradient[rows, i] = -np.sign(dot)[:, None] * directions[j]
    gradient[rows, j] = -np.sign(dot)[:, None] * directions[i]
    return -np.abs(dot), gradient


# Each objective is to make the smallest of its values as large as it goes.
OBJECTIVES = {"covering": covering_gradient, "separation": separation_gradient}


def tangents(directions):
    """Two unit vectors perpendicular to each direction and to each other."""
    away = AXES[np.argmin(np.abs(directions), axis=1)]
    first = normalized(np.cross(directions, away))
    return np.stack([first, np.cross(directions, first)], axis=1)


def improve(directions, objective, step):
    """Sequential linear programming in a trust region; the three axes stay.

    max t subject to value + gradient . x >= t and |x| <= step, x the tangential moves.
    """
    value, gradient = objective(directions)
    while step > 1e-8:
        tangent = tangents(directions[3:])
        slope = np.einsum("cij,itj->cit", gradient[:, 3:], tangent).reshape(len(value), -1)
        moves = slope.shape[1]
        solution = linprog(
            np.append(np.zeros(moves), -1.0),
            A_ub=np.column_stack([-slope, np.ones(len(value))]),
            b_ub=value,
            bounds=[(-step, step)] * moves + [(None, None)],
        )
        if solution.x is None:
            break
        moved = np.einsum("it,itj->ij", solution.x[:-1].reshape(-1, 2), tangent)
        trial = np.concatenate([AXES, normalized(directions[3:] + moved)])
        trial_value, trial_gradient = objective(trial)
        if trial_value.min() > value.min() + 1e-12:
            directions, value, gradient = trial, trial_value, trial_gradient
            step = min(1.5 * step, 0.3)
        else:
            step *= 0.3
    return directions, value.min()


def spread(count, random):
    """Random directions after a few steps of the repulsion of lines, the axes held."""
    directions = np.concatenate([AXES, normalized(random.normal(size=(count - 3, 3)))])
    for step in np.geomspace(0.2, 0.02, 20):
        sign = np.sign(directions @ directions.T)[..., None]
        apart = directions[:, None] - sign * directions[None]
        force = (apart / (np.sum(apart**2, axis=-1, keepdims=True) ** 2 + 1e-9)).sum(axis=1)
        directions[3:] = normalized(directions[3:] + step * normalized(force)[3:])
    return directions


def canonical(directions):
    """Farthest first, each in the half-space z > 0 (of those with z = 0: y > 0)."""
    directions = np.where(np.abs(directions) < 1e-7, 0.0, directions)
    leading = np.where(directions[:, 2] != 0, directions[:, 2], directions[:, 1])
    rest = directions * np.where(leading < 0, -1.0, 1.0)[:, None] + 0.0  # no -0
    chosen, rest = list(AXES), list(rest[3:])
    while rest:
        # Rounded, so that noise does not decide between equals.
        nearest = np.abs(np.array(rest) @ np.array(chosen).T).max(axis=1).round(5)
        best = min(range(len(rest)), key=lambda i: (nearest[i], *(-rest[i][::-1]).round(5)))
        chosen.append(rest.pop(best))
    return np.array(chosen)


def optimise(count, objective, starts, seed):
    random = np.random.default_rng([seed, count])
    candidates = [improve(spread(count, random), OBJECTIVES[objective], 0.1) for _ in range(starts)]
    best = max(candidates, key=lambda candidate: candidate[1])[0]
    return canonical(best).astype(np.float32)


def figures(directions):
    """Smallest angle between two lines, and covering radius, in degrees."""
    directions = directions.astype(np.float64)
    closest = -separation_gradient(directions)[0].min()
    return np.degrees(np.arccos([closest, holes(directions)[3].min()]))


def row(directions):
    """The line of the document's table."""
    angle, radius = figures(directions)
    return f"| {2 * len(directions)} | {len(directions)} | {angle:.2f}° | {radius:.2f}° |"


def write(tables):
    lines = [
        "// SPDX-License-Identifier: Apache-2.0",
        "// Written by scripts/direction_tables.py --write; docs/direction-tables.md says how.",
    ]
    for directions in tables:
        lines += ["", f"constexpr Direction kDirections{len(directions)}[] = {{"]
        for direction in directions:
            # The fewest digits that round-trip a float.
            digits = [np.format_float_positional(component, trim="0") for component in direction]
            lines.append("    {" + ", ".join(f"{number}f" for number in digits) + "},")
        lines.append("};")
    CONSTANTS.write_text("\n".join(lines) + "\n", encoding="utf-8")


def read():
    number = r"(-?\d+\.\d+)f"
    text = CONSTANTS.read_text(encoding="utf-8")
    return [
        np.array(re.findall(rf"\{{{number}, {number}, {number}\}}", block), dtype=np.float32)
        for block in text.split("constexpr Direction ")[1:]
    ]


def check(tables):
    """What is wrong with the committed constants, a line each."""
    document = DOCUMENT.read_text(encoding="utf-8").splitlines()
    if tuple(map(len, tables)) != COUNTS:
        yield f"{CONSTANTS}: has tables of {[len(table) for table in tables]} directions"
        return
    for table in tables:
        place = f"{CONSTANTS}: K = {len(table)}"
        if not np.array_equal(table[:3], AXES):
            yield f"{place}: does not begin with the axes"
        if np.abs(np.linalg.norm(table.astype(np.float64), axis=1) - 1).max() > 1e-6:
            yield f"{place}: has a direction that is not unit"
        if row(table) not in document:
            yield f"{place}: {DOCUMENT} does not have the line {row(table)}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "--objective",
        choices=OBJECTIVES,
        default="covering",
        help="least covering radius (default), or largest smallest angle",
    )
    parser.add_argument("--starts", type=int, default=100, help="random starts a table")
    parser.add_argument(
        "--counts",
        type=int,
        nargs="+",
        choices=COUNTS,
        default=COUNTS,
        help="the tables to make; the others stay as committed",
    )
    parser.add_argument("--seed", type=int, default=1)
    action = parser.add_mutually_exclusive_group()
    action.add_argument("--write", action="store_true", help="write the C++ constants")
    action.add_argument("--check", action="store_true", help="check them against the document")
    arguments = parser.parse_args()

    tables, faults = read(), []
    if arguments.check:
        faults = list(check(tables))
    else:
        made = {len(table): table for table in tables}
        for count in arguments.counts:
            made[count] = optimise(count, arguments.objective, arguments.starts, arguments.seed)
        tables = [made[count] for count in sorted(made)]
    print("| k | K | smallest angle | covering radius |\n|---|---|---|---|")
    for table in tables:
        print(row(table))
    for fault in faults:
        print(fault, file=sys.stderr)
    if arguments.write:
        write(tables)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
