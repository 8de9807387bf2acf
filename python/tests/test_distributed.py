# SPDX-License-Identifier: BSD-3-Clause
"""Runs in units on executors: the bytes of one process, whatever is killed."""

import concurrent.futures
import contextlib
import io
import json
import multiprocessing
import os
import pathlib
import random
import shutil
import signal
import socket
import subprocess
import sys
import time

import numpy as np
import pytest

import hinge
from hinge import distributed

ROOT = pathlib.Path(__file__).resolve().parents[2]
UBIQUITIN = ROOT / "molecular/data/1ubq.pdb"
ARM = ROOT / "robotics/data/arm.urdf"
SAMPLE = ("sample", "1ubq.pdb", "--free", "A:70-76", "--exempt-reference", "--sigma", "5", "--mode", "any")


@pytest.fixture(name="place", autouse=True)
def _place(tmp_path, monkeypatch, tool):
    """A working directory with the input files; the tools are there, or the test is skipped."""
    monkeypatch.setenv("HINGE_TOOLS_DIR", str(pathlib.Path(tool("biocd")).parent))
    monkeypatch.chdir(tmp_path)
    shutil.copy(UBIQUITIN, "1ubq.pdb")
    shutil.copy(ARM, "arm.urdf")
    return tmp_path


def pool(workers=2):
    return concurrent.futures.ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn"))


def output(name, *words):
    """The standard output of a tool."""
    program = pathlib.Path(os.environ["HINGE_TOOLS_DIR"]) / name
    return subprocess.run([program, *words], capture_output=True, check=False).stdout


def merged(folder, name="biocd"):
    return output(name, "merge", str(folder))


def test_numpy_reads_the_verdicts():
    words = (*SAMPLE, "-n", "500")
    verdicts = np.load(io.BytesIO(output("biocd", *words, "--npy")))
    assert verdicts.dtype == np.uint8 and verdicts.shape == (500,)
    rows = output("biocd", *words, "--csv").decode().splitlines()[1:]
    assert verdicts.tolist() == [int(row.split(",")[1]) for row in rows]
    assert 0 < verdicts.sum() < 500


@pytest.mark.parametrize("form", ["--json", "--csv", "--npy"])
def test_units_have_the_bytes_of_one_process(form):
    words = (*SAMPLE, "-n", "1000", form)
    whole = output("biocd", *words)
    assert whole
    with pool() as executor:
        summary = distributed.run(distributed.Question("biocd", *words, unit=70), executor, "parts", threads=2)
    assert (summary.units, summary.computed, summary.there, summary.conformations) == (15, 15, 0, 1000)
    assert merged("parts") == whole
    words = ("check", "arm.urdf", "--random", "500", form)
    with concurrent.futures.ThreadPoolExecutor(3) as executor:
        distributed.run(distributed.Question("robocd", *words, unit=100), executor, "robot")
    assert merged("robot", "robocd") == output("robocd", *words)


def test_workers_that_do_not_see_the_folder_get_the_inputs():
    words = (*SAMPLE, "-n", "400", "--csv")
    question = distributed.Question("biocd", *words, unit=50)
    with pool() as executor:
        summary = distributed.run(question, executor, "parts", ship=["1ubq.pdb"])
        assert summary.computed == 8
        assert merged("parts") == output("biocd", *words)
        with pytest.raises(hinge.ModelError, match="inside the working directory"):
            distributed.run(question, executor, "other", ship=[str(UBIQUITIN)])
        with pytest.raises(hinge.LoadError, match="nothing: does not exist"):
            distributed.run(question, executor, "other", ship=["nothing"])


def test_a_second_call_computes_only_what_is_missing():
    words = (*SAMPLE, "-n", "600", "--csv")
    question = distributed.Question("biocd", *words, unit=100)
    seen = []
    with concurrent.futures.ThreadPoolExecutor(2) as executor:
        distributed.run(question, executor, "parts", progress=lambda done, units: seen.append((done, units)))
        assert seen == [(k, 6) for k in range(1, 7)]
        pathlib.Path("parts/unit-000000002.part").unlink()
        part = pathlib.Path("parts/unit-000000004.part")
        part.write_bytes(part.read_bytes()[:-30])
        summary = distributed.run(question, executor, "parts")
    assert (summary.computed, summary.there) == (2, 4)
    assert merged("parts") == output("biocd", *words)
    log = json.loads(pathlib.Path(summary.log).read_text())
    assert sorted(row["unit"] for row in log["units"]) == [2, 4]
    assert log["summary"]["there"] == 4 and log["error"] is None and log["hinge"] == hinge.__version__
    assert list(log["instruction_sets"].values())[0] in ("baseline", "avx2", "avx512")


class Unreliable(concurrent.futures.ThreadPoolExecutor):
    """Fails at the first `failures` calls."""

    def __init__(self, failures):
        super().__init__(1)
        self.failures = failures

    def submit(self, function, *arguments):
        self.failures -= 1
        return super().submit(self.fail if self.failures >= 0 else function, *arguments)

    @staticmethod
    def fail(*_):
        raise OSError("no space left on device")


def test_units_are_tried_again():
    question = distributed.Question("biocd", *SAMPLE, "-n", "300", "--npy", unit=100)
    with Unreliable(2) as executor:
        assert distributed.run(question, executor, "parts").retries == 2
    assert merged("parts") == output("biocd", *question.words)
    with Unreliable(100) as executor, pytest.raises(distributed.UnitError, match="after 2 attempts: no space left.*0 of"):
        distributed.run(question, executor, "other", retries=1)
    log = json.loads(next(pathlib.Path("other").glob("log-*")).read_text())
    assert log["error"].startswith("UnitError") and log["units"][0]["error"] == "no space left on device"


def test_bad_questions_are_refused_before_any_work():
    for tool, words in (("hinge", ()), ("biocd", ("sample", "--parts", "x")), ("biocd", ("sample", "--threads=2"))):
        with pytest.raises(hinge.ModelError):
            distributed.Question(tool, *words)
    with pytest.raises(hinge.ModelError):
        distributed.Question("biocd", "sample", unit=0)
    with concurrent.futures.ThreadPoolExecutor(1) as executor:
        with pytest.raises(hinge.LoadError, match="nothing.pdb: cannot be opened"):
            distributed.run(distributed.Question("biocd", "sample", "nothing.pdb", "--npy"), executor, "parts")
        with pytest.raises(hinge.ModelError, match="expected --json, --csv or --npy"):
            distributed.run(distributed.Question("biocd", "sample", "1ubq.pdb"), executor, "parts")
        distributed.run(distributed.Question("biocd", *SAMPLE, "-n", "10", "--npy"), executor, "parts")
        with pytest.raises(hinge.LoadError, match="another question: it has .*10.*, expected .*20"):
            distributed.run(distributed.Question("biocd", *SAMPLE, "-n", "20", "--npy"), executor, "parts")


def test_a_worker_with_other_inputs_or_another_version_is_refused(tmp_path, monkeypatch):
    question = distributed.Question("biocd", *SAMPLE, "-n", "10", "--npy")
    other = tmp_path / "tools"
    other.mkdir()
    (other / "biocd").write_text("#!/bin/sh\necho ready 1 0123 baseline\nread unit\n")
    (other / "biocd").chmod(0o755)

    class OtherTools(concurrent.futures.ThreadPoolExecutor):
        def submit(self, function, *arguments):
            monkeypatch.setenv("HINGE_TOOLS_DIR", str(other))  # the client has its answer already
            return super().submit(function, *arguments)

    with OtherTools(1) as executor, pytest.raises(distributed.UnitError, match="inputs or the version of biocd differ"):
        distributed.run(question, executor, "parts", retries=0)


def test_a_killed_worker_ends_the_pool_and_the_next_call_goes_on():
    words = (*SAMPLE, "-n", "60000", "--npy")
    question = distributed.Question("biocd", *words, unit=500)
    with pool() as executor:
        killed = []

        def kill(done, _):
            if done == 20 and not killed:
                killed.append(next(iter(executor._processes)))
                os.kill(killed[0], signal.SIGKILL)

        with pytest.raises(distributed.UnitError, match="executor ended .*run again to go on"):
            distributed.run(question, executor, "parts", progress=kill)
    with pool() as executor:
        summary = distributed.run(question, executor, "parts")
    assert summary.there >= 20 and summary.there + summary.computed == 120
    assert merged("parts") == output("biocd", *words)


def command(*where, unit=2000, n=100000):
    return [sys.executable, "-B", "-m", "hinge.distributed", *where, "--parts", "parts", "--unit", str(unit), "--",
            "biocd", *SAMPLE, "-n", str(n), "--npy"]


def environment():
    package = str(pathlib.Path(hinge.__file__).parents[1])
    return {**os.environ, "PYTHONPATH": package, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def call(words, **more):
    return subprocess.run(words, env=environment(), capture_output=True, text=True, timeout=120, check=False, **more)


def processes_in(folder):
    """The processes whose working directory is the folder."""
    found = []
    for link in pathlib.Path("/proc").glob("[0-9]*/cwd"):
        with contextlib.suppress(OSError):  # ended meanwhile
            if link.readlink() == folder:
                found.append(int(link.parent.name))
    return [number for number in found if number != os.getpid()]


def test_the_command_survives_kills_of_the_client(place):
    seed = random.Random(25)
    for _ in range(3):
        client = subprocess.Popen(command("--local", "2"), env=environment(), stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL)
        time.sleep(seed.uniform(0.2, 0.8))
        client.kill()
        client.wait()
    end = time.monotonic() + 20.0
    while processes_in(place) and time.monotonic() < end:
        time.sleep(0.1)
    assert not processes_in(place)  # no worker and no tool waits for ever
    done = call(command("--local", "2"))
    assert done.returncode == 0, done.stderr
    assert "of 50 units computed" in done.stdout and "biocd merge parts prints the output" in done.stdout
    assert merged("parts") == output("biocd", *SAMPLE, "-n", "100000", "--npy")


def test_the_command_says_what_is_wrong():
    assert call([*command("--local", "1"), "--json"]).returncode == 2  # two formats
    missing = call([sys.executable, "-B", "-m", "hinge.distributed", "--local", "1", "--parts", "p", "--", "biocd",
                    "sample", "nothing.pdb", "--npy"])
    assert missing.returncode == 3
    assert missing.stderr == "hinge.distributed: biocd: nothing.pdb: cannot be opened: No such file or directory\n"
    assert call([sys.executable, "-B", "-m", "hinge.distributed", "--local", "1"]).returncode == 2


def test_the_client_needs_little_memory():
    code = ("import resource, sys; from hinge import distributed; distributed._main(sys.argv[1:]); "
            "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)")
    words = command("--local", "2", unit=20, n=60000)
    done = call([sys.executable, "-B", "-c", code, *words[4:]])
    assert done.returncode == 0, done.stderr
    assert int(done.stdout.split()[-1]) < 300_000  # kB, 3000 units


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class DaskCluster:
    """A scheduler and workers on loopback, in processes of their own. Workers may have different instruction sets."""

    def __init__(self, folder):
        pytest.importorskip("distributed")
        self.folder, self.port = folder, free_port()
        self.address = f"tcp://127.0.0.1:{self.port}"
        self.processes = []

    def start(self, module, *words, **variables):
        log = open(self.folder / f"{module.split('.')[-1]}-{len(self.processes)}.log", "w")
        process = subprocess.Popen([sys.executable, "-B", "-m", module, *words], env={**environment(), **variables},
                                   stdout=log, stderr=log, start_new_session=True)
        self.processes.append(process)
        return process

    def scheduler(self):
        return self.start("distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", str(self.port),
                          "--no-dashboard")

    def worker(self, **variables):
        return self.start("distributed.cli.dask_worker", self.address, "--nthreads", "1", "--no-dashboard",
                          "--no-nanny", "--death-timeout", "30", "--local-directory", str(self.folder), **variables)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in self.processes:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()


@pytest.fixture(name="cluster")
def _cluster(tmp_path):
    with DaskCluster(tmp_path) as cluster:
        cluster.scheduler()
        sets = ["baseline", hinge.instruction_set, "baseline", hinge.instruction_set]
        cluster.workers = [cluster.worker(HINGE_ISA=name) for name in sets]
        yield cluster


def test_dask_gives_the_same_bytes(cluster):
    import distributed as dask

    words = (*SAMPLE, "-n", "40000", "--csv")
    question = distributed.Question("biocd", *words, unit=1000)
    with dask.Client(cluster.address, timeout=30) as client:
        client.wait_for_workers(4, timeout=60)
        summary = distributed.run(question, client, "parts")
        assert summary.computed == 40 and summary.workers == 4
        shipped = distributed.run(question, client, "shipped", ship=["1ubq.pdb"])
        assert shipped.computed == 40
        through = distributed.run(question, client.get_executor(), "through")
        assert through.computed == 40
    whole = output("biocd", *words)
    for folder in ("parts", "shipped", "through"):
        assert merged(folder) == whole


def test_dask_goes_on_without_killed_workers(cluster):
    import distributed as dask

    words = (*SAMPLE, "-n", "150000", "--npy")
    question = distributed.Question("biocd", *words, unit=1000)

    def kill(done, _):
        if done in (20, 60, 100):
            cluster.workers.pop().kill()

    with dask.Client(cluster.address, timeout=30) as client:
        client.wait_for_workers(4, timeout=60)
        summary = distributed.run(question, client, "parts", progress=kill)
    assert summary.there + summary.computed == 150
    assert merged("parts") == output("biocd", *words)


def test_dask_survives_a_killed_scheduler(tmp_path):
    with DaskCluster(tmp_path) as cluster:
        first = cluster.scheduler()
        for _ in range(2):
            cluster.worker()
        client = subprocess.Popen(command("--timeout", "5", "--scheduler", cluster.address, unit=1000, n=100000),
                                  env=environment(), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while len(list(pathlib.Path("parts").glob("unit-*.part"))) < 20:
            assert client.poll() is None, client.communicate()
            time.sleep(0.01)
        os.killpg(first.pid, signal.SIGKILL)
        first.wait()
        _, error = client.communicate(timeout=120)
        assert client.returncode == 3, error
        assert "run again to go on" in error
        cluster.scheduler()
        for _ in range(2):
            cluster.worker()
        done = call(command("--scheduler", cluster.address, unit=1000, n=100000))
        assert done.returncode == 0, done.stderr
        assert "were there" in done.stdout
    assert merged("parts") == output("biocd", *SAMPLE, "-n", "100000", "--npy")


def test_an_unreachable_scheduler_is_said(tmp_path):
    pytest.importorskip("distributed")
    done = call(command("--timeout", "1", "--scheduler", f"tcp://127.0.0.1:{free_port()}"))
    assert done.returncode == 3
    assert "hinge.distributed: " in done.stderr and "Timed out" in done.stderr


def mpirun():
    pytest.importorskip("mpi4py")
    program = shutil.which("mpirun")
    if program is None:
        pytest.skip("mpirun is not here")
    return program


def test_mpi_gives_the_same_bytes():
    words = command("--mpi", unit=1000, n=40000)
    words[2:4] = ["-m", "mpi4py.futures", *words[2:4]]
    done = call([mpirun(), "--oversubscribe", "-n", "4", *words])
    assert done.returncode == 0, done.stderr
    assert "40 of 40 units computed, by 3 workers" in done.stdout
    assert merged("parts") == output("biocd", *SAMPLE, "-n", "40000", "--npy")


def test_mpi_ranks_may_run_the_tool_itself():
    words = ["sample", "1ubq.pdb", "--free", "A:70-76", "-n", "3000", "--csv", "--mode", "any"]
    program = str(pathlib.Path(os.environ["HINGE_TOOLS_DIR"]) / "biocd")
    shell = f"{program} {' '.join(words)} --parts ranks --unit 100 --slice $((OMPI_COMM_WORLD_RANK+1))/$OMPI_COMM_WORLD_SIZE"
    done = call([mpirun(), "--oversubscribe", "-n", "3", "sh", "-c", shell])
    assert done.returncode == 0, done.stderr  # although collisions are found
    assert merged("ranks") == output("biocd", *words)


@pytest.mark.long
def test_a_soak_of_random_kills():
    """Kills the client, workers and the scheduler at random times, HINGE_SOAK_SECONDS (60) long."""
    pytest.importorskip("distributed")
    seed = random.Random(2026)
    end = time.monotonic() + float(os.environ.get("HINGE_SOAK_SECONDS", "60"))
    kills, runs = 0, 0
    while time.monotonic() < end:
        shutil.rmtree("parts", ignore_errors=True)
        n = 4_000_000
        runs += 1
        with DaskCluster(pathlib.Path.cwd()) as cluster:
            scheduler, workers = cluster.scheduler(), [cluster.worker() for _ in range(3)]
            client = None
            while True:
                if client is None:
                    client = subprocess.Popen(command("--scheduler", cluster.address, unit=10000, n=n),
                                              env=environment(), stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
                try:
                    client.wait(timeout=seed.uniform(1, 6))
                    said = client.communicate()[0].decode()
                    if client.returncode == 0:
                        break
                    assert client.returncode in (3, -signal.SIGKILL), said
                    client = None
                except subprocess.TimeoutExpired:
                    kills += 1
                    victim = seed.choice(["client", "worker", "worker", "scheduler"])
                    if victim == "client":
                        client.kill()
                    elif victim == "worker":
                        workers.pop(seed.randrange(len(workers))).kill()
                        workers.append(cluster.worker())
                    else:
                        scheduler.kill()
                        scheduler.wait()
                        for worker in workers:
                            worker.kill()
                        scheduler, workers = cluster.scheduler(), [cluster.worker() for _ in range(3)]
        assert merged("parts") == output("biocd", *SAMPLE, "-n", str(n), "--npy"), (kills, runs)
    print(f"{kills} kills in {runs} runs")
    assert kills > 0
