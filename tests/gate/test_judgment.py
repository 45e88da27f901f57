# SPDX-License-Identifier: MIT
"""How often the statistics see what is not there, and what is, on synthetic noise."""

import math
import unittest
import unittest.mock
import warnings

from support import seeded
from gating import judgment

CASES, PAIRS, THRESHOLD = 8, 20, 0.05
NOISES = {
    "normal, 3 %": lambda random: random.gauss(0, 0.03),
    "Student's, two degrees of freedom": lambda random: 0.02 * random.gauss(0, 1) / math.sqrt(random.expovariate(1)),
    "a tenth is off by up to 40 %": lambda random: (random.uniform(-0.35, 0.35) if random.random() < 0.1
                                                    else random.gauss(0, 0.02)),
}


def pairs(random, noise, change=0.0, count=PAIRS):
    """(base, head) on a machine whose speed varies."""
    result = []
    for _ in range(count):
        base = random.uniform(1, 1.5)
        result.append((base, base * (1 + change) * math.exp(noise(random))))
    return result


def gates(random, noise, number, slower_case=0.0):
    """Estimates of so many gates, the first case of each slower by so much."""
    for _ in range(number):
        yield list(judgment.estimates({case: pairs(random, noise, 0 if case else slower_case)
                                        for case in range(CASES)}).values())


class Judgment(unittest.TestCase):
    def setUp(self):  # quicker, and still fine enough
        patch = unittest.mock.patch.object(judgment, "RESAMPLES", 999)
        patch.start()
        self.addCleanup(patch.stop)

    def test_no_change_is_seldom_called_one(self):
        for seed, (name, noise) in enumerate(NOISES.items()):
            with self.subTest(name):
                found = list(gates(seeded(seed), noise, 60))
                called = sum(any(one.slower() for one in gate) for gate in found)
                self.assertLessEqual(called, 5)  # 3 are allowed, in the mean; of one side half of them are expected
                failed = sum(any(one.slower() and one.change > THRESHOLD for one in gate) for gate in found)
                self.assertEqual(failed, 0)

    def test_slowdowns_are_seen(self):
        for seed, (name, noise) in enumerate(NOISES.items()):
            for change, least in ((0.07, 80), (0.15, 97)):
                with self.subTest(f"{name}; {change}"):
                    random = seeded(seed)
                    found = [judgment.estimate(pairs(random, noise, change), CASES) for _ in range(100)]
                    # With Holm's largest factor.
                    seen = sum(one.slower(judgment.ALPHA / CASES) and one.change > THRESHOLD for one in found)
                    self.assertGreaterEqual(seen, least)

    def test_gains_are_seen(self):
        for gate in gates(seeded(5), NOISES["normal, 3 %"], 10, -0.10):
            self.assertTrue(gate[0].faster())
            self.assertFalse(gate[0].slower())

    def test_the_interval_is_wider_for_more_cases(self):
        found = pairs(seeded(6), NOISES["normal, 3 %"])
        one, many = (judgment.estimate(found, cases) for cases in (1, 20))
        self.assertLess(many.low, one.low)
        self.assertGreater(many.high, one.high)
        self.assertEqual(one.change, many.change)

    def test_equal_pairs(self):
        same = judgment.estimate([(2.0, 2.0)] * PAIRS, 1)
        self.assertEqual((same.change, same.low, same.high, same.p), (0, 0, 0, 1))
        slower = judgment.estimate([(2.0, 2.2)] * PAIRS, 1)
        self.assertAlmostEqual(slower.low, 0.1)
        self.assertTrue(slower.slower())

    def test_some_equal_pairs(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            found = judgment.estimate([(2.0, 2.0)] * 3 + pairs(seeded(7), NOISES["normal, 3 %"], 0.1), 1)
        self.assertTrue(found.slower())

    def test_the_interval_and_the_test_must_both_say_so(self):
        def estimate(low, high, p):
            return judgment.Estimate((low + high) / 2, low, high, p, PAIRS)
        for low, p, called in ((0.01, 0.04, True), (0, 0.04, False), (-0.01, 0.04, False), (0.01, 0.06, False),
                               (0.01, judgment.ALPHA, False)):
            with self.subTest(f"{low}; {p}"):
                self.assertEqual(estimate(low, 0.1, p).slower(), called)
                self.assertEqual(estimate(-0.1, -low, p).faster(), called)

    def test_holm(self):
        for got, expected in zip(judgment.holm([0.01, 0.04, 0.03, 0.005]), [0.03, 0.06, 0.06, 0.02]):
            self.assertAlmostEqual(got, expected)
        self.assertEqual(judgment.holm([0.9, 0.8]), [1, 1])

    def test_unclear(self):
        def unclear(low, high):
            return judgment.Estimate(0, low, high, 1, PAIRS).unclear(THRESHOLD)
        self.assertTrue(unclear(-0.04, 0.06))
        self.assertFalse(unclear(-0.2, 0.04))  # whatever it is, it is below the threshold
        self.assertFalse(unclear(0.01, 0.3))  # there is a change
        self.assertFalse(unclear(-0.01, 0.03))


if __name__ == "__main__":
    unittest.main()
