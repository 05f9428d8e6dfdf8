"""A photo of 12 megapixels through the Double Gauss, as the Image panel makes it; skipped unless asked for.

``python -m pytest tests/benchmarks/test_photo_speed.py --benchmark-only -s`` prints the figures. The picture is made in
a process of its own, so that the memory is its alone.
"""

import json
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

from p2sf.image.charts import draw_chart
from p2sf.io.transfer import srgb_from_linear

ROWS, COLUMNS = 3000, 4000
MOST_S, MOST_GIB = 40.0, 2.0
MADE = """
import json, resource, sys, time
from p2sf.image.progress import Progress
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.views.image import pixels, planned, question
from p2sf_explorer.state.state import new_state

asked = question(live(new_state(photo_source=sys.argv[1], photo_pixel_um=None, photo_full=True))).question
told, begun, cpu = [], time.perf_counter(), time.process_time()
answer = planned(asked, Progress(told.append))
pixels(answer.before), pixels(answer.after)
print(json.dumps({
    "wall": time.perf_counter() - begun, "cpu": time.process_time() - cpu, "told": len(told), "last": told[-1],
    "gib": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20, "shape": answer.after.shape,
}))
"""


@pytest.fixture(scope="module")
def photo(tmp_path_factory):
    path = tmp_path_factory.mktemp("photo") / "landscape.jpg"
    levels = np.clip(srgb_from_linear(draw_chart("landscape", ROWS, COLUMNS)), 0, 1)
    Image.fromarray(np.rint(255 * levels).astype(np.uint8)).save(path, quality=92)
    return path


def test_twelve_megapixels_through_the_double_gauss(benchmark, photo):
    def work():
        done = subprocess.run([sys.executable, "-c", MADE, photo], capture_output=True, text=True, check=True)
        return json.loads(done.stdout)

    found = benchmark.pedantic(work, rounds=1)
    print(
        f"\n{ROWS * COLUMNS / 1e6:.0f} megapixels: wall {found['wall']:.1f} s, CPU {found['cpu']:.1f} s, "
        f"peak {found['gib']:.2f} GiB, progress told {found['told']} times"
    )
    assert found["shape"] == [ROWS, COLUMNS, 3] and found["told"] > 100 and found["last"] == pytest.approx(1.0)
    assert found["wall"] <= MOST_S and found["gib"] <= MOST_GIB
