# SPDX-License-Identifier: MIT
"""What the gate's tests share: the package, folders that go away, and programs that pretend to be goffer_bench."""

import pathlib
import random
import sys
import tempfile
import textwrap
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "bench"))

FAKE = """
    #!/usr/bin/python3 -SE
    import os, re, sys
    times, spread, swing, fault, change_after = {times!r}, {spread!r}, {swing!r}, {fault!r}, {change_after!r}
    options = dict(word.lstrip("-").partition("=")[::2] for word in sys.argv[1:])
    if "benchmark_list_tests" in options:
        print("\\n".join(times))
        sys.exit()
    if fault == "exit":
        sys.exit("it went wrong")
    with open(__file__ + ".runs", "a") as runs:
        runs.write(".")
        run = runs.tell()
    if change_after and run > change_after[0]:
        times = {{case: value * change_after[1] for case, value in times.items()}}
    def result(case, value):
        normal = sum(os.urandom(12)) / 255 - 6  # about
        figure = value * (1 + spread * normal) * (1 + swing if run % 2 else 1 / (1 + swing))
        name = "ns_per_instance" if case.startswith("setup") else "ns_per_vertex"
        fault_words = ', "error_occurred": true, "error_message": "no such body"' if fault == "error" else ""
        return '{{"name": "%s", "%s": %r, "of_floor": 0.2, "real_time": %r%s}}' % (case, name, figure, figure, fault_words)
    wanted = re.compile(options["benchmark_filter"])
    found = [result(case, value) for case, value in times.items() if wanted.search(case)]
    with open(options["benchmark_out"], "w") as file:
        file.write("" if fault == "empty" else '{{"benchmarks": [' + ", ".join(found) + "]}}")
"""

CASES = {"setup/instance": 60.0, "deform/positions/cache/avx2/1": 1.0}


class Case(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def fake(self, name, times=None, *, factor=1.0, spread=0.01, swing=0, fault="", change_after=None):
        """A program in the folder that pretends to take so long: with noise, by turns more and less, from some run on more."""
        path = self.folder / name
        times = {case: value * factor for case, value in (times or CASES).items()}
        path.write_text(textwrap.dedent(FAKE).lstrip().format(times=times, spread=spread, swing=swing,
                                                              fault=fault, change_after=change_after))
        path.chmod(0o755)
        return str(path)


def seeded(seed):
    """Numbers that are the same in every run."""
    return random.Random(seed)
