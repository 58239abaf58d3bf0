"""A statement of the study beside what a run measured: the columns of every table of claims."""

COLUMNS = ["claim", "paper", "measured", "holds", "records", "threshold"]
STUDY, OURS = "the study's", "ours"


def statement(claim, paper, measured, holds, threshold, records=""):
    """Return one row of a table of claims.

    Parameters
    ----------
    claim, paper : str
        What is claimed, and the study's number for it.
    measured : str
        What the run gives.
    holds : bool
    threshold : {STUDY, OURS}
        Whose number decides: one that the study states, or one chosen here.
    records : str
        Motions behind it, and where from.

    Returns
    -------
    dict
        Of COLUMNS; "holds" as "yes" or "no".

    Raises
    ------
    ValueError
        If the threshold is nobody's.
    """
    if threshold not in (STUDY, OURS):
        raise ValueError(f"threshold '{threshold}': expected '{STUDY}' or '{OURS}'")
    values = (claim, paper, measured, "yes" if holds else "no", records, threshold)
    return dict(zip(COLUMNS, values, strict=True))
