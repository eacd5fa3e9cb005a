"""A report in headless Chromium, for tests of its page. Ends with 77 where there is no browser to open it."""
import fcntl
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.ui import WebDriverWait
except ImportError:
    print("no report was opened: selenium is not installed for this Python (package python3-selenium)")
    sys.exit(77)

DRIVER = pathlib.Path("/usr/bin/chromedriver")
MOST_SECONDS = 300  # until a page has drawn itself, on a busy machine; what hangs ends there

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


def roomy_memory():
    """A folder in memory where there is one with a gigabyte of room: thousands of trials are journalled there at
    once, where a disk is waited for three times as long. None: where temporary files lie."""
    memory = pathlib.Path("/dev/shm")
    return memory if memory.is_dir() and shutil.disk_usage(memory).free > 1e9 else None


class ReportPage(unittest.TestCase):
    talus = maker = tube_and_drum = shots = None
    shown = None  # the page and its width, as long as nothing has changed it

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="talus_report_", dir=roomy_memory())
        options = Options()
        for flag in ("--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     "--enable-unsafe-swiftshader",  # WebGL without a GPU
                     "--hide-scrollbars", "--user-data-dir=" + cls.folder.name + "/profile"):
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        cls.driver = webdriver.Chrome(service=Service(str(DRIVER)), options=options)

    @classmethod
    def tearDownClass(cls):
        cls.driver.quit()
        cls.folder.cleanup()

    def open_report(self, name, trials, parameters, state, width=1400, coarse_design=False):
        """A page that a test before has opened and left as it was is not opened again."""
        campaign = pathlib.Path(self.folder.name) / name
        if not campaign.exists():
            subprocess.run([self.maker, campaign, str(trials), str(parameters), state] +
                           (["coarse_design"] if coarse_design else []), check=True)
            with open(campaign / "campaign.lock", "w") as lock:
                if state == "running":  # somebody works on it
                    fcntl.flock(lock, fcntl.LOCK_EX)
                subprocess.run([self.talus, "report", campaign], check=True, stdout=subprocess.DEVNULL)
        for log in ("browser", "performance"):
            self.driver.get_log(log)  # what earlier pages left
        self.was_loaded = ReportPage.shown != (name, width)
        if self.was_loaded:
            self.driver.set_window_size(width, 1000)
            self.driver.get((campaign / "report" / "report.html").as_uri())
        ReportPage.shown = (name, width)

    def will_change_the_page(self):
        """To be called by a test that does."""
        def forget():
            ReportPage.shown = None
        forget()
        self.addCleanup(forget)

    def check_log(self):
        severe = [e["message"] for e in self.driver.get_log("browser") if e["level"] == "SEVERE"]
        self.assertEqual(severe, [])
        messages = [json.loads(e["message"])["message"] for e in self.driver.get_log("performance")]
        urls = [m["params"]["request"]["url"] for m in messages
                if m["method"] == "Network.requestWillBeSent"]
        self.assertTrue(urls or not self.was_loaded)
        self.assertEqual([u for u in urls if not u.startswith(("file:", "data:", "blob:"))], [])
        standing = self.driver.find_element(By.ID, "standing").text
        self.assertRegex(standing, r"^\w[\w ]* \d+ simulations|talus resume \S+ goes on\. \d+ sim")
        self.assertNotRegex(standing, r"null|undefined|\[object")

    def check_charts(self, only=None):
        charts = only or self.driver.execute_script("return talusCharts.map((c) => c.id)")
        self.assertTrue(charts)
        for chart in charts:
            element = self.driver.find_element(By.ID, chart)
            self.driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", element)
            drawn = "return talusCharts.find((c) => c.id === arguments[0]).drawn"
            end = time.monotonic() + MOST_SECONDS
            while not self.driver.execute_script(drawn, chart) and time.monotonic() < end:
                time.sleep(0.05)
            self.assertTrue(self.driver.execute_script(drawn, chart), chart + " was not drawn")
            coloured = self.driver.execute_script(COUNT_COLOURED, chart)
            self.assertGreater(coloured, 60, chart + " shows no data")  # a point has some 30 pixels
        return charts

    def keep_screenshot(self, name):
        if self.shots is None:
            return
        self.will_change_the_page()
        height = self.driver.execute_script("return document.documentElement.scrollHeight")
        self.driver.set_window_size(self.driver.get_window_size()["width"], height + 100)
        time.sleep(1)
        self.driver.save_screenshot(str(pathlib.Path(self.shots) / (name + ".png")))

    def keep_first_screen(self, name):
        if self.shots is None:
            return
        self.driver.save_screenshot(str(pathlib.Path(self.shots) / (name + ".png")))

    def column(self, key):
        return self.driver.execute_script(
            "const heads = [...document.querySelectorAll('#trials th')];"
            "const k = heads.findIndex((h) => h.dataset.key === arguments[0]);"
            "return [...document.querySelectorAll('#trials tbody tr')].map((r) => r.cells[k].textContent)",
            key)

    def numbers_of(self, path):
        """The value of an expression on the page."""
        return self.driver.execute_script("return " + path)

    def made(self, changes, make, of="textContent"):
        """What the page makes of data that differ from its own."""
        return self.driver.execute_script(
            f"const made = within({{...D, {changes}}}, () => element('div', {{}}, {make})); return made.{of}")

    def rows(self, changes, make):
        """The same of a table, as the texts of its cells."""
        return self.driver.execute_script(
            f"const made = within({{...D, {changes}}}, () => element('div', {{}}, {make}));"
            "return [...made.querySelectorAll('tbody tr')].map((r) => [...r.cells].map((c) => c.textContent))")

    def option(self, chart, what):
        """A part of what a chart was given."""
        return self.driver.execute_script(
            "talusCharts.find((c) => c.id === arguments[0]).start();"
            "const o = echarts.getInstanceByDom(document.getElementById(arguments[0])).getOption();"
            "const of = (name) => o.series.find((s) => s.name === name), one = (part) => [].concat(part)[0];"
            "return " + what, chart)


def main(arguments):
    """TALUS MAKE_SYNTHETIC_CAMPAIGN TUBE_AND_DRUM [SCREENSHOTS]."""
    if not DRIVER.exists():
        print(f"no report was opened: {DRIVER} is not there (package chromium-driver)")
        sys.exit(77)
    ReportPage.talus, ReportPage.maker, ReportPage.tube_and_drum = arguments[1:4]
    if len(arguments) > 4:
        ReportPage.shots = arguments[4]
        pathlib.Path(ReportPage.shots).mkdir(parents=True, exist_ok=True)
        print("screenshots are kept in " + ReportPage.shots)
    unittest.main(argv=arguments[:1])
