# SPDX-License-Identifier: MIT
"""Counts, from what callgrind writes to the verdict beside the baseline."""

import json
import unittest

import support
from gating import baseline, counts
from gating.counts import Work
from gating.outcome import Unmeasured, Verdict

DUMP = """version: 1
events: Ir
summary: 1060

ob=/lib/libm.so.6
fl=sincosf.c
fn=sincosf
0x10 100

ob=/b/goffer_count
fl=???
fn=run
0x20 7
0x24 5
cob=/lib/libm.so.6
cfn=sincosf
calls=1 0x10
0x28 100
0x2c 3
fi=inlined.hpp
0x30 2
"""


class Profile(unittest.TestCase):
    def test_only_the_programs_own_work_is_summed(self):
        self.assertEqual(counts.read_profile(DUMP, "/b/goffer_count", {0x24, 0x10}), Work(17, 5))

    def test_roots_and_divisions(self):
        for name in ("vsqrtps", "sqrtss", "vdivpd", "divss", "fsqrt", "sdiv", "idivl", "div", "divq"):
            self.assertRegex(name, counts.SLOW)
        for name in ("vrsqrtps", "vrcpps", "vmulps", "mov"):
            self.assertNotRegex(name, counts.SLOW)

    def test_slopes(self):
        # 500 a frame, 30 a group of 16, 40 an instance, 3 a vertex.
        def frame(instances, vertices):
            return Work(500 + 30 * (instances + 15) // 16 + instances * (40 + 3 * vertices), vertices * instances)
        frames = {size: frame(*size) for size in ((1, 1024), (1, 3072), (16, 64), (48, 64))}
        self.assertEqual(counts.per_vertex(frames), Work(3, 1))
        self.assertAlmostEqual(counts.per_instance(frames).instructions, 40 + 30 / 16)
        self.assertAlmostEqual(counts.per_instance(frames).slow, 0)

    def test_what_is_not_there(self):
        with self.assertRaisesRegex(Unmeasured, "no_such_tool is not here"):
            counts.output_of("no_such_tool")
        with self.assertRaisesRegex(Unmeasured, r"^ls failed \(\d+\): ls: .*/nowhere"):
            counts.output_of("ls", "/nowhere")


class Memory(support.Case):
    def test_what_cannot_be_counted_is_left_out(self):
        program = self.folder / "goffer_count"
        program.write_text("#!/bin/sh\necho allocations/run 0\necho sizes/body 120\necho allocations/load -1\n")
        program.chmod(0o755)
        self.assertEqual(counts.memory_counts(str(program)), {"allocations/run": 0.0, "sizes/body": 120.0})


class Baseline(support.Case):
    def verdict(self, was, now):
        return baseline.compare("x", was, now, set()).verdict

    def test_tolerance(self):
        self.assertIs(self.verdict(100, 102), Verdict.PASS)
        self.assertIs(self.verdict(100, 102.1), Verdict.REGRESSION)
        self.assertIs(self.verdict(100, 98), Verdict.PASS)
        self.assertIs(self.verdict(100, 97.9), Verdict.GAIN)
        self.assertIs(self.verdict(0, 0), Verdict.PASS)
        self.assertIs(self.verdict(0, 0.01), Verdict.REGRESSION)  # no allocation stays none
        self.assertIs(self.verdict(None, 1), Verdict.NOTE)

    def test_what_is_no_longer_counted(self):
        self.assertIs(self.verdict(1, None), Verdict.REGRESSION)
        self.assertIs(baseline.compare("instructions/avx2/x", 1, None, {"scalar"}).verdict, Verdict.NOTE)
        self.assertIs(baseline.compare("instructions/avx2/x", 1, None, {"avx2"}).verdict, Verdict.REGRESSION)

    def test_judgment(self):
        document = {"compiler": "GNU 12.2.0", "counts": {"a": 100, "b": 10}}
        part = baseline.judge(document, "GNU 12.2.0", {"a": 103, "b": 9, "c": 1})
        self.assertEqual({row.name: row.verdict for row in part.rows},
                         {"a": Verdict.REGRESSION, "b": Verdict.GAIN, "c": Verdict.NOTE})
        self.assertEqual(part.exit_code, 1)

    def test_another_compiler_is_reported_not_compared(self):
        part = baseline.judge({"compiler": "GNU 12.2.0", "counts": {"a": 1}}, "Clang 14.0.6", {"a": 2})
        self.assertEqual(part.exit_code, 0)
        self.assertIs(part.rows[0].verdict, Verdict.NOTE)
        self.assertIn("reported, not compared", part.remarks[0])

    def test_update_keeps_bounds_and_order(self):
        path = self.folder / "baseline.json"
        path.write_text(json.dumps({"compiler": "old", "counts": {"z": 1}, "ratios": {"of_floor": {"x": 0.1}}}))
        baseline.write(path, "GNU 12.2.0", {"b": 2, "a": 1.5})
        document = baseline.read(path)
        self.assertEqual(document["ratios"], {"of_floor": {"x": 0.1}})
        self.assertEqual(list(document), ["compiler", "counts", "ratios"])
        self.assertEqual(list(document["counts"]), ["a", "b"])
        before = path.read_text()
        baseline.write(path, "GNU 12.2.0", {"a": 1.5, "b": 2})
        self.assertEqual(path.read_text(), before)

    def test_unreadable(self):
        with self.assertRaises(Unmeasured):
            baseline.read(self.folder / "none.json")

    def test_the_repositorys_own(self):
        document = baseline.read(support.ROOT / "bench/baseline.json")
        self.assertEqual(list(document["counts"]), sorted(document["counts"]))
        self.assertEqual(document["counts"]["allocations/run"], 0)
        self.assertEqual(set(document["ratios"]), {"of_floor", "over_naive", "two_threads"})


if __name__ == "__main__":
    unittest.main()
