"""Formulas of codes that the checks use: number, text, where it is from, how it was read.

Nothing here is computed. A check names the formulas it applies by these keys, so that whoever signs
can look each of them up.
"""

from typing import NamedTuple

OFFICIAL = "official wording"  # of the text, in a public transcription with page numbers
TRANSCRIPTION = "transcription"  # of the formula, in the same place, from the page's image
SECOND_HAND = "second hand"
DERIVED = "derived here"
UNREAD = "usual form, no text read"

CIRCOLARE = "Circolare 7/2019"
NTC = "NTC 2018"
EUROCODE = "EN 1998-3:2025"
NEW_ZEALAND = "NZS 1170.5:2004"


class Formula(NamedTuple):
    """One formula or rule: number, text, document, and how it was read (a constant above)."""

    number: str
    text: str
    document: str = CIRCOLARE
    status: str = TRANSCRIPTION


FORMULAS = {
    "multiplier": Formula("C8.7.1.1", "α0 = (Σ P δ_y − Σ F δ_F + L_i)/Σ (P + Q) δ_x"),
    "interlocking": Formula(
        "C8.7.1.2", "F = 0.4 n(n + 1) Φ μ l² t_s W a return wall, at h/3, Φ = h_b/l"
    ),
    "acceleration": Formula("C8.7.1.3", "a = α(d_C) g/(e* FC)"),
    "displacement": Formula("C8.7.1.4", "d = d_C Σ(P + Q)δ²/[δ_C Σ(P + Q)δ]"),
    "mass": Formula("C8.7.1.5", "e* = [Σ(P + Q)δ]²/{Σ(P + Q) Σ(P + Q)δ²}"),
    "elastic": Formula("C8.7.1.6", "a = 4π² d/T0²"),
    "period": Formula("C8.7.1.7", "T0 = κ λ L √(W/(E g)), κ = 6.2 or 2.2"),
    "onset": Formula("C8.7.1.8", "a_Z,SLD = α0 g/(e* FC)"),
    "onset_free": Formula("C8.7.1.9", "S_eZ,SLD(T0) = a_y/FC at 5 %"),
    "confidence": Formula(
        "C8.7.1.2.1.3",
        "FC of knowledge level 1 wherever α leaves the masonry's compressive strength out",
        status=OFFICIAL,
    ),
    "limits": Formula(
        "C8.7.1.2.1.6",
        "d_SLV: the least of 0.4 d0 and of the displacement at which a link's failure takes more "
        "than half of the capacity; d_SLC: 0.6 d0",
        status=OFFICIAL,
    ),
    "lasting": Formula(
        "C8.7.1.2.1.6",
        "0.4 d0 is of a capacity curve with those actions alone whose presence is verified until "
        "collapse (taken here: a link that gives way before may be left out of it)",
        status=OFFICIAL,
    ),
    "punching": Formula(
        "Master Magazine 7, p. 75",
        "R = f_vd · 4 (a + t) t of a square plate a on a wall t, from π (D + t) t f_vd of a round "
        "one in a worked example, f_vd = τ0/(γ_M FC), vertical stress left out",
        "design office's example",
        SECOND_HAND,
    ),
    "crushing": Formula(
        "crushing under a plate",
        "R = f_d a² under the plate, f_d = f_m/(γ_M FC), γ_M = 2",
        "mechanics",
        UNREAD,
    ),
    "behaviour": Formula("C8.7.1.2.1.7", "a_g,SLV = q a_g,SLD, q = 2", status=OFFICIAL),
    "secant_slv": Formula("C8.7.1.10", "T_SLV = 1.68π √(d_SLV/a(d_SLV))"),
    "secant_slc": Formula("C8.7.1.11", "T_SLC = 1.56π √(d_SLC/a(d_SLC))"),
    "largest": Formula(
        "C8.7.1.2.1.8",
        "demand: the largest spectral displacement over [T0, T_SLV]; 8 % damping (SLV), 10 % "
        "(SLC); a_g,SLV is not taken below a_g,SLD; at a height the first mode suffices",
        status=OFFICIAL,
    ),
    "at_height": Formula(
        "C8.7.1.12", "S_eZ(T, ξ, z) T²/4π², not less than S_eZ(T1, ξ, z) b² T1²/4π² where T > b T1"
    ),
    "dynamic": Formula(
        "C8.7.1.2.1.9",
        "fulfilled if d0 is exceeded in no analysis and the mean of the largest displacements does "
        "not exceed d_SLV (d_SLC)",
        status=OFFICIAL,
    ),
    "floor": Formula(
        "C7.2.5–7",
        "S_eZ by modes, root of squares, R = 1.1 ξ_k^−0.5 η(ξ) from a T_k to b T_k, a = 0.8, "
        "b = 1.1; not less than S_e(T, ξ) where T > T1",
    ),
    "floor_peak": Formula("C7.2.8", "a_Z = √Σ a_Z,k²"),
    "damaged": Formula(
        "C8.7.1.2.1.4",
        "at ultimate states the building's period grows by 50 to 100 %, its damping is 10 to 20 %",
        status=OFFICIAL,
    ),
    "spectrum": Formula("3.2.2–7", "S_e(T) from a_g, F0, T_C*, S_S, C_C, S_T", NTC),
    "eta": Formula("3.2.4", "η = √(10/(5 + ξ)) ≥ 0.55", NTC),
    "motions": Formula(
        "3.2.3.6",
        "recorded motions: their mean spectrum of 5 % no more than 10 % below and 30 % above the "
        "target at any period of interest",
        NTC,
        OFFICIAL,
    ),
    "rocking": Formula(
        "11.4–11.9, 11.40–11.45",
        "a* = λ g/e*, T = 1.6π √(d/a*), γ_Sd S_De(T) η ≤ d/γ_Rd, d = 0.4 or 0.6 d0; S_eZ without η",
        EUROCODE,
        SECOND_HAND,
    ),
    "parts": Formula(
        "8.2–8.5", "F = C(0) C_Hi C_i(T_p) C_ph R_p W ≤ 3.6 W", NEW_ZEALAND, SECOND_HAND
    ),
    "wedge": Formula(
        "compound overturning",
        "α0 = [W b/2 + V (b + h tan β/3) + F h/3]/(W h/2 + 2 V h/3), V the weight of the return "
        "walls' wedges behind cracks at β from the vertical",
        "mechanics",
        DERIVED,
    ),
    "crack": Formula(
        "eq. 2–3 of Szabó and others (2023)",
        "friction of interlocked courses on a crack at β: F (1 − tan β/tan β_b), tan β_b = l/h_b",
        "Casapulla and others (2021)",
        SECOND_HAND,
    ),
    "hanging": Formula(
        "horizontal bending",
        "α0 = [Σ P δz + H b (1/L1 + 1/L2) δ]/Σ P δx of two triangles about diagonal cracks; of a "
        "plain wall 3 b/(2 D) + 3 H b (1/L1 + 1/L2)/W",
        "mechanics",
        DERIVED,
    ),
    "energy": Formula(
        "Housner (1963)", "V = √(8gR(1 − cos α)/3)/cos α against S_v", "mechanics", DERIVED
    ),
}


def cited(*keys):
    """Numbers of formulas by document, with how they were read, in one line."""
    by: dict = {}
    for key in keys:
        formula = FORMULAS[key]
        by.setdefault(formula.document, []).append(formula)
    parts = []
    for document, found in by.items():
        numbers = ", ".join(dict.fromkeys(f.number for f in found))
        status = ", ".join(dict.fromkeys(f.status for f in found))
        parts.append(f"{document} {numbers} ({status})")
    return "; ".join(parts)
