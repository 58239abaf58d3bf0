"""The models: what each boundary condition consists of, and how figures draw it.

Whatever differs from one model to another stands here, so that nothing hangs on how a name is
spelt. Adding a boundary condition is a row here, and an assembly where no existing one serves.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Model:
    """One boundary condition."""

    name: str  #: word of the vocabulary, used in the configuration, in file names and in legends
    #: return walls are "none"; "one" block up the height, with the motion of the base; "floors", a
    #: block for each lumped mass with that mass's motion; or "bricks", an interlocking column
    walls: str
    #: the joint between façade and return walls starts with cohesion and tensile strength
    bonded: bool = False
    meaning: str = ""  #: in words, for pages and legends
    colour: str = "0.4"  #: in figures
    marker: str = "o"  #: in figures
    static: str = ""  #: line of its pushover curve in Figure 9; empty where it has none of its own
    #: the return walls carry the masses of the chain, joined by its springs and dashpots, and feel
    #: the façade (two-way coupling); otherwise their motion is prescribed (one-way)
    two_way: bool = False
    #: time of a run in YADE over that of W1; two-way models count as their one-way ones
    cost: float = 1.0

    @property
    def chain(self):
        """Whether its return walls belong to the floors of the chain."""
        return self.walls in ("floors", "bricks")

    @property
    def nodes_up(self):
        """Key of section numerics with the nodes up a return wall's block."""
        return "nodes_per_block" if self.walls == "floors" else "nodes_height"

    @property
    def moved(self):
        """How the return walls move, in words."""
        if not self.chain:
            return "the walls move with the ground"
        if self.two_way:
            return f"as {self.one_way_model}, but the façade pushes the building's mass"
        return "they move with the building's floors, which the façade cannot push"

    @property
    def single_block(self):
        """Whether the façade is the only block that moves freely."""
        return self.walls != "bricks"

    @property
    def compiled(self):
        """Whether the compiled planar solver can stand in for YADE, whatever the façade has."""
        return self.single_block and self.scanned

    @property
    def scanned(self):
        """Whether the compiled planar solver can scan its curves."""
        return self.walls != "none"

    @property
    def climb_from(self):
        """Share of b/h from which a short climb looks for a first collapse."""
        return 0.5 if self.chain else 0.7

    @property
    def climb_ratio(self):
        """From one amplitude of a short climb to the next; floors make narrower ranges."""
        return 1.03 if self.walls == "floors" else 1.12

    @property
    def one_way_model(self):
        """Name of the model with the same walls and joint, one-way coupled."""
        same = (m for m in MODELS.values() if (m.walls, m.bonded) == (self.walls, self.bonded))
        return next(m.name for m in same if not m.two_way)

    @property
    def two_way_model(self):
        """Name of the model with the same walls and joint whose walls feel the façade."""
        same = (m for m in MODELS.values() if (m.walls, m.bonded) == (self.walls, self.bonded))
        return next(m.name for m in same if m.two_way)

    @property
    def plain(self):
        """Name of the one-way coupled, dry model with these walls, whose convergence is theirs."""
        same = (m for m in MODELS.values() if m.walls == self.walls)
        return next(m.name for m in same if not (m.bonded or m.two_way))


MODELS = {
    model.name: model
    for model in (
        Model("free", "none", meaning="no return walls", static="-."),
        Model("W1", "one", False, "one block, ground motion", "#0072B2", "o", "-"),
        Model("W1c", "one", True, "W1 with a bonded joint", "#56B4E9", "s", ":", cost=7.0),
        Model("W2", "floors", False, "a block a floor, floor motions", "#D55E00", "^", cost=2.3),
        Model("W2c", "floors", True, "W2 with a bonded joint", "#E69F00", "D", cost=9.0),
        Model(
            "W3",
            "bricks",
            False,
            "interlocking bricks, floor motions",
            "#009E73",
            "v",
            "--",
            cost=18.0,
        ),
        Model("W2m", "floors", False, "W2 with the building's mass", "#CC79A7", "<", two_way=True),
        Model("W3m", "bricks", False, "W3 with the building's mass", "#7A5195", "P", two_way=True),
        Model("W2cm", "floors", True, "W2c with the building's mass", "#B5A21E", ">", two_way=True),
    )
}
# The complete building has an assembly, a study and rules of its own (`building.complete`)
COMPLETE = {
    model.name: model
    for model in (
        Model("CB", "building", False, "complete building, façade cracked off", "#000000", "X"),
        Model("CBc", "building", True, "complete building, façade bonded", "#7F7F7F", "*"),
    )
}
WITH_WALLS = tuple(name for name, model in MODELS.items() if model.walls != "none")
REFERENCE_MODELS = tuple(
    n for n in WITH_WALLS if MODELS[n].single_block and not MODELS[n].bonded
)  # of dry joints
PUSHED = tuple(name for name, model in MODELS.items() if model.static)


def cost(name):
    """Time of a run of a model in YADE over that of W1; 1 for what is no model."""
    return MODELS[MODELS[name].one_way_model].cost if name in MODELS else 1.0


def model(name):
    """Return the model called `name`; a ValueError of one line names the known models."""
    if not isinstance(name, str) or name not in MODELS:
        raise ValueError(f"unknown façade model '{name}': expected one of {', '.join(MODELS)}")
    return MODELS[name]
