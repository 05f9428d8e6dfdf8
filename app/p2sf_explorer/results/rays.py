"""Exact rays of the present source: spot diagram, ray fan, OPD fan."""

from p2sf.raytrace.pencil import Fan, Spot, opd_fan, ray_fan, spot
from p2sf_explorer.compute.live import Live

RINGS = {"preview": 6, "settled": 10}
FAN_RAYS = 41


def spots(live: Live) -> Spot:
    """Return where hexapolar rays meet the sensor, µm from the chief ray; fewer rays while a slider moves."""
    setup = live.setup
    return spot(setup.lens, setup.source, RINGS[live.quality], clip=live.state.optics.clip)


def ray_errors(live: Live) -> Fan:
    """Return transverse ray errors along the two axes of the pupil, µm."""
    return ray_fan(live.setup.lens, live.setup.source, FAN_RAYS)


def path_errors(live: Live) -> Fan:
    """Return optical path differences along the two axes of the pupil, waves."""
    return opd_fan(live.setup.lens, live.setup.source, FAN_RAYS)
