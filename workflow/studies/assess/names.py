"""Names of mechanisms by key and language: code compares keys, reports print these.

Italian terms are those of the Circolare and of the practice that follows it.
"""

COMPOUND, HORIZONTAL, PART_WIDTH = "compound", "horizontal", "part_width"
OVERTURNING, BENDING, CORNER = "overturning", "bending", "corner"
ENGLISH, ITALIAN = "en", "it"
NAMES = {
    COMPOUND: {
        ENGLISH: "façade with wedges of the return walls above {foot_m:.2f} m, cracks at "
        "{crack_deg:.1f}° from the vertical",
        ITALIAN: "ribaltamento composto sopra {foot_m:.2f} m, con cunei delle pareti di "
        "controvento, lesioni a {crack_deg:.1f}° dalla verticale",
    },
    HORIZONTAL: {
        ENGLISH: "horizontal bending between {left_m:+.2f} and {right_m:+.2f} m from the middle, "
        "above {foot_m:.2f} m",
        ITALIAN: "flessione orizzontale tra {left_m:+.2f} e {right_m:+.2f} m dalla mezzeria, sopra "
        "{foot_m:.2f} m",
    },
    PART_WIDTH: {
        ENGLISH: "part of the width between {left_m:+.2f} and {right_m:+.2f} m from the middle, "
        "above {foot_m:.2f} m",
        ITALIAN: "ribaltamento parziale tra {left_m:+.2f} e {right_m:+.2f} m dalla mezzeria, sopra "
        "{foot_m:.2f} m",
    },
}
KINDS = {  # kinds of mechanisms
    OVERTURNING: {ENGLISH: "overturning", ITALIAN: "ribaltamento semplice"},
    BENDING: {ENGLISH: "vertical bending", ITALIAN: "flessione verticale"},
    CORNER: {ENGLISH: "corner", ITALIAN: "ribaltamento del cantonale"},
    COMPOUND: {ENGLISH: "compound overturning", ITALIAN: "ribaltamento composto"},
    HORIZONTAL: {ENGLISH: "horizontal bending", ITALIAN: "flessione orizzontale"},
    PART_WIDTH: {ENGLISH: "part-width overturning", ITALIAN: "ribaltamento parziale"},
}
SENTENCES = {  # what the report says of a kind
    COMPOUND: {
        ENGLISH: "Façade and wedges of the return walls, turning about the outer edge at the foot. "
        "Friction of interlocked courses on the crack fades with its angle.",
        ITALIAN: "Facciata e cunei delle pareti di controvento, in rotazione attorno allo spigolo "
        "esterno al piede. L'attrito degli ammorsamenti si riduce con l'inclinazione della "
        "lesione.",
    },
    HORIZONTAL: {
        ENGLISH: "Two bodies between lines that hold turn about diagonal cracks on the outer face "
        "and open on the outer side of the line where they meet. α0 = [Σ P δz + H b (1/L1 + 1/L2)]"
        "/Σ P δx, H = {thrust_kn:g} kN.",
        ITALIAN: "Due corpi tra linee trattenute ruotano attorno a lesioni diagonali sulla faccia "
        "esterna. α0 = [Σ P δz + H b (1/L1 + 1/L2)]/Σ P δx, H = {thrust_kn:g} kN.",
    },
    PART_WIDTH: {
        ENGLISH: "What lies above the foot between two vertical cracks, turning about its outer "
        "edge. Courses that are stated rub in the cracks; else nothing holds there.",
        ITALIAN: "Quanto sta sopra il piede tra due lesioni verticali, in rotazione attorno allo "
        "spigolo esterno. Nelle lesioni agisce l'attrito degli ammorsamenti, se dichiarati.",
    },
    CORNER: {
        ENGLISH: "Both walls up to their cracks, turning about the bisector's normal; by strips.",
        ITALIAN: "Le due pareti fino alle lesioni, in rotazione attorno alla normale alla "
        "bisettrice; per strisce.",
    },
}

NOT_ASKED = {
    ENGLISH: "Not asked for (assessment.mechanisms): {kinds}.",
    ITALIAN: "Non richiesti (assessment.mechanisms): {kinds}.",
}


def named(kind, language=ENGLISH, **places):
    """Name of one mechanism of a kind, with its places."""
    return NAMES[kind][language].format(**places)


def said(kind, language=ENGLISH, **values):
    """What the report says of a kind of mechanism."""
    return SENTENCES[kind][language].format(**values)


def kind_of(one):
    """Key of the kind of a mechanism, of a `family.Candidate` or a `sites.Site`."""
    if one.side:
        return CORNER
    if one.crack_deg is not None:
        return COMPOUND
    if one.left_m is not None:
        return PART_WIDTH if one.middle_m is None else HORIZONTAL
    return OVERTURNING if one.held_m is None else BENDING


def not_asked(asked, language=ENGLISH):
    """Kinds that could be checked by hand and were not, in words; empty where all were.

    `asked` are the kinds of `assessment.mechanisms`.
    """
    left = [KINDS[kind][language] for kind in NAMES if kind not in asked]
    return NOT_ASKED[language].format(kinds=", ".join(left)) if left else ""
