"""W3: the façade interlocked with a column of return-wall bricks, in courses.

Courses count from the bottom. Even courses hold a header of the façade, which reaches
by the overlap v into the return wall, and behind it a half brick; odd courses hold a
return brick. Half a model by symmetry: half the façade and one return wall::

        façade |            top
     ┌─────────┼────┐┌────┐   even course: header, half brick
     │         ├────┴┴────┤   odd course: return brick
     │         ├────┐┌────┤
     │  y = 0 >├────┴┴────┤   (outward is to the left here)

Return bricks are driven along y by the rule of `wall_motion` and are free in z and in
rotation about x (paper, section 4); a half brick belongs to the return brick below it.
Its two bed joints in series make the joint to the next return brick half as stiff, as
stiff as the two bed joints of the header beside it.

Where the walls carry the building's mass (W3m) the bricks hang on its masses, see `panels`,
and the scene stands in the frame of the ground.

Dry joints have no dashpot along them: YADE's contact law would not bound it by friction, and where
a light brick closes on a corner it would carry what friction cannot. Across them it stays.

Contacts of two edges that slide off each other: one node on the header's rear edge
against the brick's face, one on the brick's front edge against the header's face. The
ends of the overlap are always such a pair, and both faces end where the blocks do, so
a course that has slipped by v carries nothing.

How a header hangs on the façade (`header_joint`)::

    rigid    part of the façade
    bonded   two Gauss points with tension, cohesion and friction of the brick: it deforms,
             and each point breaks
    sliding  two points that tie in tension but transmit no shear: it rides up the façade
    hinged   one such point at mid height: it also stays level while the façade turns
    study    bonded, and the return bricks among the lowest courses that have a header below
             them are cut by an inclined plane, see `split_bricks`
"""

import math
from dataclasses import replace

import numpy as np

from yade_scripts.model import split_bricks
from yade_scripts.model.facade import BASE, FACADE, Beds, ground_block, plain_block
from yade_scripts.model.facades import Facade
from yade_scripts.model.floor_motions import GROUND
from yade_scripts.model.panels import Hanging
from yade_scripts.model.quadrature import GAUSS
from yade_scripts.model.scene import NO_DRAG, Block, Interface, NodeList, Scene, box_inertia, held
from yade_scripts.model.split_bricks import DOWN, ONTO_BRICK, UP
from yade_scripts.model.wall_motion import motion_of

HEADER_JOINTS = ("rigid", "bonded", "sliding", "hinged", "study")
BACK = (0.0, -1.0, 0.0)


def interlocking_scene(config, beta_s, *, two_way=False):
    """Build the scene of W3, or of W3m if `two_way`; β is that of the façade's base and back face.

    Its notes hold "rims", "partial" (see `engine.faces`), "motions" (weights of floor motions by
    name), "debris" (headers, which fall once out), "bed_joints" (names, from the bottom) and
    "walls" (modelled return walls). ValueError: see `check`.
    """
    return _Assembly(config, beta_s, two_way).scene()


def check(config, two_way=False):
    """Refuse bricks that cannot be laid: a ValueError of one line.

    So if the courses do not fill the height, the overlap does not leave a half brick, a cut misses
    its brick, or a rule is unknown or not for these walls.
    """
    height, w3 = Facade.of(config["facade"]).height_m, config["w3"]
    course, overlap = w3["course_height_m"], w3["overlap_m"]
    courses = round(height / course)
    if abs(courses * course - height) > 1e-6 * height or courses < 2:
        near = max(courses, 2)
        raise ValueError(
            f"w3.course_height_m = {course:g}: expected a divisor of facade.height_m = "
            f"{height:g} (m), so that whole courses fill the height, as {height / near:.6g} "
            f"({near} courses)"
        )
    if not 0.0 < overlap < w3["brick_length_m"]:
        raise ValueError(
            f"w3.overlap_m = {overlap:g}: expected less than w3.brick_length_m = "
            f"{w3['brick_length_m']:g} (m), so that a part of each brick stays in the wall"
        )
    if w3["header_joint"] not in HEADER_JOINTS:
        raise ValueError(
            f"w3.header_joint = '{w3['header_joint']}': expected {', '.join(HEADER_JOINTS)}"
        )
    if w3["header_joint"] == "study" and w3["lower_courses"]:
        split_bricks.lowest_edge(course, overlap, math.radians(w3["split_inclination_deg"]))
        if two_way:
            raise ValueError(
                "w3.header_joint = 'study': expected another rule for W3m, whose bricks hang "
                "on the building's masses and cannot be cut"
            )


class _Assembly:
    """Collects blocks and joints of W3; one instance builds one scene."""

    def __init__(self, config, beta_s, two_way):
        facade, wall, w3 = Facade.of(config["facade"]), config["return_wall"], config["w3"]
        self.config, self.beta, self.two_way = {**config, "facade": facade}, beta_s, two_way
        self.h, self.b = facade.height_m, facade.thickness_m
        self.course, self.v = w3["course_height_m"], w3["overlap_m"]
        self.length = w3["brick_length_m"]
        self.t, self.density, self.w3 = wall["thickness_m"], facade.density_kg_m3, w3
        check(config, two_way)
        self.courses = round(self.h / self.course)
        self.split_inclination = math.radians(w3["split_inclination_deg"])
        self.split = w3["lower_courses"] if w3["header_joint"] == "study" else 0
        # in a half model everything is halved: weight and stiffness, hence no number changes
        self.walls = 1 if w3["half_model"] else wall["count"]
        self.share = self.walls / wall["count"]
        self.width = facade.width_m * self.share
        spread = 0.5 * (facade.width_m - self.t)
        self.x = [0.0] if self.walls == 1 else np.linspace(-spread, spread, self.walls).tolist()
        self.blocks, self.nodes, self.rims, self.motions = [], NodeList(NO_DRAG), {}, {}
        self.beds, self.bricks, self.headers, self.partial = [], [], [], []
        self.hanging: Hanging | None = None
        self.brick = Interface(
            jkn_pa_m=w3["jkn_pa_m"], jks_pa_m=w3["jks_pa_m"], beta_s=w3["joint_beta_s"]
        )
        self.bed = replace(self.brick, friction_rad=math.radians(w3["friction_deg"]))

    def scene(self):
        """Assemble everything."""
        self._facade()
        links = []
        if self.two_way:
            self.hanging = Hanging(self.config, self.blocks, self.nodes, self.walls, self.length)
        for wall, x in enumerate(self.x, 1):
            self._wall(f"wall {wall}" if self.walls > 1 else "wall", x)
        if self.hanging:
            links = self.hanging.finish(self.bricks)
        notes = {
            "rims": self.rims,
            "debris": self.headers,
            "partial": self.partial,
            "motions": self.motions,
            "bed_joints": self.beds,
            "walls": self.walls,
        }
        return Scene(
            self.blocks,
            self.nodes.joints,
            self.nodes.done(),
            monitor=FACADE,
            monitor_point_m=(0.0, 0.5 * self.b, self.h),
            reference=BASE,
            thickness_m=self.b,
            links=links,
            shaking=GROUND if self.two_way else None,
            notes=notes,
        )

    def _facade(self):
        """Ground, façade and the base joint between them."""
        facade = replace(self.config["facade"], width_m=self.width)
        ground = ground_block(facade, None if self.two_way else GROUND)
        self.blocks += [ground, plain_block(facade, "yzX")]
        Beds({**self.config, "facade": facade}, self.beta, self.nodes, planar=True).base(1, 0)

    def _wall(self, wall, x):
        """One return wall: bricks, headers, and their joints from the bottom up."""
        # of a cut brick the rear stands on the column, the front between the two headers
        rear = front = self._brick(wall, 1, x)
        area = self.t * self.length / 3.0
        foot = [(x, y, 0.0) for y in (0.0, -0.5 * self.length, -self.length)]
        self.nodes.add_joint(f"{wall} foot", rear, 0, foot, UP, [area] * 3, self.bed)
        self._back(wall, 1, front, x)
        for course in range(2, self.courses + 1, 2):
            header = self._header(wall, course, x)
            self._bed(wall, course - 1, front, header, x, header_above=True)
            if course == self.courses:
                break
            below = rear
            rear, front = self._brick_or_parts(wall, course + 1, x)
            if rear == front:
                self._bed(wall, course, front, header, x, header_above=False)
            else:
                split_bricks.add_bed(self, f"{wall} bed {course}", course, rear, front, header, x)
            # the half brick behind the header stands on `below` and is part of it
            length = self.length - self.v
            place = [(x, y, course * self.course) for y in (-self.v, -self.length)]
            name = f"{wall} half brick {course}"
            half = {key: 0.5 * getattr(self.bed, key) for key in ("jkn_pa_m", "jks_pa_m")}
            self.nodes.add_joint(
                name,
                below,
                rear,
                place,
                DOWN,
                0.5 * self.t * length,
                replace(self.bed, **half),
            )
            self.rims[name] = ONTO_BRICK
            self._back(wall, course + 1, front, x)

    def bond(self, place):
        """What holds a joint by section w3, with strengths of "header" or "lower" courses."""
        tension, cohesion = (self.w3[f"{place}_{what}_mpa"] for what in ("tension", "cohesion"))
        return held(tension * 1e6, cohesion * 1e6, math.radians(self.w3["friction_deg"]))

    def _brick_or_parts(self, wall, course, x):
        """Append a return brick, cut if it is one of the lowest; return its rear and front."""
        if course > self.split:
            whole = self._brick(wall, course, x)
            return whole, whole
        bottom = (course - 1) * self.course
        name, half = f"{wall} brick {course}", course < self.courses
        motion = self._motion(bottom + 0.5 * self.course)
        return split_bricks.add_parts(self, name, x, bottom, motion, half)

    def _brick(self, wall, course, x):
        """Append a return brick with the half brick above its rear; return its index."""
        bottom = (course - 1) * self.course
        rear = self.length - self.v if course < self.courses else 0.0
        parts = [  # (length, y, z of the centre)
            (self.length, -0.5 * self.length, bottom + 0.5 * self.course),
            (rear, -self.v - 0.5 * rear, bottom + 1.5 * self.course),
        ]
        masses = np.array([self.density * self.t * self.course * part[0] for part in parts])
        centre = sum(m * np.array([x, *part[1:]]) for m, part in zip(masses, parts, strict=True))
        centre = centre / masses.sum()
        inertia = np.zeros(3)
        for m, (length, y, z) in zip(masses, parts, strict=True):
            moments = box_inertia(m, (self.t, length, self.course))
            dy, dz = y - centre[1], z - centre[2]
            inertia += np.array(moments) + m * np.array([dy**2 + dz**2, dz**2, dy**2])
        motion = None if self.two_way else self._motion(centre[2])
        self.blocks.append(
            Block(
                f"{wall} brick {course}",
                tuple(centre),
                (self.t, self.length, self.course),
                float(masses.sum()),
                tuple(inertia),
                free="yzX" if self.two_way else "zX",
                motion=motion,
            )
        )
        self.bricks.append(len(self.blocks) - 1)
        if self.hanging:
            self.hanging.hang(self.bricks[-1], x)
        return self.bricks[-1]

    def _motion(self, z):
        """Name of the motion of a brick at height z."""
        rule, n = self.config["return_wall"]["motion"], self.config["smdof"]["n_dof"]
        return motion_of(rule, z, self.h, n, self.motions)

    def _header(self, wall, course, x):
        """Append a header and its joint to the façade; return its index."""
        w3, middle = self.w3, (course - 0.5) * self.course
        rule = w3["header_joint"]
        if rule == "rigid":
            return 1
        size = (self.t, self.v, self.course)
        mass = self.density * self.t * self.v * self.course
        self.blocks.append(
            Block(
                f"{wall} header {course}",
                (x, -0.5 * self.v, middle),
                size,
                mass,
                box_inertia(mass, size),
                free="yzX",
            )
        )
        self.headers.append(self.blocks[-1].name)
        header, area = len(self.blocks) - 1, self.t * self.course
        name = f"{wall} header joint {course}"
        pair = [(x, 0.0, middle - GAUSS * self.course), (x, 0.0, middle + GAUSS * self.course)]
        # a plane through the joint along which façade and header part as it rises
        inclined = rule != "study" and course <= w3["lower_courses"]
        slope = math.radians(w3["lower_inclination_deg"]) if inclined else 0.0
        if inclined or rule in ("bonded", "study"):
            places, bond = pair, self.bond("lower" if inclined else "header")
        else:
            places = pair if rule == "sliding" else [(x, 0.0, middle)]
            bond = held(w3["header_tension_mpa"] * 1e6, 0.0, 0.0)
        self.nodes.add_joint(
            name,
            header,
            1,
            places,
            (0.0, -math.cos(slope), -math.sin(slope)),
            area / len(places),
            replace(self.brick, **bond),
        )
        return header

    def _bed(self, wall, lower, brick, header, x, header_above):
        """Bed joint above course `lower`, between a return brick and a header."""
        z, area = lower * self.course, 0.5 * self.t * self.v
        name = f"{wall} bed {lower}"
        onto, under = (UP, DOWN) if header_above else (DOWN, UP)
        # header's rear edge on the brick's face; brick's front edge on the header's face
        edge, front = f"{name} rear edge", f"{name} front edge"
        self.nodes.add_joint(edge, header, brick, [(x, -self.v, z)], onto, area, self.bed)
        self.rims[edge] = ONTO_BRICK
        self.nodes.add_joint(front, brick, header, [(x, 0.0, z)], under, area, self.bed)
        self.rims[front] = ((0.0, -1.0, 0.0), self.v)
        self.beds.append(name)

    def _back(self, wall, course, brick, x):
        """Front end of a return brick against the façade's back face: compression only."""
        bottom = (course - 1) * self.course
        place = [(x, 0.0, bottom), (x, 0.0, bottom + self.course)]
        self.nodes.add_joint(
            f"{wall} back {course}",
            brick,
            1,
            place,
            BACK,
            0.5 * self.t * self.course,
            Interface(
                self.w3["jkn_pa_m"],
                self.w3["jks_pa_m"],
                beta_s=self.beta,
                friction_rad=math.radians(self.config["return_wall"]["friction_deg"]),
            ),
        )
