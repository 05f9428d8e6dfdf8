"""Depth nodes of a plan, where a curved image is sharp between the axis and the corner."""

import numpy as np

from p2sf.lensfile.library import find_lens
from p2sf.scene.planning.plan import plan
from p2sf.scene.planning.verify import error_at
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor


def test_depths_are_resolved_where_a_curved_image_is_sharp_between_axis_and_corner():
    """One depth node, tried on the axis and in the corner alone, was off by 0.107 where 0.044 was predicted."""
    sensor = Sensor(198, 281, 26.597)
    scene = Scene(sensor, (Channel("green", (584.311,), (1.0,)),), 13251.5, np.inf, 0.1, f_number=6.665)
    planned = plan(find_lens("plano_convex"), scene)
    found, _ = error_at(planned, -0.465, 2.466, 0.0, 0)
    assert found <= planned.predicted_error <= planned.allowed_error


def test_depth_nodes_serve_channels_that_are_less_blue_as_well():
    """Of large pixels the longer waves alone blur beyond one at the near end: with one node they were off by 0.3."""
    channels = tuple(Channel(f"{nm}", (nm - 20.0, nm + 0.0, nm + 20.0), (1.0, 1.0, 1.0)) for nm in (501, 465))
    scene = Scene(Sensor(77, 273, 71.965), channels, near_mm=7045.7, rtol=0.2, f_number=17.6)
    planned = plan(find_lens("periskop"), scene)
    assert len(planned.vergences) > 1
    near = float(scene.vergences(2)[-1])
    assert max(error_at(planned, 0.0, 0.0, near, channel)[0] for channel in (0, 1)) <= planned.predicted_error
