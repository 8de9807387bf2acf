# SPDX-License-Identifier: BSD-3-Clause
"""Runs a command of biocd or robocd in units on many processes or machines.

A question is a command line: `biocd check` or `biocd sample`, or `robocd check`, with --npy, --csv or --json. Its
conformations are divided into units of equal length. Each finished unit is a file in a folder, so any process may be
killed at any time: run the same question again and it goes on. `biocd merge FOLDER` (`robocd merge FOLDER`) prints the
output of the whole run, with the same bytes as one process would print.

    question = Question("biocd", "sample", "1ubq.pdb", "--free", "A:70-76", "-n", "1000000", "--npy")
    with concurrent.futures.ProcessPoolExecutor(4) as executor:
        run(question, executor, "parts")

Executors: anything with submit() of concurrent.futures, a dask.distributed.Client or its get_executor(), and
mpi4py.futures.MPIPoolExecutor. Start processes by "spawn" or "forkserver". The workers need this package and the
tools, which are looked for in the folder of the environment variable HINGE_TOOLS_DIR, otherwise in PATH. Each worker
loads the question once and computes one unit after another. Workers may have different instruction sets.

From a shell: python3 -m hinge.distributed --help
"""

import argparse
import collections
import contextlib
import dataclasses
import hashlib
import json
import os
import pathlib
import queue
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time
import uuid

from . import Error, LoadError, ModelError, __version__

__all__ = ["Question", "Summary", "UnitError", "run"]


_DIGEST_LINE = 65  # bytes at the end of a unit's file: a digest and the end of the line


class UnitError(Error):
    """A unit could not be computed, on any worker that tried. Finished units are kept."""


@dataclasses.dataclass(frozen=True)
class Question:
    """A command line whose conformations are divided into units.

    tool: "biocd" or "robocd". words: the command and its options, without --parts, --unit, --slice and --threads.
    unit: conformations of a unit; choose it so that a unit takes some seconds. Raises ModelError for another tool, a
    unit below 1, or an option that run() sets.
    """

    tool: str
    words: tuple
    unit: int

    def __init__(self, tool, *words, unit=10000):
        if tool not in ("biocd", "robocd"):
            raise ModelError(f"tool {tool!r}: expected 'biocd' or 'robocd'")
        words = tuple(str(word) for word in words)
        for word in words:
            if word.split("=")[0] in ("--parts", "--unit", "--slice", "--threads", "--serve"):
                raise ModelError(f"{word}: is set by run(), expected a question without it")
        if unit < 1:
            raise ModelError(f"unit {unit}: expected at least 1")
        object.__setattr__(self, "tool", tool)
        object.__setattr__(self, "words", words)
        object.__setattr__(self, "unit", int(unit))

    def _command(self, folder, threads):
        return [_program(self.tool), *self.words, "--parts", str(folder), "--unit", str(self.unit), "--threads",
                str(threads), "--serve"]


@dataclasses.dataclass
class Summary:
    """What run() did.

    units: of the question; computed: in this call; there: complete before. conformations: computed. retries: units
    that were tried again. workers: processes that computed a unit. seconds: of the whole call. notes: what the tool
    says about the input. log: the file with the details, JSON. Raises nothing.
    """

    units: int = 0
    computed: int = 0
    there: int = 0
    conformations: int = 0
    retries: int = 0
    workers: int = 0
    seconds: float = 0.0
    notes: tuple = ()
    log: str = ""

    def __str__(self):
        rate = self.conformations / self.seconds if self.seconds > 0 else 0.0
        text = f"{self.computed} of {self.units} units computed"
        if self.there:
            text += f", {self.there} were there"
        text += f", by {self.workers} workers in {self.seconds:.1f} s"
        if self.conformations:
            text += f"; {self.conformations} conformations, {rate:.0f} per second"
        if self.retries:
            text += f"; {self.retries} retries"
        return text


def _program(tool):
    folder = os.environ.get("HINGE_TOOLS_DIR")
    path = shutil.which(tool, path=folder) if folder else shutil.which(tool)
    if path is None:
        raise LoadError(f"{tool}: not found in {folder or 'PATH'} on {socket.gethostname()}, expected the program "
                        "(HINGE_TOOLS_DIR names its folder)")
    return path


class _Server:
    """A process of the tool that has the question loaded and computes units on demand."""

    def __init__(self, question, folder, threads, cwd=None):
        self.errors = tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace")
        self.process = subprocess.Popen(question._command(folder, threads), stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=self.errors, text=True, cwd=cwd)
        word, units, self.digest, self.instruction_set = self._answer().split()
        assert word == "ready", word
        self.units = int(units)

    def _answer(self):
        line = self.process.stdout.readline()
        if line.endswith("\n"):
            return line
        status = self.process.wait()
        lines = [line for line in self.messages() if not line.startswith("note: ")]
        reason = lines[-1] if lines else f"{self.process.args[0]}: ended with status {status}"
        raise ModelError(reason) if status == 2 else LoadError(reason)

    def messages(self):
        """Returns the lines that the process has written on standard error."""
        self.errors.seek(0)
        return self.errors.read().splitlines()

    def compute(self, unit):
        """Returns ("done" or "there", seconds)."""
        try:
            self.process.stdin.write(f"{unit}\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            pass  # the reason is among its errors
        word, number, seconds = self._answer().split()
        assert int(number) == unit, number
        return word, float(seconds)

    def close(self):
        self.process.stdin.close()
        self.process.stdout.close()
        self.process.wait()
        self.errors.close()


class _Idle:
    """The servers of this process that wait for work. A worker may compute several units at once, in threads."""

    def __init__(self):
        self.lock = threading.Lock()
        self.servers = collections.defaultdict(list)
        self.folders = {}  # of questions without a shared folder: a temporary folder
        self.pid = os.getpid()

    def take(self, key):
        with self.lock:
            if self.pid != os.getpid():  # after a fork the servers belong to the parent
                self.servers.clear()
                self.folders.clear()
                self.pid = os.getpid()
            return self.servers[key].pop() if self.servers[key] else None

    def give(self, key, server):
        with self.lock:
            self.servers[key].append(server)


_idle = _Idle()


class _NeedsInputs(Exception):
    """The worker does not have the input files yet."""


def _local_folder(question, inputs, digest):
    """Returns a temporary folder with the input files, which exists as long as this process."""
    key = (question, digest)
    with _idle.lock:
        if key not in _idle.folders:
            if inputs is None:
                raise _NeedsInputs
            folder = tempfile.TemporaryDirectory(prefix="hinge-")
            for name, content in inputs.items():
                path = pathlib.Path(folder.name, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(content)
            _idle.folders[key] = folder
        return _idle.folders[key].name


def _compute(question, unit, folder, threads, digest, cwd, inputs):
    """Computes a unit; runs on a worker. folder: None if it is not shared: then the result has the file's bytes."""
    shared = folder is not None
    if not shared:
        cwd = _local_folder(question, inputs, digest)
        folder = os.path.join(cwd, "parts")
    key = (question, folder, threads)
    server = _idle.take(key) or _Server(question, folder, threads, cwd)
    if server.digest != digest:
        server.close()
        raise LoadError(f"{socket.gethostname()}: the inputs or the version of {question.tool} differ from the client's")
    word, seconds = server.compute(unit)
    _idle.give(key, server)
    path = pathlib.Path(folder, _file_name(unit))
    with open(path, "rb") as file:
        first, last = file.readline().decode().split("conformations ")[1].split(",")[0].split(" to ")
    content = None
    if not shared:
        content = path.read_bytes()
        path.unlink()
    return {"unit": unit, "outcome": word, "seconds": seconds, "host": socket.gethostname(), "pid": os.getpid(),
            "instruction_set": server.instruction_set, "conformations": int(last) - int(first) + 1, "content": content}


def _file_name(unit):
    return f"unit-{unit:09d}.part"


def _is_whole(path):
    """Returns whether the file of a unit is there and its digest is right."""
    digest, tail = hashlib.sha256(), b""
    try:
        with open(path, "rb") as file:
            while block := file.read(1 << 20):
                tail += block
                digest.update(tail[:-_DIGEST_LINE])
                tail = tail[-_DIGEST_LINE:]
    except OSError:
        return False
    return tail == digest.hexdigest().encode() + b"\n"


def _write(path, content):
    """Writes a file completely or not at all."""
    with tempfile.NamedTemporaryFile(dir=path.parent, prefix=path.name + ".", suffix=".partial", delete=False) as file:
        try:
            file.write(content)
            file.close()
            os.chmod(file.name, 0o644)
            os.replace(file.name, path)
        except BaseException:
            os.unlink(file.name)
            raise


def _submitter(executor):
    """Returns submit(name, function, *arguments) -> future, and the number of workers that is known, or None."""
    client = executor if hasattr(executor, "scheduler_info") else getattr(executor, "_client", None)
    if client is not None:  # of Dask, or the client of its executor
        return lambda name, *call: executor.submit(*call, key=name, pure=False), sum(client.nthreads().values()) or None
    return lambda name, *call: executor.submit(*call), getattr(executor, "_max_workers", None)


def _read_inputs(names):
    """Returns the content of files, and of all files in folders, by their relative names."""
    inputs = {}
    for name in names:
        path = pathlib.Path(name)
        if path.is_absolute() or ".." in path.parts:
            raise ModelError(f"{name}: expected a path inside the working directory, because it is made on each worker")
        if not path.exists():
            raise LoadError(f"{name}: does not exist")
        for file in sorted(path.rglob("*")) if path.is_dir() else [path]:
            if file.is_file():
                inputs[str(file)] = file.read_bytes()
    return inputs


class _Run:
    """The state of one call of run()."""

    def __init__(self, question, executor, folder, threads, ship, retries, in_flight, progress):
        self.question, self.threads, self.retries, self.progress = question, threads, retries, progress
        self.folder = pathlib.Path(folder).absolute()
        server = _Server(question, self.folder, 1)
        self.units, self.digest = server.units, server.digest
        self.notes = [line.removeprefix("note: ") for line in server.messages()]
        server.close()
        self.shared = ship is None
        self.inputs = None if self.shared else _read_inputs(ship)
        self.submit, workers = _submitter(executor)
        self.in_flight = in_flight or 2 * (workers or os.cpu_count() or 1)
        self.finished = queue.SimpleQueue()
        self.flying = {}  # future -> (unit, attempt)
        self.workers, self.instruction_sets = set(), {}
        self.summary = Summary(units=self.units, notes=tuple(self.notes))
        self.id = uuid.uuid4().hex[:8]  # of this run: Dask takes tasks of one name for the same
        self.started = time.time()
        self.clock = time.monotonic()

    def start(self, unit, attempt, with_inputs=False):
        name = f"{self.question.tool}-{self.id}-unit-{unit:09d}-{attempt}{'-inputs' if with_inputs else ''}"
        try:
            future = self.submit(name, _compute, self.question, unit, str(self.folder) if self.shared else None,
                                 self.threads, self.digest, os.getcwd() if self.shared else None,
                                 self.inputs if with_inputs else None)
        except Exception as error:  # such as a scheduler that is gone, or a broken pool
            raise UnitError(f"the executor ended ({error}); {self._kept()}") from error
        self.flying[future] = (unit, attempt)
        future.add_done_callback(self.finished.put)

    def take(self, future):
        """Handles a future that is done."""
        unit, attempt = self.flying.pop(future)
        try:
            result = future.result()
        except _NeedsInputs:
            self.start(unit, attempt, with_inputs=True)
            return
        except Exception as error:
            if type(error).__name__ in ("CancelledError", "BrokenProcessPool", "BrokenExecutor"):
                raise UnitError(f"the executor ended ({type(error).__name__}); {self._kept()}") from error
            if isinstance(error, ModelError):  # it fails everywhere
                raise
            self.record({"unit": unit, "attempt": attempt, "error": str(error)})
            if attempt >= self.retries:
                raise UnitError(f"unit {unit}, after {attempt + 1} attempts: {error}; {self._kept()}") from error
            self.summary.retries += 1
            self.start(unit, attempt + 1)
            return
        content = result.pop("content")
        if content is not None:
            _write(self.folder / _file_name(unit), content)
        self.record({**result, "attempt": attempt})
        self.summary.computed += 1
        self.summary.conformations += result["conformations"]
        if self.progress:
            self.progress(self.summary.there + self.summary.computed, self.units)

    def run(self):
        for unit in range(self.units):
            if _is_whole(self.folder / _file_name(unit)):
                self.summary.there += 1
                continue
            while len(self.flying) >= self.in_flight:
                self.take(self.finished.get())
            self.start(unit, 0)
        while self.flying:
            self.take(self.finished.get())

    def _kept(self):
        return f"{self.summary.there + self.summary.computed} of {self.units} units are complete, run again to go on"

    def record(self, row):
        """Writes a row of the log, so that memory does not grow with the number of units."""
        self.log.write(("" if self.log_is_empty else ",\n") + json.dumps(row))
        self.log_is_empty = False
        if "host" in row:
            self.workers.add((row["host"], row["pid"]))
            self.instruction_sets[row["host"]] = row["instruction_set"]

    def open_log(self):
        head = {"hinge": __version__, "question": self.digest, "tool": self.question.tool,
                "words": list(self.question.words), "unit": self.question.unit,
                "started": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(self.started)),
                "client": socket.gethostname(), "run": self.id, "notes": self.notes}
        started = time.strftime("%Y%m%dT%H%M%SZ", time.gmtime(self.started))
        self.log_path = self.folder / f"log-{started}-{socket.gethostname()}-{os.getpid()}.json"
        self.log = open(f"{self.log_path}.partial", "w", encoding="utf-8")
        self.log_is_empty = True
        self.log.write(json.dumps(head)[:-1] + ', "units": [\n')

    def close_log(self, error):
        self.summary.seconds = time.monotonic() - self.clock
        self.summary.workers = len(self.workers)
        self.summary.log = str(self.log_path)
        summary = {k: v for k, v in dataclasses.asdict(self.summary).items() if k not in ("log", "notes")}
        end = {"instruction_sets": self.instruction_sets, "summary": summary, "error": error}
        self.log.write("],\n" + json.dumps(end)[1:] + "\n")
        self.log.close()
        os.replace(self.log.name, self.log_path)


def run(question, executor, folder, *, threads=1, ship=None, retries=3, in_flight=None, progress=None):
    """Computes the units of a question that are not in the folder yet, and returns a Summary.

    question: a Question. executor: see the module. folder: of the finished units; it is made if it is absent.
    threads: of each worker. ship: None if all workers see the folder and the input files under the same names;
    otherwise a list of input files and folders, relative to the working directory: each worker gets them once, and
    sends the finished units back. retries: how often a unit is tried again. in_flight: the largest number of units
    that are submitted at a time (default: two for each worker). progress: called with (units done, units).

    Raises LoadError or ModelError if the question itself cannot be answered, and UnitError if a unit fails on every
    attempt or the executor ends. Finished units are kept: the next call goes on. A log of the call is written to the
    folder: versions, instruction sets, and place and time of each unit.
    """
    call = _Run(question, executor, folder, threads, ship, retries, in_flight, progress)
    error = None
    call.open_log()
    try:
        call.run()
    except BaseException as problem:
        error = f"{type(problem).__name__}: {problem}"
        with contextlib.suppress(Exception):  # the executor may be gone
            for future in list(call.flying):
                future.cancel()
        raise
    finally:
        call.close_log(error)
    return call.summary


def _end_with_parent():
    """Ends this process when its parent has ended. A pool whose client was killed would wait for work for ever."""
    import multiprocessing

    def wait():
        multiprocessing.parent_process().join()
        os._exit(1)

    threading.Thread(target=wait, daemon=True).start()


def _executor_of(arguments):
    """Returns the executor that the command line asks for."""
    if arguments.scheduler:
        import distributed

        return distributed.Client(arguments.scheduler, timeout=arguments.timeout)
    if arguments.mpi:
        from mpi4py.futures import MPIPoolExecutor

        return MPIPoolExecutor()
    import concurrent.futures
    import multiprocessing

    return concurrent.futures.ProcessPoolExecutor(arguments.local, mp_context=multiprocessing.get_context("spawn"),
                                                  initializer=_end_with_parent)


def _parser():
    parser = argparse.ArgumentParser(
        prog="python3 -m hinge.distributed",
        description="Computes a question in units on many processes or machines. Ends with status 0 if all units are "
        "complete, 2 for a wrong command line, and 3 otherwise; finished units are kept.",
        epilog="example: python3 -m hinge.distributed --local 4 --parts parts -- biocd sample 1ubq.pdb --free A:70-76 "
        "-n 1000000 --npy; biocd merge parts --out verdicts.npy")
    where = parser.add_mutually_exclusive_group(required=True)
    where.add_argument("--scheduler", metavar="ADDRESS", help="of a Dask cluster, such as tcp://host:8786")
    where.add_argument("--mpi", action="store_true",
                       help="the ranks of MPI; start with mpirun -n RANKS python3 -m mpi4py.futures -m hinge.distributed")
    where.add_argument("--local", type=int, metavar="N", help="N processes of this machine")
    parser.add_argument("--parts", required=True, metavar="FOLDER", help="of the finished units")
    parser.add_argument("--unit", type=int, default=10000, metavar="N", help="conformations of a unit (default: 10000)")
    parser.add_argument("--threads", type=int, default=1, metavar="N", help="threads of each worker (default: 1)")
    parser.add_argument("--ship", nargs="*", metavar="PATH",
                        help="the workers do not see the folder: send them these files and folders")
    parser.add_argument("--retries", type=int, default=3, metavar="N", help="of a unit (default: 3)")
    parser.add_argument("--timeout", type=float, default=30.0, metavar="SECONDS",
                        help="to reach the scheduler (default: 30)")
    parser.add_argument("question", nargs="+", metavar="WORD", help="biocd or robocd, the command and its options")
    return parser


def _main(words):
    arguments = _parser().parse_args(words)
    start = time.monotonic()

    def progress(done, units):
        if sys.stderr.isatty():
            rate = done / (time.monotonic() - start)
            print(f"\r{done} of {units} units, {rate:.1f} per second", end="\n" if done == units else "",
                  file=sys.stderr, flush=True)

    try:
        question = Question(arguments.question[0], *arguments.question[1:], unit=arguments.unit)
        executor = _executor_of(arguments)
        try:
            summary = run(question, executor, arguments.parts, threads=arguments.threads, ship=arguments.ship,
                          retries=arguments.retries, progress=progress)
        finally:
            with contextlib.suppress(Exception):  # a scheduler that is gone is reported by run()
                executor.__exit__(None, None, None)
    except ModelError as error:
        print(f"hinge.distributed: {error}", file=sys.stderr)
        return 2
    except (Error, ImportError, OSError) as error:
        print(f"hinge.distributed: {error}", file=sys.stderr)
        return 3
    for note in summary.notes:
        print(f"note: {note}", file=sys.stderr)
    print(f"{summary}; {arguments.question[0]} merge {arguments.parts} prints the output")
    return 0


if __name__ == "__main__":
    # Workers must be able to import what they run, so it must not belong to the module __main__.
    from hinge import distributed as _self

    sys.exit(_self._main(sys.argv[1:]))
