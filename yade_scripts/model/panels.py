"""How return walls hang on the masses of the chain, where the rule of `wall_motion` asks for it.

The masses stand at the storey heights. A light panel hangs between each two of them: a bar that
may shift along y and turn about x, tied to the mass above and the mass (or ground) below, so it
moves by interpolation of height and reactions reach the masses by the same lever.

    top           pieces of wall are tied to their mass
    middle        to a slab that shifts along y, tied to its panel at the storey's middle
    interpolated  to their panel, at the height of their centroid

So does the base of a façade that stands on lower storeys hang between the masses below and above
it. What it weighs, and its panel, is taken from them: the building's mass stays what it is.
"""

from dataclasses import replace

from yade_scripts.model.base import base_jkn
from yade_scripts.model.chain import chain_links
from yade_scripts.model.scene import Block, Interface, box_inertia, held
from yade_scripts.model.wall_motion import storey_of, weight_of

OUT = (0.0, -1.0, 0.0)
TIE_N_M, TIE_BETA_S = 1e9, 2e-5  # some eight times a brick's front joint
BASE_TIE = 4.0  # stiffness of what the base hangs by, over that of its joint
LIGHT = 0.1  # mass of the base, and of its panel, over a mass of the chain


def building_mass(config):
    """Mass of the building behind the façade [kg]; ValueError where the case states none."""
    mass = config["return_wall"].get("building_mass_kg")
    if not mass:
        raise ValueError("return_wall.building_mass_kg: expected the building's mass (kg)")
    return mass


def mass_heights(config):
    """Heights of the chain's masses above the façade's base, from the lowest up [m]."""
    n, facade = config["smdof"]["n_dof"], config["facade"]
    tall = facade.building_top_m / n
    return [j * tall - facade.base_height_m for j in range(1, n + 1)]


def base_block(config, ground):
    """The base of a façade that hangs on the chain; `ground` is one that stands on the ground."""
    mass = LIGHT * building_mass(config) / config["smdof"]["n_dof"]
    return replace(ground, free="y", mass_kg=mass)


def _join(nodes, name, a, b, place_m, k_n_m):
    """Join two blocks along y at one point, in tension and compression, without shear."""
    strong = held(1e30, 0.0, 0.0)
    nodes.add_joint(
        name, a, b, [place_m], OUT, 1.0, Interface(k_n_m, k_n_m, beta_s=TIE_BETA_S, **strong)
    )


def hang_base(config, blocks, nodes, base, masses):
    """Tie the base, block `base`, to the masses below and above it, and take its mass from them.

    A panel whose mass stands at its two ends lies between them, light and rigid; where the base is
    as high as a mass it is tied to that. The chain's masses are blocks too, from the lowest up.
    """
    facade, n = config["facade"], config["smdof"]["n_dof"]
    whole, raised = facade.building_top_m, facade.base_height_m
    storey = storey_of(raised / whole, n)
    weight = weight_of("interpolated", raised / whole, n)
    lower, upper = (masses[storey - 1] if storey else 0), masses[storey]
    k = BASE_TIE * base_jkn(facade) * facade.thickness_m * facade.width_m
    middle = 0.5 * facade.thickness_m

    def join(name, a, b, z):
        # on the panel's axis: it turns without lifting the node
        _join(nodes, name, a, b, (0.0, middle, z), k)

    def lighten(index, mass):
        if index:
            blocks[index] = replace(blocks[index], mass_kg=blocks[index].mass_kg - mass)

    light = blocks[base].mass_kg
    lighten(lower, (1.0 - weight) * light)
    lighten(upper, weight * light)
    if weight in (0.0, 1.0):
        join("base tie", base, upper if weight else lower, 0.0)
        return
    tall = whole / n
    low = storey * tall - raised
    size = (facade.width_m, facade.thickness_m, tall)
    inertia = (0.25 * light * tall**2, *box_inertia(light, size)[1:])
    centre = (0.0, middle, low + 0.5 * tall)
    blocks.append(Block("base panel", centre, size, light, inertia, free="yX"))
    panel = len(blocks) - 1
    join("base tie", base, panel, 0.0)
    join("base panel foot", panel, lower, low)
    join("base panel head", panel, upper, low + tall)
    lighten(lower, 0.5 * light)
    lighten(upper, 0.5 * light)


class Hanging:
    """Masses of the chain, with the panels and slabs that a rule needs, for so many modelled walls.

    Block 0 is the ground; the walls that move with panels and slabs are `length_m` long.
    """

    def __init__(self, config, blocks, nodes, walls, length_m):
        """Add masses, panels and slabs; what hangs on them comes after."""
        wall, self.nodes, self.blocks = config["return_wall"], nodes, blocks
        self.config, self.walls, self.length = config, walls, length_m
        self.h, self.n = config["facade"].building_top_m, config["smdof"]["n_dof"]
        self.raised = config["facade"].base_height_m
        self.total = building_mass(config) * walls / wall["count"]
        tall = self.h / self.n
        self.heights = mass_heights(config)
        self.masses = [
            self._add(f"mass {j}", (0.0, -2.0 * length_m, z), (wall["thickness_m"], length_m, 0.1))
            for j, z in enumerate(self.heights, 1)
        ]
        self.carriers, self.light = list(self.masses), []
        if wall["motion"] == "top":
            return
        size = (wall["thickness_m"], length_m, tall)
        mass = walls * config["facade"].density_kg_m3 * size[0] * size[1] * size[2]
        for j, head in enumerate(self.masses):
            foot, low = (self.masses[j - 1] if j else 0), j * tall - self.raised
            place = (0.0, -length_m, (j + 0.5) * tall - self.raised)
            panel = self._add(f"panel {j + 1}", place, size, mass, box_inertia(mass, size), "yX")
            self._join(f"panel {j + 1} foot", panel, foot, (0.0, -length_m, low))
            self._join(f"panel {j + 1} head", panel, head, (0.0, -length_m, self.heights[j]))
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
        _join(self.nodes, name, a, b, place, self.walls * TIE_N_M)

    def hang(self, index, x_m):
        """Tie a piece of wall to what carries it, at the height of its centroid."""
        z = self.blocks[index].centre_m[2]
        carrier = self.carriers[storey_of((self.raised + z) / self.h, self.n)]
        name = f"{self.blocks[index].name} tie"
        self._join(name, index, carrier, (x_m, -self.length, z))

    def finish(self, hung):
        """Give the masses what the pieces of wall leave of the building's mass; return links.

        ValueError if nothing is left.
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
        return chain_links(self.config["smdof"], self.total, self.masses, self.heights)
