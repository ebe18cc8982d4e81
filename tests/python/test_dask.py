"""Sweeps by Dask, with a worker killed meanwhile."""

import threading

import subimpact as si
from conftest import tables


def test_tables_of_dask_with_a_worker_killed_are_the_same(population, tmp_path):
    from dask.distributed import Client, LocalCluster

    si.sweep(population, out=tmp_path / "serial", workers=0)
    slow = si.Plan(population.case, population.axes, population.scatter, samples=20)
    si.sweep(slow, out=tmp_path / "slow", workers=0)
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with Client(cluster) as client:
            si.sweep(population, out=tmp_path / "dask", executor=client)
            assert tables(tmp_path / "dask") == tables(tmp_path / "serial")
            killed = []

            def kill():
                nanny = next(iter(cluster.workers.values()))
                process = nanny.process.process
                killed.append(process.pid)
                process._process.kill()

            timer = threading.Timer(0.3, kill)
            timer.start()
            si.sweep(slow, out=tmp_path / "killed", executor=client)
            timer.join()
            assert killed
            assert tables(tmp_path / "killed") == tables(tmp_path / "slow")
