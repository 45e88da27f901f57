# SPDX-License-Identifier: MIT
"""Where a source file can be changed, and what into.

A change is of one line. Sites are looked for by patterns, in the file's text with everything blanked out that no change
may touch: comments, strings, preprocessor lines, template parameters, assertions. There is no parser behind it: what does
not compile is thrown away later.
"""

from __future__ import annotations

import dataclasses
import io
import re
import tokenize
from collections.abc import Callable, Iterator


@dataclasses.dataclass(frozen=True, order=True)
class Mutant:
    """One change of one line."""

    file: str
    line: int  # from 1
    kind: str
    old: str  # the whole line
    new: str

    @property
    def key(self) -> tuple[str, str, str]:
        """What stays the same when lines move."""
        return self.file, self.old.strip(), self.new.strip()


Change = tuple[int, int, str]  # first column, column behind the last, what stands there instead
Finder = Callable[[str], Iterator[Change]]

CPP_BLANKED = re.compile(
    r"""//[^\n]* | /\*.*?\*/ | R"\((?:.|\n)*?\)" | "(?:\\.|[^"\\\n])*" | (?<![0-9a-zA-Z_])'(?:\\.|[^'\\\n])+'
      | ^[ \t]*\#(?:\\\n|[^\n])*""", re.X | re.S | re.M)
# Up to the semicolon, over several lines.
CPP_ASSERTIONS = re.compile(r"\b(?:static_assert|assert|GOFFER_ASSERT)\b[^;]*;")
CPP_TEMPLATES = re.compile(r"\btemplate\s*<")
CPP_DECLARATION = re.compile(r"^\s*(?!return\b|throw\b)(?:(?:alignas\(\w+\)|static|const|constexpr|typename|mutable)\s+)*"
                             r"[\w:]+(?:<[^=()]*>)?[\s&*]+"
                             r"\w+(?:\[[^=()]*\])?(?:,\s*\*?\w+(?:\[[^=()]*\])?)*;", re.M)


def blank(text: str) -> str:
    """Spaces instead of everything but the ends of lines."""
    return re.sub(r"[^\n]", " ", text)


def blanked_cpp(text: str) -> str:
    """C++ less what no change may touch."""
    text = CPP_BLANKED.sub(lambda found: blank(found[0]), text)
    text = CPP_ASSERTIONS.sub(lambda found: blank(found[0]), text)
    while found := CPP_TEMPLATES.search(text):
        end = closing(text, found.end() - 1, "<", ">")
        text = text[:found.start()] + blank(text[found.start():end]) + text[end:]
    return CPP_DECLARATION.sub(lambda found: blank(found[0]), text)


def blanked_python(text: str) -> str:
    """Python less its comments and strings."""
    lines = text.splitlines(keepends=True)
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line))
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type in (tokenize.STRING, tokenize.COMMENT):
            first, last = (starts[row - 1] + column for row, column in (token.start, token.end))
            text = text[:first] + blank(text[first:last]) + text[last:]
    return re.sub(r"^[ \t]*(?:import|from|@)[^\n]*", lambda found: blank(found[0]), text, flags=re.M)


def closing(text: str, at: int, opens: str = "(", closes: str = ")") -> int:
    """The place behind the bracket that closes the one at `at`; behind the text where none does."""
    depth = 0
    for i in range(at, len(text)):
        depth += (text[i] == opens) - (text[i] == closes)
        if depth == 0:
            return i + 1
    return len(text)


def swaps(pattern: str, into: dict[str, tuple[str, ...]]) -> Finder:
    """Replaces the pattern's first group by each of what `into` has for it."""
    expression = re.compile(pattern)

    def find(line: str) -> Iterator[Change]:
        for found in expression.finditer(line):
            for new in into.get(found[1], ()):
                yield found.start(1), found.end(1), new
    return find


def constants(line: str) -> Iterator[Change]:
    """0 becomes 1, whole numbers grow by 1, others are doubled; what is next to nothing becomes 1."""
    for found in re.finditer(r"(?<![\w.<'])(\d+\.?\d*(?:e-?\d+)?)(f|u|)(?![\w.>'])", line):
        digits, suffix = found[1], found[2]
        if digits.isdigit():
            new = str(int(digits) + 1)
        else:
            value = float(digits)
            new = repr(1.0 if value < 1e-5 else 2 * value)
        yield found.start(), found.end(), new + suffix


def cpp_conditions(line: str) -> Iterator[Change]:
    """Negates what stands in an `if` or `while` that ends on its line."""
    for found in re.finditer(r"\b(?:if(?: constexpr)?|while) \(", line):
        end = closing(line, found.end() - 1)
        inner = line[found.end():end - 1]
        if line[end - 1:end] == ")" and ";" not in inner and " = " not in inner:
            yield found.end(), end - 1, f"!({{}})"


def python_conditions(line: str) -> Iterator[Change]:
    """The same of `if` and `while`."""
    if found := re.match(r"\s*(?:if|elif|while) (.+):\s*$", line):
        if ":=" not in found[1]:
            yield found.start(1), found.end(1), "not ({})"


def cpp_returns(line: str) -> Iterator[Change]:
    """Returns the other truth value, or nothing that was worked out."""
    if found := re.search(r"\breturn (.+);\s*$", line):
        value = found[1].strip()
        new = {"true": "false", "false": "true"}.get(value, "{}")
        if value not in ("{}", "0", "nullptr"):
            yield found.start(1), found.end(1), new.replace("{}", "{{}}")


def python_returns(line: str) -> Iterator[Change]:
    """The same."""
    if found := re.match(r"\s*return (.*\S)\s*$", line):
        new = {"True": "False", "False": "True"}.get(found[1], "None")
        if found[1] != "None" and all(found[1].count(a) == found[1].count(b) for a, b in ("()", "[]", "{}")):
            yield found.start(1), found.end(1), new


ASSIGNMENT = r"[*\w.:\->\[\]+]+ [+\-*/|&]?= "


def cpp_statements(line: str) -> Iterator[Change]:
    """Leaves out an assignment or a call."""
    found = re.match(rf"\s*((?:{ASSIGNMENT}.+|(?!return\b|assert\b)[\w:.\->\[\]<>]+\(.*\));)\s*$", line)
    if found and found[1].count("(") == found[1].count(")") and ".reserve(" not in found[1]:
        yield found.start(1), found.end(1), ";"


def python_statements(line: str) -> Iterator[Change]:
    """The same, but for assignments that make a name: without it nothing would run."""
    found = re.match(r"\s*(\w+(?: [+\-*/|]|[\w.\[\]]*[.\[][\w.\[\]]* )= .+|(?!return\b)[\w.\[\]]+\(.*\))\s*$", line)
    if found and all(found[1].count(a) == found[1].count(b) for a, b in ("()", "[]", "{}")):
        yield found.start(1), found.end(1), "pass"


COMMUTATIVE = r"(?<!max)(?<!min)(?<!dot)(?<!distance)"


def arguments(line: str) -> Iterator[Change]:
    """Swaps the two arguments of a call, where both are simple."""
    for found in re.finditer(rf"(?<=\w){COMMUTATIVE}\(([\w.\[\]]+), ([\w.\[\]]+)\)", line):
        if found[1] != found[2]:
            yield found.start(1), found.end(2), f"{found[2]}, {found[1]}"


ARITHMETIC = swaps(r" ([+\-*/]=?) ", {"+": ("-",), "-": ("+",), "*": ("/",), "/": ("*",), "+=": ("-=",), "-=": ("+=",),
                                      "*=": ("/=",), "/=": ("*=",)})
COMPARISON = swaps(r" (<|<=|>|>=|==|!=) ", {"<": ("<=", ">"), "<=": ("<", ">="), ">": (">=", "<"), ">=": (">", "<="),
                                            "==": ("!=",), "!=": ("==",)})
EXTREME = swaps(r"\b(max|min)\(", {"max": ("min",), "min": ("max",)})

CPP: dict[str, Finder] = {
    "arithmetic": ARITHMETIC,
    "multiply-add": swaps(r"\b(madd|nmadd)\(", {"madd": ("nmadd",), "nmadd": ("madd",)}),
    "comparison": COMPARISON,
    "extreme": EXTREME,
    "logic": swaps(r" (&&|\|\|) ", {"&&": ("||",), "||": ("&&",)}),
    "constant": constants,
    "condition": cpp_conditions,
    "return": cpp_returns,
    "statement": cpp_statements,
    "arguments": arguments,
}
PYTHON: dict[str, Finder] = {
    "arithmetic": ARITHMETIC,
    "comparison": COMPARISON,
    "extreme": EXTREME,
    "logic": swaps(r" (and|or|in|not in|is|is not) ", {"and": ("or",), "or": ("and",), "in": ("not in",), "not in": ("in",),
                                                       "is": ("is not",), "is not": ("is",)}),
    "constant": constants,
    "condition": python_conditions,
    "return": python_returns,
    "statement": python_statements,
    "arguments": arguments,
}


def mutants(file: str, text: str) -> list[Mutant]:
    """All changes of a file that are known, in order."""
    python = file.endswith(".py")
    blanked = (blanked_python if python else blanked_cpp)(text).split("\n")
    found = []
    before = ";"  # the last character before the line
    for number, (old, line) in enumerate(zip(text.split("\n"), blanked), 1):
        for kind, find in (PYTHON if python else CPP).items():
            if kind == "statement" and not python and before not in ";{}:":
                continue  # the end of a statement, or what depends on a condition
            for first, last, new in find(line):
                changed = old[:first] + (new.format(old[first:last]) if "{" in new else new) + old[last:]
                if changed != old:
                    found.append(Mutant(file, number, kind, old, changed))
        before = (line.rstrip() or before)[-1]
    return found
