#!/usr/bin/python3
"""report_browser_test.py TALUS MAKE_SYNTHETIC_CAMPAIGN TUBE_AND_DRUM [SCREENSHOTS]: opens reports in headless Chromium
and checks that they load nothing from elsewhere, that no script fails, that every chart draws its data, and that
the table of trials sorts and filters. TUBE_AND_DRUM: what tube_and_drum.py has made. With SCREENSHOTS, what was seen
stays as pictures in that folder."""
import base64
import json
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import time
import zlib

from report_page import MOST_SECONDS, By, ReportPage, WebDriverWait, main


def grey_png(width, height):
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
    rows = b"".join(b"\0" + bytes(x * 255 // width for x in range(width)) for _ in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class ReportInABrowser(ReportPage):
    def test_finished_campaign_with_three_parameters(self):
        self.open_report("three", 60, 3, "finished")
        charts = self.check_charts()
        # Convergence, space, outlines, times; the region; marginals; slices; pairs.
        self.assertEqual(len(charts), 4 + 1 + 3 + 3 + 3, charts)
        self.assertIn("three parameters", self.driver.find_element(By.ID, "space-section").text)
        self.check_log()
        self.keep_screenshot("three")

    def test_running_campaign_with_two_parameters(self):
        self.open_report("two", 40, 2, "running")
        self.assertEqual(len(self.check_charts()), 4 + 1 + 2 + 2 + 1)
        self.assertIn("not concluded yet", self.driver.find_element(By.ID, "answer").text)
        so_far = self.driver.find_element(By.ID, "so-far").text
        self.assertRegex(so_far, r"Best so far\n[\d.]+ mm²")
        self.assertRegex(so_far, r"Time left\nat most [\d.]+ (min|h)\nby the budget")
        self.check_log()
        self.keep_screenshot("two")

    def test_campaign_that_has_just_begun(self):
        self.open_report("begun", 2, 3, "running")
        self.check_charts()
        self.check_log()

    # More than a chart draws (docs/report.md: 3000, convergence 4000).
    def test_campaign_of_five_thousand_trials(self):
        self.open_report("many", 5000, 3, "running")
        self.check_charts()
        self.will_change_the_page()
        self.driver.find_element(By.ID, "trial-filter").send_keys("state=failed")
        self.assertEqual(set(self.column("state")), {"failed"})
        self.assertIn("1 to 50 of ", self.driver.find_element(By.ID, "trial-count").text)
        self.check_log()
        self.keep_screenshot("many")

    def test_colouring_by_another_objective_redraws(self):
        self.open_report("three", 60, 3, "finished")
        self.will_change_the_page()
        self.check_charts(["space"])
        picture = ("return echarts.getInstanceByDom(document.getElementById('space'))"
                   ".getDataURL({pixelRatio: 1})")
        before = self.driver.execute_script(picture)
        self.assertEqual(before, self.driver.execute_script(picture))
        self.driver.execute_script("const s = document.getElementById('space-objective'); s.value = 2;"
                                   "s.dispatchEvent(new Event('change'))")
        self.assertNotEqual(before, self.driver.execute_script(picture))
        self.check_log()

    def test_of_one_parameter_a_line_marks_what_is_recommended(self):
        self.open_report("three", 60, 3, "finished")
        self.will_change_the_page()
        # The star stood at the campaign's own objective, on whatever axis was shown.
        series, value = self.driver.execute_script(
            "D.parameters = D.parameters.slice(0, 1); document.getElementById('space').id = 'former';"
            "document.getElementById('space-section').append(spaceChart()); talusCharts[talusCharts.length - 1].start();"
            "return [echarts.getInstanceByDom(document.getElementById('space')).getOption().series"
            ".find((s) => s.name === 'recommended'), D.headline.values[0].value]")
        self.assertEqual(series["data"], [])
        self.assertEqual([mark["xAxis"] for mark in series["markLine"]["data"]], [value])
        self.check_log()
        self.keep_screenshot("one")

    def test_of_one_parameter_a_ring_is_at_the_mean_of_its_repeats(self):
        self.open_report("three", 60, 3, "finished")
        self.will_change_the_page()
        # It stood at the first of them.
        rings, sad, text = self.driver.execute_script(
            "D.parameters = D.parameters.slice(0, 1); document.getElementById('space').id = 'former';"
            "const rows = doneTrials().slice(0, 2), best = D.objectives[0].trials.best[0];"
            "best.trials = rows.map((i) => D.trials.id[i]);"
            "document.getElementById('space-section').append(spaceChart()); talusCharts[talusCharts.length - 1].start();"
            "const option = echarts.getInstanceByDom(document.getElementById('space')).getOption();"
            "const ring = option.series.find((s) => s.name.startsWith('ten best by SAD')).data[0];"
            "return [ring.value, rows.map(valuesOf(D.objectives[0]).value),"
            " option.tooltip[0].formatter({data: ring})]")
        self.assertAlmostEqual(rings[1], sum(sad) / 2, places=9)
        self.assertTrue(text.startswith("Mean of trials "), text)
        self.check_log()

    def test_table_sorts_filters_and_turns_pages(self):
        self.open_report("three", 60, 3, "finished")
        self.will_change_the_page()
        head = self.driver.find_element(By.CSS_SELECTOR, "#trials th[data-key=sad_mm2]")
        self.driver.execute_script("arguments[0].click()", head)
        rising = [float(x) for x in self.column("sad_mm2") if x != "–"]
        self.assertEqual(rising, sorted(rising))
        self.driver.execute_script("arguments[0].click()", head)
        falling = [float(x) for x in self.column("sad_mm2") if x != "–"]
        self.assertEqual(falling, sorted(falling, reverse=True))
        self.assertGreater(falling[0], rising[0])
        button = head.find_element(By.TAG_NAME, "button")
        for key, order in ((" ", "ascending"), ("\n", "descending")):  # without a mouse
            button.send_keys(key)
            self.assertEqual(head.get_attribute("aria-sort"), order)

        box = self.driver.find_element(By.ID, "trial-filter")
        box.send_keys("state=failed")
        self.assertEqual(set(self.column("state")), {"failed"})
        self.assertIn("of 4 trials", self.driver.find_element(By.ID, "trial-count").text)
        box.clear()
        box.send_keys("sad_mm2<1 search")
        self.assertTrue(self.column("sad_mm2"))
        self.assertTrue(all(float(x) < 1 for x in self.column("sad_mm2")))
        self.assertEqual(set(self.column("purpose")), {"search"})
        box.clear()
        box.send_keys(" ")
        self.assertEqual(len(self.column("trial")), 50)
        next_page = self.driver.find_element(By.XPATH, "//button[text()='Next']")
        self.driver.execute_script("arguments[0].click()", next_page)
        self.assertEqual(len(self.column("trial")), 10)

    def test_fits_a_phone(self):
        self.will_change_the_page()
        self.driver.set_window_size(500, 1000)  # the least that a window can have
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": 390, "height": 844, "deviceScaleFactor": 1, "mobile": True})
        try:
            for name, coarse_design in (("three", False), ("posterior", True)):
                self.open_report(name, 60, 3 if not coarse_design else 2, "finished", width=500,
                                 coarse_design=coarse_design)
                self.check_charts()
                width = self.driver.execute_script("return document.documentElement.scrollWidth")
                self.assertEqual(width, 390)
                if name == "three":  # "γ (J/m²)" was cut off at the edge
                    axes = self.driver.execute_script(
                        "const made = echarts.getInstanceByDom(document.getElementById('space')).getOption();"
                        "return (made.zAxis3D || []).map((axis) => axis.name)")
                    self.assertIn(axes, ([], ["γ"]))
                self.keep_screenshot("phone_" + name)
        finally:
            self.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})

    def test_posterior_is_what_the_page_shows(self):
        self.open_report("posterior", 60, 2, "finished", coarse_design=True)
        charts = self.check_charts()
        self.assertIn("region", charts)
        self.assertIn("marginal-1", charts)
        self.assertGreaterEqual(min(self.numbers_of("D.slices.flatMap((s) => s.mean)")), 0)
        self.assertGreaterEqual(min(self.numbers_of("D.slices.flatMap((s) => s.low)")), 0)
        text = self.driver.find_element(By.TAG_NAME, "main").text
        self.assertIn("fit every measurement", self.driver.find_element(By.ID, "verdict").text)
        self.assertIn("What to do next", self.driver.find_element(By.ID, "next").text)
        self.assertNotIn("Gaussian process of SAD", text)
        self.assertIn("single runs", text)  # both figures of the confirmed SAD
        self.check_log()
        self.keep_screenshot("posterior")

    # What `talus next` leaves in the folder, with a test whose simulations have been run.
    def test_next_steps_are_those_that_talus_next_ranks(self):
        self.open_report("posterior", 60, 2, "finished", coarse_design=True)
        campaign = pathlib.Path(self.folder.name) / "next"
        shutil.copytree(campaign.with_name("posterior"), campaign)
        self.assertEqual(self.driver.find_elements(By.ID, "next-table"), [])
        subprocess.run([self.talus, "next", campaign], check=True, stdout=subprocess.DEVNULL)
        path = campaign / "next" / "next.json"
        table = json.loads(path.read_text())
        widths = table["width_90"]
        table["candidates"].insert(0, {
            "kind": "test", "name": "wide plate", "what": "carry it out in 3 runs", "num_simulations": 38,
            "core_time_s": 150, "remaining": 1 / 16, "bits": 2.5, "width_90": {k: w / 4 for k, w in widths.items()},
            "told_apart": [[0.15, 0.5], [0.6, 0.15]], "picture": "wide-plate.png"})
        path.write_text(json.dumps(table))
        (campaign / "next" / "wide-plate.png").write_bytes(grey_png(320, 100))
        subprocess.run([self.talus, "report", campaign], check=True, stdout=subprocess.DEVNULL)
        self.open_report("next", 60, 2, "finished", coarse_design=True)
        steps = self.driver.find_element(By.ID, "next").text
        self.assertIn("Wide plate: carry it out in 3 runs", steps)
        self.assertNotIn("more simulations of heap", steps)  # of no gain: in the table only
        rows = self.driver.execute_script(
            "return [...document.querySelectorAll('#next-table tbody tr')].map((r) => "
            "[...r.cells].map((c) => c.textContent))")
        self.assertEqual(len(rows), len(table["candidates"]))
        self.assertEqual((rows[0][0], rows[0][3]), ("wide plate: carry it out in 3 runs", "2.5"))
        self.assertRegex(rows[0][2], r"^6\.3\s%$")  # of the ranges' volume
        self.assertEqual(rows[0][1], "38 simulations, 2.50 min")
        self.assertEqual(rows[-1][2], "?")  # nothing of it has been simulated
        figure = self.driver.find_element(By.CSS_SELECTOR, "#told-apart figure")
        self.assertIn("first μₜ 0.150, μᵣ 0.500", figure.text)
        self.assertEqual(figure.find_element(By.TAG_NAME, "img").get_property("naturalWidth"), 320)
        self.check_log()
        self.keep_screenshot("next")

    def test_running_campaign_shows_its_region(self):
        self.open_report("running_posterior", 60, 2, "running", coarse_design=True)
        self.assertIn("region", self.check_charts())
        self.assertRegex(self.driver.find_element(By.ID, "so-far").text, r"Joint 90\s% region so far\n[\d.]+ %")
        self.assertEqual(self.driver.execute_script("return talusCharts.filter((c) => c.id === 'shrinking').length"), 0)
        self.will_change_the_page()  # as one that is watched has it
        page = pathlib.Path(self.folder.name) / "running_posterior/report/report.html"
        page.write_text(page.read_text().replace('"region_history":[]', '"region_history":[[20,0.6],[40,0.3],[60,0.2]]'))
        self.driver.get(page.as_uri())
        self.assertIn("shrinking", self.check_charts())
        self.check_log()
        self.keep_screenshot("running")

    def test_verdict_comes_before_any_number(self):
        self.open_report("posterior", 60, 2, "finished", coarse_design=True)
        first = self.driver.execute_script(
            "return document.querySelector('#answer').children[1].firstElementChild.id")
        self.assertEqual(first, "verdict")

    # Before anyone scrolls: what was measured beside what is simulated with the answer.
    def test_first_screen_shows_measured_and_simulated_heap(self):
        self.open_report("posterior", 60, 2, "finished", coarse_design=True)
        pair = self.driver.find_element(By.ID, "heap-pair")
        self.assertLess(pair.rect["y"] + pair.rect["height"], 1000)
        images = pair.find_elements(By.TAG_NAME, "img")
        self.assertEqual(len(images), 2)
        self.assertTrue(all(image.get_property("naturalWidth") > 50 for image in images))
        self.assertIn("Measured", pair.text)
        self.assertIn("Simulated", pair.text)
        self.keep_first_screen("first_screen")

    # The sheet to print is one, with all that it is for.
    def test_summary_is_one_page(self):
        for name, parameters, coarse_design in (("three", 3, False), ("posterior", 2, True)):
            self.open_report(name, 60, parameters, "finished", coarse_design=coarse_design, width=800)
            self.will_change_the_page()
            sheet = pathlib.Path(self.folder.name) / name / "report" / "summary.html"
            self.driver.get(sheet.as_uri())
            text = self.driver.find_element(By.TAG_NAME, "body").text
            for words in ("Calibrated parameters", "How well it fits", "It holds for", "lift velocity", "report.html"):
                self.assertIn(words, text)
            words = self.driver.execute_script("return document.body.textContent")
            self.assertNotRegex(words, r"\d\.?\d*e[-+]\d")  # powers as people write them, on the chart's axes, too
            cut_off = self.driver.execute_script(
                "return [...document.querySelectorAll('table, svg, li, p')].filter((e) => e.getBoundingClientRect().right >"
                " e.parentElement.getBoundingClientRect().right + 1).map((e) => e.outerHTML.slice(0, 80))")
            self.assertEqual(cut_off, [])
            self.assertEqual(len(self.driver.find_elements(By.TAG_NAME, "svg")), 1)
            self.assertGreaterEqual(len(self.driver.find_elements(By.TAG_NAME, "img")), 2)
            pdf = self.driver.execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True, "printBackground": True})
            data = base64.b64decode(pdf["data"])
            self.assertEqual(len(re.findall(rb"/Type /Page\b(?!s)", data)), 1, name)
            self.keep_screenshot("summary_" + name)

    def test_each_objective_says_what_it_knows(self):
        self.open_report("posterior", 60, 2, "finished", coarse_design=True)
        rows = self.driver.execute_script(
            "return [...document.querySelectorAll('#knowledge tbody tr')].map((r) => "
            "[...r.cells].map((c) => c.textContent))")
        self.assertEqual(rows[0][0], "whole heap (SAD, RMSE)")
        self.assertTrue(all("%" in row[1] and "refits" in row[2] for row in rows), rows)

    # A lifted tube and a drum, simulated: what a page of them says, but for the spec and the tables of versions.
    def test_words_are_those_of_the_bench(self):
        folder = pathlib.Path(self.folder.name) / "words"
        shutil.copytree(self.tube_and_drum, folder)
        subprocess.run([self.talus, "predict", folder / "run", folder / "heap1.json", "--draws", "2", "--seeds", "2"],
                       check=True, stdout=subprocess.DEVNULL)
        subprocess.run([self.talus, "report", folder / "run"], check=True, stdout=subprocess.DEVNULL)
        self.will_change_the_page()
        self.driver.set_window_size(1400, 1000)
        for log in ("browser", "performance"):
            self.driver.get_log(log)  # what earlier pages left
        self.driver.get((folder / "run/report/report.html").as_uri())
        self.was_loaded = True
        self.check_charts()
        self.check_log()
        cells = self.driver.execute_script(
            "const t = document.querySelector('[aria-label=\"Prediction of heap1\"]');"
            "return [...t.querySelectorAll('tr')].map((r) => r.cells.length)")
        self.assertGreater(len(cells), 2)
        self.assertEqual(len(set(cells)), 1, cells)  # a head for each column
        text = self.driver.execute_script("const s = document.getElementById('spec'); if (s) s.remove();"
                                          "return document.body.innerText")
        self.assertNotRegex(text, r"\b[μm]u?_[trγ]\b")  # symbols, not their spelling
        self.assertNotRegex(text, r"\d\.?\d*e[-+]\d")  # powers as print has them
        self.assertNotRegex(text, r"[-−]\d[\d.]*\s?mg")  # no mass is negative
        self.assertNotIn("--experiment", text)
        self.assertIn("drum: diameter 16 mm, width 5 mm, speed 60 rpm", text)
        self.assertNotRegex(text, r"drum: [^\n]*(lift velocity|plate diameter)")
        first = self.driver.execute_script("return ['standing', 'answer'].map((id) => document.getElementById(id).innerText).join()")
        self.assertLessEqual(len(re.findall("budget", first)), 2, first)  # that it is used, and what more would do
        for section in ("convergence-section", "trials-section", "compare"):  # both experiments, side by side
            titles = [h.text for h in self.driver.find_elements(By.CSS_SELECTOR, f"#{section} .experiments h3")]
            self.assertLessEqual({"heap", "mixer"}, set(titles), section)
        self.keep_screenshot("tube_and_drum")

    # The stated range, the region's shadow and the width across a curve are not the same.
    def test_the_ranges_of_a_parameter_stand_beside_each_other(self):
        self.open_report("posterior", 60, 2, "finished", coarse_design=True)
        rows = self.driver.execute_script(
            "return [...document.querySelectorAll('#widths tbody tr')].map((r) => "
            "[...r.cells].map((c) => c.textContent))")
        self.assertEqual([row[0].split("90")[0].split("from")[0] for row in rows],
                         ["Stated range", "Shadow of the region", "Across the curve"])
        tile = self.driver.find_element(By.CSS_SELECTOR, ".value .range").text
        self.assertIn(rows[0][1], tile)
        self.assertEqual(len({row[1] for row in rows}), 3, rows)

    def test_experiment_is_not_compared_with_itself(self):
        self.open_report("three", 60, 3, "finished")
        cells = self.driver.execute_script(
            "return [...document.querySelectorAll('#measures tbody tr')].map((r) => "
            "[r.cells[0].textContent, r.cells[1].textContent])")
        iou = [own for name, own in cells if name.startswith("IoU")]
        self.assertEqual(iou, ["–"])

    def test_trials_of_several_grain_sizes_are_told_apart(self):
        self.open_report("posterior", 60, 2, "finished", coarse_design=True)
        self.check_charts(["space"])
        names = self.driver.execute_script(
            "return echarts.getInstanceByDom(document.getElementById('space')).getOption()"
            ".series.map((s) => s.name)")
        self.assertIn("scale factor 2", names)
        self.assertIn("scale factor 1", names)
        self.assertEqual(self.driver.execute_script(
            "return document.getElementById('space-objective').value"), "-1")

    # As a reader with a dark system sees it: text and background stand apart, in charts too.
    def test_dark_page_is_dark_and_readable(self):
        self.will_change_the_page()
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
            "features": [{"name": "prefers-color-scheme", "value": "dark"}]})
        try:
            self.open_report("posterior", 60, 2, "finished", coarse_design=True)
            self.check_charts()
            lightness = self.driver.execute_script(
                "const of = (colour) => colour.match(/\\d+/g).slice(0, 3).map(Number)"
                ".reduce((a, b) => a + b) / 765;"
                "const style = getComputedStyle(document.querySelector('.card'));"
                "return [of(style.backgroundColor), of(style.color)]")
            self.assertLess(lightness[0], 0.2)
            self.assertGreater(lightness[1], 0.7)
            self.assertGreater(self.driver.execute_script(
                "return parseInt(ink.slice(1, 3), 16)"), 180)  # what charts write with
            self.check_log()
            self.keep_screenshot("dark")
        finally:
            self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})

    def test_a_screen_reader_finds_a_name_for_everything(self):
        """What Chromium hands to a screen reader: charts are images with a name, and no heading skips a level."""
        named = {"button", "checkbox", "combobox", "image", "link", "slider", "table", "textbox"}
        for name, parameters, coarse_design in (("three", 3, False), ("posterior", 2, True)):
            self.open_report(name, 60, parameters, "finished", coarse_design=coarse_design)
            nodes = self.driver.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
            seen = [n for n in nodes if not n["ignored"]]
            kinds = {n["role"]["value"] for n in seen}
            self.assertLessEqual({"button", "image", "table", "heading"}, kinds)
            for node in seen:
                if node["role"]["value"] in named:
                    self.assertTrue(node["name"]["value"].strip(), node)
            by_id = {n["nodeId"]: n for n in nodes}

            def in_order(node):
                yield node
                for child in node.get("childIds", []):
                    if child in by_id:
                        yield from in_order(by_id[child])
            levels = [p["value"]["value"] for n in in_order(nodes[0]) if not n["ignored"]
                      for p in n.get("properties", []) if n["role"]["value"] == "heading" and p["name"] == "level"]
            self.assertEqual(levels[0], 1)
            for before, after in zip(levels, levels[1:]):
                self.assertLessEqual(after, before + 1, levels)

    # The first print of a page whose charts have not been seen yet has all pages that a second one has.
    def test_nothing_is_cut_off_the_end_of_the_paper(self):
        self.will_change_the_page()
        self.open_report("posterior", 60, 2, "finished", coarse_design=True)

        def pages():
            pdf = self.driver.execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True})
            return len(re.findall(rb"/Type /Page\b(?!s)", base64.b64decode(pdf["data"])))

        first = pages()
        self.assertGreater(first, 3)
        self.assertEqual(first, pages())

    # An experiment may have no trial of its own yet; and what fails in one chart leaves the others on paper.
    def test_a_chart_without_data_leaves_the_others(self):
        self.open_report("posterior", 60, 2, "finished", coarse_design=True)
        self.will_change_the_page()
        missing = self.driver.execute_script(
            "return within({...D, objectives: D.objectives.map((o) => ({...o, absent: 'no trial'}))}, () => "
            "card(spaceChart())) === null && within({...D, trials: {...D.trials, state: D.trials.id.map(() => 'running')}},"
            " () => card(convergenceChart())) === null")
        self.assertTrue(missing)
        empty = self.driver.execute_script(
            "return within({...D, objectives: D.objectives.map((o) => ({...o, absent: 'no trial'})), trials: {...D.trials,"
            " state: D.trials.id.map(() => 'failed')}}, () => element('div', {}, ...comparisonSection())).outerHTML")
        self.assertIn("No trial has succeeded", empty)
        self.assertNotIn("<table", empty)
        charts = self.driver.execute_script(
            "const fail = () => { throw new Error('broken'); };"
            "return talusCharts.unshift({id: 'broken', start: fail, toPaper: fail, redraw: fail}) - 1")
        self.driver.execute_cdp_cmd("Page.printToPDF", {})
        self.assertEqual(len(self.driver.find_elements(By.CSS_SELECTOR, "canvas.paper")), charts)
        self.driver.get_log("browser")  # the console names the broken one

    # The library labels powers of ten only, of which less than a decade may hold none.
    def test_a_short_logarithmic_axis_has_labels(self):
        self.open_report("posterior", 60, 2, "finished", coarse_design=True)
        for low, high, ticks in ((0.2, 0.9, [0.2, 0.5]), (0.02, 0.6, [0.02, 0.05, 0.1, 0.2, 0.5]), (1e-6, 1e-2, None),
                                 (0.31, 0.38, [0.32, 0.34, 0.36, 0.38]), (2e-5, 9e-5, [2e-5, 5e-5])):
            self.assertEqual(self.numbers_of(f"ticksBetween({low}, {high}) || null"), ticks)
        self.will_change_the_page()
        labels = self.driver.execute_script(
            "const p = {symbol: 'a', unit: '', low: .2, high: .9, log: true};"
            "const made = chart('short', 'short', '', () => ({xAxis: parameterAxis(p), yAxis: valueAxis('b'), series: []}));"
            "document.getElementById('main').append(made.figure);"
            "talusCharts[talusCharts.length - 1].start();"
            "return echarts.getInstanceByDom(document.getElementById('short')).getModel().getComponent('xAxis').axis"
            ".getViewLabels().map((label) => label.formattedLabel)")
        self.assertEqual(labels, ["0.2", "0.5"])
        self.check_log()

    # What no synthetic campaign has: the page's functions with other data.
    def test_words_for_what_is_rare(self):
        self.open_report("two", 40, 2, "running")

        def text(changes, make):
            return self.driver.execute_script(
                f"const made = within({{...D, {changes}}}, () => {make}); return made && made.textContent")
        self.assertEqual(
            text("campaign: {...D.campaign, state: 'finished', counts: {searched: 0, reused: 0, confirming: 0, failed: 4}}",
                 "notYet()"), "No trial succeeded: 4 failed (see Failures).")
        best = text("campaign: {...D.campaign, num_experiments: 2, experiment: 'box', objective: {...D.campaign.objective, "
                    "is_distance: true, reference: 0, value_title: 'AOR 2, off by'}}", "bestSoFar()")
        self.assertTrue(best.startswith("Best so far of box: AOR 2, off by"), best)
        row = ("{experiment: 'a', what: 'b', simulated: '', measured: 'c', judgement: '', implausibility: null, "
               "meets: 'unknown', held_out: false}")
        self.assertNotIn("..", text("", f"fitList({{fit: [{row}]}})"))
        tile = text("", "valueTile({...D.parameters[0], nuisance: true}, {value: .5, low: .4, high: .6})")
        self.assertIn("not asked for", tile)

    # WebGL draws it with a camera of its own, on a screen of any density.
    def test_the_space_of_three_parameters_is_on_paper(self):
        self.will_change_the_page()
        self.open_report("three", 60, 3, "finished")
        self.driver.execute_cdp_cmd("Page.printToPDF", {})  # seen for the first time there
        coloured = self.driver.execute_script(
            "const canvas = document.querySelector('#space + canvas.paper');"
            "const pixels = canvas.getContext('2d').getImageData(0, 80, canvas.width, canvas.height - 80).data;"
            "let count = 0;"
            "for (let i = 0; i < pixels.length; i += 4)"
            "  if (Math.max(...pixels.slice(i, i + 3)) - Math.min(...pixels.slice(i, i + 3)) > 40) ++count;"
            "return count")
        self.assertGreater(coloured, 500)

    # Every chart is drawn, seen or not, and none is wider than A4 with its margins.
    def test_prints_on_a4(self):
        self.will_change_the_page()
        self.open_report("posterior", 60, 2, "finished", coarse_design=True)
        self.driver.execute_script("for (const made of talusCharts) made.start()")
        end = time.monotonic() + MOST_SECONDS
        while time.monotonic() < end and not self.driver.execute_script(
                "return talusCharts.every((c) => c.drawn)"):
            time.sleep(0.05)
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": 688, "height": 1017, "deviceScaleFactor": 1, "mobile": False})
        try:
            self.assertEqual(self.driver.execute_script(
                "return talusCharts.filter((c) => !c.drawn).map((c) => c.id)"), [])
            # The page hears of the paper by an event, in a moment of its own.
            count = len(self.driver.execute_script("return talusCharts"))
            WebDriverWait(self.driver, MOST_SECONDS).until(
                lambda d: len(d.find_elements(By.CSS_SELECTOR, "canvas.paper")) == count)
            too_wide = self.driver.execute_script(
                "return [...document.querySelectorAll('canvas, img, figure, .card')]"
                ".filter((e) => e.getBoundingClientRect().right > 689).map((e) => e.outerHTML.slice(0, 80))")
            self.assertEqual(too_wide, [])
            pdf = self.driver.execute_cdp_cmd("Page.printToPDF", {
                "paperWidth": 8.27, "paperHeight": 11.69, "printBackground": True, "preferCSSPageSize": True})
            printed = base64.b64decode(pdf["data"])
            self.assertGreater(printed.count(b"/Type /Page\n"), 2)
            if self.shots is not None:
                (pathlib.Path(self.shots) / "print.pdf").write_bytes(printed)
        finally:
            self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
            self.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


if __name__ == "__main__":
    main(sys.argv)
