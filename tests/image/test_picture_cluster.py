"""Pictures that the workers of a cluster form are those of this process, bit for bit."""

import pickle
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

import p2sf
from p2sf.errors import Cancelled, ClusterError
from p2sf.image import form as forming
from p2sf.image.charts import draw_chart
from p2sf.image.form import Forming, form_image
from p2sf.image.progress import Progress
from p2sf.lensfile.library import find_lens
from p2sf.scene.planning.plan import plan
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor
from tests.support.cluster import running_cluster

distributed = pytest.importorskip("distributed")

ROWS, COLUMNS = 48, 40
GREEN = (Channel("green", (540.0,), (1.0,)),)


@pytest.fixture(scope="module")
def scene():
    """Return a plan, a picture and its depths, a slope with a step, in two rows of two tiles each."""
    sensor = Sensor(ROWS, COLUMNS, 40.0)
    taken = Scene(sensor, GREEN, 1500.0, 6000.0, 0.2, f_number=11.0, focus_mm=2500.0)
    depth = np.linspace(1500.0, 4000.0, ROWS)[:, None] * np.ones(COLUMNS)
    depth[:20, 20:] = 6000.0
    return plan(find_lens("double_gauss_28"), taken), draw_chart("landscape", ROWS, COLUMNS)[..., 1:2], depth


@pytest.fixture(autouse=True)
def small_tiles(monkeypatch):
    monkeypatch.setattr(forming, "TILE", 32)


@pytest.fixture(scope="module")
def client():
    with (
        distributed.LocalCluster(2, threads_per_worker=1, processes=False, dashboard_address=None) as cluster,
        distributed.Client(cluster, set_as_default=False) as client,
    ):
        yield client


@pytest.mark.parametrize("how", [Forming(), Forming("lowrank", surround="black")])
def test_rows_of_tiles_are_those_of_this_process(scene, client, how):
    told = []
    found = form_image(*scene, replace(how, scheduler=client), Progress(told.append))
    np.testing.assert_array_equal(found, form_image(*scene, how))
    assert told == sorted(told) and told[-1] == 1 and len(told) >= 4  # tiles


def test_another_process_forms_the_same_row(scene, monkeypatch):
    """What travels is no more than the picture and the plan: kernels are computed where it arrives."""
    sent = []

    def pickled(former, parts, take):
        sent.append(pickle.dumps(former))
        for formed in forming._form_row(pickle.loads(sent[0]), parts):
            take(formed)

    monkeypatch.setattr(forming, "_form_rows", pickled)
    found = form_image(*scene, Forming(scheduler="another"))
    np.testing.assert_array_equal(found, form_image(*scene))
    assert len(sent[0]) < 4 * sum(each.nbytes for each in scene[1:]) + 2**18


def test_a_cancelled_picture_leaves_the_workers_nothing_to_do(scene, client):
    calls = iter([False, False, *[True] * 1000])
    with pytest.raises(Cancelled):
        form_image(*scene, Forming(scheduler=client), Progress(cancelled=partial(next, calls)))
    assert not [name for name in client.futures if name.startswith("_form_row")]


def test_nobody_there_is_a_sentence(scene, monkeypatch):
    monkeypatch.setattr("p2sf.cluster.ANSWER_S", 0.2)
    with pytest.raises(ClusterError, match="no scheduler answers at"):
        p2sf.form_image(*scene, scheduler="tcp://127.0.0.1:1")


@pytest.mark.slow
def test_workers_of_other_processes_form_the_same_picture_until_their_scheduler_is_lost(scene, tmp_path):
    with running_cluster(tmp_path) as cluster:
        found = p2sf.form_image(*scene, scheduler=cluster.address)
        np.testing.assert_array_equal(found, p2sf.form_image(*scene))
        lost = Progress(lambda share: cluster.kill_scheduler())
        with pytest.raises(ClusterError, match="is lost"):
            form_image(*scene, Forming(scheduler=cluster.address), lost)
