"""A statement of the study beside what a run measured: the columns of every table of claims."""

COLUMNS = ["claim", "paper", "measured", "holds", "records", "threshold"]
STUDY, OURS = "the study's", "ours"


def statement(claim, paper, measured, holds, threshold, records=""):
    """Return one row of a table of claims, of COLUMNS.

    What is claimed and the study's number for it, what the run gives, whether that holds ("yes" or
    "no"), and whose number decides: STUDY, one that the study states, or OURS, one chosen here.
    `records` are the motions behind it, and where from.
    """
    if threshold not in (STUDY, OURS):
        raise ValueError(f"threshold '{threshold}': expected '{STUDY}' or '{OURS}'")
    values = (claim, paper, measured, "yes" if holds else "no", records, threshold)
    return dict(zip(COLUMNS, values, strict=True))
