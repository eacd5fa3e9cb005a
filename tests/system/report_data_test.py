#!/usr/bin/python3
"""report_data_test.py TALUS MAKE_SYNTHETIC_CAMPAIGN TUBE_AND_DRUM: what the page of a report makes of its data, in
headless Chromium: words, numbers, columns and the series of charts beside what they are made of."""
import re
import sys

from report_page import By, ReportPage, main


class ReportOfKnownData(ReportPage):
    def test_numbers_are_written_as_print_has_them(self):
        self.open_report("three", 60, 3, "finished")
        for call, text in (("format(-12.34)", "−12.3"), ("format(123456)", "1.23 × 10⁵"), ("format(-2e-5)", "−2.00 × 10⁻⁵"),
                           ("format(NaN)", "–"), ("format(null)", "–"), ("tick(1e5)", "10⁵"), ("tick(2e-5)", "2 × 10⁻⁵"),
                           ("percent(4e-4)", "< 0.1 %"), ("percent(null)", "–"), ("duration(5400)", "90.0 min"),
                           ("duration(7200)", "2.00 h"), ("widthText(D.parameters[2], .5)", "a factor of 20"),
                           ("widthText({low: 10, high: 20, unit: 'mm'}, .5)", "5.0 mm"),
                           ("inWords({title: 'AOR', is_distance: true})", "distance from the measured AOR"),
                           ("setText([.1, .2, 1e-5])", "μₜ 0.100, μᵣ 0.200, γ 1.00 × 10⁻⁵ J/m²")):
            self.assertEqual(self.numbers_of(call), text, call)

    def test_no_text_is_taken_for_markup(self):
        self.open_report("three", 60, 3, "finished")
        self.assertEqual(self.numbers_of("element('p', {}, '<i>a</i>', ['<i>']).innerHTML"), "&lt;i&gt;a&lt;/i&gt;&lt;i&gt;")
        self.assertEqual(self.numbers_of("lines(['<i>', 'b'])"), "&lt;i&gt;<br>b")
        for part in ("D.warnings", "D.left_out"):
            name = part.split(".")[1]
            call = {"warnings": "alarms()", "left_out": "leftOut()"}[name]
            self.assertIn("<li>a <code>b</code></li>", self.made(f"{name}: ['a `b`']", call, "innerHTML"))

    def test_answer_is_told_with_its_ranges_and_doubts(self):
        self.open_report("three", 60, 3, "finished")
        self.assertEqual([e.text.strip() for e in self.driver.find_elements(By.CSS_SELECTOR, "#answer .value .number")],
                         ["0.320", "0.210", "3.00 × 10⁻⁵ J/m²"])
        tile = "valueTile({...D.parameters[2], low: 1e-6, high: 1e-2}, {value: 1e-4, low: 1e-5, high: 1e-3, prior: 'flat'})"
        self.assertIn("90\u00a0% range 1.00 × 10⁻⁵ to 0.00100 J/m² (prior flat)", self.made("", tile))
        places = [float(x) for x in re.findall(r"(?:left|width):([\d.]+)%", self.made("", tile, "innerHTML"))]
        for place, expected in zip(places, (25, 50, 50), strict=True):  # the band's start and width, the dot
            self.assertAlmostEqual(place, expected, 6)
        said = "verdict({sentences: ['S.'], verdict_kind: 'curve', fits: %s, trade_off: 'T.', fit_sentence: 'F.', use: 'U.'})"
        self.assertEqual(self.made("", said % "false"), "S.T.F.Use it now? U.")
        self.assertIn("S.The parameters trade", self.made("", said % "true"))
        row = ("{experiment: 'a', what: 'b', simulated: '%s', measured: '4', judgement: 'low', implausibility: %s, "
               "meets: '%s', held_out: %s}")
        fit = self.made("", "fitList({fit: [%s, %s]})" % (row % ("3", "4.21", "no", "true"), row % ("", "null", "yes", "false")))
        self.assertIn("a, b ✗ missesHeld out: not used for the answer.Simulated: 3.Measured: 4.low; implausibility 4.2."
                      "a, b ✓ fitsSimulated: not yet.Measured: 4.low.", fit)
        steps = "nextSteps({next: [{what: 'w', cost: 'c', leaves: 'l'}], fits: %s, verdict_kind: 'point', has_card: true})"
        self.assertRegex(self.made("", steps % "true"), r"talus card .* writes the set.*wCosts c\.Leaves l\.")
        self.assertIn("First what", self.made("", steps % "false"))
        branch = "{share: .25, values: [.1, .2, 1e-5], low: [.05, .1, 1e-6], high: [.15, .3, 1e-4]}"
        self.assertEqual(self.rows("", f"branches({{branches: [{branch}, {branch}]}})")[0],
                         ["μₜ", *["0.1000.0500 to 0.150"] * 2])
        facts = self.made("campaign: {...D.campaign, objective: {...D.campaign.objective, noise_floor: null}}",
                          "facts({...D.headline, predicted: 1, predicted_sd: .2, noise_sd: .3, region_volume: .04})")
        for words in ("1.00 mm² ± 0.20", "0.300 mm²", "unknown", "4.0 %"):
            self.assertIn(words, facts)
        self.assertNotIn("unknown", self.made("", "facts(D.headline)"))
        for key, call in (("held_out", "Held out"), ("conditions", "It holds for")):
            self.assertIn(call + "of it", self.made(f"{key}: ['of it']", "answerSection()"))
        self.assertNotIn("Held out", self.made("held_out: []", "answerSection()"))
        set_ = "{values: [.1, .2, 1e-5], recommended: %s, uri: 'data:,', trial: 7, trial_values: [.3, .2, 1e-5], "\
               "trial_objective: 2, distance: %s, expected: 1, expected_sd: .5}"
        heaps = self.made("", "representativeHeaps({representatives: [%s, %s]})" % (set_ % ("true", "0"), set_ % ("false", ".1")))
        self.assertRegex(heaps, r"^Recommended: μₜ 0\.100, .*Trial 7: SAD 2\.00 mm²; expected of the mean heap 1\.00 mm² ± 0\.50\."
                                r"Set 1: .*Trial 7, the nearest simulated, at μₜ 0\.300")

    def test_what_next_and_sensitivity_have_found_is_told(self):
        self.open_report("three", 60, 3, "finished")
        candidate = ("{name: 'n', what: 'w', remaining: .25, bits: 2, needs_simulations: false, goal: .1, width: [.5, .5, .5],"
                     " simulations: 3, core_time: 150, apart: [[.1, .2, 1e-5], [.3, .4, 1e-5]], apart_by: [], uri: 'data:,'}")
        table = (f"next: {{width: [1, 1, 1], asked: '', outdated: %s, candidates: [{candidate}],"
                 " goal: {title: 'Angle', process: 'drum', unit: '°', half_width: .2}}")
        said = self.made(table % "true", "nextTable()")
        self.assertIn("Trials have ended since", said)
        self.assertNotIn("Trials have ended since", self.made(table % "false", "nextTable()"))
        self.assertIn("known within ±now 0.20°", said)
        self.assertIn("μₜ known withinnow 0.70", said)
        self.assertIn("first μₜ 0.100, μᵣ 0.200, γ 1.00 × 10⁻⁵ J/m², second μₜ 0.300", said)
        self.assertEqual(self.rows(table % "true", "nextTable()"),
                         [["n: w", "3 simulations, 2.50 min", "0.10°", "25.0 %", "2.0", "0.35", "0.35", "a factor of 20"]])
        shift = "{to: .4, error: .01, low: .3, high: .5, exceeds: %s, told: %s}"
        move = ("{name: 'e', from: '1', to: '2', why_not: '%s', fits_no_set: false, moves_still: false, answer: ["
                + ", ".join(shift % of for of in (("true", "true"), ("false", "true"), ("false", "false"))) + "]}")
        moved = "sensitivity: {outdated: %%s, scale_factor: 2, alarms: ['alarm'], moves: [%s, %s]}" % (
            move % "", move.replace(re.search(r"\[.*\]", move)[0], "[]") % "broken")
        told = self.made(moved % "true", "sensitivity()")
        self.assertIn("Trials have ended since", told)
        self.assertIn("alarm.", told)
        cell = "0.400 ± 0.01 (0.30 to 0.50)"
        self.assertEqual(self.rows(moved % "false", "sensitivity()"), [
            ["e 2 in place of 1", cell + " !", cell, "0.400 J/m² ± 0.01 (0.30 to 0.50) ?"],
            ["e 2 in place of 1: not known, broken", "?", "?", "?"]])

    def test_tables_hold_their_columns(self):
        self.open_report("three", 60, 3, "finished")
        campaign = "campaign: {...D.campaign, counts: {searched: 5, reused: 2, confirming: 1, failed: 3, running: 4}, core_hours: 3, %s}"
        self.assertEqual(self.made(campaign % "stop_reason: 'why'", "...standing()"),
                         "finished 5 simulations of at most 120 and 1 that confirms the answer · 3 failed · 4 to be run or collected · "
                         "reused: 2 simulations · 3.00 h of core time in all. Why it stopped: why")
        going = "campaign: {...D.campaign, state: 'running', counts: {searched: 5, running: 4}, stop_reason: 'an `a b` ended it'}"
        self.assertIn(" · 4 under way", self.made(going, "...standing()"))
        self.assertIn("an <code>a b</code> ended it", self.made(going, "...standing()", "innerHTML"))
        self.assertEqual(self.rows("headline: {...D.headline, sobol_first: [.1, .2, .3], sobol_total: [.4, .5, .6]}",
                                   "sensitivityTable()")[0], ["μₜ", "10.0 %", "40.0 %"])
        known = "{title: 't', absent: '', region: .2, low: .1, high: .3, holds: %s, num_holding: 3, num_refits: 4}"
        self.assertEqual(self.rows(f"knowledge: [{known % 'true'}, {known % 'false'}]", "knowledgeTable()"), [
            ["t", "20.0 % (10.0 % to 30.0 %)", "yes; 3 of 4 refits do"],
            ["t", "20.0 % (10.0 % to 30.0 %)", "no; 3 of 4 refits do"]])
        best = ("[{trials: [7], values: [.1, .2, 1e-5], quantity: 31, objective: 1}, "
                "{trials: [8, 9], values: [.3, .4, 2e-5], quantity: 28, objective: 2}]")
        found = ("knowledge: [], objectives: [{title: 'AOR', unit: '°', is_distance: true, reference: 30, reference_error: .5, "
                 f"noise_sd: 1, absent: '', trials: {{num_sets: 9, num_tied: 2, best: {best}}}}}]")
        self.assertEqual(self.rows(found, "comparisonSection()"), [
            ["AOR", "31.00°", "30.00° ± 0.50", "0.100", "0.200", "1.00 × 10⁻⁵", "2 of 9"],
            ["1", "31.00", "1.00", "0.100", "0.200", "1.00 × 10⁻⁵", "7"],
            ["2", "28.00", "2.00", "0.300", "0.400", "2.00 × 10⁻⁵", "8, 9"]])
        metrics = "[['sad_mm2', 'SAD', 'mm²'], ['nebp_px', 'NEBP', 'px'], ['iou', 'IoU', ''], ['angle_deg', 'Angle', '°']]"
        measured = (f"metrics: {metrics}.map(([name, title, unit]) => ({{name, title, unit}})), measures: ["
                    "{title: 'experiment', note: '', values: [0, 1, 1, 30]}, {title: 'trial 3', note: '', values: [.5, 2, .9, null]}]")
        self.assertEqual(self.rows(measured, "measuresTable()"), [
            ["SAD (mm²)", "–", "0.5000"], ["IoU", "–", "0.9000"], ["Angle (°)", "30.00", "not defined"]])
        failed = "trials: {id: [1, 2, 3, 4], state: ['failed', 'failed', 'failed', 'ok'], reason: ['x', 'seed 1', 'seed 2', '']}"
        self.assertEqual(self.rows(failed, "failuresSection()"), [["seed 1 (the numbers differ)", "2", "2, 3"], ["x", "1", "1"]])
        self.assertEqual(self.rows("stages: [{name: 'n', seconds: 7200}]", "stagesTable()"), [["n", "2.00 h"]])
        self.assertTrue(self.driver.find_elements(By.CSS_SELECTOR, "#failures tbody tr"))
        self.assertIn("were calibrated with talus", self.driver.find_element(By.ID, "methods-text").text)

    def test_predictions_are_told_as_talus_predict_tells_them(self):
        self.open_report("three", 60, 3, "finished")
        number = ("{title: '%s', unit: '°', usual: %s, mean: 30, low: 20, high: 40, parameters_sd: 3, run_sd: 1, "
                  "parameters_share: .9, silent: '', surrogate: {used: true, scale_factor: 1.5, left_out: .2, draws: .4}, measured: %s}")
        inside = "{value: 33, error: .5, inside: %s, another_inside: %s, another_is_told: true}"
        made = ("{name: 'p', test: 'drum', by: 'posterior', scale_factor: 1.5, draws: 2, runs: 4, ended: %s, outdated: %s, notes: [], "
                f"numbers: [{number % ('A', 'false', 'null')}, {number % ('B', 'true', inside % ('true', 'true'))}, "
                f"{number % ('C', 'false', inside % ('false', 'true'))}, {number % ('D', 'false', inside % ('false', 'false'))}],"
                " mean: 'data:,', mean_size: [1, 1], different: 'data:,', different_size: [1, 1], "
                "different_sets: [[.1, .2, 1e-5], [.3, .4, 1e-5]]}")
        line = "p: B 30.0°, 90\u00a0% of runs in 20.0 to 40.0°; 90.0 % of the variance from the parameters; measured 33.0° ± 0.50: inside"
        self.assertEqual(self.made("", f"predictionLine({made % (4, 'false')})"), line)
        self.assertEqual(self.made("", f"predictionLine({made % (3, 'true')})"),
                         line + " (3 of 4 runs); by an earlier state of the campaign: predict again")
        card = self.made("", f"predictionCard({made % (4, 'true')})")
        for words in ("3 of 4", "left μₜ 0.100, ", "right μₜ 0.300, ", "predict again", "scale factor 1.50, 4 of 4 runs"):
            (self.assertNotIn if words == "3 of 4" else self.assertIn)(words, card)
        self.assertNotIn("predict again", self.made("", f"predictionCard({made % (4, 'false')})"))
        told = ["30.0°", "20.0 to 40.0°", "3.0°", "1.0°", "90.0 %", "surrogate, scale factor 1.50 (0.20° and 0.40°)"]
        self.assertEqual(self.rows("", f"predictionCard({made % (4, 'false')})"), [
            ["A", *told, "–"], ["B", *told, "33.0° ± 0.50: inside"], ["C", *told, "33.0° ± 0.50: outside, yet a draw gives it"],
            ["D", *told, "33.0° ± 0.50: outside, and no draw gives it"]])

    def test_a_heap_lies_over_its_photograph(self):
        self.open_report("three", 60, 3, "finished")
        self.will_change_the_page()
        picture = "{title: '%s', uri: 'data:image/png;base64,%s', width: 100, height: 50}"
        overlay = (f"overlay: {{photographs: [{picture % ('a', 'A')}, {picture % ('b', 'B')}], simulated: {picture % ('trial 1', 'S')}, "
                   "pixel_mm: .5, center_x: 50, baseline: 40, outlines: [{title: 'o', points: [[-5, 0], [0, 10]]}]}")
        found = self.driver.execute_script(
            f"const made = within({{...D, {overlay}}}, overlayFigure); document.getElementById('main').append(made);"
            "const set = (e, changes, event) => { Object.assign(e, changes); e.dispatchEvent(new Event(event)); };"
            "const [photograph, simulated] = made.querySelectorAll('.layers img'), svg = made.querySelector('svg');"
            "set(made.querySelector('[type=range]'), {value: 20}, 'input'); set(made.querySelector('select'), {value: 1}, 'change');"
            "const before = svg.style.display; set(made.querySelector('[type=checkbox]'), {checked: false}, 'change');"
            "const box = (e) => JSON.stringify(e.getBoundingClientRect());"
            "return [svg.firstChild.getAttribute('points'), simulated.style.clipPath, photograph.src.slice(-1), before, svg.style.display]")
        self.assertEqual(found, ["40.00,40.00 50.00,20.00", "inset(0px 0px 0px 20%)", "B", "", "none"])
        self.assertEqual(self.driver.execute_script(
            "return getComputedStyle(document.querySelector('.layers .above')).position"), "absolute")
        pictures = (f"overlay: null, pictures: [{picture % ('Experiment (AEHP)', 'E')}, {picture % ('ANHP of trial 9, a confirming one', 'C')}]")
        self.assertRegex(self.made(pictures, "heapPair()", "innerHTML"), "base64,E.*Measured.*base64,C.*Simulated")

    def test_running_campaign_says_how_far_it_is(self):
        self.open_report("two", 40, 2, "running")
        self.assertIn("of 0.226 mm² ± 0.0092 there.", self.driver.find_element(By.ID, "answer").text)
        trials = ("trials: {id: [1, 2, 3, 4, 5], state: ['ok', 'ok', 'ok', 'failed', 'ok'], purpose: ['design', 'search', 'search', 'search', 'confirm'],"
                  " scale: [2, 1, 1, 1, 1], values: [[.1, .2, .3, .4, .5], [.6, .7, .8, .9, 1]], metrics: [[28, 35, 33, 30, 30]]}, "
                  "metrics: [{name: 'a', title: 'A', unit: '°'}]")
        self.assertEqual(self.made(f"campaign: {{...D.campaign, objective: {{metric: 'a', unit: '°', is_distance: false}}}}, {trials}", "bestSoFar()"),
                         "Best so far33.0°trial 3: μₜ 0.300, μᵣ 0.800")
        self.assertEqual(self.made("campaign: {...D.campaign, objective: {metric: 'a', unit: '°', is_distance: true, reference: 34, "
                                   f"value_title: 'off by'}}}}, {trials}", "bestSoFar()"),
                         "Best so far: off by1.00°trial 2: μₜ 0.200, μᵣ 0.700")
        self.assertEqual(self.made("campaign: {...D.campaign, seconds_left: 5400}", "timeLeft()"),
                         "Time leftat most 90.0 minby the budget, with the confirmation")

    def test_charts_draw_what_was_found(self):
        self.open_report("posterior", 60, 2, "finished", coarse_design=True)
        self.will_change_the_page()
        data = self.numbers_of("D")
        trials, sad = data["trials"], data["trials"]["metrics"][0]
        best, least = [], float("inf")
        for i, number in enumerate(trials["id"]):
            if trials["state"][i] == "ok" and trials["purpose"][i] != "confirm" and trials["scale"][i] == 1 and sad[i] < least:
                least = sad[i]
                best.append([number, least])
        best.append([60, least])
        noise = data["campaign"]["objective"]["noise_sd"]
        self.assertEqual(self.option("convergence", "of('best so far').data"), best)
        self.assertEqual(self.option("convergence", "of('noise floor of the experiment').data"), [[0, 1.3], [60, 1.3]])
        self.assertEqual(self.option("convergence", "of('± noise of one trial').data.map((p) => p[1])"),
                         [y + noise - max(0, y - noise) for _, y in best])
        self.assertFalse(self.numbers_of("document.querySelector('#convergence-section input').disabled"))
        self.assertEqual(self.option("times", "of('failed').data.map((p) => p[0])"),
                         [n for n, state in zip(trials["id"], trials["state"]) if state == "failed"])

        self.driver.execute_script("talusCharts.find((c) => c.id === 'space').start();"
                                   "const s = document.getElementById('space-objective'); s.value = 0; s.dispatchEvent(new Event('change'))")
        known = sorted(s for s, state in zip(sad, trials["state"]) if state == "ok")
        self.assertEqual(self.option("space", "[one(o.visualMap).min, one(o.visualMap).max, one(one(o.visualMap).inRange.color)]"),
                         [known[0], known[int(.9 * (len(known) - 1))], "#440154"])
        self.assertEqual(self.option("space", "one(o.visualMap).text"),
                         [self.numbers_of("'≥ ' + formatUnit(%r, 'mm²')" % known[int(.9 * (len(known) - 1))]),
                          self.numbers_of("'SAD  ' + format(%r)" % known[0])])
        self.assertEqual(self.option("space", "of('recommended').data"), [[.32, .21, 0, -1]])
        self.assertEqual([trials["id"][i] for i in self.option("space", "of('ten best by SAD').data.map((p) => p.value[3])")],
                         [b["trials"][0] for b in data["objectives"][0]["trials"]["best"]])
        slice_ = data["slices"][1]
        series = "o.series.map((s) => s.data.map((p) => p[1]))"
        low, width, mean = self.option("slice-1", series)
        self.assertEqual([low, mean], [slice_["low"], slice_["mean"]])
        self.assertEqual(width, [b - a for a, b in zip(slice_["low"], slice_["high"])])
        for chart in ("slice-1", "marginal-1"):
            self.assertEqual(self.option(chart, "o.series.flatMap((s) => s.markLine ? s.markLine.data.map((mark) => mark.xAxis) : [])"), [.21])
        marginal = data["marginals"][1]
        self.assertIn(self.numbers_of("format(%r, 2)" % (marginal["density"][40] / marginal["prior"][40])) + " times",
                      self.option("marginal-1", "one(o.tooltip).formatter([{dataIndex: 40}])"))
        pair = data["pairs"][0]
        nx = len(pair["x"]) - 1
        cells = self.option("region", "o.series[0].data")
        self.assertTrue(cells == [[k % nx, k // nx, v] for k, v in enumerate(pair["value"]) if v < .9], cells[:3])
        self.assertEqual(self.option("region", "o.series[1].data[0].value"), [.32, .21])
        self.assertEqual(self.numbers_of("[.49, .51].map(regionShade)"), data["colors"]["regions"])
        self.assertEqual(self.numbers_of("zoomed([0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0], Array.from({length: 13}, (_, k) => k))"),
                         {"low": 2, "high": 10})
        self.assertEqual(self.option("outlines", "one(o.tooltip).formatter({seriesName: 's', data: [1, 2]})"),
                         "s<br>1.00 mm from the centre, 2.00 mm high")
        self.assertEqual(self.option("outlines", "o.series[o.series.length - 1].data"), [[-5, 0], [5, 0]])
        self.assertEqual(self.option("outlines", "o.series[0].lineStyle.width"), 3)
        self.assertEqual(self.numbers_of("thin([...Array(10).keys()], 3, new Set([1]))"), [0, 1, 3, 6])
        self.assertEqual(self.numbers_of("trialText(59).slice(0, 4)"), ["Trial 60, confirm", *(
            f"{p['symbol']} = " + self.numbers_of("format(%r)" % v[59]) for p, v in zip(data["parameters"], trials["values"])),
            "SAD = " + self.numbers_of("formatUnit(%r, 'mm²')" % sad[59])])
        self.assertEqual(self.numbers_of("scaleFactors"), [2, 1])

    def test_space_of_three_has_logarithmic_axes_and_the_region_its_words(self):
        self.open_report("three", 60, 3, "finished")
        self.will_change_the_page()
        *star, _, _ = self.option("space", "of('recommended').data[0]")
        self.assertEqual([round(x, 6) for x in star], [.32, .21, -4.522879])
        self.assertEqual(self.option("space", "one(o.zAxis3D).axisLabel.formatter(-5)"), "10⁻⁵")
        caption = self.numbers_of("document.getElementById('region').parentElement.textContent")
        pair = self.numbers_of("D.pairs[D.closest_pair]")
        share = sum(v < .9 for v in pair["value"]) / len(pair["value"])
        self.assertIn("The light area is " + self.numbers_of("percent(%r)" % share), caption)

    def test_trials_stand_in_their_columns_and_conditions_hold(self):
        self.open_report("three", 60, 3, "finished")
        self.will_change_the_page()
        for condition, rows in (("a>=2", [1, 2]), ("a<=2", [0, 1]), ("a<2", [0]), ("a>2", [2]), ("a=2", [1])):
            self.assertEqual(self.numbers_of("[0, 1, 2, 3].filter(condition('%s', [{key: 'a', title: 'A', value: (i) => "
                                             "[1, 2, 3, null][i]}]))" % condition), rows, condition)
        values = self.numbers_of("D.trials.values.map((column) => format(column[0], 4))")
        self.assertEqual([self.column(name)[0] for name in ("sliding_friction", "rolling_friction", "surface_energy")], values)
        self.assertEqual(self.column("reason")[12], self.numbers_of("D.trials.reason[12]"))
        self.assertEqual(self.numbers_of("[...document.querySelectorAll('#trials tr.failed')].map((r) => r.cells[1].textContent)"
                                         ".filter((t) => t !== 'failed').length + document.querySelectorAll('#trials tr.failed').length"), 3)
        able = "[...document.querySelectorAll('#trials-section .row button')].map((b) => b.disabled)"
        self.assertEqual(self.numbers_of(able), [True, False])
        turn = "document.querySelectorAll('#trials-section .row button')[1].click();"
        count = "document.getElementById('trial-count').textContent"
        self.assertEqual(self.driver.execute_script(f"{turn} return [{able}, {count}]"), [[False, True], "51 to 60 of 60 trials"])
        sort = "document.querySelector('#trials th[data-key=trial]').click();"
        self.assertEqual(self.driver.execute_script(f"{sort} return {count}"), "1 to 50 of 60 trials")
        typed = ("const f = document.getElementById('trial-filter');"
                 "const type = (text) => { f.value = text; f.dispatchEvent(new Event('input')); };")
        self.assertEqual(self.driver.execute_script(f"{typed} {turn} type('state=ok'); return {count}"), "1 to 50 of 56 trials")
        self.assertEqual(self.driver.execute_script(f"{typed} type('nowhere'); return {count}"), "no trial fits")
        self.assertEqual(self.driver.execute_script(
            "const box = document.querySelector('#trials-section [type=checkbox]'), all = document.getElementById('trials').classList;"
            "const before = all.contains('all'); box.checked = true; box.dispatchEvent(new Event('change'));"
            "return [before, all.contains('all')]"), [False, True])


if __name__ == "__main__":
    main(sys.argv)
