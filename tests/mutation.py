#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Breaks the runtime in small ways, one at a time, and counts how many of them its tests notice.

    python3 tests/mutation.py [--groups kernels,validator,planner] [--count 40] [--seed 1] [--work build/mutation]

Mutants are chosen from all places where an operator, a constant, a condition or a statement can be changed, by a fixed
seed, `count` from each group of files; a larger count begins with the same mutants. Each is compiled, and the fast tests
of its group run until one fails, crashes or takes too long: then it is killed. Survivors are printed. Those that
mutation_equivalent.txt lists with a reason do not count. Exit status 1 if fewer than 95 % of the others are killed. After
a change of the files other mutants are chosen; --only tries some again.

Not a part of the CI: 120 mutants take about half an hour on two cores, the first build included.
"""

import argparse
import os
import random
import re
import shutil
import subprocess
import sys
import time

SOURCE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SLOWER = 4  # times the time of the unbroken tree, and three seconds more, are too slow

GROUPS = {
    "kernels": {
        "files": ["simd/evaluate_body.h", "simd/sums.h", "simd/pieces.h", "simd/light.h", "simd/formats.h", "simd/stores.h",
                  "simd/base_body.h", "simd/control_normals_body.h", "simd/refine_body.h", "simd/skin_body.h",
                  "simd/morph.h", "simd/lanes_avx2.h", "simd/lanes_scalar.h", "simd/quads_x86.h"],
        "tests": ["files", "kernels", "kernels quads", "quads", "skin", "kernels fast", "kernels fast quads", "light",
                  "channels", "poses"],
    },
    "validator": {
        "files": ["runtime/pack.c", "runtime/pack_character.c", "runtime/chunks.h", "runtime/checksum.c"],
        "tests": ["files", "pack", "pack_pieces", "pack_character", "channels"],
    },
    "planner": {
        "files": ["runtime/plan.c", "runtime/lod.c", "runtime/edge_error.h", "runtime/templates.c", "runtime/base.c",
                  "runtime/view.c"],
        "tests": ["files", "view_planes", "templates", "base", "frames"],
    },
}

# What a line may become: a pattern, and what its match is replaced by. Operators have spaces on both sides, thanks to
# clang-format, so that pointers and casts are left alone.
OPERATORS = [
    (r" < ", " <= "), (r" <= ", " < "), (r" > ", " >= "), (r" >= ", " > "), (r" == ", " != "), (r" != ", " == "),
    (r" \+ ", " - "), (r" - ", " + "), (r" \* ", " + "), (r" / ", " * "), (r" % ", " / "),
    (r" && ", " || "), (r" \|\| ", " && "), (r" & ", " | "), (r" \| ", " & "), (r" << ", " >> "), (r" >> ", " << "),
    (r" \+= ", " -= "), (r" -= ", " += "), (r" \|= ", " &= "), (r" &= ", " |= "), (r"\+\+", "--"),
    (r"\btrue\b", "false"), (r"\bfalse\b", "true"), (r"\bLIMN_OK\b", "LIMN_ERROR_HOST"),
    (r"(?<![\w.\[])0(?![\w.])", "1"), (r"(?<![\w.])1(?![\w.])", "2"), (r"(?<![\w.])2(?![\w.])", "3"),
    (r"(?<![\w.])([3-9]|[1-9]\d+)(?![\w.])", lambda m: str(int(m.group(1)) + 1)),
    (r"\b0\.5f?\b", "0.25f"), (r"\(!", "("), (r"if \((?!!)([^()]*)\)", r"if (!(\1))"),
]
STATEMENT = re.compile(r"^\s+(?=\S)(?!return\b|\w+ \**\w)([\w.\->\[\]*+ ]+ [-+|&*]?= .*|\w+\(.*\));$")
FIRST_LINE = re.compile(r"([;{}:]|\belse|\b(if|for|while) \(.*\))$")  # of what stands before a statement
SKIPPED = re.compile(r"^\s*(#|//|/\*|\*)|LIMNI_REQUIRE|static_assert|_Static_assert|^\s*\.?\w+ = \"|^\w")


def mutants_of(root, path):
    """All mutants of a file: (path, line number, line, mutated line)."""
    found = []
    comment, before = False, ";"
    for number, line in enumerate(open(os.path.join(root, path)).read().split("\n")):
        opens = comment
        comment = (comment or "/*" in line) and "*/" not in line
        if opens or comment or SKIPPED.search(line):
            continue
        code = re.sub(r"\s*//.*$", "", line)
        begins, before = bool(FIRST_LINE.search(before)), code or before
        for pattern, replacement in OPERATORS:
            if pattern == r"\+\+" and "for (" in code:
                continue  # it would not end
            for match in re.finditer(pattern, code):
                changed = code[:match.start()] + match.expand(replacement) + code[match.end():] \
                    if isinstance(replacement, str) else code[:match.start()] + replacement(match) + code[match.end():]
                if changed != code:
                    found.append((path, number, line, changed))
        if begins and STATEMENT.match(code):
            found.append((path, number, line, re.match(r"\s*", code).group() + ";"))
        if re.match(r"\s+if \(.*\) return .*;$", code):
            found.append((path, number, line, ";"))
    return found


def choose(root, group, first, count, seed):
    everything = [mutant for path in GROUPS[group]["files"] for mutant in mutants_of(root, path)]
    random.Random(seed).shuffle(everything)
    return len(everything), sorted(everything[first:count])


def read_equivalents():
    """Keys (path, line, mutated line) of those that change nothing that can be seen."""
    keys = set()
    for line in open(os.path.join(SOURCE, "tests/mutation_equivalent.txt")):
        parts = [part.strip() for part in line.split(" || ")]
        if len(parts) == 4:
            keys.add(tuple(parts[:3]))
    return keys


class Tree:
    """A copy of the repository, built with assertions, in which one line at a time is changed."""

    def __init__(self, work):
        self.limits, self.originals = {}, {}
        self.source, self.build = os.path.join(work, "source"), os.path.join(work, "build")
        shutil.rmtree(self.source, ignore_errors=True)
        shutil.copytree(SOURCE, self.source, ignore=shutil.ignore_patterns("build", ".git", "out"))
        for group in GROUPS.values():  # what an earlier run built of them may have been a mutant
            for path in group["files"]:
                os.utime(os.path.join(self.source, path))
        flags = ["-DCMAKE_BUILD_TYPE=None", "-DCMAKE_C_FLAGS=-O1 -w", "-DLIMN_ISAS=scalar;avx2", "-DLIMN_BUILD_VIEWER=OFF",
                 "-DLIMN_BUILD_BENCH=OFF", "-DLIMN_BUILD_EXAMPLES=OFF", "-DLIMN_INSTALL=OFF",
                 "-DCMAKE_DISABLE_FIND_PACKAGE_OpenSubdivCPU=ON"]
        # The sanitizers of the CI would see what steps outside of an array, or shifts too far.
        with open(os.path.join(self.source, "runtime/CMakeLists.txt"), "a") as file:
            file.write("target_compile_options(limn_runtime PRIVATE -fsanitize=bounds,shift -fsanitize-undefined-trap-on-error)\n")
        if shutil.which("ccache"):
            flags += ["-DCMAKE_C_COMPILER_LAUNCHER=ccache", "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"]
        subprocess.run(["cmake", "-S", self.source, "-B", self.build, "-G", "Ninja", *flags], check=True,
                       stdout=subprocess.DEVNULL)
        # A few small meshes: the tests that read whole folders are to be fast.
        self.assets = os.path.join(work, "assets")
        shutil.rmtree(self.assets, ignore_errors=True)
        os.makedirs(self.assets)
        os.makedirs(os.path.join(work, "docs"), exist_ok=True)
        shutil.copy(os.path.join(SOURCE, "docs/box.obj"), os.path.join(work, "docs"))
        for name in ["cube.off", "sail.obj", "torus32.obj", "imp.obj", "mug.obj"]:
            shutil.copy(os.path.join(SOURCE, "assets", name), self.assets)

    def make(self, tests):
        targets = sorted({"test_" + test.split()[0] for test in tests})
        return subprocess.run(["cmake", "--build", self.build, "--target", *targets], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)

    def run(self, test):
        """The failure of a test, or None."""
        name, *arguments = test.split()
        if name == "files":
            arguments = [os.path.join(self.source, "tests/compatibility")]
        start = time.time()
        environment = dict(os.environ, LIMN_ASSETS=self.assets, LIMN_TEST_ASSETS="")
        try:
            done = subprocess.run([os.path.join(self.build, "tests/test_" + name), *arguments], env=environment,
                                  timeout=self.limits.get(test), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                  cwd=os.path.join(self.build, "tests"))
        except subprocess.TimeoutExpired:
            return test + ": too slow"
        self.limits.setdefault(test, SLOWER * (time.time() - start) + 3)
        return f"{test}: {done.returncode}" if done.returncode else None

    def write(self, path, number=None, changed=None):
        place = os.path.join(self.source, path)
        if path not in self.originals:
            self.originals[path] = open(place).read()
        lines = self.originals[path].split("\n")
        if number is not None:
            lines[number] = changed
        with open(place, "w") as file:
            file.write("\n".join(lines))


def try_mutant(tree, mutant, tests):
    """"invalid" if it does not compile, what killed it, or None."""
    path, number, _, changed = mutant
    tree.write(path, number, changed)
    try:
        if tree.make(tests).returncode:
            return "invalid"
        for test in tests:
            killer = tree.run(test)
            if killer:
                return killer
        return None
    finally:
        tree.write(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--groups", default=",".join(GROUPS))
    parser.add_argument("--count", type=int, default=40, help="mutants of each group")
    parser.add_argument("--skip", type=int, default=0, help="leave out the first of them")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--work", default=os.path.join(SOURCE, "build/mutation"))
    parser.add_argument("--only", help="those at these places: file:line,file:line")
    parser.add_argument("--list", action="store_true", help="say which, and do nothing")
    options = parser.parse_args()

    equivalents = read_equivalents()
    killed = survived = equivalent = invalid = 0
    tree = None if options.list else Tree(options.work)
    for group in options.groups.split(","):
        tests = GROUPS[group]["tests"]
        total, chosen = choose(tree.source if tree else SOURCE, group, options.skip, options.count, options.seed)
        if options.only:
            chosen = [mutant for mutant in chosen if f"{mutant[0]}:{mutant[1] + 1}" in options.only.split(",")]
        print(f"{group}: {len(chosen)} of {total} mutants", flush=True)
        if tree:
            built = tree.make(tests)
            failures = [tree.run(test) for test in tests] if built.returncode == 0 else [built.stdout.decode()]
            if any(failures):
                sys.exit(f"the unbroken tree fails: {[f for f in failures if f]}")
        for mutant in chosen:
            path, number, line, changed = mutant
            start = time.time()
            is_known = (path, line.strip(), changed.strip()) in equivalents
            result = "equivalent" if is_known else "listed" if options.list else try_mutant(tree, mutant, tests)
            equivalent += result == "equivalent"
            invalid += result == "invalid"
            survived += result is None
            killed += result not in (None, "invalid", "equivalent", "listed")
            print(f"{path}:{number + 1}: {result or 'SURVIVED'} ({time.time() - start:.0f} s)", flush=True)
            if result is None or options.list:
                print(f"    - {line.strip()}\n    + {changed.strip()}", flush=True)
    counted = killed + survived
    share = 100 * killed / counted if counted else 0
    print(f"{killed} of {counted} killed, {share:.1f} %; {survived} survived; {equivalent} more are equivalent, "
          f"{invalid} did not compile")
    return 0 if options.list or share >= 95 else 1


if __name__ == "__main__":
    sys.exit(main())
