# SPDX-License-Identifier: Apache-2.0
"""The report: medians, ratios, means, the Pareto front, what the page says, bad input."""

import dataclasses
import json
import re

import duckdb
import made_results
import pytest

from sobb.tools.report import method, results
from sobb.tools.report.page import facts, noise, page, points, table
from sobb.tools.report.pictures.draw import Picture


@pytest.fixture
def read(tmp_path):
    """Results made up with the arguments of made_results.write()."""

    def make(**options):
        path = tmp_path / "results.duckdb"
        made_results.write(path, **options)
        return results.read(path)

    return make


def some(found, **wanted):
    return [point for point in found if all(point[k] == v for k, v in wanted.items())]


def test_medians_and_variation(read):
    case = next(case for case in read().done if case.method == "sobb")
    figure = case.figures[results.Key("mrays_s", "primary", "array")]
    assert figure.repetitions == 3
    assert figure.median == pytest.approx(20 * 1.5, rel=0.021)
    assert 0 < figure.variation < 0.03
    assert case.value(results.Key("mrays_s", "shadow", "array")) is None


def test_kinds_of_rays_and_calls_in_their_order(read):
    found = read()
    assert found.rays() == ["primary", "diffuse1"]
    assert found.calls() == ["array", "single"]


def test_table_has_ratios_best_and_means(read):
    made = table.tables(read())
    assert [t.call for t in made] == ["array", "single"]
    titles = [column.title for column in made[0].columns]
    assert titles == [
        "Build [ms]",
        "Overhead [ms]",
        "Area inner nodes",
        "Primary [Mrays/s]",
        "Diffuse 1 [Mrays/s]",
    ]
    rows = {row.variant.method: row for row in made[0].rows if row.scene == "city [2k]"}
    assert list(rows) == ["aabb", "sobb", "embree"]
    assert rows["sobb"].cells[3].ratio == pytest.approx(1.5, rel=0.05)
    assert rows["sobb"].cells[3].best and not rows["aabb"].cells[3].best
    assert rows["aabb"].cells[0].best
    assert rows["aabb"].cells[1].value is None  # overhead over itself
    assert rows["sobb"].cells[1].value == pytest.approx(2.5, abs=0.6)
    assert rows["embree"].cells[1].value is None
    means = {row.variant.method: row for row in made[0].means}
    assert means["sobb"].scene == "geometric mean of 6"
    assert means["sobb"].cells[3].ratio == pytest.approx(1.5, rel=0.03)
    assert means["sobb"].cells[3].best


def test_refined_scenes_follow_each_other(read):
    cases = read(scenes=("builtin:city:9",), failures={}).done
    by_times = [c for c in cases if c.subdivision == 1]
    made = [
        dataclasses.replace(c, case_id=f"{c.case_id}-{times}", subdivision=times, triangles=None)
        for times in (64, 1, 16, 4)
        for c in by_times
    ]
    found = results.Results([], made)
    shown = [row.scene for row in table.tables(found)[0].rows]
    assert list(dict.fromkeys(shown)) == ["city", "city ×4", "city ×16", "city ×64"]
    drawn = [point["scene"] for point in points.points(found)]
    assert list(dict.fromkeys(drawn)) == ["city", "city ×4", "city ×16", "city ×64"]


def test_charts_begin_with_rays_that_all_methods_have(read):
    found = read(failures={})
    assert '<option value="diffuse1" selected>' in page.html(found, [])
    less = [
        dataclasses.replace(c, figures={k: f for k, f in c.figures.items() if k.rays != "diffuse1"})
        if c.method == "sobb"
        else c
        for c in found.cases
    ]
    assert '<option value="primary" selected>' in page.html(results.Results(found.runs, less), [])


def test_variants_name_what_varies(read):
    methods = {
        "aabb": made_results.METHODS["aabb"],
        "sobb": made_results.METHODS["sobb"],
    }
    named = method.variants(read(methods=methods).done)
    assert {variant.title for variant in named.values()} == {"AABB", "SOBB"}


def test_ratios_are_to_the_same_options(read):
    cases = read(scenes=("builtin:city:9",), failures={}).done
    aabb, sobb = (next(c for c in cases if c.method == name) for name in ("aabb", "sobb"))
    high = dataclasses.replace(aabb, case_id="high", quality="high")
    assert method.bases([high, sobb]) == {"high": high}
    assert method.bases([high, sobb, aabb])[sobb.case_id] is aabb


def test_the_best_instruction_set_compares_with_any(read):
    cases = read(scenes=("builtin:city:9",), failures={}).done
    aabb, embree = (next(c for c in cases if c.method == name) for name in ("aabb", "embree"))
    best = dataclasses.replace(embree, isa="best")
    assert method.bases([aabb, best])[best.case_id] is aabb
    assert {variant.title for variant in method.variants([aabb, best]).values()} == {
        "AABB",
        "Embree",
    }


def test_volumes_that_share_a_traversal_are_told(read):
    obb = {**made_results.METHODS, "obb": (None, None, None, 1.2, 1.1)}
    found = read(methods=obb)
    assert any("share one hierarchy" in note for note in facts.lead(found, [])["notes"])
    without = results.Results(found.runs, [c for c in found.cases if c.method != "obb"])
    assert facts.lead(without, [])["notes"] == []


def test_front_is_what_nothing_beats(rng):
    for _ in range(50):
        count = int(rng.integers(1, 8))
        made = [
            {"speed": s, "build": b, "variant": str(i), "rays": "r", "call": "c"}
            for i, (s, b) in enumerate(rng.integers(1, 4, (count, 2)).tolist())
        ]
        means = points.gains(made)
        assert len(means) == count
        for own in means:
            beaten = any(
                other["speed"] >= own["speed"]
                and other["build"] <= own["build"]
                and (other["speed"] > own["speed"] or other["build"] < own["build"])
                for other in means
            )
            assert own["front"] == (not beaten)


def test_points_say_what_charts_need(read):
    found = points.points(read())
    own = some(found, variant="SOBB", rays="diffuse1", call="array", scene="city ×4 [8k]")
    assert len(own) == 1
    assert own[0]["curve"] == "city"
    assert own[0]["volumes"] == pytest.approx(50 / 1.5)  # counted by single rays
    assert own[0]["ns"] == pytest.approx(1000 / own[0]["mrays"])
    assert all(point["volumes"] is None for point in some(found, variant="Embree"))


def test_noise_says_how_much_repetitions_differ(read):
    found = noise.variations(read())
    assert found == sorted(found, key=lambda v: -v.variation)
    assert "vary by less than" in noise.section(found)["text"]
    assert noise.section([])["text"] == "Nothing was measured more than once."


def test_strings_from_the_file_are_text(read):
    """Nothing that a name or an error says becomes markup, nor ends a script."""
    html = page.html(read(), [Picture(made_results.HOSTILE, made_results.HOSTILE)])
    assert made_results.HOSTILE not in html
    assert "<script>alert" not in html
    assert "&lt;img src=x onerror=alert(1)&gt;" in html
    datasets = re.search(r'id="datasets">(.*?)</script>', html)[1]
    assert any(made_results.HOSTILE in p["scene"] for p in json.loads(datasets)["points"])


def test_page_loads_nothing(read):
    html = page.html(read(), [])
    assert "default-src 'none'" in html
    markup = re.sub(r"<script.*?</script>", "", html, flags=re.DOTALL)
    assert not re.search(r'(?:src|href)="(?!data:|#)', markup)
    assert "signal 11" in html and "gave up after 60 s" in html
    assert "A &amp; B" in html and "abc1234" in html


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"scenes": (), "failures": {}}, "no cases"),
        ({"scenes": ()}, "No case was measured"),
        ({"methods": {"sobb": made_results.METHODS["sobb"]}}, "Only one method"),
        (
            {"methods": {m: made_results.METHODS[m] for m in ("sobb", "embree")}},
            "AABBs were not measured",
        ),
    ],
)
def test_little_measured_is_said(read, options, said):
    assert said in page.html(read(**options), [])


def test_one_scene_has_no_means(read):
    made = read(scenes=("builtin:city:9",))
    assert "geometric mean of 2" in page.html(made, [])  # at two subdivisions
    assert facts.lead(made, points.points(made))["tiles"][0]["value"].startswith("1.5")


def test_command_writes_one_page_with_pictures(cli, tmp_path):
    file, out = tmp_path / "results.duckdb", tmp_path / "new" / "report"
    made_results.write(file, scenes=("builtin:hairball:2000", "/missing/x.glb"))
    done = cli("report", file, "--out", out, "--size", "64x36")
    assert done.returncode == 0, done.stderr
    assert [path.name for path in out.iterdir()] == ["index.html"]
    html = (out / "index.html").read_text()
    assert html.count("data:image/webp;base64,") == 3 + 2 * 3
    assert "Level 13" in html and "Level 17" in html
    assert "no such file, nor a scene of that name" in html


def test_bad_files_are_named(cli, tmp_path):
    text, other, bare = (tmp_path / f"{name}.duckdb" for name in ("text", "other", "bare"))
    text.write_text("no database")
    made_results.write(other, scenes=())
    with duckdb.connect(str(other)) as database:
        database.execute("UPDATE meta SET value = '99'")
    with duckdb.connect(str(bare)):
        pass
    for file, cause in (
        (tmp_path / "missing.duckdb", "no such file"),
        (text, "not a valid DuckDB database"),
        (bare, "no file of results"),
        (other, "version 99"),
    ):
        done = cli("report", file, "--out", tmp_path / "out")
        assert done.returncode == 1
        assert done.stderr.startswith(f"sobb: {file}: ") and cause in done.stderr
        assert "Traceback" not in done.stderr
    assert not (tmp_path / "out").exists()


def test_page_that_cannot_be_written_is_told(cli, tmp_path):
    file, out = tmp_path / "results.duckdb", tmp_path / "out"
    made_results.write(file, scenes=())
    out.write_text("a file where the folder should be")
    done = cli("report", file, "--out", out)
    assert done.returncode == 1 and str(out) in done.stderr
