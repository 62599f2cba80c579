"""The same call on a cluster of processes, with a worker lost in the middle."""

import os
import signal

import numpy as np
import pytest

from ptproof.simulation import ensemble, ensembles

distributed = pytest.importorskip("distributed")


@pytest.fixture
def client():
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


# The cluster's own sockets are closed by a worker that dies, which is what is tested.
@pytest.mark.filterwarnings("default")
def test_nothing_is_lost_with_a_worker(client, monkeypatch):
    monkeypatch.setattr(ensembles, "_TASK", 8)
    size, question = 32, {"seed": 2, "engine": "casadi", "rtol": 1e-5}
    processes = list(client.run(os.getpid).values())
    killed = []

    def progress(done):
        if not killed:
            killed.append(processes[0])
            os.kill(processes[0], signal.SIGKILL)

    result = ensemble("saturated", size, "pt", client=client, progress=progress, **question)
    assert killed
    assert result.counts == {"reached T": size}
    local = ensemble("saturated", size, "pt", **question)
    assert np.array_equal(result.x, local.x)
    assert not set(processes) <= set(client.run(os.getpid).values())
