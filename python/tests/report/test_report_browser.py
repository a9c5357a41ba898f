# SPDX-License-Identifier: Apache-2.0
"""The report in a browser, Debian's chromium: charts, sorting, themes, a telephone's width."""

import os
import shutil

import made_results
import pytest
from playwright.sync_api import sync_playwright

from sobb.tools.report import write

CHROMIUM = shutil.which("chromium")
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="needs chromium in PATH")

WIDE, PHONE = {"width": 1280, "height": 900}, {"width": 390, "height": 844}


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    """The address of a report with pictures of one scene."""
    folder = tmp_path_factory.mktemp("report")
    made_results.write(folder / "results.duckdb")
    write.run(str(folder / "results.duckdb"), folder, True, (96, 54), None)
    return (folder / "index.html").as_uri()


@pytest.fixture(scope="module")
def browser():
    sandbox = ["--no-sandbox"] if os.geteuid() == 0 else []  # Chromium's own does not run as root
    with sync_playwright() as running:
        browser = running.chromium.launch(executable_path=CHROMIUM, args=sandbox)
        yield browser
        browser.close()


@pytest.fixture
def show(browser, report):
    """Opens the report; at the end of the test nothing was complained of, nothing was fetched."""
    opened, said, fetched = [], [], []

    def open_page(**options):
        page = browser.new_page(**{"viewport": WIDE, **options})
        page.on("console", lambda message: said.append(message.text))
        page.on("pageerror", lambda error: said.append(str(error)))
        page.on("request", lambda request: fetched.append(request.url))
        page.goto(report)
        page.wait_for_selector("html[data-ready]")
        opened.append(page)
        return page

    yield open_page
    for page in opened:
        page.close()
    assert said == []
    assert all(url == report or url.startswith("data:") for url in fetched)


def marks(page, title):
    """How many points a chart shows, by the heading above it."""
    figure = page.locator("figure", has=page.get_by_role("heading", name=title))
    return figure.locator("svg .mark-symbol.role-mark path").count()


def column(page, number):
    """The texts of a column of the table that is shown, but for the means."""
    cells = page.locator(f".by-call:not([hidden]) tbody:first-of-type tr :nth-child({number + 1})")
    return cells.evaluate_all("cells => cells.map((cell) => cell.dataset.sort)")


def test_charts_draw_what_was_measured(show):
    page = show()
    assert marks(page, "Speed by scene and method") == 6 * 2  # scenes, methods but AABB
    assert marks(page, "What a build costs, and what it gains") == 6 * 2 + 3  # and the means
    assert marks(page, "Volumes tested against time") == 6 * 2  # Embree does not count
    sizes = page.locator("figure", has=page.get_by_role("heading", name="Cost against triangles"))
    assert sizes.locator("svg").count() == 3
    assert marks(page, "Cost against triangles") == 6 * 3
    assert page.locator(".chart svg").count() == 7


def test_choosing_rays_changes_charts_and_a_call_the_table(show):
    page = show()
    times = "svg .mark-symbol.role-mark path"
    before = page.locator(times).evaluate_all("paths => paths.map((path) => path.ariaLabel)")
    page.get_by_label("Rays of the charts").select_option("primary")
    page.wait_for_function(
        "([times, before]) => [...document.querySelectorAll(times)]"
        ".some((path, i) => path.ariaLabel !== before[i])",
        arg=[times, before],
    )
    assert page.locator(".by-call:visible").count() == 1
    page.get_by_label("Traced as").select_option("single")
    assert page.locator(".by-call:visible h3").inner_text() == "One ray per call"


def test_sorting_by_click(show):
    page = show()
    speed = page.locator(".by-call:not([hidden]) thead th", has_text="Primary")
    place = speed.evaluate("cell => cell.cellIndex")
    speed.get_by_role("button").click()
    assert speed.get_attribute("aria-sort") == "ascending"
    values = [float(value) for value in column(page, place)]
    assert values == sorted(values) and len(set(values)) > 3
    speed.get_by_role("button").click()
    assert speed.get_attribute("aria-sort") == "descending"
    assert [float(value) for value in column(page, place)] == values[::-1]
    assert page.locator(".by-call:not([hidden]) [aria-sort]").count() == 1
    assert page.locator("tbody.means").first.locator("th").first.inner_text().startswith("geo")


def test_sorting_by_keyboard_and_what_has_no_value_comes_last(show):
    page = show()
    overhead = page.locator(".by-call:not([hidden]) thead th", has_text="Overhead")
    overhead.get_by_role("button").focus()
    for key, order in (("Enter", "ascending"), ("Space", "descending")):
        page.keyboard.press(key)
        assert overhead.get_attribute("aria-sort") == order
        values = column(page, overhead.evaluate("cell => cell.cellIndex"))
        assert values[:6] and "" not in values[:6]
        assert set(values[6:]) == {""}


def test_theme_follows_the_system_and_the_button(show):
    page = show(color_scheme="dark")
    paper = "getComputedStyle(document.body).backgroundColor"
    ink = "getComputedStyle(document.querySelector('.role-axis-title text')).fill"
    dark = page.evaluate(f"[{paper}, {ink}]")
    button = page.get_by_role("button", name="Dark")
    assert button.get_attribute("aria-pressed") == "true"
    button.click()
    assert button.get_attribute("aria-pressed") == "false"
    light = page.evaluate(f"[{paper}, {ink}]")
    assert light[0] != dark[0]
    assert light[1] != dark[1]  # charts, too
    page.emulate_media(color_scheme="light")
    assert page.evaluate(f"[{paper}, {ink}]") == light


def test_marks_have_their_methods_colours(show):
    page = show()
    fills = page.locator("svg .mark-symbol.role-mark path").evaluate_all(
        "paths => [...new Set(paths.map((path) => getComputedStyle(path).fill))]"
    )
    dots = page.locator("td.method span").evaluate_all(
        "all => [...new Set(all.map((one) => getComputedStyle(one, '::before').backgroundColor))]"
    )
    assert len(fills) == 3 and set(fills) == set(dots)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_on_a_telephone_only_boxes_scroll_sideways(show, scheme):
    page = show(viewport=PHONE, color_scheme=scheme)
    assert page.evaluate("document.documentElement.scrollWidth") == PHONE["width"]
    table = page.locator(".scroll").first
    assert table.evaluate("box => box.scrollWidth > box.clientWidth")
    for chart in page.locator(".chart svg").all():
        assert chart.bounding_box()["width"] <= PHONE["width"]


def test_slider_moves_by_keyboard_and_pointer(show):
    page = show()
    slider = page.get_by_role("slider").first
    box = slider.locator("..")
    at = "box => getComputedStyle(box.querySelector('.over')).clipPath"
    middle = box.evaluate(at)
    slider.focus()
    page.keyboard.press("ArrowRight")
    assert slider.input_value() == "51" and box.evaluate(at) != middle
    slider.scroll_into_view_if_needed()
    place = slider.bounding_box()
    page.mouse.click(place["x"] + place["width"] * 0.2, place["y"] + place["height"] / 2)
    assert int(slider.input_value()) < 30
    assert "AABBs" in slider.get_attribute("aria-label")


def test_pictures_are_there_and_described(show):
    page = show()
    images = page.locator("main img").evaluate_all(
        "all => all.map((image) => [image.complete && image.naturalWidth > 0, image.alt])"
    )
    assert len(images) == 2 * (3 + 6)
    assert all(drawn and text for drawn, text in images)


def test_skip_link_comes_first_and_focus_shows(show):
    page = show()
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.className") == "skip"
    outline = "getComputedStyle(document.activeElement).outlineStyle"
    assert page.evaluate(outline) == "solid"
    page.keyboard.press("Enter")
    assert page.url.endswith("#content")


def test_names_from_the_file_are_shown_as_text(show):
    page = show()
    assert page.get_by_text(made_results.HOSTILE).count() > 0
    assert page.locator("img[src='x']").count() == 0
