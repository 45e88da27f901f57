# SPDX-License-Identifier: MIT
"""Bounds: the best of several tries, and threads on a busy machine."""

import os
import unittest
import unittest.mock

import support
from gating import machine, ratios
from gating.outcome import Verdict

CASE = "deform/positions/cache/avx2/1"
PAIR = {"deform/packed/crowd/avx2/1": 2.0, "deform/packed/crowd/avx2/2": 1.1}


class Ratios(support.Case):
    def judge(self, bounds, program, others=0.0, reached=4.0):
        with unittest.mock.patch.object(ratios.Others, "processors", return_value=others), \
                unittest.mock.patch.object(ratios, "two_programs", return_value=reached):
            part = ratios.judge({"ratios": bounds}, program, lambda text: None)
        return part, [row.verdict for row in part.rows]

    def test_met_and_missed(self):
        program = self.fake("head", {CASE: 1.0, "naive/positions": 20.0}, spread=0)
        part, verdicts = self.judge({"over_naive": {CASE: 19}, "of_floor": {CASE: 0.25}}, program)
        self.assertEqual(verdicts, [Verdict.PASS, Verdict.REGRESSION])
        self.assertEqual([row.head for row in part.rows], [20, 0.2])
        self.assertEqual(part.exit_code, 1)

    def test_the_best_of_several_tries(self):
        program = self.fake("head", PAIR, spread=0, swing=0.0, change_after=(2, 0.5))
        for bound, verdict in ((1.8, Verdict.PASS), (1.9, Verdict.REGRESSION)):
            self.assertEqual(self.judge({"two_threads": {"deform/packed/crowd/avx2": bound}}, program)[1], [verdict])

    def test_tries_end_when_the_bound_is_met(self):
        program = self.fake("head", {CASE: 1.0}, spread=0)
        self.judge({"of_floor": {CASE: 0.1}}, program)
        self.assertEqual((self.folder / "head.runs").read_text(), ".")
        self.judge({"of_floor": {CASE: 0.3}}, program)
        self.assertEqual((self.folder / "head.runs").read_text(), "." * (1 + ratios.TRIES))

    def test_the_machine_has_a_name(self):
        self.assertRegex(machine.processor(), r"\S")

    def test_threads_on_a_busy_machine_are_not_judged(self):
        program = self.fake("head", PAIR, spread=0)
        bounds = {"two_threads": {"deform/packed/crowd/avx2": 1.9}}
        part, verdicts = self.judge(bounds, program, others=0.8)
        self.assertEqual(verdicts, [Verdict.NOTE])
        self.assertIn("busy", part.rows[0].remark)
        self.assertEqual(part.exit_code, 0)

    def test_threads_where_two_processors_are_not_worth_two(self):
        bounds = {"two_threads": {"deform/packed/crowd/avx2": 1.9}}
        for reached, verdict in ((2.0, Verdict.NOTE), (2.2, Verdict.REGRESSION)):
            with self.subTest(reached):
                part, verdicts = self.judge(bounds, self.fake("head", PAIR, spread=0), reached=reached)  # 1.82
                self.assertEqual(verdicts, [verdict])
        self.assertEqual(part.exit_code, 1)

    def test_one_bad_moment_of_two_programs_is_no_excuse(self):
        bounds = {"two_threads": {"deform/packed/crowd/avx2": 1.9}}
        with unittest.mock.patch.object(ratios.Others, "processors", return_value=0), \
                unittest.mock.patch.object(ratios, "two_programs", side_effect=(2.3, 2.3, 1.2, 2.3)):
            part = ratios.judge({"ratios": bounds}, self.fake("head", PAIR, spread=0), lambda text: None)
        self.assertEqual([row.verdict for row in part.rows], [Verdict.REGRESSION])

    def test_two_programs(self):
        program = self.fake("head", PAIR, spread=0, change_after=(1, 1.6))  # 2.0 alone, 3.2 beside each other
        self.assertAlmostEqual(ratios.two_programs(program, "deform/packed/crowd/avx2/1"), 1.25)
        self.assertEqual((self.folder / "head.runs").read_text(), "." * 3)

    def test_cases_that_are_not_there(self):
        part, verdicts = self.judge({"of_floor": {"deform/positions/cache/avx512/1": 0.1}}, self.fake("head"))
        self.assertEqual(verdicts, [Verdict.NOTE])  # this machine lacks the instruction set
        self.assertEqual(part.exit_code, 0)
        part, verdicts = self.judge({"of_floor": {"deform/renamed/cache/avx2/1": 0.1}}, self.fake("head"))
        self.assertEqual(verdicts, [Verdict.REGRESSION])
        self.assertIn("no such case", part.rows[0].remark)
        part, _ = self.judge({"of_flor": {CASE: 0.1}}, self.fake("head"))
        self.assertIn("of_flor", part.unmeasured)

    def test_failing(self):
        part, _ = self.judge({"of_floor": {CASE: 0.1}}, self.fake("head", fault="exit"))
        self.assertIn("it went wrong", part.unmeasured)
        self.assertEqual(part.exit_code, 2)
        self.assertEqual(self.judge({}, self.fake("head"))[0].exit_code, 2)

    def test_how_busy_others_are(self):
        def stat(*ticks):
            return unittest.mock.mock_open(read_data="cpu  " + " ".join(map(str, ticks)) + "\ncpu0 1 2 3 4 5 6 7 8 9 10\n")
        second = os.sysconf("SC_CLK_TCK")
        for column, counts in enumerate((True, True, True, False, False, True, True, True, False, False)):
            before = [500 * second] * 10
            after = [ticks + 12 * second * (i == column) for i, ticks in enumerate(before)]
            with self.subTest(column), unittest.mock.patch.object(machine.time, "monotonic", side_effect=(100, 110)), \
                    unittest.mock.patch.object(machine, "_own_seconds", side_effect=(1, 3)):
                with unittest.mock.patch("builtins.open", stat(*before)):
                    others = machine.Others()
                with unittest.mock.patch("builtins.open", stat(*after)):
                    self.assertAlmostEqual(others.processors(), 1.0 if counts else 0.0)

    def test_one_processor_is_remarked_on(self):
        program = self.fake("head", {CASE: 1.0}, spread=0)
        for processors, remarks in ((1, ["This machine has one processor: nothing is said of two threads."]), (2, [])):
            with self.subTest(processors), unittest.mock.patch.object(ratios.os, "cpu_count", return_value=processors):
                self.assertEqual(self.judge({"of_floor": {CASE: 0.1}}, program)[0].remarks, remarks)

    def test_naive_of(self):
        self.assertEqual(ratios.naive_of("deform/interleaved-positions/cache/avx2/1"), "naive/positions")


if __name__ == "__main__":
    unittest.main()
