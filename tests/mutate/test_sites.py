#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Where a file can be changed, and what into."""

import sys
import unittest

sys.dont_write_bytecode = True

from mutating.sites import blanked_cpp, blanked_python, mutants  # noqa: E402


def changes(text, file="a.cpp"):
    """Kinds and new lines."""
    return {(one.kind, one.new.strip()) for one in mutants(file, text)}


class Cpp(unittest.TestCase):
    def blanked(self, text):
        found = blanked_cpp(text)
        self.assertEqual([len(line) for line in found.split("\n")], [len(line) for line in text.split("\n")])
        return " ".join(found.split())

    def test_what_is_not_touched(self):
        for text in ("// 1 < 2", "/* 1\n < 2 */", '"1 < 2 \\" 3"', "'1'", "'\\''", 'R"(1 < 2)"', "#include <a1>",
                     "# define A 1 \\\n 2", "static_assert(1 < 2,\n 3);", "assert(a < 1);", "template <class L, int N = 2>",
                     "float matrix[12];",
                     "    alignas(64) float place[4], scale[4];"):
            with self.subTest(text):
                self.assertEqual(self.blanked(text + "\nf(1);"), "f(1);")

    def test_what_is_left(self):
        for text in ("n < 10'000;", "a = b[1]; b = 'a' < c;", "float a[2] = {1, 2};", "return a;"):
            with self.subTest(text):
                self.assertEqual(self.blanked(text).replace(" ", "")[:4], text.replace(" ", "")[:4])

    def test_operators(self):
        self.assertEqual(changes("    const float* a = b + c * d;"),
                         {("arithmetic", "const float* a = b - c * d;"), ("arithmetic", "const float* a = b + c / d;")})
        self.assertEqual(changes("    x.y += b;"), {("arithmetic", "x.y -= b;"), ("statement", ";")})
        self.assertEqual(changes("    const bool a = b < c && d == e;"),
                         {("comparison", "const bool a = b <= c && d == e;"),
                          ("comparison", "const bool a = b > c && d == e;"),
                          ("comparison", "const bool a = b < c && d != e;"), ("logic", "const bool a = b < c || d == e;")})
        self.assertEqual(changes("    const Vec a = L::nmadd(b, std::max(c, d), e);"),
                         {("multiply-add", "const Vec a = L::madd(b, std::max(c, d), e);"),
                          ("extreme", "const Vec a = L::nmadd(b, std::min(c, d), e);")})

    def test_constants(self):
        self.assertEqual(changes("    const auto a = f<3>(0, 7u, 0.5f, 1e-12, b2);"),
                         {("constant", f"const auto a = f<3>({these}, b2);") for these in
                          ("1, 7u, 0.5f, 1e-12", "0, 8u, 0.5f, 1e-12", "0, 7u, 1.0f, 1e-12", "0, 7u, 0.5f, 1.0")})

    def test_conditions_and_returns(self):
        self.assertEqual(changes("    if (f(a)) return true;"),
                         {("condition", "if (!(f(a))) return true;"), ("return", "if (f(a)) return false;")})
        self.assertEqual(changes("    return f(a);"), {("return", "return {};")})
        self.assertEqual(changes("    return {};"), set())

    def test_statements(self):
        self.assertEqual(changes("    f(a);"), {("statement", ";")})
        self.assertEqual(changes("    *a.b[c] = d;"), {("statement", ";")})
        self.assertEqual(changes("    Vec a = d;"), set())
        self.assertEqual(changes("    b.reserve(c);"), set())
        self.assertEqual(changes("    g(b,\n      f(c),\n      d);"), set())

    def test_arguments(self):
        self.assertEqual(changes("    const auto a = f(b, c.d);"), {("arguments", "const auto a = f(c.d, b);")})
        self.assertEqual(changes("    const auto a = max(b, c.d);"), {("extreme", "const auto a = min(b, c.d);")})
        self.assertEqual(changes("void f(int a, int b) {"), set())


class Python(unittest.TestCase):
    def test_what_is_not_touched(self):
        for text in ("# 1 < 2", '"1 < 2"', '"""1\n < 2"""', 'f"{1 < 2}"', "from a1 import b", "@c(1)"):
            with self.subTest(text):
                self.assertEqual(blanked_python(text + "\nf(1)").split(), ["f(1)"])

    def test_changes(self):
        self.assertEqual(changes("if a and b:\n    return c", "a.py"),
                         {("logic", "if a or b:"), ("condition", "if not (a and b):"), ("return", "return None")})
        self.assertEqual(changes("x.y = f(1)\nz = a not in b\nf(a)", "a.py"),
                         {("statement", "pass"), ("constant", "x.y = f(2)"), ("logic", "z = a in b")})


if __name__ == "__main__":
    unittest.main()
