"""Charts are what their names say, at every size, and reading back gives what was written."""

import numpy as np
import pytest

from p2sf.errors import RequestError
from p2sf.image.charts import BRIGHT, CHARTS, DARK, draw_chart, slanted_edge


@pytest.mark.parametrize("name", CHARTS)
@pytest.mark.parametrize("shape", [(8, 9), (40, 64), (65, 33)])
def test_every_chart_fills_its_size_with_light_between_black_and_white(name, shape):
    drawn = draw_chart(name, *shape)
    assert drawn.shape == (*shape, 3) and drawn.dtype == np.float32
    assert drawn.min() >= 0 and drawn.max() <= 1 and drawn.std() > 0.01


def test_the_edge_is_averaged_over_its_pixels_exactly():
    """64 samples a pixel each way miss a straight edge's share by at most a sample's width."""
    fine = 64
    y, x = (((np.arange(16 * fine) + 0.5) / fine - 0.5 - 8) for _ in range(2))
    angle = np.deg2rad(5.0)
    sampled = (x * np.cos(angle) - y[:, None] * np.sin(angle) > 0).reshape(16, fine, 16, fine).mean((1, 3))
    drawn = (slanted_edge(16, 16) - DARK) / (BRIGHT - DARK)
    assert np.abs(drawn - sampled).max() < 1 / fine


def test_the_landscape_has_the_spectrum_of_nature():
    """Amplitudes of natural pictures fall roughly with 1/f (Field 1987): a slope between −0.7 and −1.6."""
    spectrum = np.abs(np.fft.fft2(draw_chart("landscape", 256, 256)[..., 1]))
    f = np.hypot(*np.meshgrid(np.fft.fftfreq(256), np.fft.fftfreq(256)))
    rings = [(f > low) & (f < 2 * low) for low in (0.02, 0.04, 0.08, 0.16)]
    slope = np.polyfit(np.log([f[r].mean() for r in rings]), np.log([spectrum[r].mean() for r in rings]), 1)[0]
    assert -1.6 < slope < -0.7


def test_a_wrong_name_or_size_is_one_sentence():
    with pytest.raises(RequestError, match="did you mean siemens_star"):
        draw_chart("siemens", 64, 64)
    with pytest.raises(RequestError, match="give 8 to"):
        draw_chart("text", 4, 64)
