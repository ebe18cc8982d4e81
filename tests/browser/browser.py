"""A browser without network, and runs of the program for it to look at."""

import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

skipped = 77  # for ctest

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
except ImportError:
    webdriver = None


def skip_unless_there():
    """Ends the process if a part of the browser is missing."""
    missing = [name for name in ("chromium", "chromedriver") if shutil.which(name) is None]
    if webdriver is None:
        missing.append("python3-selenium")
    if missing:
        print("skipped: missing", ", ".join(missing),
              "(Debian: chromium chromium-driver python3-selenium)")
        sys.exit(skipped)


def start(width=1280, height=1000, reachable=""):
    """A browser that reaches no other machine; of this one, only an address that is `reachable`."""
    rules = "MAP * ~NOTFOUND" + (f", EXCLUDE {reachable}" if reachable else "")
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     f"--window-size={width},{height}", f"--host-resolver-rules={rules}",
                     "--proxy-server=127.0.0.1:9", "--force-device-scale-factor=1",
                     "--allow-file-access-from-files"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    driver.set_script_timeout(60)
    return driver


def open_page(driver, path, live=True):
    driver.get(pathlib.Path(path).resolve().as_uri())
    if not live:
        return
    for _ in range(600):
        if driver.execute_script("return Boolean(window.page)"):
            return
        time.sleep(0.05)
    raise AssertionError("the page did not start: %s" % driver.get_log("browser"))


class Program:
    """The program in a directory for temporary files."""

    def __init__(self, path, case):
        self.path = pathlib.Path(path).resolve()
        self.directory = pathlib.Path(tempfile.mkdtemp(prefix="subimpact-browser-"))
        # Of a name that no line of a narrow page holds and that offers no place to break it.
        self.case = self.directory / ("Case" * 25) / pathlib.Path(case).name
        self.case.parent.mkdir()
        shutil.copy(case, self.case)

    def __call__(self, *arguments):
        done = subprocess.run([self.path, *map(str, arguments)], cwd=self.directory,
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise AssertionError(f"{arguments}: status {done.returncode}: {done.stderr}")
        return done

    def run(self, name, *settings):
        """A run of the case with settings "key=value" in the directory `name`."""
        arguments = ["run", self.case, "--out", name, "--quiet"]
        for setting in settings:
            arguments += ["--set", setting]
        self(*arguments)
        return self.directory / name

    def table(self, *names):
        """A CSV file as a list of rows; empty cells are None."""
        with open(self.directory.joinpath(*names), newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def remove(self):
        shutil.rmtree(self.directory)
