# SPDX-License-Identifier: MIT
"""Pairs: which of the two programs is started first, and what is measured a second time."""

import unittest
import unittest.mock

import support
from gating import judgment, pairs
from gating.outcome import Unmeasured, Verdict

COUNT = 6


class Pairs(support.Case):
    def judge(self, head, threshold):
        """A case whose base always takes 1 and whose head always takes so long: its row, and which pairs were swapped."""
        with unittest.mock.patch.object(pairs, "measure_pair", return_value=(1.0, head)) as measured:
            row, = pairs.Comparison(("base", "head"), COUNT, threshold).judge(["case"])
        return row, [call.kwargs["swapped"] for call in measured.call_args_list if call.kwargs]

    def test_it_tells_which_pair_is_measured(self):
        told = []
        with unittest.mock.patch.object(pairs, "measure_pair", return_value=(1.0, 1.0)):
            pairs.Comparison(("base", "head"), 2, 0.05, told.append).judge(["case"])
        self.assertEqual(told, ["pair 1 of 2: case", "pair 2 of 2: case"])

    def test_both_programs_are_ended_whatever_happens(self):
        runs = [unittest.mock.Mock(), unittest.mock.Mock()]
        runs[0].counters.side_effect = Unmeasured("failed")
        with unittest.mock.patch.object(pairs, "Run", side_effect=runs), self.assertRaises(Unmeasured):
            pairs.measure_pair(("base", "head"), "case", False)
        for run in runs:
            run.stop.assert_called_once_with()

    def test_programs_take_turns_to_be_first(self):
        self.assertEqual(self.judge(1.0, 0.05)[1], [False, True] * (COUNT // 2))

    def test_a_change_above_the_threshold_is_measured_again(self):
        change = judgment.estimate([(1.0, 1.5)] * COUNT, 1).change  # about 0.5
        for threshold, sets, verdict in ((0.99 * change, 2, Verdict.REGRESSION), (change, 1, Verdict.PASS)):
            with self.subTest(threshold):
                row, swapped = self.judge(1.5, threshold)
                self.assertEqual((len(swapped), row.verdict), (sets * COUNT, verdict))


if __name__ == "__main__":
    unittest.main()
