"""What carries the supports: the scheme of a chain and of modes, in closed form."""

import numpy as np
import pytest
from rocking.solver import bodies, substructure
from rocking.solver.inputs import Supports


def chain(n=3, turning=True):
    """Masses with springs and dashpots to their neighbours, and supports that hang on them."""
    draw = np.random.default_rng(n)
    mass, k = 1.0 + draw.random(n), 50.0 * (1.0 + draw.random(n))
    stiffness = np.diag(k + np.append(k[1:], 0.0)) - np.diag(k[1:], 1) - np.diag(k[1:], -1)
    rows = draw.normal(size=(3, 2, n)) if turning else (None, None, None)
    return bodies(mass, stiffness, 0.01 * stiffness, *rows, ground=draw.normal(size=n))


def still(carried):
    """Carriers before the motion, and their supports with one that stands still."""
    ride = substructure.riding(carried, np.zeros(substructure.rows_of(carried)))
    return ride, Supports(*np.zeros((12, len(carried.hang) + 1)))


def moving(carried, draw):
    """Carriers in a drawn state, and the supports that they have moved through a step of 0.1 s."""
    ride, supports = still(carried)
    ride.u[:], ride.v[:], ride.a[:] = draw.normal(size=(3, 3))
    substructure.carry(carried, ride, 0.05, 0.1, supports)
    return ride, supports


def test_supports_move_by_what_each_coordinate_adds():
    """Along y, along z and about x: place, velocity at the step, way since the last one."""
    carried = chain()
    ride, supports = moving(carried, np.random.default_rng(7))
    now = ride.v + 0.05 * ride.a
    for rows, found in (
        (carried.hang, (supports.y, supports.vy, supports.dy)),
        (carried.lift, (supports.z, supports.vz, supports.dz)),
        (carried.roll, (supports.turn, supports.spin, supports.dturn)),
    ):
        for value, expected in zip(found, (ride.u, now, 0.1 * ride.v), strict=True):
            assert value[:-1] == pytest.approx(rows @ expected)
            assert value[-1] == 0.0  # what stands still


@pytest.mark.parametrize("turning", [True, False])
def test_forces_reach_the_carriers_by_virtual_work(turning):
    """M a = Hᵀ f − K u − C w − M r a_g, at the velocity of the step."""
    carried = chain(turning=turning)
    draw = np.random.default_rng(8)
    ride, supports = moving(carried, draw)
    supports.fy[:2], supports.fz[:2], supports.moment[:2] = draw.normal(size=(3, 2))
    given = carried.hang.T @ supports.fy[:-1]
    if turning:
        given += carried.lift.T @ supports.fz[:2] + carried.roll.T @ supports.moment[:2]
    given -= carried.k_n_m @ ride.u + carried.c_n_s_m @ ride.w
    substructure.accelerate(carried, ride, supports, 1.7, 1.0)
    assert ride.a == pytest.approx(given / carried.mass_kg - 1.7 * carried.ground)


@pytest.mark.parametrize("count", [2, 4, 9])
def test_only_entries_that_there_are_are_visited(count):
    """Supports between two masses, one that stands still and a mass without any: all of H."""
    draw = np.random.default_rng(count)
    hang = np.zeros((4, count))
    hang[0, 0], hang[1, -2:], hang[3] = 1.0, (0.3, 0.7), draw.normal(size=count)
    carried = bodies(np.ones(count), np.eye(count), np.eye(count), hang)
    ride, supports = still(carried)
    ride.u[:] = draw.normal(size=count)
    substructure.carry(carried, ride, 0.05, 0.1, supports)
    assert supports.y[:-1] == pytest.approx(hang @ ride.u)
    supports.fy[:-1] = draw.normal(size=4)
    substructure.accelerate(carried, ride, supports, 0.0, 1.0)
    assert ride.a == pytest.approx(hang.T @ supports.fy[:-1] - ride.u)


def test_quiet_is_said_of_absolute_accelerations():
    """A mass that the ground takes along is shaken; one that stands still in space is quiet."""
    carried = bodies([1.0], [[0.0]], [[0.0]])
    ride, supports = still(carried)
    assert not substructure.accelerate(carried, ride, supports, 5.0, 1.0)
    assert ride.a[0] == -5.0
    supports.fy[0] = 2.0
    assert substructure.accelerate(carried, ride, supports, 5.0, 1.0)


def test_a_free_chain_swings_with_its_frequencies():
    """Leapfrog from rest in each mode, without dashpots: u = φ cos nθ with sin θ/2 = ωh/2."""
    whole = chain(turning=False)
    carried = bodies(whole.mass_kg, whole.k_n_m, 0.0 * whole.c_n_s_m)
    root = np.sqrt(carried.mass_kg)
    values, vectors = np.linalg.eigh(carried.k_n_m / np.outer(root, root))
    for omega, vector in zip(np.sqrt(values), (vectors / root[:, None]).T, strict=True):
        ride, supports = still(carried)
        ride.u[:], step = vector, 0.1 / omega
        for k in range(500):
            half, past = (0.5 * step, step) if k else (0.0, 0.0)
            substructure.carry(carried, ride, half, past, supports)
            substructure.accelerate(carried, ride, supports, 0.0, 1.0)
            substructure.travel(ride, step if k else 0.5 * step, step)
        angle = 2.0 * np.arcsin(0.05)  # 0.1, but for the scheme's (ωh)²/24
        assert ride.u == pytest.approx(vector * np.cos(500 * angle), abs=1e-9)


@pytest.mark.parametrize(
    "given",
    [
        ([1.0, -1.0], np.eye(2), np.eye(2)),
        ([1.0], np.eye(2), np.eye(2)),
        ([1.0, 1.0], np.eye(2), np.eye(2), np.ones((1, 3))),
        ([1.0, 1.0], np.eye(2), np.eye(2), np.ones((1, 2)), np.ones((2, 2))),
        ([1.0, 1.0], np.eye(2), np.eye(2), None, None, None, [1.0]),
    ],
)
def test_shapes_that_do_not_fit_are_refused(given):
    with pytest.raises(ValueError, match="bodies: expected"):
        bodies(*given)
