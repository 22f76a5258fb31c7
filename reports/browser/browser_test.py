#!/usr/bin/python3
"""Opens the pages of an invented run and comparison in headless Chromium: browser_test.py REPORTS_EXAMPLE

Looks for what only a browser can tell: that every chart is drawn from the numbers of tables/*.csv, without a message
on the console and without a request to the network, in light and dark mode; that the pointer and the keyboard show
the frames of a curve; that the page prints. Exit code 77: there is no Chromium here.
"""

import base64
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
FLAGS = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync"]
# The page is drawn in about a second; a machine that is busy building may take many times as long.
PATIENCE_S = 60
LARGEST_PAGE_BYTES = 8_000_000

failures = []


def expect(holds, message):
    if not holds:
        failures.append(message)
        print(f"FAILED: {message}")


def start_browser(chromium, driver):
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service

    options = Options()
    options.binary_location = chromium
    for flag in FLAGS:
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(service=Service(driver), options=options)


def open_page(browser, page, scheme):
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia",
                            {"features": [{"name": "prefers-color-scheme", "value": scheme}]})
    browser.get(page.as_uri())
    end = time.monotonic() + PATIENCE_S
    while browser.execute_script("return typeof glovebench === 'undefined' || glovebench.drawnMs === null"):
        if time.monotonic() > end:
            expect(False, f"{scheme}: the page was not drawn within {PATIENCE_S} s")
            break
        time.sleep(0.1)


def check_silence(browser, page, scheme):
    for entry in browser.get_log("browser"):
        expect(False, f"{scheme}: console: {entry['message']}")
    for entry in browser.get_log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] == "Network.requestWillBeSent":
            url = message["params"]["request"]["url"]
            expect(url.startswith("data:") or url.split("#")[0] == page.as_uri(), f"{scheme}: request: {url[:200]}")


def check_charts(browser, scheme):
    places = browser.execute_script("""
        return [...document.querySelectorAll('[data-chart]')].map(place => [
            place.dataset.chart, place.querySelectorAll('svg .mark-line path, svg .mark-symbol path, ' +
            'svg .mark-rect path').length, place.getBoundingClientRect().width]);""")
    names = [name for name, _, _ in places]
    missing = browser.execute_script("return glovebench.missing")
    expect(missing == [], f"{scheme}: charts without data: {missing}")
    for expected in ["figure4-position", "figure5-posture", "figure6-rotation", "figure7-time", "figure7-rank",
                     "figure8", "figure9-time", "ablations-posture"]:
        expect(expected in names, f"{scheme}: there is no chart {expected}")
    for name, marks, width in places:
        expect(marks > 0 and width > 100, f"{scheme}: {name}: {marks} marks, {width} px wide")
    sections = browser.execute_script("return [...document.querySelectorAll('nav a')].map(a => "
                                      "[a.hash, document.querySelector(a.hash) !== null])")
    expect(len(sections) > 8, f"{scheme}: {len(sections)} sections")
    for target, exists in sections:
        expect(exists, f"{scheme}: the contents lead to {target}, which is missing")
    expect(browser.execute_script("return document.documentElement.scrollWidth <= innerWidth"),
           f"{scheme}: the page is wider than the window")


def check_claims(browser, scheme):
    """Every claim's history can be opened, and one that changed shows what it was."""
    ids = browser.execute_script("return [...document.querySelectorAll('#claims tr[id]')].map(row => row.id)")
    expect(len(ids) > 30 and "claim-15-hz-plain" in ids, f"{scheme}: rows of claims: {ids}")
    shown = browser.execute_script("""
        const row = document.getElementById('claim-position-error-rises-slowly');
        for (let details = row.querySelector('details'); details; details = details.parentElement.closest('details'))
            details.open = true;
        return row.querySelector('details').innerText;""")
    for text in ["changed 2 times", "d87120a", "81f65fc", "below 0.1", "within 0..0.1", "within 0.01..0.1",
                 "reproduced (a25e2d4"]:
        expect(text in shown, f"{scheme}: a claim's history does not show {text}: {shown}")
    without = browser.execute_script("return [...document.querySelectorAll('#claims tr[id]')].filter(row => "
                                     "!row.querySelector('details.history li')).map(row => row.id)")
    expect(without == [], f"{scheme}: claims without a history: {without}")


def read_table(folder, name):
    """Rows as the page has them: numbers as numbers, empty cells as None."""
    def value(text):
        if text == "":
            return None
        try:
            return float(text)
        except ValueError:
            return text
    with open(folder / "tables" / f"{name}.csv", newline="", encoding="utf-8") as file:
        return [{key: value(text) for key, text in row.items()} for row in csv.DictReader(file)]


def check_numbers(browser, folder):
    """What the charts are drawn from is what the files say."""
    tables = browser.execute_script("return glovebench.tables")
    expect({"figure4", "figure5", "figure6", "figure7", "figure8", "figure9", "ablations"} <= set(tables),
           f"tables: {sorted(tables)}")
    for name, rows in tables.items():
        expect(rows == read_table(folder, name), f"tables/{name}.csv is not what the page draws")

    def drawn(chart):
        return browser.execute_script("return glovebench.views[arguments[0]].data('source_0')", chart)
    rows = read_table(folder, "figure5")
    first = [row for row in rows if row["seed"] == rows[0]["seed"]]
    expect([row["posture_rms_deg"] for row in drawn("figure5-posture")] == [row["posture_rms_deg"] for row in first],
           "figure5-posture draws other numbers")
    expect([row["mean"] for row in drawn("figure4-rotation")] ==
           [row["rotation_error_deg_mean"] for row in read_table(folder, "figure4")],
           "figure4-rotation draws other numbers")
    expect([row["distance_us"] for row in drawn("figure7-time")] ==
           [row["distance_us"] for row in read_table(folder, "figure7")], "figure7-time draws other numbers")


def check_glossary(browser, scheme):
    """A heading of each metric leads to its entry, which is in sight then."""
    links = browser.execute_script("""
        return [...document.querySelectorAll('th a[href^="#metric-"]')].map(link => link.hash);""")
    for metric in ["position_error_mm", "found_percent", "latency_frames", "jitter_position_mm", "joint_pck_area",
                   "command_joints_deg"]:
        expect(f"#metric-{metric}" in links, f"{scheme}: no heading leads to {metric}")
    for target in set(links):
        expect(browser.execute_script("return document.querySelector(arguments[0])?.tagName === 'DT'", target),
               f"{scheme}: a heading leads to {target}, which is no entry of the glossary")
    without = browser.execute_script("""
        return [...document.querySelectorAll('#metrics th:not(.name), #commands h3 + div th:not(.name)')]
            .filter(heading => !heading.querySelector('a')).map(heading => heading.textContent);""")
    expect(without == [], f"{scheme}: headings without a link: {without}")
    browser.execute_script("document.querySelector('#metrics th a[href=\"#metric-latency_frames\"]').click()")
    expect(is_in_sight(browser, "metric-latency_frames"), f"{scheme}: the entry of latency_frames is not in sight")


def is_in_sight(browser, name):
    return browser.execute_script("""
        const box = document.getElementById(arguments[0]).getBoundingClientRect();
        return box.top >= 0 && box.top < innerHeight;""", name)


def check_bars(browser, page, chart):
    """A click on a bar opens the frames of its experiment."""
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By

    bar = browser.find_elements(By.CSS_SELECTOR, f'[data-chart="{chart}"] .mark-rect.role-mark path')[0]
    browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", bar)
    ActionChains(browser).move_to_element(bar).click().perform()
    names = browser.execute_script("return [...document.querySelectorAll('#frames details[open]')].map(d => d.id)")
    expect(len(names) == 1, f"{page}: a click on a bar opens {names}")
    for name in names:
        expect(is_in_sight(browser, name), f"{page}: {name} is open and not in sight")
        text = browser.execute_script("return document.getElementById(arguments[0]).innerText", name)
        experiment = name.removeprefix("frames-")
        expect("glovebench explain . " in text and f"--experiment {experiment} " in text and
               f"tables/frames_{experiment}.csv" in text, f"{page}: {name} shows {text}")


def shown_frame(browser):
    return browser.execute_script("""
        const viewer = document.querySelector('.frame-viewer[data-figure="figure5"]');
        return [viewer.querySelector('.frame-number').textContent,
                getComputedStyle(viewer.querySelector('.row-0')).backgroundPosition,
                getComputedStyle(viewer.querySelector('.row-1')).backgroundPosition,
                [...viewer.querySelectorAll('td')].map(cell => cell.textContent).join(' ')];""")


def check_frames(browser, folder, scheme):
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys

    before = shown_frame(browser)
    curve = browser.find_element(By.CSS_SELECTOR, '[data-chart="figure5-posture"]')
    browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", curve)
    ActionChains(browser).move_to_element(curve).perform()
    hovered = shown_frame(browser)
    for old, new, what in zip(before, hovered, ["number", "truth", "difference", "errors"]):
        expect(old != new, f"{scheme}: pointing at the curve does not change the frame's {what}")
    slider = browser.find_element(By.CSS_SELECTOR, '.frame-viewer[data-figure="figure5"] input')
    browser.execute_script("arguments[0].focus()", slider)
    slider.send_keys(Keys.ARROW_RIGHT)
    stepped = shown_frame(browser)
    expect(int(stepped[0]) == int(hovered[0]) + 1, f"{scheme}: the right arrow goes from {hovered[0]} to {stepped[0]}")
    expect(stepped[1] != hovered[1], f"{scheme}: the right arrow does not change the picture")
    row = read_table(folder, "figure5")[int(stepped[0])]
    expect(stepped[3].startswith(f"{row['position_error_mm']:.2f} mm {row['paper_position_error_mm']:.2f} mm"),
           f"{scheme}: frame {stepped[0]} shows {stepped[3]}")
    browser.find_element(By.CSS_SELECTOR, '.keyframes[data-figure="figure5"] button:last-child').click()
    expect(shown_frame(browser)[0] == "116", f"{scheme}: the last keyframe is {shown_frame(browser)[0]}")


def check_colors(browser, scheme, colors):
    """The background, and the text of a chart, which must be told from it."""
    colors[scheme] = browser.execute_script("""
        return [getComputedStyle(document.body).backgroundColor,
                getComputedStyle(document.querySelector('[data-chart="figure5-position"] .role-axis-title text')).fill]""")


def check_comparison(browser, folder):
    """The differences of a comparison are drawn, those of an experiment in one chart, from what comparison.json says."""
    page = folder / "comparison" / "index.html"
    open_page(browser, page, "light")
    check_silence(browser, page, "comparison")
    expect(browser.execute_script("return document.documentElement.scrollWidth <= innerWidth"),
           "comparison: the page is wider than the window")
    experiments = json.loads((page.parent / "comparison.json").read_text())["frame_differences"]
    expect(len(experiments) == 4, f"comparison: {len(experiments)} experiments")
    rows = browser.execute_script("return glovebench.tables.differences")
    for number, experiment in enumerate(experiments):
        chart = f"differences {number}"
        drawn = [row for row in rows if row["experiment"] == number]
        changed = 0
        for metric, values in experiment["differences"].items():
            expect([row[metric] for row in drawn] == values, f"comparison: {chart} draws other numbers of {metric}")
            changed += any(values)
        panels = browser.execute_script("""
            return document.querySelectorAll(`[data-chart="${arguments[0]}"] svg .mark-line path`).length""", chart)
        expect(panels == changed, f"comparison: {chart} has {panels} lines, {changed} metrics changed")


def check_own_run(browser, folder):
    """A run that is not the paper's has bars of each kind of experiment, and none of the paper's diamonds."""
    page = folder / "own" / "index.html"
    open_page(browser, page, "light")
    check_silence(browser, page, "own run")
    expect(browser.execute_script("return glovebench.missing") == [], "own run: charts without data")
    bars, diamonds = browser.execute_script("""
        const place = document.querySelector('[data-chart="errors-position"]');
        const marks = [".mark-rect.role-mark path", ".mark-symbol.role-mark path"];
        return marks.map(mark => place.querySelectorAll("svg " + mark).length);""")
    expect(bars >= 2 and diamonds == 0, f"own run: {bars} bars and {diamonds} diamonds")
    check_bars(browser, "own run", "errors-rotation")


def check_settings(browser, folder):
    """A point of each setting in the panel of each quantity."""
    page = folder / "settings.html"
    open_page(browser, page, "light")
    check_silence(browser, page, "settings")
    expect(browser.execute_script("return glovebench.missing") == [], "settings: the chart has no data")
    expected, points = browser.execute_script("""
        const means = glovebench.tables.settings.filter(row => row.quantity !== 'time_ms' && row.mean !== null);
        return [means.length, document.querySelectorAll('[data-chart="settings"] .mark-symbol.role-mark path').length];""")
    expect(expected == points and points >= 12, f"settings: {points} points, {expected} means")


def check_print(browser):
    pdf = base64.b64decode(browser.execute_cdp_cmd("Page.printToPDF", {})["data"])
    expect(pdf.startswith(b"%PDF") and len(pdf) > 20_000, f"the printed page has {len(pdf)} bytes")


def check_without_scripts(browser, page):
    """Tables and keyframes need no JavaScript."""
    browser.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
    browser.get(page.as_uri())
    root = browser.execute_cdp_cmd("DOM.getDocument", {})["root"]["nodeId"]

    def count(selector):
        return len(browser.execute_cdp_cmd("DOM.querySelectorAll", {"nodeId": root, "selector": selector})["nodeIds"])
    expect(count("[data-chart] svg") == 0, "without scripts: charts are drawn all the same")
    expect(count("section table") >= 8, f"without scripts: {count('section table')} tables")
    expect(count(".keyframes button") == 12, f"without scripts: {count('.keyframes button')} keyframes")
    browser.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": False})


def main():
    chromium, driver = shutil.which("chromium"), shutil.which("chromedriver")
    if chromium is None or driver is None:
        print("skipped: no chromium or no chromedriver")
        return SKIPPED
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        subprocess.run([sys.argv[1], folder], check=True, stdout=subprocess.DEVNULL)
        page = folder / "index.html"
        expect(page.stat().st_size < LARGEST_PAGE_BYTES, f"the page has {page.stat().st_size} bytes")
        browser = start_browser(chromium, driver)
        try:
            colors = {}
            for scheme in ["light", "dark"]:
                open_page(browser, page, scheme)
                check_silence(browser, page, scheme)
                check_charts(browser, scheme)
                check_claims(browser, scheme)
                check_frames(browser, folder, scheme)
                check_glossary(browser, scheme)
                check_bars(browser, scheme, "figure4-position")
                check_colors(browser, scheme, colors)
                check_silence(browser, page, scheme)
                print(f"{scheme}: drawn in {browser.execute_script('return glovebench.drawnMs'):.0f} ms")
            check_numbers(browser, folder)
            for light, dark, what in zip(colors["light"], colors["dark"], ["page", "charts"]):
                expect(light != dark, f"the {what} has the same color in both modes: {light}")
            check_print(browser)
            check_comparison(browser, folder)
            check_own_run(browser, folder)
            check_settings(browser, folder)
            check_without_scripts(browser, page)
        finally:
            browser.quit()
    return 1 if failures else 0


sys.exit(main())
