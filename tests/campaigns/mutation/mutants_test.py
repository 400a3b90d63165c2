#!/usr/bin/env python3
"""Tests of the mutation test: the mutants it makes, the draw, and its results for a small project."""
import csv
import importlib.machinery
import importlib.util
import itertools
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from mutants import OPERATORS, Source, blank, draw  # noqa: E402


def load_run():
    loader = importlib.machinery.SourceFileLoader("run", str(HERE / "run"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("run", loader))
    sys.modules["run"] = module
    loader.exec_module(module)
    return module


run = load_run()


def mutated(body, operator):
    """Returns the bodies that an operator makes of the body of a function."""
    text = "void f() {\n" + body + "\n}\n"
    found = [mutant.apply(text) for mutant in Source("lib/a.cpp", text).mutants() if mutant.operator == operator]
    return [one[len("void f() {\n"):-len("\n}\n")] for one in found]


class Operators(unittest.TestCase):
    def test_sign(self):
        self.assertEqual(mutated("x = a + b;", "sign"), ["x = a - b;"])
        self.assertEqual(mutated("x += -b;", "sign"), ["x -= -b;", "x += b;"])
        self.assertEqual(mutated("x = add(v, negate(w));", "sign"), ["x = subtract(v, negate(w));", "x = add(v, (w));"])
        self.assertEqual(mutated("--x;", "sign"), [])

    def test_boundary(self):
        self.assertEqual(mutated("if (i < n) g(max(i, n));", "boundary"),
                         ["if (i <= n) g(max(i, n));", "if (i < n) g(min(i, n));"])
        self.assertEqual(mutated("x = y[4u];", "boundary"), ["x = y[3u];", "x = y[5u];"])
        self.assertEqual(mutated("Span<int> x = y<int>();", "boundary"), [])
        self.assertEqual(mutated("x = Real(0.5);", "boundary"), [])

    def test_order(self):
        self.assertEqual(mutated("x = height - size;", "order"), ["x = size - height;"])
        self.assertEqual(mutated("return less(item, other.part(0));", "order"), ["return less(other.part(0), item);"])
        self.assertEqual(mutated("x = dot(first, second);", "order"), [])
        self.assertEqual(mutated("x = body_a + body_b;", "order"), ["x = body_b + body_b;", "x = body_a + body_a;"])
        self.assertEqual(mutated("x = a;", "order"), [], "there is no b")
        self.assertEqual(mutated("Real less(const Real& v, Real w);", "order"), [], "a declaration")

    def test_count(self):
        self.assertEqual(mutated("report.lost += pool.drop();", "count"), ["static_cast<void>(pool.drop());"])
        self.assertEqual(mutated("++count_;", "count"), ["{}"])
        self.assertEqual(mutated("if (full) count++;", "count"), ["if (full) {}"])
        self.assertEqual(mutated("while (x < y) ++x;", "count"), [])
        self.assertEqual(mutated("for (int i = 0; i < n; ++i) g(i);", "count"), [])

    def test_call(self):
        self.assertEqual(mutated("cache.visits.set(slot);", "call"), ["{}"])
        self.assertEqual(mutated("if (woken) wake<true>(state, slot);", "call"), ["if (woken) {}"])
        self.assertEqual(mutated("x.for_each([&](int i) { g(i); });", "call"), ["{}", "x.for_each([&](int i) { {} });"])
        self.assertEqual(mutated("Lab lab(capacity);", "call"), [])

    def test_field(self):
        self.assertEqual(mutated("info.count = mesh.count();", "field"), ["static_cast<void>(mesh.count());"])
        self.assertEqual(mutated("return Info{first, 0, other(1, 2)};", "field"),
                         ["return Info{{}, 0, other(1, 2)};", "return Info{first, 0, {}};"])
        self.assertEqual(mutated("Def def = {.size = size};", "field"), ["Def def = {.size = {}};"])
        self.assertEqual(mutated("Def& operator=(const Def&) = delete;", "field"), [])

    def test_condition_and_logic(self):
        self.assertEqual(mutated("if (const int x = g(); x < y && z) return;", "condition"),
                         ["if (const int x = g(); !(x < y && z)) return;"])
        self.assertEqual(mutated("x = y && z;", "logic"), ["x = y || z;"])
        self.assertEqual(mutated("auto&& x = y;", "logic"), [])

    def test_jump(self):
        self.assertEqual(mutated("if (x) return y;\nreturn z;", "jump"), ["if (x) {}\nreturn z;"])
        self.assertEqual(mutated("if (x) {\n++y;\ncontinue;\n}", "jump"), ["if (x) {\n++y;\n{}\n}"])

    def test_only_code_is_mutated(self):
        text = '#define F(x) \\\n  (x + 1)\nint f() { // a + b\n  static_assert(2 < 3); /* c\n+ d */ g("x + y", \'+\'); }\n'
        self.assertEqual([mutant.before for mutant in Source("lib/a.cpp", text).mutants() if mutant.operator != "order"],
                         ['+ d */ g("x + y", \'+\'); }'])
        self.assertEqual([len(line) for line in blank(text).split("\n")], [len(line) for line in text.split("\n")])


LIBRARY = """
int f(int a, int b) {
  if (a < b) return a - b;
  int sum = 0;
  for (int i = 0; i < a; ++i) sum += i * b;
  return sum;
}
"""


class Draw(unittest.TestCase):
    sources = [("lib/base/a.cpp", LIBRARY), ("lib/base/b.cpp", LIBRARY * 9)]

    def test_the_seed_decides_the_draw(self):
        def first(seed, sources=self.sources):
            return [[mutant.id for mutant in itertools.islice(pool, 5)] for pool in draw(sources, seed).values()]
        self.assertEqual(first(3), first(3))
        self.assertEqual(first(3), first(3, self.sources[::-1]))
        self.assertNotEqual(first(3), first(4))

    def test_each_mutant_is_drawn_once_and_more_of_them_in_the_larger_file(self):
        pools = draw(self.sources, 1)
        self.assertEqual(list(pools), OPERATORS)
        for pool in pools.values():
            drawn = list(pool)
            self.assertEqual(len({mutant.id for mutant in drawn}), len(drawn))
            self.assertEqual(len(drawn), sum(mutant.operator == drawn[0].operator for path, text in self.sources
                                             for mutant in Source(path, text).mutants()) if drawn else 0)
        early = list(itertools.islice(draw(self.sources, 1)["boundary"], 20))
        self.assertGreater(sum(mutant.path == "lib/base/b.cpp" for mutant in early), 12)

    def test_an_id_does_not_depend_on_line_numbers(self):
        here = {mutant.id for mutant in Source("lib/a.cpp", LIBRARY).mutants()}
        below = {mutant.id for mutant in Source("lib/a.cpp", "// more\n\n" + LIBRARY).mutants()}
        self.assertEqual(here, below)


PROJECT = {
    "CMakeLists.txt": """cmake_minimum_required(VERSION 3.25)
project(small CXX)
add_compile_options(-Wall -Werror)
add_library(detent_fx64 STATIC lib/base/sum.cpp lib/world/far.cpp)
enable_testing()
add_subdirectory(tests/unit/base)
add_subdirectory(tests/unit/world)
""",
    "lib/CMakeLists.txt": "add_subdirectory(base)\nadd_subdirectory(world)\n",
    "lib/base/sum.cpp": """int sum_below(int n) {
  int sum = 0;
  for (int i = 0; i < n; ++i) sum += i;
  return sum;
}
int unseen(int n) { return n + 1; }
int idle(int n) { return sizeof(int) == 3 ? n + 2 : n; }
""",
    "lib/world/far.cpp": "int far(int n) { return n + 3; }\n",
    "tests/unit/base/CMakeLists.txt": """add_executable(base_test test.cpp)
target_link_libraries(base_test detent_fx64)
add_test(NAME base COMMAND base_test)
""",
    "tests/unit/base/test.cpp": """int sum_below(int n);
int unseen(int n);
int idle(int n);
int main(int count, char**) {
  const int twice = unseen(count) + idle(count);
  return sum_below(4) == 6 ? 0 * twice : 1;
}
""",
    "tests/unit/world/CMakeLists.txt": """add_executable(world_test test.cpp)
target_link_libraries(world_test detent_fx64)
add_test(NAME world COMMAND world_test)
""",
    "tests/unit/world/test.cpp": "int sum_below(int n);\nint main() { return sum_below(2) == 1 ? 0 : 1; }\n",
    ".gitignore": "/build/\n",
}


@unittest.skipUnless(all(map(shutil.which, ("cmake", "ninja", "git", "c++"))), "needs cmake, ninja, git and a compiler")
class Run(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = Path(cls.folder.name)
        for name, text in PROJECT.items():
            (cls.root / name).parent.mkdir(parents=True, exist_ok=True)
            (cls.root / name).write_text(text)
        subprocess.run(["git", "init", "-q"], cwd=cls.root, check=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def judge(self, *arguments):
        done = subprocess.run([sys.executable, str(HERE / "run"), "--root", str(self.root), *arguments], capture_output=True,
                              text=True)
        self.assertIn("results:", done.stdout, done.stdout + done.stderr)
        with open(self.root / "build/mutation/results.csv", newline="") as file:
            return done, list(csv.DictReader(file))

    def mutant(self, path, before, after):
        for mutant in Source(path, PROJECT[path]).mutants():
            if before in mutant.before and after in mutant.after:
                return mutant
        self.fail(f"no mutant {after}")

    def only(self, *wanted):
        found = [self.mutant(*one) for one in wanted]
        done, rows = self.judge(*itertools.chain.from_iterable(("--only", mutant.id) for mutant in found))
        results = {row["id"]: (row["result"], row["test"]) for row in rows}
        return done, [results[mutant.id] for mutant in found]

    def test_each_result_is_reported(self):
        base = "lib/base/sum.cpp"
        done, results = self.only(
            (base, "sum += i", "i <= n"),
            (base, "sum += i", "++i) static_cast<void>(i);"),
            (base, "unseen", "n - 1"),
            (base, "idle", "n - 2"),
            (base, "sum += i", "n < i"),
            ("lib/world/far.cpp", "far", "n - 3"))
        self.assertEqual(results, [("killed", "base_test"), ("killed", "base_test"), ("survived", ""), ("same_code", ""),
                                   ("killed", "base_test"), ("not_reached", "")])
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, r"all +5 +3 +1 +1 +60.0 %")
        old = self.root / "build/old.csv"
        shutil.copyfile(self.root / "build/mutation/results.csv", old)
        again, rows = self.judge("--again", str(old))
        self.assertEqual(len(rows), 6, "those of the other mutants are kept")
        self.assertEqual(len(re.findall("min left", again.stdout)), 2)
        self.assertRegex(again.stdout, r"all +5 +3 +1 +1 +60.0 %")
        self.assertIn("survived", done.stdout)
        self.assertEqual((self.root / base).read_text(), PROJECT[base], "the sources themselves are unchanged")

    def test_a_mutant_listed_as_equivalent_is_not_judged(self):
        mutant = self.mutant("lib/base/sum.cpp", "unseen", "n - 1")
        judged = self.root / "tests/campaigns/mutation/equivalent.csv"
        judged.parent.mkdir(parents=True)
        with open(judged, "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["file", "before", "after", "reason"])
            writer.writerow([mutant.path, mutant.before, mutant.after, "its value is unused"])
        done, results = self.only(("lib/base/sum.cpp", "unseen", "n - 1"))
        shutil.rmtree(judged.parent)
        self.assertEqual(results, [("equivalent", "")])
        self.assertEqual(done.returncode, 0)

    def test_a_patch_with_an_endless_loop_is_a_timeout(self):
        patch = self.root / "build/endless.patch"
        patch.parent.mkdir(exist_ok=True)
        patch.write_text("--- a/lib/base/sum.cpp\n+++ b/lib/base/sum.cpp\n@@ -2,3 +2,3 @@\n   int sum = 0;\n"
                         "-  for (int i = 0; i < n; ++i) sum += i;\n+  for (volatile int i = 0; i < n;) sum = i;\n"
                         "   return sum;\n")
        done, rows = self.judge("--patch", str(patch))
        self.assertEqual([(row["id"], row["result"], row["test"]) for row in rows], [("endless", "timeout", "base_test")])
        self.assertEqual(done.returncode, 0)

    def test_the_count_excludes_replaced_mutants_and_resume_judges_none_again(self):
        done, rows = self.judge("--count", "4", "--seed", "2")
        self.assertEqual(sum(row["result"] in run.COUNTED for row in rows), 4)
        again, _ = self.judge("--count", "4", "--seed", "2", "--resume")
        self.assertNotIn("min left", again.stdout, "all of it is known")


if __name__ == "__main__":
    unittest.main()
