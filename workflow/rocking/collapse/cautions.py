"""What to bear in mind of a run's collapse intensities, in sentences."""

LARGE_FACTOR = 5.0  # beyond it a scaled record is hardly a stronger earthquake's motion
BANDS = ("pga_median_g", "pga_p10_g", "pga_p90_g")


def scale_factors(records, runs, collapse):
    """Largest intensity of every record's runs over its own peak.

    Of a record that YADE does not confirm: from where its scans collapse throughout, or to where
    they went.
    """
    table = records[["record", "pga_g"]]
    largest = runs.groupby("record")["pga_g"].max()
    scanned = collapse["pga_all_g"].fillna(collapse["pga_max_g"]).groupby(collapse["record"]).max()
    largest_g = table["record"].map(largest).fillna(table["record"].map(scanned))
    return table.assign(pga_largest_g=largest_g, scale_factor=largest_g / table["pga_g"])


def cautions(records, runs, collapse, factors):
    """What to bear in mind, a sentence each."""
    said = []
    surrogates = int((records["source"] == "surrogate").sum())
    if surrogates:
        said.append(
            f"{surrogates} of {len(records)} records are surrogates: they have the peaks of the "
            "motion that they are called after, not its pulses, which decide one-sided rocking."
        )
    far = factors[factors["scale_factor"] > LARGE_FACTOR]
    if len(far):
        names = ", ".join(f"{row.record} ({row.scale_factor:.1f})" for row in far.itertuples())
        said.append(f"Scaled to more than {LARGE_FACTOR:g} times their own peak: {names}.")
    failed = int((runs["status"] == "failed").sum())
    if failed:
        said.append(f"{failed} of {len(runs)} runs failed numerically and count for nothing.")
    never = int(collapse["pga_collapse_g"].isna().sum())
    if never:
        said.append(f"{never} of {len(collapse)} curves never collapsed: blank, not strong.")
    if "collapse_fell" in collapse:
        alone = collapse["collapse_fell"] == 1
        if alone.any():
            said.append(
                f"The lowest collapse of {int(alone.sum())} of {len(collapse)} curves is that of "
                "one history alone; see there the PGA at which a tenth falls."
            )
        hidden = collapse["safe_bound"].max()
        if hidden > 0.0:
            said.append(
                f"Where a curve is called safe, up to {100.0 * hidden:.0f} % may still collapse "
                "within 1 % of some amplitude (95 % confidence)."
            )
    if "disagreements" in collapse and (odd := int(collapse["disagreements"].sum())):
        said.append(f"At {odd} intensities YADE and the planar solver disagree on the collapse.")
    if set(BANDS[1:]) <= set(collapse):
        wide = collapse["pga_p90_g"] > 1.1 * collapse["pga_p10_g"]
        if wide.any():
            said.append(
                f"{int(wide.sum())} of {len(collapse)} curves have no single collapse intensity: "
                "slightly different histories fall or stand over more than a tenth; use the band."
            )
    said.append(
        "The band is numerical scatter of one façade under one motion, not that of earthquakes "
        "or materials; stand and fall of single runs near it mean little."
    )
    return said
