"""How the bricks of W3m hang on the masses of the chain.

The masses stand at the storey heights, and a light panel hangs between each two of them: a bar
that may shift along y and turn about x, tied to the mass above and the mass (or ground) below.
A brick is tied to its panel at the height of its centroid, so it follows the masses by
interpolation of height and its reaction reaches them by the same lever.
"""

from yade_scripts.model.chain import chain_links, chain_matrices
from yade_scripts.model.facade import building_mass
from yade_scripts.model.scene import Block, box_inertia

OUT = (0.0, -1.0, 0.0)
TIE_N_M, TIE_BETA_S = 1e9, 2e-5  # some eight times a brick's front joint


def add_panels(assembly):
    """Panels between the storey heights, before the bricks that hang on them."""
    n = assembly.config["smdof"]["n_dof"]
    tall = assembly.h / n
    size = (assembly.t, assembly.length, tall)
    mass = assembly.walls * assembly.density * assembly.t * assembly.length * tall
    for j in range(1, n + 1):
        assembly.panels.append(len(assembly.blocks))
        assembly.blocks.append(
            Block(
                f"panel {j}",
                (0.0, -assembly.length, (j - 0.5) * tall),
                size,
                mass,
                box_inertia(mass, size),
                free="yX",
            )
        )


def add_masses(assembly):
    """Masses of the chain: what the bricks and panels leave of the building's mass."""
    n = assembly.config["smdof"]["n_dof"]
    total = building_mass(assembly.config) * assembly.share
    names = ("panel", "brick")
    hung = sum(b.mass_kg for b in assembly.blocks if any(name in b.name for name in names))
    if hung >= total:
        raise ValueError(
            f"return_wall.building_mass_kg = {total / assembly.share:g}: expected more than the "
            f"{hung / assembly.share:.0f} kg of the return walls' bricks"
        )
    first = len(assembly.blocks)
    heights = [j * assembly.h / n for j in range(1, n + 1)]
    for j, z in enumerate(heights, 1):
        assembly.blocks.append(
            Block(
                f"mass {j}",
                (0.0, -2.0 * assembly.length, z),
                (assembly.t, assembly.length, 0.1),
                (total - hung) / n,
                (1.0, 1.0, 1.0),
                free="y",
            )
        )
    _, stiffness, damping = chain_matrices(assembly.config["smdof"], total)
    assembly.links = chain_links(stiffness, damping, range(first, first + n), 0, heights)
    for j, panel in enumerate(assembly.panels):
        low = first + j - 1 if j else 0
        for end, other, z in (("foot", low, j * assembly.h / n), ("head", first + j, heights[j])):
            tie(assembly, f"panel {j + 1} {end}", panel, other, (0.0, -assembly.length, z))


def tie(assembly, name, a, b, place):
    """Join two blocks along y at one point, in tension and compression, without shear."""
    stiffness = assembly.walls * TIE_N_M
    assembly.nodes.add_joint(
        name, a, b, [place], OUT, 1.0, stiffness, stiffness, beta_s=TIE_BETA_S, tension_pa=1e30
    )
