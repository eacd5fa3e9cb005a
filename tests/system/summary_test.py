#!/usr/bin/python3
"""summary_test.py TALUS MAKE_SYNTHETIC_CAMPAIGN SCREENSHOTS: the sheet of a campaign, printed as a user prints it, is one
page of A4, even where everything that it says is long (report_browser_test.py has others). It stays in the folder
SCREENSHOTS."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

NEEDED = ("chromium", "pdfinfo")


def printed(page, pdf, root):
    subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={root}/browser",
                    "--no-pdf-header-footer", f"--print-to-pdf={pdf}", page.as_uri()],
                   check=True, capture_output=True, timeout=600)
    info = subprocess.run(["pdfinfo", pdf], check=True, capture_output=True, text=True).stdout
    return dict(line.split(":", 1) for line in info.splitlines() if ":" in line)


def main(talus, maker, shots, root):
    missing = [program for program in NEEDED if shutil.which(program) is None]
    if missing:
        print("nothing was printed: " + ", ".join(missing) + " is not installed")
        return 77
    shots.mkdir(parents=True, exist_ok=True)
    campaign = root / "long"
    subprocess.run([maker, campaign, "60", "3", "finished", "much_to_say"], check=True)
    subprocess.run([talus, "report", campaign], check=True, stdout=subprocess.DEVNULL)
    pdf = shots / "summary_long.pdf"
    info = printed(campaign / "report/summary.html", pdf, root)
    assert info["Pages"].strip() == "1", info
    assert re.search(r"59[45](\.\d+)? x 84[12]", info["Page size"]), info  # points of A4
    print(f"{pdf}: one page")
    return 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="talus_summary_") as scratch:
        sys.exit(main(*sys.argv[1:3], pathlib.Path(sys.argv[3]), pathlib.Path(scratch)))
