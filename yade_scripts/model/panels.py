"""How return walls hang on the masses of the chain, where the rule of `wall_motion` asks for it.

The masses stand at the storey heights. A light panel hangs between each two of them: a bar that
may shift along y and turn about x, tied to the mass above and the mass (or ground) below, so it
moves by interpolation of height and reactions reach the masses by the same lever.

    top           pieces of wall are tied to their mass
    middle        to a slab that shifts along y, tied to its panel at the storey's middle
    interpolated  to their panel, at the height of their centroid
"""

from dataclasses import replace

from yade_scripts.model.chain import chain_links, chain_matrices
from yade_scripts.model.scene import Block, box_inertia, held
from yade_scripts.model.wall_motion import storey_of

OUT = (0.0, -1.0, 0.0)
TIE_N_M, TIE_BETA_S = 1e9, 2e-5  # some eight times a brick's front joint


def building_mass(config):
    """Mass of the building behind the façade [kg]; ValueError where the case states none."""
    mass = config["return_wall"].get("building_mass_kg")
    if not mass:
        raise ValueError("return_wall.building_mass_kg: expected the building's mass (kg)")
    return mass


class Hanging:
    """Masses of the chain, with the panels and slabs that a rule needs.

    Parameters
    ----------
    config : dict
        Sections facade, return_wall, smdof.
    blocks, nodes
        Of the scene that is being assembled; block 0 is the ground.
    walls : int
        Modelled return walls.
    length_m : float
        Of the walls that move with panels and slabs.
    """

    def __init__(self, config, blocks, nodes, walls, length_m):
        """Add masses, panels and slabs; what hangs on them comes after."""
        wall, self.nodes, self.blocks = config["return_wall"], nodes, blocks
        self.config, self.walls, self.length = config, walls, length_m
        self.h, self.n = config["facade"]["height_m"], config["smdof"]["n_dof"]
        self.total = building_mass(config) * walls / wall["count"]
        tall = self.h / self.n
        self.heights = [(j + 1) * tall for j in range(self.n)]
        self.masses = [
            self._add(f"mass {j}", (0.0, -2.0 * length_m, z), (wall["thickness_m"], length_m, 0.1))
            for j, z in enumerate(self.heights, 1)
        ]
        self.carriers, self.light = list(self.masses), []
        if wall["motion"] == "top":
            return
        size = (wall["thickness_m"], length_m, tall)
        mass = walls * config["facade"]["density_kg_m3"] * size[0] * size[1] * size[2]
        for j, head in enumerate(self.masses):
            foot, middle = (self.masses[j - 1] if j else 0), (j + 0.5) * tall
            place = (0.0, -length_m, middle)
            panel = self._add(f"panel {j + 1}", place, size, mass, box_inertia(mass, size), "yX")
            self._join(f"panel {j + 1} foot", panel, foot, (0.0, -length_m, j * tall))
            self._join(f"panel {j + 1} head", panel, head, (0.0, -length_m, (j + 1) * tall))
            self.carriers[j] = panel
            self.light.append(panel)
            if wall["motion"] == "middle":
                self.carriers[j] = self._add(f"slab {j + 1}", place, size, mass)
                self.light.append(self.carriers[j])
                self._join(f"slab {j + 1} tie", self.carriers[j], panel, place)

    def _add(self, name, centre, size, mass=1.0, inertia=(1.0, 1.0, 1.0), free="y"):
        self.blocks.append(Block(name, centre, size, mass, inertia, free=free))
        return len(self.blocks) - 1

    def _join(self, name, a, b, place):
        """Join two blocks along y at one point, in tension and compression, without shear."""
        k = self.walls * TIE_N_M
        self.nodes.add_joint(
            name, a, b, [place], OUT, 1.0, k, k, beta_s=TIE_BETA_S, **held(1e30, 0.0, 0.0)
        )

    def hang(self, index, x_m):
        """Tie a piece of wall to what carries it, at the height of its centroid."""
        z = self.blocks[index].centre_m[2]
        carrier = self.carriers[storey_of(z / self.h, self.n)]
        name = f"{self.blocks[index].name} tie"
        self._join(name, index, carrier, (x_m, -self.length, z))

    def finish(self, hung):
        """Give the masses what the pieces of wall leave of the building's mass.

        Parameters
        ----------
        hung : sequence of int
            Block indices of the pieces of wall.

        Returns
        -------
        list of Link

        Raises
        ------
        ValueError
            If nothing is left.
        """
        carried = sum(self.blocks[i].mass_kg for i in {*self.light, *hung})
        if carried >= self.total:
            share = self.total / building_mass(self.config)
            raise ValueError(
                f"return_wall.building_mass_kg = {self.total / share:g}: expected more than the "
                f"{carried / share:.0f} kg of the return walls in contact with the façade"
            )
        for i in self.masses:
            self.blocks[i] = replace(self.blocks[i], mass_kg=(self.total - carried) / self.n)
        _, stiffness, damping = chain_matrices(self.config["smdof"], self.total)
        return chain_links(stiffness, damping, self.masses, 0, self.heights)
