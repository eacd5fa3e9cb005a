#!/usr/bin/python3
"""report_browser_test.py TALUS MAKE_SYNTHETIC_CAMPAIGN: opens reports in headless Chromium and checks
that they load nothing from elsewhere, that no script fails, that every chart draws its data, and that
the table of trials sorts and filters. With a third argument, it keeps screenshots in that folder."""
import json
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By

# Pixels of a colour that is not grey: the axes and the text of a chart are grey, its data are not.
COUNT_COLOURED = """
const chart = echarts.getInstanceByDom(document.getElementById(arguments[0]));
const canvas = chart.getRenderedCanvas({pixelRatio: 1, backgroundColor: "#fff"});
const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
let count = 0;
for (let i = 0; i < pixels.length; i += 4) {
  const [r, g, b] = [pixels[i], pixels[i + 1], pixels[i + 2]];
  if (Math.max(r, g, b) - Math.min(r, g, b) > 40) ++count;
}
return count;
"""


class ReportInABrowser(unittest.TestCase):
    talus = maker = shots = None

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="talus_report_")
        options = Options()
        for flag in ("--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     "--enable-unsafe-swiftshader",  # WebGL without a GPU
                     "--hide-scrollbars", "--user-data-dir=" + cls.folder.name + "/profile"):
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        cls.driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)

    @classmethod
    def tearDownClass(cls):
        cls.driver.quit()
        cls.folder.cleanup()

    def open_report(self, name, trials, parameters, state, width=1400):
        campaign = pathlib.Path(self.folder.name) / name
        if not campaign.exists():
            subprocess.run([self.maker, campaign, str(trials), str(parameters), state], check=True)
            subprocess.run([self.talus, "report", campaign], check=True, stdout=subprocess.DEVNULL)
        self.driver.set_window_size(width, 1000)
        for log in ("browser", "performance"):
            self.driver.get_log(log)  # what earlier pages left
        self.driver.get((campaign / "report" / "report.html").as_uri())

    def check_log(self):
        severe = [e["message"] for e in self.driver.get_log("browser") if e["level"] == "SEVERE"]
        self.assertEqual(severe, [])
        messages = [json.loads(e["message"])["message"] for e in self.driver.get_log("performance")]
        urls = [m["params"]["request"]["url"] for m in messages
                if m["method"] == "Network.requestWillBeSent"]
        self.assertTrue(urls)
        self.assertEqual([u for u in urls if not u.startswith(("file:", "data:", "blob:"))], [])

    def check_charts(self):
        charts = self.driver.execute_script("return talusCharts.map((c) => c.id)")
        for chart in charts:
            element = self.driver.find_element(By.ID, chart)
            self.driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", element)
            drawn = "return talusCharts.find((c) => c.id === arguments[0]).drawn"
            end = time.monotonic() + 60
            while not self.driver.execute_script(drawn, chart) and time.monotonic() < end:
                time.sleep(0.05)
            self.assertTrue(self.driver.execute_script(drawn, chart), chart + " was not drawn")
            coloured = self.driver.execute_script(COUNT_COLOURED, chart)
            self.assertGreater(coloured, 60, chart + " shows no data")  # a point has some 30 pixels
        return charts

    def keep_screenshot(self, name):
        if self.shots is None:
            return
        height = self.driver.execute_script("return document.documentElement.scrollHeight")
        self.driver.set_window_size(self.driver.get_window_size()["width"], height + 100)
        time.sleep(1)
        self.driver.save_screenshot(str(pathlib.Path(self.shots) / (name + ".png")))

    def column(self, key):
        return self.driver.execute_script(
            "const heads = [...document.querySelectorAll('#trials th')];"
            "const k = heads.findIndex((h) => h.dataset.key === arguments[0]);"
            "return [...document.querySelectorAll('#trials tbody tr')].map((r) => r.cells[k].textContent)",
            key)

    def test_finished_campaign_with_three_parameters(self):
        self.open_report("three", 60, 3, "finished")
        charts = self.check_charts()
        self.assertEqual(len(charts), 4 + 3 + 3)  # convergence, space, outlines, times; slices; pairs
        self.assertIn("three parameters", self.driver.find_element(By.ID, "space-section").text)
        self.check_log()
        self.keep_screenshot("three")

    def test_running_campaign_with_two_parameters(self):
        self.open_report("two", 40, 2, "running")
        self.assertEqual(len(self.check_charts()), 4 + 2 + 1)
        self.assertIn("not concluded yet", self.driver.find_element(By.ID, "answer").text)
        self.check_log()
        self.keep_screenshot("two")

    def test_campaign_that_has_just_begun(self):
        self.open_report("begun", 2, 3, "running")
        self.check_charts()
        self.check_log()

    def test_campaign_of_ten_thousand_trials(self):
        self.open_report("many", 10000, 3, "running")
        self.check_charts()
        self.driver.find_element(By.ID, "trial-filter").send_keys("state=failed")
        self.assertEqual(set(self.column("state")), {"failed"})
        self.assertIn("1 to 50 of ", self.driver.find_element(By.ID, "trial-count").text)
        self.check_log()
        self.keep_screenshot("many")

    def test_colouring_by_another_objective_redraws(self):
        self.open_report("three", 60, 3, "finished")
        self.check_charts()
        picture = ("return echarts.getInstanceByDom(document.getElementById('space'))"
                   ".getDataURL({pixelRatio: 1})")
        before = self.driver.execute_script(picture)
        self.assertEqual(before, self.driver.execute_script(picture))
        self.driver.execute_script("const s = document.getElementById('space-objective'); s.value = 2;"
                                   "s.dispatchEvent(new Event('change'))")
        self.assertNotEqual(before, self.driver.execute_script(picture))
        self.check_log()

    def test_table_sorts_filters_and_turns_pages(self):
        self.open_report("three", 60, 3, "finished")
        head = self.driver.find_element(By.CSS_SELECTOR, "#trials th[data-key=sad_mm2]")
        self.driver.execute_script("arguments[0].click()", head)
        rising = [float(x) for x in self.column("sad_mm2") if x != "–"]
        self.assertEqual(rising, sorted(rising))
        self.driver.execute_script("arguments[0].click()", head)
        falling = [float(x) for x in self.column("sad_mm2") if x != "–"]
        self.assertEqual(falling, sorted(falling, reverse=True))
        self.assertGreater(falling[0], rising[0])

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
        self.open_report("three", 60, 3, "finished", width=500)  # the least that a window can have
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": 390, "height": 844, "deviceScaleFactor": 1, "mobile": True})
        try:
            self.open_report("three", 60, 3, "finished", width=500)
            self.check_charts()
            width = self.driver.execute_script("return document.documentElement.scrollWidth")
            self.assertEqual(width, 390)
            self.keep_screenshot("phone")
        finally:
            self.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


if __name__ == "__main__":
    ReportInABrowser.talus, ReportInABrowser.maker = sys.argv[1:3]
    ReportInABrowser.shots = sys.argv[3] if len(sys.argv) > 3 else None
    unittest.main(argv=sys.argv[:1])
