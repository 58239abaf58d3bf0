"""The formula's page in a real browser: Chromium without a window, against `rocking.formula.law`.

Moves the page's own inputs a thousand times and reads what it shows, to three digits; and looks
whether it fits a telephone. Needs Chromium (`apt-get install chromium`), which the project does not
install::

    .venv/bin/python tests/trials/formula_page.py --browser chromium --count 1000
"""

import argparse
import html
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from rocking.formula import law
from studies.atlas import page

SHOWN = """
const found = [];
for (const a of ASKED) {
  for (const id of ["model", "base", "measure"]) document.getElementById(id).value = a[id];
  for (const [name] of FIELDS) document.getElementById(name).value = a.x[name];
  document.getElementById("height_m").dispatchEvent(new Event("input"));
  const strong = document.querySelector("#answer strong");
  const curves = document.querySelectorAll("#curve path").length;
  found.push([strong ? parseFloat(strong.textContent) : null, curves]);
}
"""
REPORT = """
const out = document.createElement("pre");
out.id = "report";
out.textContent = JSON.stringify(%s);
document.body.appendChild(out);
"""
WIDTH = 360  # of a small telephone [px]


def dumped(browser, text, folder, name):
    """What a page's report holds, after the browser has run it."""
    path = Path(folder) / f"{name}.html"
    path.write_text(text, "utf-8")
    command = [browser, "--headless=new", "--no-sandbox", "--disable-gpu"]
    command += [f"--user-data-dir={folder}/profile", "--virtual-time-budget=20000", "--dump-dom"]
    run = subprocess.run(
        [*command, path.as_uri()], capture_output=True, text=True, timeout=300, check=True
    )
    return json.loads(html.unescape(re.search(r'<pre id="report">(.*?)</pre>', run.stdout)[1]))


def asked(known, count):
    """Inputs that the page can be given."""
    rng, bases = np.random.default_rng(5), [known["made_of"]["base"], *known["bases"]]
    found = []
    for _ in range(count):
        row = {name: float(rng.uniform(*ends)) for name, ends in known["limits"].items()}
        row["storeys"] = round(row["storeys"])
        row["thickness_m"] = row["height_m"] / row["slenderness"]
        row["slenderness"] = row["height_m"] / row["thickness_m"]
        names = (list(known["models"]), bases, list(law.MEASURES))
        model, base, measure = (each[rng.integers(len(each))] for each in names)
        found.append({"x": row, "model": model, "base": base, "measure": measure})
    return found


def main():
    """Print how far page and Python agree, and how wide the page is; 1 where it must not be so."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--browser", default="chromium")
    parser.add_argument("--count", type=int, default=1000)
    given = parser.parse_args()
    known = law.read()
    text, rows = page.page(known), asked(known, given.count)
    script = f"<script>const ASKED = {json.dumps(rows)};{SHOWN}{REPORT % 'found'}</script></body>"
    frame = html.escape(text, quote=True)
    phone = (
        f'<!DOCTYPE html><body><iframe id="f" width="{WIDTH}" height="800" srcdoc="{frame}">'
        "</iframe>"
        "<script>document.getElementById('f').addEventListener('load', (e) => {"
        "const d = e.target.contentDocument, r = d.documentElement;"
        + REPORT % "[r.scrollWidth, r.clientWidth, d.querySelector('#answer strong').textContent]"
        + "});</script></body>"
    )
    with tempfile.TemporaryDirectory() as folder:
        found = dumped(given.browser, text.replace("</body>", script), folder, "values")
        wide, room, answer = dumped(given.browser, phone, folder, "phone")
    wrong = 0
    for one, (shown, curves) in zip(rows, found, strict=True):
        own = law.said(one["x"], one["model"], one["measure"], one["base"])[0]
        wrong += shown != float(f"{own:.3g}") or curves != 1
    print(f"{len(rows)} inputs: {wrong} differ in the third digit")
    print(f"at {WIDTH} px: {wide} px of content in {room} px; it says {answer}")
    return int(wrong > 0 or wide > room)


if __name__ == "__main__":
    sys.exit(main())
