# SPDX-License-Identifier: MIT
"""What people and programs read: the gate's report and history, and the report of a whole benchmark run."""

import contextlib
import io
import json
import pathlib
import shutil
import subprocess
import sys
import unittest

import support
from gating import command, history, report
from gating.outcome import Part, Row, Unmeasured, Verdict

PAIR = {"low": 0.05, "high": 0.2, "p": 0.001, "pairs": 40, "median_of_head": 11.5}


def parts():
    return [Part("counts", [Row("a", Verdict.PASS, 10, 10), Row("allocations", Verdict.REGRESSION, 0, 3),
                            Row("b", Verdict.GAIN, 10, 9, "keep it")]),
            Part("ratios", unmeasured="there | is no program"),
            Part("pairs", [Row("setup/x", Verdict.REGRESSION, 10, 11.2, "seen", dict(PAIR))], ["Busy."])]


class Report(support.Case):
    def test_markdown(self):
        text = report.markdown(parts(), {"head": "abc", "base": ""})
        self.assertTrue(text.startswith("# Benchmark gate: REGRESSION\n\nhead abc. "))
        self.assertIn("| `setup/x` | 10 | 11.2 | +12.0 % | +5.0 % .. +20.0 % | 0.001 | 40 | **REGRESSION**: seen |",
                      text)
        self.assertIn("| `allocations` | 0 | 3 | from 0 to 3 | **REGRESSION** |", text)
        self.assertIn("| `b` | 10 | 9 | -10.0 % | better: keep it |", text)
        self.assertEqual(text.count("| `a` |"), 1)
        self.assertIn("<summary>1 counts within the tolerance</summary>", text)
        self.assertIn("**Could not measure:** there | is no program", text)
        self.assertIn("\nBusy.\n", text)

    def test_json(self):
        document = json.loads(json.dumps(report.document(parts(), {"head": "abc"})))
        self.assertEqual(document["exit_code"], 1)
        self.assertEqual([part["exit_code"] for part in document["parts"]], [1, 2, 1])
        self.assertEqual(document["parts"][2]["rows"][0],
                         {"name": "setup/x", "verdict": "regression", "base": 10, "head": 11.2,
                          "change": document["parts"][2]["rows"][0]["change"], "remark": "seen", **PAIR})

    def test_summary(self):
        self.assertEqual(report.summary(parts()),
                         ["counts: REGRESSION (1 ok, 1 better, 1 REGRESSION)", "  allocations: from 0 to 3 REGRESSION",
                          "  b: -10.0 % better", "ratios: could not measure (there | is no program)",
                          "pairs:  REGRESSION (1 REGRESSION)", "  setup/x: +12.0 % REGRESSION"])


class History(support.Case):
    def test_record_and_read(self):
        path = self.folder / "new" / "h.csv"
        facts = {"head": "abc", "compiler": "GNU 12", "processor": "Some, cpu"}
        history.record(path, parts(), facts)
        history.record(path, parts(), facts | {"processor": "other"})
        history.record(path, parts(), facts | {"head": "def"})
        commits, series = history.read(path)
        self.assertEqual(commits, ["abc", "def"])  # of the last processor alone
        self.assertEqual(series["pairs/setup/x"], {"abc": [11.5], "def": [11.5]})
        self.assertEqual(series["counts/allocations"], {"abc": [3], "def": [3]})

    @unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is not here")
    def test_chart(self):
        path = self.folder / "h.csv"
        for head in ("abc", "def"):
            history.record(path, parts(), {"head": head, "processor": "cpu"})
        chart = history.draw(path).read_text()
        self.assertIn("<svg", chart)
        for words in ("setup/x", "ns per instance", "abc", "def"):
            self.assertIn(words, chart)
        self.assertNotIn("allocations", chart)

    @unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is not here")
    def test_command_draws_it(self):
        path = self.folder / "h.csv"
        for head in ("abc", "def"):
            history.record(path, parts(), {"head": head, "processor": "cpu"})
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            self.assertEqual(command.main(["--chart", str(path)]), 0)
        self.assertIn("<svg", pathlib.Path(out.getvalue().strip()).read_text())

    def test_no_history(self):
        with self.assertRaises(Unmeasured):
            history.draw(self.folder / "none.csv")
        (self.folder / "odd.csv").write_text("a,b\n1,2\n")
        with self.assertRaises(Unmeasured):
            history.draw(self.folder / "odd.csv")


class BenchReport(support.Case):
    """bench/report.py."""

    def test_table(self):
        def run(name, family, **counters):
            return {"name": name, "run_name": name, "run_type": "iteration", "family_index": family, **counters}
        case = "deform/positions/cache/avx2"
        runs = [run("naive/positions", 0, ns_per_vertex=40.0),
                *(run(f"{case}/1", 1, ns_per_vertex=value, of_floor=0.25, bytes_per_second=12e9)
                  for value in (1, 2, 6)),
                run(f"{case}/2", 2, ns_per_vertex=1.0),
                run("setup/instance", 3, ns_per_instance=60.0)]
        context = {"date": "today", "num_cpus": 2, "load_avg": [1, 2, 3],
                   "caches": [{"level": 1, "type": "Data", "size": 32768}]}
        source = self.folder / "run.json"
        source.write_text(json.dumps({"context": context, "benchmarks": runs}))
        subprocess.run([sys.executable, support.ROOT / "bench/report.py", source, self.folder], check=True)
        text = (self.folder / "report.md").read_text()
        self.assertIn("medians of 3 repetitions", text)
        self.assertIn("L1 d 32 KiB", text)
        self.assertIn(f"| {case} | vertex | 2.000 | 125.0 % | 12.0 | 0.25 | 1.000 |  |  |  | 20.0 |", text)
        self.assertIn("| setup/instance | instance | 60.000 |", text)

    def test_faults(self):
        source = self.folder / "run.json"
        source.write_text('{"context": {}, "benchmarks": []}')
        done = subprocess.run([sys.executable, support.ROOT / "bench/report.py", source, self.folder],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("no measurements", done.stderr)


if __name__ == "__main__":
    unittest.main()
