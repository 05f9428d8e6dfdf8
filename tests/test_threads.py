"""Threads: results in order and the same on any number, errors, no pools in pools, BLAS at one thread and back."""

import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import lru_cache, partial
from threading import Barrier, Event, current_thread
from time import monotonic, sleep

import numpy as np
import pytest
from threadpoolctl import ThreadpoolController, threadpool_info, threadpool_limits

import p2sf
from p2sf import threads
from p2sf.database.build import build_database
from p2sf.database.render import Sampling, render_source
from p2sf.database.space import Space
from p2sf.errors import Cancelled, RequestError
from p2sf.threads import AHEAD, for_each, map_threads, one_blas_thread, threads_or_default, using_threads

PATIENCE = 30  # seconds until a test that hangs fails


@pytest.fixture(autouse=True)
def no_environment(monkeypatch):
    monkeypatch.delenv(threads.VARIABLE, raising=False)


@pytest.fixture
def two_blas_threads():
    """Give BLAS two threads as a fresh process on two cores has them: no thread has asked for them.

    Workers of windows that earlier tests have closed may still be within `one_blas_thread`.
    """
    patient_until = monotonic() + PATIENCE
    while one_blas_thread._process.within:
        assert monotonic() < patient_until, "a context of an earlier test was never left"
        sleep(0.01)
    limits = threadpool_limits(2, "blas")
    for library in ThreadpoolController().lib_controllers:
        if hasattr(library, "clear_controlling_thread"):
            library.clear_controlling_thread()
    yield
    limits.restore_original_limits()


def blas_threads():
    return {found["num_threads"] for found in threadpool_info() if found["user_api"] == "blas"}


def test_the_caller_goes_before_the_environment_and_that_before_the_cores(monkeypatch):
    monkeypatch.setattr(threads, "_usable_cores", lambda: 7)
    assert threads_or_default() == 7
    monkeypatch.setenv(threads.VARIABLE, " 3 ")
    assert threads_or_default() == 3
    assert threads_or_default(5) == 5
    monkeypatch.setenv(threads.VARIABLE, "")
    assert threads_or_default() == 7


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux binds a process to cores this way")
def test_a_process_bound_to_one_core_uses_one_thread():
    code = "import os; os.sched_setaffinity(0, {min(os.sched_getaffinity(0))}); from p2sf import threads; "
    code += "print(threads.threads_or_default())"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["1"]


@pytest.mark.parametrize("number", [0, -1, True, 1.5, "2"])
def test_a_number_that_is_none_is_refused(number):
    with pytest.raises(RequestError, match=f"threads is {number}; give a whole number of 1 or more"):
        map_threads(str, [1, 2], threads=number)


@pytest.mark.parametrize("text", ["0", "-2", "two", "1.5"])
def test_an_environment_that_says_no_number_is_refused(monkeypatch, text):
    monkeypatch.setenv(threads.VARIABLE, text)
    with pytest.raises(RequestError, match=f"P2SF_THREADS is {text}; give a whole number of 1 or more"):
        threads_or_default()


def test_a_number_holds_within_for_all_that_is_given_none(monkeypatch):
    monkeypatch.setenv(threads.VARIABLE, "7")
    with using_threads(3):
        assert (threads_or_default(), threads_or_default(5)) == (3, 5)
        with using_threads(None):
            assert map_threads(lambda _: threads_or_default(), range(2), 2) == [3, 3]
        with pytest.raises(RequestError, match="threads is 0"), using_threads(0):
            pass
        assert threads_or_default() == 3
    assert threads_or_default() == 7


@pytest.mark.parametrize("count", [1, 2, 3])
def test_results_come_in_the_order_of_the_items_whatever_ends_first(count):
    last = Event()

    def late(item):  # the first item ends after the second, where two threads can have it so
        if item == 0 and count > 1:
            assert last.wait(PATIENCE)
        last.set()
        return item * item

    assert map_threads(late, range(20), count) == [k * k for k in range(20)]


def test_threads_work_at_the_same_time():
    both = Barrier(2, timeout=PATIENCE)
    names = map_threads(lambda _: (both.wait(), current_thread().name)[1], range(2), 2)
    assert len(set(names)) == 2


@pytest.mark.parametrize("items, count", [([], 2), ([1], 2), ([1, 2], 1)])
def test_nothing_to_share_stays_in_the_callers_thread(items, count):
    assert map_threads(lambda _: current_thread(), items, count) == [current_thread()] * len(items)


@pytest.mark.parametrize("count", [1, 3])
def test_the_first_item_that_fails_is_the_error_and_ends_the_work(count):
    started = []

    def fails(item):
        started.append(item)
        if item in (4, 6):
            raise Cancelled("stopped at {item}", item=item)

    with pytest.raises(Cancelled, match="stopped at 4"):
        for_each(fails, range(1000), lambda result: None, count)
    assert len(started) <= 5 + AHEAD * count


def test_results_are_taken_in_order_by_the_caller_and_few_wait_for_it():
    started, taken = [], []

    def take(result):
        assert current_thread() is caller
        taken.append(result)
        if result == 3:
            raise Cancelled("enough")

    caller = current_thread()
    with pytest.raises(Cancelled, match="enough"):
        for_each(lambda item: started.append(item) or item, range(1000), take, 2)
    assert taken == [0, 1, 2, 3]
    assert len(started) <= 4 + 2 * AHEAD


def test_a_pool_within_a_pool_is_the_same_thread():
    def inner(_):
        return {current_thread(), *map_threads(lambda _: current_thread(), range(4), 2)}

    assert [len(found) for found in map_threads(inner, range(4), 2)] == [1] * 4


def test_threads_have_the_floating_point_state_of_their_caller():
    with np.errstate(divide="raise"):
        assert {state["divide"] for state in map_threads(lambda _: np.geterr(), range(3), 2)} == {"raise"}


def test_sums_in_order_are_the_same_to_the_last_bit_on_any_number_of_threads():
    parts = np.random.default_rng(1).normal(size=(50, 200)) * 10.0 ** np.arange(-25, 25)[:, None]
    sums = {count: sum(map_threads(np.sum, parts, count)) for count in (1, 2, 5)}
    assert len(set(sums.values())) == 1


def test_blas_has_one_thread_within_and_its_own_number_afterwards(two_blas_threads):
    with one_blas_thread:
        assert blas_threads() == {1}
        with one_blas_thread:
            pass
        assert blas_threads() == {1}
    assert blas_threads() == {2}
    assert map_threads(lambda _: blas_threads(), range(2), 2) == [{1}, {1}]
    assert blas_threads() == {2}
    with pytest.raises(ZeroDivisionError):
        one_blas_thread(lambda: 1 / 0)()
    assert blas_threads() == {2}


def test_blas_stays_at_one_thread_until_the_last_one_leaves(two_blas_threads):
    within, leave = Barrier(2, timeout=PATIENCE), Event()

    def stays():
        with one_blas_thread:
            within.wait()
            assert leave.wait(PATIENCE)

    with ThreadPoolExecutor(1) as pool:
        with one_blas_thread:
            other = pool.submit(stays)
            within.wait()
        assert blas_threads() == {1}
        leave.set()
        other.result()
    assert blas_threads() == {2}


def test_a_library_that_is_loaded_within_is_held_too():
    code = """
from threadpoolctl import threadpool_info
from p2sf.threads import one_blas_thread
import numpy
with one_blas_thread:
    import scipy.linalg
    with one_blas_thread:
        print({x["num_threads"] for x in threadpool_info() if x["user_api"] == "blas"})
"""
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "2", "MKL_NUM_THREADS": "2"}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, env=environment)
    assert done.stdout.split() == ["{1}"]


class OpenMpLibrary:
    """A BLAS built on OpenMP: each thread has its own number."""

    threading_layer = "openmp"

    def __init__(self):
        self.numbers = {}

    def get_num_threads(self):
        return self.numbers.get(current_thread(), 8)

    def set_num_threads(self, number):
        self.numbers[current_thread()] = number


def test_a_blas_with_a_number_for_each_thread_has_one_in_every_thread_of_a_pool(monkeypatch):
    library = OpenMpLibrary()
    monkeypatch.setattr(threads, "_blas", lambda with_scipy: ([], [library]))
    with one_blas_thread:
        assert map_threads(lambda _: library.get_num_threads(), range(4), 2) == [1] * 4
    assert library.get_num_threads() == 8


LENS = p2sf.load_lens("double_gauss_28")
SPACE = Space(np.linspace(20_000, 60_000, 10), np.linspace(0, 0.2, 10), np.linspace(0.45, 0.65, 4))


def stack():
    return render_source(build_database(LENS, SPACE), SPACE.axes, Sampling(32, 1.0))


def huygens_sum():
    return p2sf.render(LENS, p2sf.Source(field_deg=10), "huygens", pixels=16).values


@lru_cache(maxsize=1)
def planned():
    scene = p2sf.Scene(p2sf.Sensor(rows=24, columns=36, pixel_um=60.0), rtol=0.2, f_number=8)
    return replace(p2sf.plan(LENS, scene), counts=(5, 6))  # more kernels than the scene needs: something to share


def picture(method):
    values = np.random.default_rng(1).random((24, 36, 3))
    return p2sf.form_image(planned(), values, method=method)


@pytest.mark.slow
@pytest.mark.parametrize("work", [stack, huygens_sum, partial(picture, "patches"), partial(picture, "lowrank")])
def test_results_are_the_same_to_the_last_bit_and_are_shared(work, monkeypatch):
    shared = []
    by_pool = threads._by_pool
    monkeypatch.setattr(threads, "_by_pool", lambda *arguments: shared.append(1) or by_pool(*arguments))
    with using_threads(1):
        alone = work()
    assert not shared
    for count in (2, 3):
        with using_threads(count):
            assert work().tobytes() == alone.tobytes()
    assert len(shared) >= 2
