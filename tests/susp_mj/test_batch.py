"""Jobs side by side: order, the same results and the same error whatever the number of workers."""

from __future__ import annotations

import threading
import time

import numpy as np
import pytest

from manoeuvres import Bump, RoadStep
from susp_mj import InputError, simulate
from susp_mj.batch import side_by_side, usable_cores
from vehicles import load_vehicle
from vehicles.mjcf import build


def same(value):
    return value


@pytest.mark.parametrize("workers", [None, 1, 2, 3])
def test_runs_are_those_of_simulate_in_the_order_given(workers):
    jobs = [
        (name, model, manoeuvre)
        for name in ("linear", "nonlinear")
        for model in ("quarter_2dof", "quarter_1dof")
        for manoeuvre in (Bump(duration=0.5), RoadStep(duration=0.4))
    ]

    def prepare(job):
        return build(load_vehicle("chapter3", job[0]), job[1]), job[2]

    runs = side_by_side(jobs, prepare, lambda job, progress: simulate(*job, progress=progress), same, workers=workers)
    for run, job in zip(runs, jobs, strict=True):
        alone = simulate(*prepare(job))
        assert run.meta == alone.meta
        assert list(run.channels) == list(alone.channels)
        assert all(np.array_equal(run[name], alone[name]) for name in alone.channels)


@pytest.mark.parametrize("workers", [1, 2, 3])
def test_results_keep_the_order_of_the_jobs(workers):
    def slow_first(job, progress):
        time.sleep(0.02 * (5 - job))
        return job

    assert side_by_side(range(5), same, slow_first, lambda job: 10 * job, workers=workers) == [0, 10, 20, 30, 40]
    assert side_by_side([], same, slow_first, same, workers=workers) == []


@pytest.mark.parametrize("workers", [1, 2, 3])
def test_the_first_job_that_fails_names_the_error_and_those_before_it_are_finished(workers):
    finished = []

    def work(job, progress):
        time.sleep(0.02 * (4 - job))  # the later ones fail first
        if job >= 1:
            raise ValueError(job)
        return job

    with pytest.raises(ValueError, match=r"^1$"):
        side_by_side(range(4), same, work, finished.append, workers=workers)
    assert finished == [0]


@pytest.mark.parametrize("workers", [1, 2])
def test_what_cannot_be_prepared_ends_work_that_is_under_way(workers):
    started = threading.Event()

    def prepare(job):
        if job == 1:
            assert started.wait(5.0)
            raise InputError("bad")
        return job

    def endless(job, progress):
        started.set()
        while True:
            progress(0.5)

    with pytest.raises(InputError, match="bad"):
        side_by_side(range(2), prepare, endless, same, workers=workers)


@pytest.mark.parametrize("workers", [1, 3])
def test_progress_never_falls_and_ends_at_one(workers):
    seen = []

    def work(job, progress):
        for done in (0.25, 0.5, 1.0):
            progress(done)

    side_by_side(range(4), same, work, same, workers=workers, progress=lambda place, done: seen.append((place, done)))
    fractions = [done for _, done in seen]
    assert fractions == sorted(fractions)
    assert fractions[-1] == 1.0
    assert {place for place, _ in seen} == set(range(4))


def test_at_least_one_worker():
    assert usable_cores() >= 1
    with pytest.raises(InputError, match="workers: 0 is not allowed; it must be at least 1"):
        side_by_side([], same, lambda job, progress: job, same, workers=0)
