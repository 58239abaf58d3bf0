"""What is shaken: a case, as plain data.

A case is one façade with its building, before one model of what stands behind it, with β and
numerics chosen: the content of `results/<run>/cases/<model>.json`. Solvers build their scene from
it. How a `Variant` changes a case stands in `variant.py`.
"""

import copy
import json
import math
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike
from typing import Any

from rocking.collapse.frozen import frozen
from rocking.collapse.variant import Variant, allowed, applied, place
from rocking.configuration import config as configuration
from rocking.configuration import schema
from rocking.configuration.facade import WEAKEST, check_facade
from rocking.configuration.files import read_yaml
from rocking.configuration.storeys import check_storeys
from rocking.configuration.together import NoEffectWarning, without_effect
from rocking.fidelity import choose
from rocking.mechanics.beta import LAW_FILE, RangeWarning, beta_and_range, beta_for
from rocking.shipped import found
from yade_scripts.files import read_json
from yade_scripts.lists import listed
from yade_scripts.model import registry
from yade_scripts.model.facades import Facade
from yade_scripts.model.part import part_of

FIDELITY_FILE = LAW_FILE.with_name("fidelity.yaml")
OF_THE_FACADE = {"facade", "return_wall", "w3", "model"}  # what makes it possible or not
Given = str | PathLike | Mapping[str, Any]  # a configuration: its file, or values by key
SECTIONS = ("facade", "part", "return_wall", "damping", "smdof", "numerics", "ida", "ensemble")


@dataclass(frozen=True)
class Case:
    """One façade, its building and its model.

    Attributes
    ----------
    sections : dict
        model, beta_s, and the sections of a configuration that a run depends on; frozen all the
        way down. Cases of the same sections are equal.

    Examples
    --------
    >>> from rocking import Case, Variant
    >>> case = Case.configured("W1", {"facade.height_m": 5.0})
    >>> case
    Case W1: façade 5 m high, 0.375 m thick, 4.4 m wide; building of 0.27 s; β 0.00237 s
    >>> case.model, case["facade"]["height_m"], case["numerics"]["nodes_height"] > 0
    ('W1', 5.0, True)
    >>> case.varied(Variant("thick", factors={"facade.thickness_m": 2.0}))["facade"]["thickness_m"]
    0.75
    """

    sections: Mapping[str, Any]

    def __post_init__(self) -> None:
        """Check that there are sections, and freeze a copy of them."""
        if not isinstance(self.sections, Mapping):
            raise TypeError(
                f"Case of {type(self.sections).__name__}: expected Case.configured(model, …) or "
                "Case.read(path)"
            )
        object.__setattr__(self, "sections", frozen(self.sections))

    def __hash__(self) -> int:
        """Return the hash of what the case file would hold."""
        return hash(self.to_json())

    @classmethod
    def read(cls, path: str | PathLike) -> "Case":
        """Read a case file, as the workflow writes them to `results/<run>/cases`.

        Raises
        ------
        ValueError
            In one line that names the file, for one that is no case file.
        """
        expected = "expected a case file, as results/<run>/cases/<model>.json"
        try:
            sections = read_json(path)
        except (OSError, ValueError, TypeError) as error:
            raise ValueError(f"{path}: {expected}: {error}") from None
        if not isinstance(sections, dict) or not {"model", "facade"} <= sections.keys():
            raise ValueError(f"{path}: {expected}")
        return cls(sections)

    @classmethod
    def configured(cls, model: str, config: "Given | None" = None) -> "Case":
        """Return the case of a configuration.

        Parameters
        ----------
        model : str
            A name of `yade_scripts.model.registry`.
        config : path, mapping or None
            A configuration file, or values by section or dotted key; a key that is left out has its
            default.

        Raises
        ------
        ValueError
            In one line that names the model, the key, or file and line.
        TypeError
            For a configuration that is neither.

        Warns
        -----
        NoEffectWarning
            Of a key that does nothing, since the key with which it acts is not stated.
        """
        registry.model(model)
        given = config or {}
        if not isinstance(given, (str, PathLike, Mapping)):
            raise TypeError(f"{type(given).__name__} given: expected a file, or values by key")
        if not isinstance(given, Mapping):
            given = read_yaml(found(given)) or {}
        if several := [key for key in schema.STUDY_KEYS if given.get(key)]:
            raise ValueError(
                f"{several[0]}: describes several cases; expected one, and others by Case.varied"
            )
        given = configuration.nested(given)
        resolved = configuration.resolve({**given, "models": [model]})
        stated = {key: given[key] for key in (*SECTIONS, "w3") if key in given}
        for line in without_effect(resolved, {**stated, "models": [model]}):
            warnings.warn(line, NoEffectWarning, stacklevel=2)
        with warnings.catch_warnings():
            if "law" not in (given.get("damping") or {}):  # who names none asked for none
                warnings.simplefilter("ignore", RangeWarning)
            return cls.chosen({key: resolved[key] for key in (*SECTIONS, "w3")}, model)

    @classmethod
    def chosen(
        cls,
        given: Mapping[str, Any],
        model: str,
        mass_kg: float | None = None,
        law: str | PathLike = LAW_FILE,
        fidelity: str | PathLike = FIDELITY_FILE,
    ) -> "Case":
        """Return the case of resolved sections, with what they leave open chosen.

        Parameters
        ----------
        given : mapping
            SECTIONS, and w3 for a model of bricks. Of a `part` the case is that part's alone.
        model : str
        mass_kg : float or None
            Of the building behind the façade, where it was found elsewhere.
        law, fidelity : path
            Coefficients of the law of β; measured convergence.
        """
        sections: dict[str, Any] = copy.deepcopy(dict(given))
        kind = registry.model(model)
        sections["model"] = model
        if kind.walls != "bricks":
            sections.pop("w3", None)
        if mass_kg is not None:
            sections["return_wall"]["building_mass_kg"] = mass_kg
        if sections["facade"]["hinges_m"] == WEAKEST:
            from rocking.mechanics.blocks import weakest_hinge  # slow to load, rarely needed

            sections["facade"]["hinges_m"] = [weakest_hinge(sections["facade"])]
        if not kind.compiled or kind.bonded:
            sections["facade"]["courses"] = 0  # such a façade is one block
        part = sections.pop("part", None) or {}
        sections["beta_s"] = beta_for(sections, law)
        sections["numerics"], _ = choose(sections, model, read_yaml(fidelity))
        return cls(sections).part(**part, law=law) if part else cls(sections)

    def __repr__(self) -> str:
        """Return one line: model, façade, building, β."""
        size = self.facade
        return (
            f"Case {self.model}: façade {size.height_m:g} m high, {size.thickness_m:g} m "
            f"thick, {size.width_m:g} m wide; building of {self['smdof']['period_s']:g} s; "
            f"β {self['beta_s']:.3g} s"
        )

    def __getitem__(self, key: str) -> Any:
        """Return a section, or model or beta_s."""
        try:
            return self.sections[key]
        except KeyError:
            known = listed(self.sections) or "no section"
            raise KeyError(f"the case has no {key!r}; it has {known}") from None

    @property
    def facade(self) -> Facade:
        """The façade as values: shape, holds and loads follow from it."""
        return Facade.of(self.sections["facade"])

    @property
    def model(self) -> str:
        """Name of the model."""
        return self.sections["model"]

    @property
    def kind(self) -> registry.Model:
        """What the model consists of."""
        return registry.model(self.model)

    def get(self, key: str) -> Any:
        """Return the value of a dotted key; an unknown key is a ValueError of one line."""
        return place(self.sections, key)[0][key.rpartition(".")[2]]

    def varied(self, variant: "Variant | Mapping[str, Any]") -> "Case":
        """Return the case with a variant's changes; β and numerics stay unless it names them.

        Parameters
        ----------
        variant : Variant, or mapping of str to value
            New values by dotted key are a variant too.

        Raises
        ------
        ValueError
            In one line, for a key that the case has not, for a value that the configuration would
            refuse there, or for a façade that it would refuse as a whole.
        TypeError
            For anything else.
        """
        if isinstance(variant, Mapping):
            variant = Variant(changes=variant)
        if not isinstance(variant, Variant):
            raise TypeError(
                f"{type(variant).__name__} given: expected a Variant, or new values by dotted key"
            )
        sections, changed = applied(variant, self.sections)
        if "model" in sections:
            configuration.check_limits(sections)
            if changed & OF_THE_FACADE:
                check_facade({**sections, "models": [sections["model"]]})
        return Case(sections)

    def part(
        self,
        foot_m: float,
        held_m: float | None = None,
        hinge_m: float | None = None,
        law: str | PathLike = LAW_FILE,
        *,
        wedge_deg: float = 0.0,
    ) -> "Case":
        """Return the case of a part of the façade, as a mechanism takes it, on the building.

        What lies above the foot overturns; with `held_m` it bends below that level and opens at
        `hinge_m`. See `yade_scripts.model.part`. β is that of the part's own dimensions by the law
        of `damping.law`; a part without return walls, which has none, keeps the façade's.

        Parameters
        ----------
        foot_m, held_m, hinge_m : float
            Heights above the façade's base.
        law : path
            See `chosen`.
        wedge_deg : float
            Angle from the vertical of the crack behind which a wedge of the return walls turns with
            the part; 0: no wedge.

        Raises
        ------
        ValueError
            In one line, for heights beyond the façade, or a part that the configuration would
            refuse as a façade: too stocky to rock, or unable to stand.

        Examples
        --------
        >>> from rocking import Case
        >>> case = Case.configured("W2", {"facade.ties": [{"height_m": 3.0}]})
        >>> above = case.part(3.0)
        >>> above["facade"]["height_m"], above["facade"]["base_height_m"], above["facade"]["ties"]
        (3.48, 3.0, [])
        """
        given = {"foot_m": foot_m, "held_m": held_m, "hinge_m": hinge_m, "wedge_deg": wedge_deg}
        heights = {name: allowed(f"part.{name}", value) for name, value in given.items()}
        wall = self["return_wall"]
        wedge = heights.pop("wedge_deg"), wall["count"] * wall["thickness_m"]
        section = part_of(self["facade"], **heights, wedge=wedge)
        if section == self["facade"]:
            return self
        sections = copy.deepcopy({**self.sections, "facade": section})
        check_facade({**sections, "models": [self.model]})
        if sections["damping"]["law"] != "value" and section["sides"] == "one":
            sections["beta_s"], _ = beta_and_range(sections, law)  # its range is said of the façade
        return Case(sections)

    def calibrated(self, law: str | PathLike = LAW_FILE) -> "Case":
        """Return the case with β by its law anew, after a change of what the law depends on."""
        return Case({**self.sections, "beta_s": beta_for(self.sections, law)})

    def checked(self) -> "Case":
        """Return the case, if it states all that the solvers need.

        Raises
        ------
        ValueError
            In one line.
        """
        mass = self["return_wall"]["building_mass_kg"]
        if self.kind.two_way and not (mass and mass > 0.0):
            raise ValueError(
                f"return_wall.building_mass_kg = {mass}: expected the mass (kg) of the building "
                f"behind the façade, with model {self.model}"
            )
        check_storeys({**self.sections, "models": [self.model]})
        if not math.isfinite(self["beta_s"]):
            raise ValueError(f"beta_s = {self['beta_s']}: expected a finite number (s)")
        return self

    def to_json(self) -> str:
        """Text of the case file."""
        return json.dumps(self.sections, indent=1, sort_keys=True) + "\n"
