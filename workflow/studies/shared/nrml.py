"""Fragilities in the form that OpenQuake reads: NRML 0.5, `fragilityModel`.

A continuous function carries mean m and standard deviation s of the intensity itself, not of
its logarithm: m = θ exp(β²/2), s = m √(exp β² − 1). A discrete one carries probabilities at a
list of intensities. One file holds one measure; its taxonomies are the models. Below minIML
OpenQuake keeps a continuous function at its value there, but at nothing up to noDamageLimit, so
both are given.
"""

import xml.etree.ElementTree as ET

import numpy as np
from scipy.special import ndtri

NAMESPACE = "http://openquake.org/xmlns/nrml/0.5"
LIMIT_STATE = "collapse"
POINTS = 40  # of a discrete function
TAILS = (1e-4, 1.0 - 1e-4)  # probabilities between which the functions are given


def moments(median, dispersion):
    """Mean and standard deviation of a lognormal variable from θ and β."""
    mean = median * np.exp(0.5 * dispersion**2)
    return mean, mean * np.sqrt(np.expm1(dispersion**2))


def document(name, description, imt, fits, discrete=False):
    """Text of a fragility model; `fits` are `Fragility` by taxonomy.

    `imt` is OpenQuake's name of the intensity measure, "PGA" in g, "PGV" in cm/s, "SA(0.27)" in g.
    Discrete: probabilities at `POINTS` intensities in place of mean and standard deviation.
    """
    root = ET.Element("nrml", xmlns=NAMESPACE)
    model = ET.SubElement(
        root, "fragilityModel", id=name, assetCategory="buildings", lossCategory="structural"
    )
    ET.SubElement(model, "description").text = description.encode("ascii", "replace").decode()
    ET.SubElement(model, "limitStates").text = LIMIT_STATE
    for taxonomy, fit in fits.items():
        least, most = (fit.median * np.exp(fit.dispersion * ndtri(p)) for p in TAILS)
        if discrete:
            function = ET.SubElement(model, "fragilityFunction", id=taxonomy, format="discrete")
            levels = np.geomspace(least, most, POINTS)
            imls = ET.SubElement(function, "imls", imt=imt)
            imls.text = " ".join(f"{x:.6g}" for x in levels)
            poes = ET.SubElement(function, "poes", ls=LIMIT_STATE)
            poes.text = " ".join(f"{p:.6g}" for p in fit.probability(levels))
            continue
        function = ET.SubElement(
            model, "fragilityFunction", id=taxonomy, format="continuous", shape="logncdf"
        )
        least, most = f"{least:.6g}", f"{most:.6g}"
        ET.SubElement(function, "imls", imt=imt, noDamageLimit=least, minIML=least, maxIML=most)
        mean, deviation = moments(fit.median, fit.dispersion)
        ET.SubElement(
            function, "params", ls=LIMIT_STATE, mean=f"{mean:.8g}", stddev=f"{deviation:.8g}"
        )
    ET.indent(root)
    text = ET.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'
