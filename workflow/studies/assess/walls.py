"""Which wall an assessment takes: courses, or the study's rigid block; and the range of its β."""

from rocking.mechanics.beta import EQ5_MODULUS_MPA, EQ5_THICKNESS_M

BLOCK_WALL, COURSES_WALL = "one rigid block on E/h", "four elastic courses"
WALL = {True: BLOCK_WALL, False: COURSES_WALL}  # the other wall, by whether it has courses
BETA = "beta_s"  # key of the sensitivity to contact damping


def named(facade):
    """The wall in words, to end a sentence that begins with the façade."""
    if facade["courses"]:
        return f"an elastic wall in {facade['courses']} courses"
    if facade["base_stiffness_pa_m"] is not None:
        return "one rigid block on springs of the stated stiffness"
    if facade["base"] == "study":
        return "one rigid block on even springs of E/h"
    return f"one rigid block on springs stiffer at the edges (facade.base: {facade['base']})"


def beyond_law(config):
    """What of a façade lies outside of what eq. 5 was fitted to, in words; empty where nothing."""
    if config["damping"]["law"] != "eq5":
        return ""
    facade, found = config["facade"], []
    (low, high), (soft, stiff) = EQ5_THICKNESS_M, EQ5_MODULUS_MPA
    if not low <= facade["thickness_m"] <= high:
        found.append(f"{facade['thickness_m']:g} m thick ({low:g} to {high:g} m)")
    if not soft <= facade["e_mpa"] <= stiff:
        found.append(f"of {facade['e_mpa']:,.0f} MPa ({soft:,.0f} to {stiff:,.0f} MPa)")
    return " and ".join(found)


def ranges_of(sensitivity, key):
    """Medians of a sensitivity's ratios by factor of a key: [(factor, median)]."""
    own = sensitivity[sensitivity["key"] == key].dropna(subset=["ratio"])
    return [(factor, float(part["ratio"].median())) for factor, part in own.groupby("factor")]
